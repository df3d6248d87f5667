#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Would a test notice? Makes small mistakes in the headers, one at a time, and runs the core tests, and
those of published/ and of two threads in one port.

    mutate.py --sample 150                    150 mutants, the same each time; --seed for others
    mutate.py --sample 40 'force_bound/*'     of these headers
    mutate.py --list                          how many there are; nothing is compiled

A mutant is killed by a test that fails or crashes, or when the tests take ten times as long. One that
does not compile counts for nothing. One that computes the same stands in equivalent.txt, with the
reason. The rest has survived: a test is missing.

Needs what the tests need: CMake, Ninja, g++ or CXX, Eigen, Catch2. Works in build/mutation/ on a copy
of the tree, with all mutants in one program: MUTANT=7 build/mutation/objects/tests/core_tests runs the
7th. Takes two or three builds of the core tests, then seconds for a mutant.

Exit code: 0; 1 when less than --at-least percent are killed; 2 when something is wrong."""

import argparse
import collections
import concurrent.futures
import filecmp
import fnmatch
import functools
import hashlib
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

import mutants

HERE = pathlib.Path(__file__).resolve().parent
REPOSITORY = HERE.parent.parent
INCLUDE = pathlib.Path("include/passive_haptics")
HEADERS = ["local_model.hpp", "base/*", "device/*", "port/*", "motion_estimator/*",
           "energy_observer/*", "force_bound/*", "contact/*", "constraint_geometry/*",
           "normal_interpolation/*", "published/*"]
SWITCH = INCLUDE / "mutation.hpp"  # which mutant is executed; in the copy alone
FOLDER = REPOSITORY / "build" / "mutation"
MEMORY = 4 << 30  # bytes that a mutant may take


class Broken(Exception):
    """Something that no mutant is to blame for."""


def read_headers():
    """{name: text} of the headers that are mutated."""
    folder = REPOSITORY / INCLUDE
    names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.hpp"))
    return {name: (folder / name).read_text(encoding="utf-8") for name in names
            if any(fnmatch.fnmatch(name, header) for header in HEADERS)}


def read_equivalent(text):
    """{(file, before, after): reason} of paragraphs of four lines or more: the file, `- before`,
    `+ after`, the reason."""
    entries = {}
    for paragraph in text.split("\n\n"):
        lines = [line for line in paragraph.splitlines() if line and not line.startswith("#")]
        if not lines:
            continue
        if len(lines) < 4 or not lines[1].startswith("- ") or not lines[2].startswith("+ "):
            raise Broken(f"equivalent.txt: not an entry:\n{paragraph}")
        entries[lines[0], lines[1][2:], lines[2][2:]] = " ".join(lines[3:])
    return entries


def key(mutant):
    return mutant.file, mutant.before, mutant.after


def blamed(said, folder=FOLDER):
    """The numbers of the mutants in which a compiler found fault: of each error the innermost, in the
    line itself or in the first that it was `required from`. Its paths begin in `folder`: ccache may
    have made them relative."""
    numbers, chain = set(), []
    for line in said.splitlines():
        place = re.match(r"(?:In file included from )?(\S+?):(\d+)[:,]", line)
        if place and (folder / place[1]).is_file():
            text = (folder / place[1]).read_text(encoding="utf-8").split("\n")[int(place[2]) - 1]
            mark = re.search(r"/\*mutant (\d+)\*/", text)
            here = [int(mark[1])] if mark else []
            if " error: " in line:
                numbers.update((here + chain)[:1])
                chain = []
            elif "required" in line:
                chain += here
    return numbers


class Program:
    """The core tests, those of published/ and of port/one_at_a_time.hpp, with many mutants in them."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.source, self.objects = FOLDER / "source", FOLDER / "objects"
        self.programs = "core_tests", "published_tests", "one_at_a_time_tests"
        # Not the long simulations of design.hpp, which notice by accident what no test of a part does.
        self.all = "".join(f"~[#{path.stem}]" for path in REPOSITORY.glob("tests/design/*.cpp"))
        self.known = FOLDER / "invalid.txt"  # what did not compile is not tried again next time

    def build(self, texts, numbered):
        """Returns the mutants that compile."""
        self._copy()
        names = {number: self._name(texts[m.file], m) for number, m in numbered.items()}
        invalid = set(self.known.read_text().split()) if self.known.exists() else set()
        self._run("cmake", "--preset", "test", "-S", self.source, "-B", self.objects,
                  "-DPASSIVE_HAPTICS_BUILD_EXAMPLES=OFF",
                  "-DPASSIVE_HAPTICS_TESTS=full",  # the others leave out curved surfaces, tools, laws
                  # No warnings; and what CI's sanitizers would stop is noticed: what is read beyond
                  # an array, by assertions, and what is read before it is set, as NaN.
                  # g++ 12 crashes where it unrolls the loops of some mutants.
                  "-DCMAKE_CXX_FLAGS=-w -D_GLIBCXX_ASSERTIONS -DEIGEN_INITIALIZE_MATRICES_BY_NAN"
                  " -fno-tree-loop-optimize",
                  "-DCMAKE_CXX_FLAGS_RELEASE=-O1")
        while True:
            valid = {n: m for n, m in numbered.items() if names[n] not in invalid}
            for name, text in texts.items():
                inside = {n: m for n, m in valid.items() if m.file == name}
                text = mutants.together(text, inside) if inside else text
                self._write(INCLUDE / name, mutants.not_inlined(text))
            self._write(SWITCH, mutants.SWITCH)
            print(f"building the core tests with {len(valid)} mutants in them", flush=True)
            good, said = self._try("cmake", "--build", self.objects, "--target", *self.programs,
                                   "--parallel", str(self.jobs), "--", "-k", "0")
            if good:
                return valid
            wrong = blamed(said, self.objects) & set(valid)
            if not wrong:
                raise Broken(f"the core tests do not build:\n{said}")
            print(f"{len(wrong)} of them do not compile", flush=True)
            invalid |= {names[n] for n in wrong}
            self.known.write_text("\n".join(sorted(invalid)))

    def seconds(self):
        """The CPU time that the tests take without a mistake."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not self._pass(0, resource.RLIM_INFINITY, self.all):
            raise Broken("the tests fail without a mutant")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def notices(self, number, mutant, seconds):
        """Does a test fail? Those in the file of the same name are asked first, then all."""
        own = f"[#{pathlib.Path(mutant.file).stem}]"
        return (self._passes_without(own) and not self._pass(number, seconds, own)
                or not self._pass(number, seconds, self.all))

    @functools.cache
    def _passes_without(self, which):
        return self._pass(0, resource.RLIM_INFINITY, which)

    def _pass(self, number, seconds, which):
        def limited():
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        return all(subprocess.run(
            [self.objects / "tests" / program, "--abort", "-#", which],
            env={**os.environ, "MUTANT": str(number)}, cwd=FOLDER, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, preexec_fn=limited, check=False).returncode == 0
            for program in self.programs)

    def _copy(self):
        """Brings the copy of the tree up to date; what is the same keeps its time."""
        wanted = {SWITCH}
        for path in sorted(REPOSITORY.rglob("*")):
            name = path.relative_to(REPOSITORY)
            if name.parts[0] in ("build", ".git") or "__pycache__" in name.parts or path.is_dir():
                continue
            wanted.add(name)
            copy = self.source / name
            if name.parts[:2] == INCLUDE.parts and copy.exists():
                continue  # written with its mutants
            if not copy.exists() or not filecmp.cmp(path, copy, shallow=False):
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, copy)
        for path in list(self.source.rglob("*")):
            if not path.is_dir() and path.relative_to(self.source) not in wanted:
                path.unlink()

    def _write(self, name, text):
        path = self.source / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")

    @staticmethod
    def _name(text, m):
        return hashlib.sha256(repr((text, m.start, m.end, m.text)).encode()).hexdigest()[:16]

    @staticmethod
    def _try(*command):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        return done.returncode == 0, done.stdout.decode(errors="replace")

    def _run(self, *command):
        good, said = self._try(*command)
        if not good:
            raise Broken(said)


def judged(program, numbered, jobs):
    """Yields (number, whether it was killed)."""
    most = round(5 + 10 * program.seconds())
    pool = concurrent.futures.ThreadPoolExecutor(jobs)
    try:
        trials = {pool.submit(program.notices, n, m, most): n for n, m in numbered.items()}
        for trial in concurrent.futures.as_completed(trials):
            yield trials[trial], trial.result()
    finally:
        pool.shutdown(cancel_futures=True)


def score(count):
    valid = count["killed"] + count["survived"]
    return 100.0 * count["killed"] / valid if valid else 100.0


def table(outcomes):
    """Rows by file: [(mutant, outcome)] in numbers. Those that do not compile count for nothing."""
    files = collections.defaultdict(collections.Counter)
    for mutant, outcome in outcomes:
        if outcome != "invalid":
            files[mutant.file][outcome] += 1
            files["all"][outcome] += 1
    yield "| | mutants | killed | equivalent | survived |"
    yield "|---|---|---|---|---|"
    for name in sorted(files, key=lambda name: (name == "all", name)):
        count = files[name]
        yield (f"| {name} | {sum(count.values())} | {count['killed']} | {count['equivalent']} | "
               f"{count['survived']} |")


def options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("patterns", nargs="*", default=["*"], metavar="HEADER",
                        help="of these headers alone, as in 'port/*'")
    parser.add_argument("--leave-out", action="append", default=[], metavar="HEADER")
    parser.add_argument("--sample", type=int, metavar="N", help="so many of them; default: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-least", type=float, default=0.0, metavar="PERCENT")
    parser.add_argument("--jobs", type=int, default=2, metavar="N")
    parser.add_argument("--list", action="store_true", help="count them and stop")
    return parser.parse_args()


def chosen(texts, entries, wanted):
    """The mutants to try, in the order of a lottery."""
    found = [m for name, text in texts.items() for m in mutants.mutants_of(name, text)]
    stale = set(entries) - {key(m) for m in found}
    if stale:
        raise Broken("equivalent.txt: fits no mutant any more:\n" + "\n".join(
            f"{file}\n- {before}\n+ {after}" for file, before, after in sorted(stale)))
    found = [m for m in found if any(fnmatch.fnmatch(m.file, one) for one in wanted.patterns)
             and not any(fnmatch.fnmatch(m.file, one) for one in wanted.leave_out)]
    return mutants.in_random_order(found, wanted.seed)[:wanted.sample]


def main():
    wanted, began = options(), time.monotonic()
    texts = read_headers()
    entries = read_equivalent((HERE / "equivalent.txt").read_text(encoding="utf-8"))
    todo = dict(enumerate(chosen(texts, entries, wanted), 1))
    if wanted.list:
        kinds = collections.Counter(m.kind for m in todo.values())
        print(", ".join(f"{count} {kind}" for kind, count in kinds.most_common()))
        print(f"{len(todo)} mutants in {len(texts)} headers; {len(entries)} known to be equivalent")
        return 0

    outcome = {n: "equivalent" for n, m in todo.items() if key(m) in entries}
    FOLDER.mkdir(parents=True, exist_ok=True)
    program = Program(wanted.jobs)
    untried = {n: m for n, m in todo.items() if n not in outcome}
    valid = program.build(texts, untried)
    outcome |= {n: "invalid" for n in untried if n not in valid}
    try:
        for number, killed in judged(program, valid, wanted.jobs):
            outcome[number], m = "killed" if killed else "survived", todo[number]
            print(f"{number:4} {outcome[number]:8} {m.file}:{m.line} ({m.kind})", flush=True)
            if not killed:
                print(f"- {m.before}\n+ {m.after}", flush=True)
    finally:  # after Ctrl-C, what there is
        outcomes = [(todo[n], what) for n, what in sorted(outcome.items())]
        count = collections.Counter(what for _, what in outcomes)
        print("", *table(outcomes), "", sep="\n")
        print(f"{score(count):.1f} % of {count['killed'] + count['survived']} killed; "
              f"{count['invalid']} more did not compile; seed {wanted.seed}, "
              f"{time.monotonic() - began:.0f} s")
    return 1 if score(count) < wanted.at_least else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Broken as why:
        print(why, file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
