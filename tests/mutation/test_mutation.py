# SPDX-License-Identifier: BSD-3-Clause
"""What is taken for a mistake, how many share a program, and what a compiler is blamed for. Quick."""

import pathlib
import tempfile
import unittest

import mutants
import mutate


def header(body, declaration="constexpr double f(double x, double y) noexcept"):
    return f"#pragma once\nnamespace n {{\n{declaration} {{\n{body}\n}}\n}}\n"


def changes(*text):
    """{(kind, what the line becomes)} of a function with that body."""
    return {(m.kind, m.after) for m in mutants.mutants_of("a.hpp", header(*text))}


class Mistakes(unittest.TestCase):
    def test_kinds(self):
        self.assertEqual(changes("return x * y;"),
                         {("arithmetic", "return x / y;"), ("return", "return {};")})
        for kind, line, mistaken in (
                ("relation", "if (x < y) z = y;", "if (x >= y) z = y;"),
                ("boundary", "if (x < y) z = y;", "if (x <= y) z = y;"),
                ("statement", "if (x < y) z = y;", ";"),
                ("statement", "if (x < y) z = y;", "if (x < y) ;"),
                ("statement", "a.b(x);", ";"),
                ("sign", "return -x;", "return x;"),
                ("sign", "if (!(x > y)) return y;", "if ((x > y)) return y;"),
                ("logic", "return x && y && x;", "return x && y || x;"),
                ("condition", "if (x && y) return y;", "if (!(x && y)) return y;"),
                ("choice", "return x < y ? x : y;", "return x < y ? y : x;"),
                ("constant", "x = scalar(0);", "x = scalar(1);"),
                ("constant", "x = true;", "x = false;"),
                ("magnitude", "x = kernels::magnitude(x);", "x = (x);"),
                ("extreme", "x = kernels::smaller(x, y);", "x = kernels::larger(x, y);"),
                ("clamp", "x = kernels::smaller(x, y);", "x = (y);"),
                ("arguments", "x = g(x, y);", "x = g(y, x);"),
                ("arguments", "x = kernels::clamped(x, y, 2);", "x = kernels::clamped(x, 2, y);")):
            self.assertIn((kind, mistaken), changes(line))

    def test_no_function_has_to_be_inlined(self):
        self.assertEqual("[[nodiscard]] int f(); [[]] int g();", mutants.not_inlined(
            "[[nodiscard, gnu::always_inline, gnu::flatten]] int f(); [[gnu::flatten]] int g();"))

    def test_an_index_in_an_index_is_no_attribute(self):
        self.assertIn(("arithmetic", "x = a[b[0]] - y;"), changes("x = a[b[0]] + y;"))
        self.assertIn(("arithmetic", "[[likely]] x = y - x;"), changes("[[likely]] x = y + x;"))

    def test_none_where_the_compiler_decides(self):
        for line in ("static_assert(1 < 2);", "if constexpr (N > 0) return;", "using a = b<1 + 2>;",
                     "static constexpr int a = 1 + 2;", "// x < y", "const char* s = \"x < y\";"):
            self.assertEqual(changes(line), set(), line)
        self.assertEqual(changes("int a = 1;", "struct s"), set())
        self.assertEqual(changes("{ a + b } -> std::same_as<S>;", "concept c = requires(S a, S b)"),
                         set())

    def test_no_declaration_is_left_out(self):
        for line in ("double z(x);", "const double z = x;", "typename S::vector v = x;"):
            self.assertNotIn("statement", {kind for kind, _ in changes(line)}, line)

    def test_every_edit_is_another_one(self):
        text = (mutate.REPOSITORY / mutate.INCLUDE / "port" / "guard.hpp").read_text(encoding="utf-8")
        found = mutants.mutants_of("port/guard.hpp", text)
        self.assertGreater(len(found), 50)
        self.assertEqual(len({text[:m.start] + m.text + text[m.end:] for m in found}), len(found))

    def test_the_order_survives_an_edit_elsewhere(self):
        def order(text, seed):
            found = mutants.in_random_order(mutants.mutants_of("a.hpp", text), seed)
            return [mutate.key(m) for m in found]

        text = header("x = y + 1;\ny = x < 2 ? x : y;\nreturn x * y;")
        self.assertEqual(order(text, 1), order("\n\n" + text, 1))
        self.assertNotEqual(order(text, 1), order(text, 2))


class Together(unittest.TestCase):
    def test_a_body_stands_there_once_for_each_mutant(self):
        text = header("x += 2;\n// why\nreturn x;")
        numbered = dict(enumerate(mutants.mutants_of("a.hpp", text), 1))
        all_of_them = mutants.together(text, numbered)
        self.assertIn("{\nx += 2;\n// why\nreturn x;\n}", all_of_them)
        self.assertIn("/*mutant 2*/ { x -= 2; return x; }", all_of_them)
        self.assertEqual(all_of_them.count("/*mutant "), len(numbered))
        self.assertEqual(all_of_them.count("{"), all_of_them.count("}"))

    def test_the_innermost_mutant_of_an_error_is_blamed(self):
        with tempfile.NamedTemporaryFile("w", suffix=".hpp") as file:
            file.write("/*mutant 3*/ {}\n/*mutant 4*/ {}\nno mutant\n")
            file.flush()
            one, other, none = (f"{pathlib.Path(file.name)}:{line}:1:" for line in (1, 2, 3))
            self.assertEqual(mutate.blamed(f"{one} error: no\n{other} note: see\n"), {3})
            self.assertEqual(mutate.blamed(
                f"{other}   required from here\n{one}   required from here\n{none} error: no\n"), {4})
            self.assertEqual(mutate.blamed(f"{none} error: no\n"), set())
            path = pathlib.Path(file.name)
            self.assertEqual(mutate.blamed(f"{path.name}:1:1: error: no\n", path.parent), {3})


class Equivalent(unittest.TestCase):
    ENTRY = "# what this is\n\na.hpp\n- return a < b;\n+ return a <= b;\nno two\nare alike\n"

    def test_an_entry_is_read(self):
        self.assertEqual(mutate.read_equivalent(self.ENTRY),
                         {("a.hpp", "return a < b;", "return a <= b;"): "no two are alike"})

    def test_what_is_no_entry_is_refused(self):
        for wrong in ("a.hpp\n- x\n+ y\n", "a.hpp\nx\ny\nwhy\n"):
            with self.assertRaises(mutate.Broken):
                mutate.read_equivalent(wrong)


if __name__ == "__main__":
    unittest.main()
