# SPDX-License-Identifier: BSD-3-Clause
"""The checks of the report can fail, and pass when they should."""

import copy
import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

import baseline
import limits

ROW = {"scene": "wall_strict", "author": "composed", "core": "M4F", "scalar": "float",
       "flags": "-O2, contraction off", "text": 800, "data": 0, "bss": 0, "state": 60, "stack": 40,
       "best": 60, "median": 100, "worst": 150, "undefined": []}


class Baseline(unittest.TestCase):
    def setUp(self):
        self.file = pathlib.Path(tempfile.mkdtemp()) / "baseline.csv"
        with contextlib.redirect_stdout(io.StringIO()):
            baseline.rewrite(self.file, {"compiler": "a compiler", "rows": [ROW]})
        self.compiler, self.known = baseline.read(self.file)

    def changed(self, **columns):
        row = copy.deepcopy(ROW)
        row.update(columns)
        return baseline.compare(self.known, [row])

    def test_the_same_counts_pass(self):
        self.assertEqual(self.compiler, "a compiler")
        self.assertEqual(self.changed(), ([], [], []))

    def test_one_percent_passes_and_more_does_not(self):
        self.assertEqual(self.changed(text=808), ([], [], []))
        grown, _, _ = self.changed(text=809)
        self.assertEqual(len(grown), 1)
        self.assertIn("text 800 -> 809", grown[0])

    def test_every_count_is_watched(self):
        for column in baseline.COUNTED:
            grown, _, _ = self.changed(**{column: 2 * ROW[column] + 1})
            self.assertEqual(len(grown), 1, column)

    def test_less_is_told_and_a_missing_row_fails(self):
        self.assertEqual(len(self.changed(worst=149)[1]), 1)
        self.assertEqual(len(baseline.compare(self.known, [])[2]), 1)


class Limits(unittest.TestCase):
    def violations(self, **columns):
        row = copy.deepcopy(ROW)
        row.update(columns)
        return limits.violations([row])

    def test_what_is_allowed_passes(self):
        self.assertEqual(self.violations(), [])
        self.assertEqual(self.violations(undefined=["memcpy", "memset", "sqrtf"]), [])
        self.assertEqual(self.violations(core="M3", undefined=["__aeabi_fadd"]), [])

    def test_what_is_not_is_named(self):
        for symbol in ("malloc", "abort", "__cxa_guard_acquire", "__aeabi_fadd", "__aeabi_dmul"):
            self.assertIn(symbol, self.violations(undefined=[symbol])[0])
        self.assertIn("double", self.violations(core="M3", undefined=["__aeabi_dmul"])[0])
        self.assertEqual(len(self.violations(data=4)), 1)
        self.assertEqual(len(self.violations(bss=4)), 1)


class Agreement(unittest.TestCase):
    def agree(self, left, right, *bound):
        folder = pathlib.Path(tempfile.mkdtemp())
        for name, lines in (("host", left), ("target", right)):
            text = "".join(f"tick wall {author} {line}\n" for author in ("composed", "by_hand")
                           for line in lines)
            (folder / name).write_text(text)
        script = pathlib.Path(__file__).with_name("agree.py")
        return subprocess.run([sys.executable, script, folder / "host", folder / "target", *bound],
                              capture_output=True, text=True).returncode

    def test_one_bit_is_seen(self):
        ticks = ["0 3f800000 3f800000 3f800000 0 0", "1 3f800000 3f800000 40000000 0 1"]
        self.assertEqual(self.agree(ticks, ticks), 0)
        other = [ticks[0], ticks[1].replace("40000000", "40000001")]
        self.assertNotEqual(self.agree(ticks, other), 0)
        self.assertEqual(self.agree(ticks, other, "1e-6"), 0)
        self.assertNotEqual(self.agree(ticks, other, "1e-8"), 0)
        self.assertNotEqual(self.agree(ticks, [ticks[0], ticks[1][:-1] + "0"], "1"), 0)
        self.assertNotEqual(self.agree(ticks, ticks[:1]), 0)


if __name__ == "__main__":
    unittest.main()
