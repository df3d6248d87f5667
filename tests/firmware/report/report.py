# SPDX-License-Identifier: BSD-3-Clause
"""Writes firmware.json and firmware.md from what measure.py left: report.py OUT FOLDER...

Fails on what must never happen: data or bss in a tick, a symbol from outside, a soft double."""

import json
import pathlib
import sys

import limits

HEAD = ["scene", "core", "scalar", "flags", "text B", "state B", "stack B", "best", "median",
        "worst", "text / by hand", "instructions / by hand", "from outside"]


def gather(folders):
    images = [json.loads((pathlib.Path(f) / "measured.json").read_text()) for f in folders]
    if len({image["compiler"] for image in images}) != 1:
        sys.exit("images of different compilers: build them again")
    return images


def key(row):
    return tuple(row[k] for k in ("scene", "core", "scalar", "flags"))


def table(head, lines):
    text = "| " + " | ".join(head) + " |\n|" + "---|" * len(head) + "\n"
    return text + "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def pairs(rows):
    """Each composed row with its twin by hand."""
    by_hand = {key(row): row for row in rows if row["author"] == "by_hand"}
    return [(row, by_hand[key(row)]) for row in rows if row["author"] == "composed"]


def main_table(rows):
    lines = []
    for row, twin in pairs(rows):
        outside = " ".join(row["undefined"]) or "nothing"
        if row["core"] == "M3" and row["undefined"]:
            outside = "soft float"
        lines.append(list(key(row)) + [row["text"], row["state"], row["stack"], row["best"],
                     row["median"], row["worst"], f"{row['text'] / twin['text']:.3f}",
                     f"{row['sum'] / twin['sum']:.3f}", outside])
    return table(HEAD, lines)


def wanted_table(rows):
    found = {key(row): (row, twin) for row, twin in pairs(rows)}
    at = ("M4F", "float", "-O2, contraction off")
    lines = []
    for scene, column, most in limits.WANTED:
        row, twin = found[(scene,) + at]
        lines.append([scene, column, f"≤ {most}", row[column], twin[column],
                      "yes" if row[column] <= most else "**no**"])
    for (scene, *where), (row, twin) in found.items():
        if tuple(where) != at:
            continue
        for what, ratio in (("text / by hand", row["text"] / twin["text"]),
                            ("instructions / by hand", row["sum"] / twin["sum"]),
                            ("worst / by hand", row["worst"] / twin["worst"])):
            lines.append([scene, what, f"≤ {limits.RATIO}", f"{ratio:.3f}", "1",
                          "yes" if ratio <= limits.RATIO else "**no**"])
    return table(["scene", "figure", "wanted", "measured", "by hand", "met"], lines)


def kinds(row):
    """Instructions per tick by what they do."""
    groups = dict.fromkeys(["FPU arithmetic", "√ and ÷", "FPU compare, flags",
                            "FPU load, store, move", "integer load, store",
                            "branch, call, condition", "integer"], 0)
    for name, count in row["operations"].items():
        if name.startswith(("vdiv", "vsqrt")):
            group = "√ and ÷"
        elif name.startswith(("vcmp", "vmrs")):
            group = "FPU compare, flags"
        elif name.startswith(("vldr", "vstr", "vmov", "vldm", "vstm", "vpush", "vpop", "vsel")):
            group = "FPU load, store, move"
        elif name.startswith("v"):
            group = "FPU arithmetic"
        elif name.startswith(("ldr", "str", "ldm", "stm", "push", "pop", "ldrd", "strd")):
            group = "integer load, store"
        elif name.startswith(("b.", "bl", "bx", "cb", "it", "beq", "bne", "bgt", "bge", "ble",
                              "bhi", "bmi", "bpl", "bcc", "bcs", "bvs", "bvc")) or name == "b":
            group = "branch, call, condition"
        else:
            group = "integer"
        groups[group] += count
    return {group: count / row["ticks"] for group, count in groups.items()}


def where_table(rows):
    lines, head = [], None
    for row in rows:
        if (row["core"], row["flags"]) != ("M4F", "-O2, contraction off") or not row["operations"]:
            continue
        means = kinds(row)
        head = ["scene", "author"] + list(means) + ["sum"]
        lines.append([row["scene"], row["author"]] + [f"{n:.1f}" for n in means.values()]
                     + [f"{sum(means.values()):.1f}"])
    return table(head, lines) if lines else "The QEMU here loads no plugins: not counted.\n"


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    out, images = pathlib.Path(sys.argv[1]), gather(sys.argv[2:])
    rows = [row for image in images for row in image["rows"]]
    out.mkdir(parents=True, exist_ok=True)
    document = {"compiler": images[0]["compiler"],
                "cross_checked": all(image["cross_checked"] for image in images), "rows": rows}
    (out / "firmware.json").write_text(json.dumps(document, indent=1) + "\n")
    ticks = rows[0]["ticks"]
    checked = "by the core's timer" + (" and by a plugin, which agree" if document["cross_checked"] else "")
    (out / "firmware.md").write_text(
        "# The tick on Cortex-M\n\n"
        f"{images[0]['compiler']}. Text is the tick and all it calls, constants included; data and "
        "bss are 0 in every row. Stack is the deepest chain of the call graph (library routines of "
        "soft float not included). Instructions are those of the best, the median and the worst of "
        f"{ticks} recorded ticks, good and bad input, counted in QEMU {checked}.\n\n"
        + main_table(rows)
        + "\n## What was wanted (M4F, -O2, contraction off)\n\n" + wanted_table(rows)
        + "\n## Where the instructions go (M4F, -O2, contraction off; mean per tick, with the "
          "calls and the readings of the clock around it)\n\n" + where_table(rows))
    print((out / "firmware.md").read_text())
    print(f"{out / 'firmware.json'} and firmware.md written")
    wrong = limits.violations(rows)
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
