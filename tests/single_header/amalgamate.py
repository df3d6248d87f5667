# SPDX-License-Identifier: BSD-3-Clause
"""Writes the core as one header: amalgamate.py REPOSITORY OUT [FORWARDERS].

OUT includes the standard library and, where it is found, Eigen: without it
there is one degree of freedom. The same commit gives the same bytes.
FORWARDERS, for tests, is a folder that gets a header of every name that went
in, which includes OUT and nothing else."""

import pathlib
import re
import subprocess
import sys

ROOTS = ["firmware.hpp", "passive_haptics.hpp", "compositions.hpp", "laws.hpp", "design.hpp",
         "identification/measure_latency.hpp"]
OWN = re.compile(r"#include <passive_haptics/(.*)>")
OTHER = re.compile(r"#include <(.*)>")


def in_order(include, name, done):
    """The headers that `name` needs, each once, what is included first; `name` last."""
    if name in done:
        return []
    done.add(name)
    path = include / "passive_haptics" / name
    if not path.is_file():
        sys.exit(f"{path}: no such header")
    order = []
    for line in path.read_text(encoding="utf-8").splitlines():
        own = OWN.match(line)
        if own:
            order += in_order(include, own.group(1), done)
    return order + [name]


def body(text):
    """(the text without its licence line, guard and includes; the other headers it includes)"""
    kept, others = [], []
    for line in text.splitlines():
        other = OTHER.match(line)
        if OWN.match(line) or line == "#pragma once" or line.startswith("// SPDX-License"):
            continue
        if other:
            others.append(other.group(1))
        else:
            kept.append(line)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(kept)).strip("\n"), others


def needs_eigen(include, name):
    """Whether a header has no use without Eigen: it includes Eigen, or such a header, on no condition."""
    depth = 0
    for line in (include / "passive_haptics" / name).read_text(encoding="utf-8").splitlines():
        depth += line.startswith("#if") - line.startswith("#endif")
        own = OWN.match(line)
        if not depth and (line.startswith("#include <Eigen/") or
                          own and needs_eigen(include, own.group(1))):
            return True
    return False


def version(include):
    text = (include / "passive_haptics" / "base" / "version.hpp").read_text(encoding="utf-8")
    return ".".join(re.findall(r"version_(?:major|minor|patch) = (\d+)", text))


def commit(repository):
    """The commit, and whether the headers differ from it."""
    git = ["git", "-c", "safe.directory=*", "-C", str(repository)]
    try:
        name = subprocess.run(git + ["rev-parse", "HEAD"], check=True, capture_output=True,
                              text=True).stdout.strip()
        changed = subprocess.run(git + ["status", "--porcelain", "include"], check=True,
                                 capture_output=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return name + (" with changes" if changed else "")


def main():
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(__doc__)
        return
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    repository, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    include = repository / "include"
    done, order = set(), []
    for root in ROOTS:
        order += in_order(include, root, done)

    parts, standard, eigen = [], set(), set()
    for name in order:
        text, others = body((include / "passive_haptics" / name).read_text(encoding="utf-8"))
        standard |= {other for other in others if not other.startswith("Eigen/")}
        eigen |= {other for other in others if other.startswith("Eigen/")}
        if text and needs_eigen(include, name):
            text = f"#if __has_include(<Eigen/Core>)\n{text}\n#endif  // Eigen"
        parts.append(f"// ---- {name}\n\n{text}\n")
    if eigen != {"Eigen/Core"}:
        sys.exit(f"the core should include Eigen/Core and no more of it, but: {sorted(eigen)}")

    licence = (repository / "LICENSE").read_text(encoding="utf-8").strip()
    head = ["// SPDX-License-Identifier: BSD-3-Clause",
            f"// passive_haptics {version(include)}, commit {commit(repository)}",
            "// The core in one file, made by tests/single_header/amalgamate.py: change the headers",
            "// that it comes from, not this.", "//"]
    head += [("// " + line).rstrip() for line in licence.splitlines()]
    head += ["#pragma once", "", "#if __has_include(<Eigen/Core>)", "#include <Eigen/Core>",
             "#endif", ""]
    head += [f"#include <{name}>" for name in sorted(standard)]
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(head) + "\n\n" + "\n".join(parts), encoding="utf-8")
    print(f"{out}: {len(order)} headers, {out.stat().st_size} bytes")

    if len(sys.argv) == 4:
        for name in order:
            forwarder = pathlib.Path(sys.argv[3]) / "passive_haptics" / name
            forwarder.parent.mkdir(parents=True, exist_ok=True)
            forwarder.write_text(f"#pragma once\n#include <{out.name}>\n", encoding="utf-8")


if __name__ == "__main__":
    main()
