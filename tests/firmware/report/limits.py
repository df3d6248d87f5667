# SPDX-License-Identifier: BSD-3-Clause
"""What the report promises, checked against what was measured."""

SYMBOLS = {"sqrtf", "sqrt", "memcpy", "memset"}
SOFT = {"M0+", "M3"}  # cores without an FPU

# M4F, -O2, contraction off. (row, column, limit)
WANTED = [
    ("wall_trusted", "text", 600),
    ("wall_trusted", "worst", 120),
    ("wall_strict", "text", 600),
    ("wall_strict", "worst", 120),
    ("triangle_thesis", "text", 4096),
    ("triangle_thesis", "worst", 1200),
    ("triangle_thesis", "stack", 512),
]
RATIO = 1.05


def soft_double(symbol):
    """Is it one of the routines that compute doubles without an FPU?"""
    return symbol.startswith("__aeabi_d") or symbol in ("__aeabi_f2d", "__aeabi_i2d", "__aeabi_l2d")


def violations(rows):
    """What must never happen, in any image: a list of sentences."""
    found = []
    for row in rows:
        name = " ".join((row["scene"], row["author"], row["core"], row["scalar"], row["flags"]))
        if row["data"] or row["bss"]:
            found.append(f"{name}: {row['data']} bytes of data and {row['bss']} of bss, not 0")
        for symbol in row["undefined"]:
            if row["scalar"] == "float" and soft_double(symbol):
                found.append(f"{name}: calls {symbol}: a double has crept in")
            elif symbol not in SYMBOLS and not symbol.startswith("__aeabi_"):
                found.append(f"{name}: needs {symbol} from outside")
            elif symbol.startswith("__aeabi_") and row["core"] not in SOFT:
                found.append(f"{name}: calls {symbol} although the core has an FPU")
    return found
