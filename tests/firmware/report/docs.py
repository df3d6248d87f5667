# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a page has the figures of the baseline, and that its code stands in the files that it
names: docs.py BASELINE PAGE [--rewrite]."""

import pathlib
import re
import sys

import baseline

MARK = re.compile(r"<!-- figures: (\S+) (\S+) (\S+) -->\n(?:\|.*\n)*")
CODE = re.compile(r"<!-- from: (\S+) -->\n```cpp\n(.*?)```", re.S)
COLUMNS = ["text", "state", "stack", "best", "median", "worst"]
BOARDS = {"M0+": "microbit, a Cortex-M0", "M3": "mps2-an385", "M4F": "mps2-an386", "M7": "mps2-an500",
          "M33": "mps2-an505"}


def figures(known, core, scalar, optimisation):
    flags = optimisation + ", contraction off"
    text = "| scene | " + " | ".join(COLUMNS) + " | by hand: " + " | ".join(
        ["text", "median", "worst"]) + " |\n|" + "---|" * 10 + "\n"
    for (scene, author, *where), row in known.items():
        if author == "composed" and where == [core, scalar, flags]:
            twin = known[(scene, "by_hand", *where)]
            numbers = [row[c] for c in COLUMNS] + [twin[c] for c in ("text", "median", "worst")]
            text += f"| {scene} | " + " | ".join(map(str, numbers)) + " |\n"
    return text


def cores(known, scalar, optimisation):
    """A row for each core: the two smallest scenes and the largest."""
    scenes, columns = ["wall_trusted", "wall_strict", "triangle_thesis"], ["text", "median", "worst"]
    head = [f"{scene}: {' / '.join(columns)}" for scene in scenes]
    text = "| core | in QEMU on | " + " | ".join(head) + " |\n|" + "---|" * 5 + "\n"
    for core, board in BOARDS.items():
        rows = [known[scene, "composed", core, scalar, optimisation + ", contraction off"]
                for scene in scenes]
        cells = [" / ".join(str(row[c]) for c in columns) for row in rows]
        text += f"| {core} | {board} | " + " | ".join(cells) + " |\n"
    return text


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    _, known = baseline.read(sys.argv[1])
    with open(sys.argv[2], encoding="utf-8") as stream:
        page = stream.read()
    if not MARK.search(page):
        sys.exit(f"{sys.argv[2]}: no figures")
    root = pathlib.Path(sys.argv[2]).resolve().parent.parent
    blocks = CODE.findall(page)
    if len(blocks) != page.count("```cpp"):
        sys.exit(f"{sys.argv[2]}: code that says not where it is from")
    for source, code in blocks:
        if code not in (root / source).read_text(encoding="utf-8"):
            sys.exit(f"{sys.argv[2]}: not in {source}:\n{code}")
    wanted = MARK.sub(lambda m: f"<!-- figures: {m[1]} {m[2]} {m[3]} -->\n"
                      + (cores(known, m[2], m[3]) if m[1] == "cores"
                         else figures(known, m[1], m[2], m[3])), page)
    if "--rewrite" in sys.argv:
        with open(sys.argv[2], "w", encoding="utf-8") as stream:
            stream.write(wanted)
    elif page != wanted:
        sys.exit(f"{sys.argv[2]}: its figures are not those of {sys.argv[1]}: docs.py --rewrite")
    else:
        print("the figures are those of the baseline")


if __name__ == "__main__":
    main()
