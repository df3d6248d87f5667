# SPDX-License-Identifier: BSD-3-Clause
"""Runs one firmware image in QEMU and measures its ticks: measure.py --help.

Leaves in the image's folder: printed.txt (what the image printed), counted.txt (what the plugin
counted) and measured.json. Fails when the image does, or when the two ways of counting
instructions differ by a single one."""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys

SCENES = ["wall_trusted", "wall_strict", "wall_reachable", "plane_strict", "plane_reachable", "triangle_thesis"]
AUTHORS = ["composed", "by_hand"]


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Tools:
    def __init__(self, prefix):
        self.prefix = prefix

    def __call__(self, name, *arguments):
        return output(self.prefix + name, *map(str, arguments))


def addresses(tools, image, *names):
    found = {}
    for line in tools("nm", image).splitlines():
        words = line.split()
        if words[-1] in names:
            found[words[-1]] = "0x" + words[0]
    return [found[name] for name in names]


def emulate(options, tools):
    """Runs the image; its exit code must be 0."""
    image = options.folder / "replay.elf"
    command = list(options.qemu)
    if options.plugin:
        begin, end, series = addresses(tools, image, "count_begin", "count_end", "count_series")
        command += ["-plugin", f"{options.plugin},begin={begin},end={end},series={series},"
                               f"out={options.folder / 'counted.txt'}"]
    printed = options.folder / "printed.txt"
    with printed.open("w") as stream:
        code = subprocess.run(command + ["-kernel", str(image)], stderr=stream,
                              timeout=300).returncode
    if code != 0:
        sys.exit(f"{image} ended with {code}; {printed} has what it printed")
    return [line.split() for line in printed.read_text().splitlines()]


def instructions(lines):
    """{(scene, author): [instructions of each tick]}, by the timer of the core."""
    counts = {}
    for words in lines:
        if words[0] == "insn":
            counts.setdefault((words[1], words[2]), []).append(int(words[4]))
    return counts


def cross_check(folder, counts):
    """The plugin must have counted the same; its first call of a series is the empty one."""
    series, operations = {}, {}
    for line in (folder / "counted.txt").read_text().splitlines():
        words = line.split()
        if words[0] == "call":
            series.setdefault(int(words[1]), []).append(int(words[2]))
        else:
            operations.setdefault(int(words[1]), {})[words[2]] = int(words[3])
    for number, (key, by_systick) in enumerate(counts.items()):
        empty, *calls = series[number]
        by_plugin = [call - empty + 1 for call in calls]
        if by_plugin != by_systick:
            wrong = [n for n, pair in enumerate(zip(by_plugin, by_systick)) if pair[0] != pair[1]]
            sys.exit(f"{folder.name}: {' '.join(key)}: timer and plugin disagree in ticks "
                     f"{wrong[:5]} ({len(by_plugin)} and {len(by_systick)} ticks)")
    return {key: operations[number] for number, key in enumerate(counts)}


def entry(tools, object_file, scene, author):
    """The linker's name of the tick."""
    wanted = (f"by_hand_{scene}_tick" if author == "by_hand"
              else f"_ZN8composed{len(scene) + 5}{scene}_tick")
    for line in tools("nm", object_file).splitlines():
        name = line.split()[-1]
        if name.startswith(wanted):
            return name
    sys.exit(f"{object_file}: no {wanted}")


def sizes(tools, emulation, folder, scene, author):
    """The bytes of the tick and of all it calls, and what it leaves to the linker."""
    object_file = folder / f"{author}_{scene}.o"
    alone = folder / f"{author}_{scene}_tick.o"
    tools("ld", *emulation, "-r", "--gc-sections", "-e", entry(tools, object_file, scene, author),
          object_file, "-o", alone)
    text, data, bss = map(int, tools("size", alone).splitlines()[1].split()[:3])
    undefined = sorted(line.split()[-1] for line in tools("nm", "-u", alone).splitlines())
    return {"text": text, "data": data, "bss": bss, "undefined": undefined}


def worst_stack(tools, folder, scene, author):
    """The deepest chain of the call graph that the compiler wrote, frames added up."""
    graph = (folder / f"{author}_{scene}.ci").read_text()
    frames, calls = {}, {}
    for title, label in re.findall(r'node: \{ title: "([^"]*)" label: "([^"]*)"', graph):
        size = re.search(r"(\d+) bytes \((\w+)", label)
        if size and size.group(2) not in ("static",):
            sys.exit(f"{scene}: {title}: a frame of unknown size")
        frames[title] = int(size.group(1)) if size else 0
    for source, target in re.findall(r'sourcename: "([^"]*)" targetname: "([^"]*)"', graph):
        calls.setdefault(source, set()).add(target)

    def depth(title, above):
        if title in above:
            sys.exit(f"{scene}: {title} calls itself: the stack has no bound")
        below = [depth(called, above | {title}) for called in calls.get(title, ())]
        return frames.get(title, 0) + max(below, default=0)

    name = entry(tools, folder / f"{author}_{scene}.o", scene, author)
    start = next(title for title in frames if title.endswith(name))
    return depth(start, frozenset())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("folder", "core", "scalar", "flags", "cross"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--plugin", default="", help="without one there is no cross-check")
    parser.add_argument("--emulation", default="", help="the linker's, if not its default")
    parser.add_argument("qemu", nargs="+", help="QEMU with its options, after --")
    options = parser.parse_args()
    options.folder = pathlib.Path(options.folder)
    tools = Tools(options.cross)
    emulation = ["-m", options.emulation] if options.emulation else []

    lines = emulate(options, tools)
    counts = instructions(lines)
    if sorted(counts) != sorted((s, a) for s in SCENES for a in AUTHORS):
        sys.exit(f"{options.folder.name}: not every scene was played: {sorted(counts)}")
    operations = cross_check(options.folder, counts) if options.plugin else {}
    states = {(w[1], w[2]): int(w[3]) for w in lines if w[0] == "state"}

    rows = []
    for (scene, author), ticks in counts.items():
        rows.append({"scene": scene, "author": author, "core": options.core,
                     "scalar": options.scalar, "flags": options.flags,
                     **sizes(tools, emulation, options.folder, scene, author),
                     "state": states[scene, author],
                     "stack": worst_stack(tools, options.folder, scene, author),
                     "best": min(ticks), "median": int(statistics.median_low(ticks)),
                     "worst": max(ticks), "sum": sum(ticks), "ticks": len(ticks),
                     "operations": operations.get((scene, author), {})})
    compiler = tools("g++", "--version").splitlines()[0]
    result = {"image": options.folder.name, "compiler": compiler,
              "cross_checked": bool(options.plugin), "rows": rows}
    (options.folder / "measured.json").write_text(json.dumps(result, indent=1) + "\n")
    ticks = sum(row["ticks"] for row in rows)
    print(f"{options.folder.name}: {ticks} ticks, instructions by the machine's timer"
          + (", the same by the plugin" if options.plugin else "; no plugin, not cross-checked"))


if __name__ == "__main__":
    main()
