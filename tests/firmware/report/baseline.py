# SPDX-License-Identifier: BSD-3-Clause
"""Compares the report with the committed counts: baseline.py BASELINE firmware.json [--rewrite].

Counts are exact, so growth of more than 1 % of any of them fails, and says which. Another compiler
counts otherwise: then the comparison is skipped and says so. --rewrite takes the report as it is."""

import csv
import json
import sys

NAMED = ["scene", "author", "core", "scalar", "flags"]
COUNTED = ["text", "data", "bss", "state", "stack", "best", "median", "worst"]
GROWTH = 1.01


def rewrite(path, report):
    with open(path, "w", encoding="utf-8", newline="") as stream:
        stream.write(f"# {report['compiler']}\n")
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(NAMED + COUNTED)
        for row in report["rows"]:
            writer.writerow([row[name] for name in NAMED + COUNTED])
    print(f"{path}: {len(report['rows'])} rows")


def read(path):
    with open(path, encoding="utf-8", newline="") as stream:
        compiler = stream.readline()[2:].strip()
        return compiler, {tuple(r[n] for n in NAMED): {c: int(r[c]) for c in COUNTED}
                          for r in csv.DictReader(stream)}


def compare(known, rows):
    """(what grew, what shrank, what is missing): lists of sentences."""
    grown, shrunk = [], []
    measured = {tuple(row[n] for n in NAMED): row for row in rows}
    other = [" ".join(k) + ": only in the " + ("baseline" if k in known else "report")
             for k in sorted(set(known) ^ set(measured))]
    for k in known.keys() & measured.keys():
        for column in COUNTED:
            was, now = known[k][column], measured[k][column]
            text = f"{' '.join(k)}: {column} {was} -> {now}"
            if now > was * GROWTH:
                grown.append(text)
            elif now < was:
                shrunk.append(text)
    return sorted(grown), sorted(shrunk), other


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with open(sys.argv[2], encoding="utf-8") as stream:
        report = json.load(stream)
    if "--rewrite" in sys.argv:
        rewrite(sys.argv[1], report)
        return
    compiler, known = read(sys.argv[1])
    if compiler != report["compiler"]:
        print(f"skipped: the baseline is of {compiler}, this is {report['compiler']}")
        return
    grown, shrunk, other = compare(known, report["rows"])
    for text in shrunk:
        print(f"less: {text}")
    if grown or other:
        sys.exit("\n".join(["more than 1 % above the baseline, or not in it:"] + grown + other))
    print(f"{len(known)} rows, no count grew by more than 1 %"
          + (f"; {len(shrunk)} shrank: rewrite the baseline" if shrunk else ""))


if __name__ == "__main__":
    main()
