# SPDX-License-Identifier: BSD-3-Clause
"""Mutants of a header: the same text with one small mistake in the body of a function.

The headers are read as clang-format leaves them: a binary operator has a space on both sides, an
angle bracket of a template has not, the brace of a block follows a space and that of an initialiser
does not. Nothing is changed that the compiler evaluates by itself, such as a template argument, the
condition of `if constexpr`, a `requires` or a `static constexpr`: it would refuse most of it. What is
computed in constant expressions alone is left alone, too: a program cannot switch it."""

import collections
import hashlib
import re

# `start`, `end` and `text` are the edit, `body` the span of the function that it is in. `before` and
# `after` are the lines that it touches, each written on one line: with `file` they name the mutant.
Mutant = collections.namedtuple("Mutant", "file line kind start end text body before after")
Token = collections.namedtuple("Token", "text start end")

TOKEN = re.compile(r"""
    //[^\n]* | /\*.*?\*/ | ^[ ]*\#(?:[^\n]*\\\n)*[^\n]*    (?#: comments, the preprocessor's lines)
  | "(?:\\.|[^"\\])*" | '(?:\\.|[^'\\])+'
  | (?P<word>[A-Za-z_]\w*) | (?P<number>\d[\w.]*(?:[eE][+-]?\d+)?)
  | (?P<sign><=>|->|::|\.\.\.|<<=|>>=|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|\+\+|--|\[\[|\]\]|[^\s\w])
""", re.VERBOSE | re.MULTILINE | re.DOTALL)

OPENING = {"(": ")", "[": "]", "{": "}", "[[": "]]"}
CLOSING = {close: opening for opening, close in OPENING.items()}
SWAPS = {
    "arithmetic": {"+": "-", "-": "+", "*": "/", "/": "*",
                   "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="},
    "relation": {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "=="},
    "boundary": {"<": "<=", ">": ">=", "<=": "<", ">=": ">"},
    "logic": {"&&": "||", "||": "&&"},
}
# What the compiler alone calls, to know what a composition promises: tests/compile_fail/ is for them.
COMPILED = {"assumptions_of", "promise_of", "spends_ledger", "are_bounds", "reduces", "keeps_nothing",
            "count_takers", "chain_promise", "wants_local_model", "shapers_reduce",
            "shapers_keep_zero", "books_turns"}
EXTREMES = {"smaller": "larger", "larger": "smaller"}
SYMMETRIC = {"smaller", "larger", "dot", "work", "worse", "worse_yet"}  # of their arguments
# What `return {}` would return anyway.
NOTHING = {"nullptr", "std::nullopt", "0", "scalar(0)", "S(0)", "Scalar(0)", "P::zero()", "Space::zero()"}
# A statement that begins so is needed by what follows it.
KEPT = {"return", "else", "for", "while", "do", "switch", "case", "default", "using", "static",
        "constexpr", "const", "typename", "struct", "static_assert", "auto", "break"}


class Header:
    """The tokens of a header, each bracket's partner, and where functions compute something."""

    def __init__(self, name, text):
        self.name, self.text = name, text
        self.tokens = list(self._read())
        self.partner, self.opening = {}, {}  # from an opening bracket to its closing one, and back
        self._pair()
        self.bodies = list(self._find_bodies())  # (first, last) tokens, the braces

    def word(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def between(self, first, last):
        """The text from token `first` to token `last`, both included."""
        return self.text[self.tokens[first].start:self.tokens[last].end]

    def spaced(self, i):
        """Is there a blank on both sides of token i?"""
        token = self.tokens[i]
        return self.text[token.start - 1].isspace() and self.text[token.end:token.end + 1].isspace()

    def after(self, i):
        """The token after token i, or after the brackets that it opens."""
        return self.partner.get(i, i) + 1

    def end_of_statement(self, i):
        """The `;` that ends what begins at token i, or None."""
        while self.word(i) not in (";", "}", ""):
            i = self.after(i)
        return i if self.word(i) == ";" else None

    def is_block(self, i):
        """Does the brace at token i open a block, and no initialiser?"""
        return self.text[self.tokens[i].start - 1].isspace() and self.word(i - 1) not in {
            "=", "return", "(", ",", "{", "?", ":", "&&", "||"}

    def computing(self, first, last):
        """The tokens of a body that are not the compiler's own business."""
        i = first + 1
        while i < last:
            if self.word(i) == "if" and "is_constant_evaluated" in self.between(i, self.after(i + 1)):
                i = self.after(self.after(i + 1))  # past the condition, and past what only it sees
            elif self.word(i) in ("static", "using", "static_assert") or (
                    self.word(i) == "constexpr" and self.word(i - 1) != "if"):
                i = self.end_of_statement(i) + 1
            elif self.word(i) == "constexpr":
                smaller = "saves_bytes" in self.between(i, self.after(i + 1))  # machines than this
                i = self.after(i + 1)
                if smaller:
                    i = self.after(i) if self.word(i) == "{" else self.end_of_statement(i) + 1
            elif self.word(i) in ("<", "[[") and i in self.partner:
                i = self.after(i)
            elif self.word(i) == "requires":
                i = self._after_requires(i)
            else:
                yield i
                i += 1

    def _read(self):
        attribute = False
        for match in TOKEN.finditer(self.text):
            text, start = match.group(), match.start()
            if match.lastgroup and text == "]]" and not attribute:  # of an index in an index
                yield Token("]", start, start + 1)
                yield Token("]", start + 1, match.end())
            elif match.lastgroup:
                attribute = text == "[[" or attribute and text != "]]"
                yield Token(text, start, match.end())

    def _pair(self):
        stack = []
        for i, token in enumerate(self.tokens):
            angle = token.text in ("<", ">") and not self.spaced(i) and self.word(i - 1) != "operator"
            if token.text in OPENING or angle and token.text == "<":
                stack.append(i)
            elif token.text in CLOSING or angle:
                opening = CLOSING.get(token.text, "<")
                while stack and self.word(stack[-1]) == "<" != opening:
                    stack.pop()  # it was no bracket
                if stack and self.word(stack[-1]) == opening:
                    self.partner[stack[-1]] = i
                    self.opening[i] = stack.pop()

    def _find_bodies(self):
        i = 0
        while i < len(self.tokens):
            if self.word(i) == "requires":
                i = self._after_requires(i)
            elif self.word(i) == "{" and not self.is_block(i):
                i = self.after(i)
            elif self.word(i) == "{" and self._is_function(i):
                if self._name(i) not in COMPILED:
                    yield i, self.partner[i]
                i = self.after(i)
            else:
                i += 1

    def _is_function(self, brace):
        """Does a declaration stand in front of this brace that is no class, namespace or the like?"""
        i = brace - 1
        while i >= 0 and self.word(i) not in (";", "{"):
            if self.word(i) == "}" and self.is_block(self.opening[i]):
                break
            if self.word(i) in ("namespace", "class", "struct", "union", "enum", "concept"):
                return False
            i = self.opening.get(i, i) - 1
        return True

    def _name(self, brace):
        """Of the function whose body begins there, when it has no arguments."""
        while self.word(brace - 1) in ("const", "noexcept"):
            brace -= 1
        return self.word(brace - 3) if self.word(brace - 2) == "(" else ""

    def _after_requires(self, i):
        """Past a clause `requires(…)`, `requires concept<…>`, or an expression `requires(…) {…}`."""
        while self.word(i) == "requires":
            i += 1
        if self.word(i) == "(":
            i = self.after(i)
        return self.after(i) if self.word(i) == "{" else i


def arguments(header, bracket):
    """The (first, last) tokens of each argument between `bracket` and its partner."""
    found, first, i = [], bracket + 1, bracket + 1
    close = header.partner[bracket]
    while i < close:
        if header.word(i) == ",":
            found.append((first, i - 1))
            first = i + 1
        i = header.after(i)
    return found + [(first, close - 1)] if close > bracket + 1 else found


def _edits(header, i):
    """(kind, first token, last token, text in their place) of what can be mistaken at token i."""
    word, text = header.word, header.word(i)
    for kind, swaps in SWAPS.items():
        if text in swaps and header.spaced(i):
            yield kind, i, i, swaps[text]
    if text in ("-", "!") and not header.spaced(i):
        yield "sign", i, i, ""
    if text in ("true", "false"):
        yield "constant", i, i, "false" if text == "true" else "true"
    if text.isdigit():
        yield "constant", i, i, "0" if text == "1" else "1"
    if text == "?" and header.spaced(i):
        yield _choice(header, i)
    if text == "return" and word(i + 1) not in (";", "{", "true", "false"):
        end = header.end_of_statement(i)
        if header.between(i + 1, end - 1) not in NOTHING:
            yield "return", i + 1, end - 1, "{}"
    if word(i + 1) == "(" and re.match(r"\w", text):
        yield from _call(header, i)
    if text not in KEPT and (word(i - 1) in (";", "{", "}", "else") or word(i - 1) == ")" and word(
            header.opening[i - 1] - 1) in ("if", "constexpr", "for", "while")):
        yield from _dropped(header, i)


def _call(header, i):
    """Mistakes in name(argument, …), of which token i is the name; and in if (condition)."""
    text, bracket = header.word(i), i + 1
    close, given = header.partner[bracket], arguments(header, bracket)
    first = i - 2 if header.word(i - 1) == "::" else i
    if text in ("if", "while"):
        top = [header.word(j) for one in given for j in range(one[0], one[1] + 1)]
        if {"&&", "||"} & set(top):  # a single relation has been turned round already
            condition = header.between(bracket + 1, close - 1)
            yield "condition", bracket + 1, close - 1, f"!({condition})"
        return
    if text in EXTREMES:
        yield "extreme", i, i, EXTREMES[text]
        for one in given:
            yield "clamp", first, close, f"({header.between(*one)})"
    if text == "magnitude":
        yield "magnitude", first, i, ""
    if text == "clamped":
        given = given[1:]  # of the first two it takes the larger
    if text not in SYMMETRIC and len(given) > 1:
        one, other = header.between(*given[0]), header.between(*given[1])
        yield "arguments", given[0][0], given[1][1], f"{other}, {one}"


def _choice(header, question):
    """a ? b : c to a ? c : b"""
    depth, i = 0, question + 1
    while header.word(i) != ":" or depth > 0:
        depth += (header.word(i) == "?") - (header.word(i) == ":")
        i = header.after(i)
    colon = i
    while header.word(i) not in (";", ",", ")", "]", "}"):
        i = header.after(i)
    first = header.between(question + 1, colon - 1)
    second = header.between(colon + 1, i - 1)
    return "choice", question + 1, i - 1, f"{second} : {first}"


def _dropped(header, i):
    """The statement that begins at token i, left out: `if (…) …;`, an assignment or a call."""
    end = header.end_of_statement(i)
    if header.word(i) == "if":
        if header.word(i + 1) == "(" and header.word(header.after(i + 1)) not in ("{", "[["):
            if header.word(end + 1) != "else":
                yield "statement", i, end, ";"
        return
    if not end or end == i or not re.match(r"[\w(]", header.word(i)):
        return
    after = i + 1
    while header.word(after) == "::" or header.word(after) == "<" and after in header.partner:
        after = header.after(after) if header.word(after) == "<" else after + 2
    if not re.match(r"[A-Za-z_&]", header.word(after)):  # two names in a row declare something
        yield "statement", i, end, ";"


def _in_for(line):
    """Does a line end within the brackets of a `for`?"""
    start = line.rfind("for (")
    return start >= 0 and line.count("(", start) > line.count(")", start)


def one_line(text):
    """The code of some lines, without comments, on one line."""
    return " ".join(re.sub(r"//[^\n]*", "", text).split())


def mutants_of(name, text):
    """All mutants of a header, each edit once."""
    header, found = Header(name, text), {}
    for body in header.bodies:
        span = header.tokens[body[0]].start, header.tokens[body[1]].end
        if "#" in text[span[0]:span[1]]:
            continue  # the preprocessor's lines do not go on one line
        for i in header.computing(*body):
            for kind, first, last, replacement in _edits(header, i):
                start, end = header.tokens[first].start, header.tokens[last].end
                top, bottom = text.rfind("\n", 0, start) + 1, text.find("\n", end)
                before = one_line(text[top:bottom])
                after = one_line(text[top:start] + replacement + text[end:bottom])
                if before != after and not (kind == "statement" and _in_for(text[top:start])):
                    found.setdefault((start, end, replacement), Mutant(
                        name, text.count("\n", 0, start) + 1, kind, start, end, replacement, span,
                        before, after))
    return list(found.values())


def in_random_order(mutants, seed):
    """As a seed says, and each for itself: an edit elsewhere does not change who comes first."""
    count = collections.Counter()

    def lot(mutant):
        same = mutant.file, mutant.before, mutant.after
        count[same] += 1
        return hashlib.sha256(repr((seed, same, count[same])).encode()).digest()

    return [mutant for _, mutant in sorted(((lot(m), m) for m in mutants), key=lambda pair: pair[0])]


def together(text, numbered):
    """A header with many mutants in it, {number: mutant}: the body of a function stands there once as
    it is, and once, on a line of its own, for each of its mutants."""
    bodies = collections.defaultdict(dict)
    for number, mutant in numbered.items():
        bodies[mutant.body][number] = mutant
    for (start, end), inside in sorted(bodies.items(), reverse=True):
        lines = [f"{{ if (mutation::none_of({', '.join(map(str, inside))})) {text[start:end]}"]
        for number, m in inside.items():
            wrong = one_line(text[start:m.start] + m.text + text[m.end:end])
            lines.append(f"else if (mutation::chosen == {number}) /*mutant {number}*/ {wrong}")
        lines.append("else __builtin_unreachable(); }")
        text = text[:start] + "\n".join(lines) + text[end:]
    return text.replace("#pragma once", "#pragma once\n#include <passive_haptics/mutation.hpp>", 1)


def not_inlined(text):
    """A header of which no function has to be inlined: with its mutants that takes a compiler minutes."""
    return re.sub(r"(?:, )?gnu::(?:always_inline|flatten)", "", text)


# What the headers include in the end; the environment says which mutant is executed.
SWITCH = """#pragma once
#include <cstdlib>
#include <type_traits>
namespace mutation {
inline const int chosen = [] {
  const char* number = std::getenv("MUTANT");
  return number ? std::atoi(number) : 0;
}();
template <class... Number>
constexpr bool none_of(Number... number) noexcept {
  return std::is_constant_evaluated() || ((chosen != number) && ...);
}
}  // namespace mutation
"""
