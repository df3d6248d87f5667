#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Shows at each type lines that use it, word for word from a program or a test that compiles: at what a function
returns those that call it, at what a struct holds those that read it, at a class inside another the other's. What
nothing but the library uses says by what it is used there.

    shown.py --root REPOSITORY --site HTML --tags TAGS --without LIST           writes them into the pages
    shown.py --root REPOSITORY --site HTML --tags TAGS --without LIST --check   a line for each type that has no
             example and does not stand in LIST, and for lines that stand in no file; and 1, if there is one
    shown.py --try                                                              plants some, and finds them
"""

import argparse
import bisect
import html
import pathlib
import re
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

TYPES = ("struct", "class", "concept")
LIBRARY = "passive_haptics"
# Short for a namespace inside where a program includes the line that says so.
SHORT = {"ph": LIBRARY, LIBRARY: LIBRARY, "sim": f"{LIBRARY}::simulation", "env": f"{LIBRARY}::environment"}
FEWEST, MOST = 3, 8  # lines
AT, GIVEN = r"(?<![\w:.>])", r"(?:<[^;{}()]*>)?(?:\{| \w+ ?[={;(])"  # before a name, and after one that is made
KEYWORDS = ("requires|noexcept|decltype|alignas|deprecated|explicit|static_assert|if|for|while|switch|return|sizeof|"
            "push_back")
OWN = re.compile(r"<dt>Example</dt>|<pre class=\"fragment shown\"")
BLOCK = re.compile(r'<pre class="fragment shown" data-from="([^"]*)" data-uses="([^"]*)">(.*?)</pre>', re.S)


class Tags:
    """What doxygen has found: types, and what returns, holds or takes one."""

    def __init__(self, path, root):
        self.pages = {}  # of a type: its page
        self.kinds = {}
        self.functions, self.variables, self.aliases = [], [], []
        self.spaces = []
        for compound in ElementTree.parse(path).getroot():
            name, kind = compound.findtext("name"), compound.get("kind")
            if kind in TYPES and "<" not in name and not re.search(r"\bdetail\b", name):
                page = compound.findtext("filename")
                self.pages[name] = page if page.endswith(".html") else page + ".html"
                self.kinds[name] = kind
            if kind == "namespace":
                self.spaces.append(name)
            if kind == "file":  # its functions are in the namespace that it opens
                header = root / "include" / (compound.findtext("path") or "") / name
                code = header.read_text("utf-8") if header.exists() else ""
                inside = [n for n in re.findall(r"^namespace ([\w:]+) \{$", code, re.M) if n not in (LIBRARY, "detail")]
                name = "::".join([LIBRARY, *inside[:1]])
            elif kind not in ("struct", "class", "namespace"):
                continue
            for member in compound.findall("member"):
                text = {part: member.findtext(part) or ""
                        for part in ("type", "name", "arglist", "anchor", "anchorfile")}
                text["owner"], text["free"] = name, kind in ("namespace", "file")
                if member.get("kind") == "function" and "operator" not in text["name"]:
                    self.functions.append(text)
                elif member.get("kind") == "variable":
                    self.variables.append(text)
                elif member.get("kind") == "typedef":
                    self.aliases.append(text)

    def outer(self, name):
        """The type that holds this one, if it is one."""
        outer = name.rpartition("::")[0]
        return outer if outer in self.pages else ""

    def same(self, said, name, owner):
        """True if `said`, which stands in `owner`, names the type."""
        short = name.rpartition("::")[2]
        for found in re.finditer(r"[\w:]*\b" + short + r"\b(?!::)", said):
            spelled = found[0].removeprefix("::")
            scope = owner
            while True:  # from the inside out, as a compiler looks
                full = f"{scope}::{spelled}" if scope else spelled
                if full in self.pages or full == name:
                    if full == name:
                        return True
                    break
                if not scope:
                    break
                scope = scope.rpartition("::")[0]
        return False


def bare(text):
    """The code with comments and strings blanked, line by line as long as before."""
    def blanked(found):
        return re.sub(r"[^\n]", " ", found[0]) if found[0].startswith("/") else '"' + " " * (len(found[0]) - 2) + '"'

    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', blanked, text, flags=re.S)


def with_included(root, path, found):
    """The code of a file and of what it includes from our own folders, by path."""
    if path in found:
        return found
    text = path.read_text("utf-8")
    found[path] = bare(text)
    for name in re.findall(r'^#include "([^"]*)"', text, re.M):
        for folder in (path.parent, root / "tests"):
            if (folder / name).exists():
                with_included(root, (folder / name).resolve(), found)
                break
    return found


class Source:
    """A file of ours that compiles, and what its names mean."""

    def __init__(self, root, path, inner):
        self.path = path.relative_to(root).as_posix()
        text = path.read_text("utf-8")
        self.lines = text.splitlines()
        self.code = bare(text)
        self.bare = self.code.splitlines()
        self.seen = "\n".join(with_included(root, path, {}).values())
        self.words = set(re.findall(r"\w+", self.code))
        self.known = set(re.findall(r"\w+", self.seen))
        self.names = {**{name: f"{LIBRARY}::{name}" for name in inner}, **SHORT}
        for short, full in re.findall(r"namespace (\w+) = ([\w:]+);", self.seen):
            self.names[short] = self.full(full)
        opened = re.findall(r"^(?:using )?namespace ([\w:]+)\s*[;{]", self.seen, re.M)
        self.opened = {self.full(name) for name in opened}
        self.stretches = []
        self.used = {}
        for name in re.findall(r"^\s*using ([\w:]+);", self.seen, re.M):
            self.used[name.rpartition("::")[2]] = self.full(name)
        for short, name in re.findall(r"^\s*using (\w+) = ([\w:]+)", self.code, re.M):
            self.used.setdefault(short, self.full(name))

    def full(self, name):
        first, colons, rest = name.partition("::")
        return self.names.get(first, first if first == LIBRARY else f"{LIBRARY}::{first}") + colons + rest

    def spellings(self, name):
        """The ways in which this file may write that name of the library."""
        scope, _, short = name.rpartition("::")
        ways = [f"{s}::{short}" for s, full in self.names.items() if full == scope]
        inside = scope.removeprefix(LIBRARY).removeprefix("::")
        if inside:
            ways += [f"{s}::{inside}::{short}" for s, full in self.names.items() if full == LIBRARY]
        for opened in self.opened:
            if scope == opened or scope.startswith(opened + "::"):
                ways.append(name.removeprefix(opened + "::"))
        return ways + [s for s, full in self.used.items() if full == name]

    def scopes(self):
        """(where it begins, its namespace or type, whether it is a type, whether it is public there, the function) of
        each stretch of a header; of what stands in a function, public is None."""
        if self.stretches:
            return self.stretches
        stack, due, called, depth, outside = [("", True, True, "")], None, "", 0, []
        self.stretches.append((0, *stack[0]))
        for found in re.finditer(r"[{};]|\b(namespace|struct|class|enum class|concept) ([\w:]+)|"
                                 r"\b(public|private|protected):|(\w*)\(|\)", self.code):
            name, is_type, public, function = stack[-1]
            if found[1]:
                inside = "" if found[2] == "v0" else found[2]
                due = ("::".join(filter(None, (name, inside))), found[1] != "namespace", found[1] != "class", "")
            elif found[3]:
                stack[-1] = (name, is_type, found[3] == "public", "")
            elif found[0] == "{":
                stack.append(due or (name, is_type, None, function or called))
                outside.append((called, depth))
                called, depth = "", 0
            elif found[0] == "}" and outside:
                stack.pop()
                called, depth = outside.pop()
                called = called if depth else ""  # a default argument ends no function's head
            if found[0][-1] in "()":
                depth += 1 if found[0][-1] == "(" else -1
            if found[4] and not called and not re.fullmatch(KEYWORDS, found[4]):
                called = found[4]
            if not found[1] and not found[3]:
                due = None
            if found[0] == ";":
                called = ""
            self.stretches.append((found.end(), *stack[-1]))
        return self.stretches

    def scope(self, at):
        return self.scopes()[bisect.bisect_right(self.scopes(), at, key=lambda s: s[0]) - 1][1:]

    def named_by(self, use):
        """The name of the type, alias, function or constant outside of a body whose declaration says that."""
        begin = max(self.code.rfind(c, 0, use.start()) for c in ";{}") + 1
        before, behind = (" ".join(text.split())
                          for text in (self.code[begin:use.start()] + "|", self.code[use.end():]))
        type_name = r"(?<!, )(?<!<)\b(?:struct|class|concept|using) (\w+)"
        function = rf"\b(?!(?:{KEYWORDS})\b)(\w+)"
        skipped = r"(?:[^;{}()]|\([^()]*\))*?"
        named = (re.search(type_name + r"(?: final)? ?[:=][^:][^;{}]*$", before) or
                 re.search(function + r"\([^;{}]*$", before) or re.match(skipped + type_name, behind) or
                 re.match(skipped + function + r"[({]", behind))
        return named and named[1]

    def where(self, pattern):
        """(number of the line on which the pattern begins, the last name in it) of each place."""
        return [(self.code.count("\n", 0, found.start()), re.findall(r"\w+", found["named"])[-1])
                for found in re.finditer(pattern, self.code)]

    def mentions(self, name):
        return name.rpartition("::")[2] in self.known and any(
            re.search(r"(?<![\w:.>])" + way + r"\b(?!::\w+::)", self.seen) for way in self.spellings(name))

    def ends(self, i):
        line = self.bare[i].strip()
        return not line or line.endswith((";", "{", "}", ":")) or line.startswith("#")

    def statement(self, i):
        """First and last line of the statement that line i is of."""
        first = i
        while first > 0 and not self.ends(first - 1):
            first -= 1
        depth = 0
        for last in range(first, len(self.bare)):
            line = self.bare[last].rstrip()
            depth += sum(line.count(c) for c in "([{") - sum(line.count(c) for c in ")]}")
            if last >= i and self.ends(last) and (depth <= 0 or (depth == 1 and line.endswith("{"))):
                return first, last
        return first, i

    def excerpt(self, i, part):
        """The lines to show for line i, (first, last), or None: its statement and those after it that use what it
        makes; `part`: of a statement that is longer the lines around."""
        first, last = self.statement(i)
        if re.match(r"\s*(using [\w:]+;|using namespace|#|namespace|TEST_CASE|(struct|class|concept) \w+ *[:={])",
                    self.bare[first]):
            return None
        if last - first + 1 > MOST:
            first = max(first, i - FEWEST)
            return (first, min(last, first + MOST - 1)) if part else None
        indent = len(self.lines[first]) - len(self.lines[first].lstrip())

        def inside(j):
            return 0 <= j < len(self.lines) and self.bare[j].strip() and (
                len(self.lines[j]) - len(self.lines[j].lstrip()) >= indent) and not self.bare[j].strip().startswith("}")

        opened = self.bare[last].rstrip().endswith("{")
        made = re.findall(r"(?:\bauto[&*]*|[\w>]) (\w+)\s*(?:[={;(,)]|$)", " ".join(self.bare[first:last + 1]))
        made += [n for names in re.findall(r"auto[&]* \[([^\]]*)\]", " ".join(self.bare[first:last + 1]))
                 for n in re.findall(r"\w+", names)]
        while inside(last + 1):
            begins, ends = self.statement(last + 1)
            if ends - first + 1 > MOST or not all(inside(j) or j == ends for j in range(begins, ends + 1)):
                break
            uses = any(re.search(rf"\b{name}\b", " ".join(self.bare[begins:ends + 1])) for name in made)
            if not (uses or opened or last - first + 1 < FEWEST):
                break
            last = ends
        while last - first + 1 < FEWEST and first > 0 and self.bare[first - 1].strip():
            begins = self.statement(first - 1)[0]
            if last - begins + 1 > MOST or re.match(r"\s*[}#]", self.bare[begins]):
                break
            first = begins
        while part and last - first + 1 < FEWEST:  # the line before it or after it, whatever it is
            if first > 0 and self.bare[first - 1].strip() and not self.bare[first - 1].lstrip().startswith("#"):
                first -= 1
            elif last + 1 < len(self.lines) and re.match(r"\s*[^\s#]", self.lines[last + 1]):
                last += 1
            else:
                break
        if any(line.endswith("\\") for line in self.lines[first:last + 1]):  # a macro
            return None
        return (first, last) if (part or FEWEST <= last - first + 1) and last - first + 1 <= MOST else None


class Shown:
    def __init__(self, root, tags):
        self.tags = tags
        programs = sorted((root / "examples").rglob("*.[ch]pp"), key=lambda p: (p.parent.name != "first", p))
        tests = sorted(p for f in ("tests", "bench") for p in (root / f).rglob("*.[ch]pp")
                       if not {"compile_fail", "fuzz"} & set(p.parts))
        headers = sorted((root / "include").rglob("*.hpp"))
        inner = {name.removeprefix(f"{LIBRARY}::") for name in tags.spaces if name.count("::") == 1}
        self.programs, self.tests, self.headers = ([Source(root, p, inner) for p in paths]
                                                   for paths in (programs, tests, headers))

    def first(self, sources, patterns, words, near, part=False):
        """(file, first, last) of the best lines that match, or None; `near` is the folder and the name of a header."""
        best = None
        for source in sources:
            if not words & source.words:
                continue
            path = pathlib.PurePosixPath(source.path)
            far = 0 if path.stem == near[1] else 1 if path.parent.name == near[0] else 2
            if source.path.startswith("examples/"):
                far = -1
            if source.path.startswith("bench/"):
                far = 3
            if best and (far, 0, 0) > best[0]:
                continue
            for rank, pattern in enumerate(patterns(source)):
                for i, word in source.where(pattern):
                    lines = source.excerpt(i, part)
                    if lines and (not best or (far, rank, abs(lines[1] - lines[0] - 4)) < best[0]):
                        best = ((far, rank, abs(lines[1] - lines[0] - 4)), word, source, *lines)
        return best and best[1:]

    def members(self, name):
        """(owner, name, kind) of what the headers declare of that type: a call, a value, or a short name in a type. The
        tags have those alone that have a comment."""
        wanted, asked, found = [(name, "")], {name}, []
        while wanted:
            full, only = wanted.pop()
            short = full.rpartition("::")[2]
            for header in self.headers:
                if short not in header.words:
                    continue
                for use in re.finditer(rf"(?:using (\w+) = )?(?<![\w:])((?:\w+::)*{short})\b(?:<[^;(){{}}]*?>+)?"
                                       r"(?:, \w+>+)?[\s&*>]*(?:(?<=[\s&*])(\w+)(?=[({;,]| =|\[))?", header.code):
                    owner, _, public, _ = header.scope(use.start())
                    if not public or re.search(r"\bdetail\b", owner) or (only and owner != only):
                        continue
                    if not only and not self.tags.same(use[2], name, owner):
                        continue
                    if use[1] and owner in self.tags.pages:
                        alias = f"{owner}::{use[1]}"
                        if alias not in asked:  # a short name may be the name itself
                            wanted.append((alias, owner))
                        asked.add(alias)
                    elif use[3] and not re.fullmatch(KEYWORDS + "|operator|const", use[3]):
                        called = header.code[use.end():use.end() + 1] == "("
                        found.append((owner, use[3], "call" if called else "value"))
        return found

    def users(self, name):
        """Types and functions of the library whose code names it, nearest first; what is `detail` counts as its own
        users."""
        asked, queue, found = {name}, [name], []
        while queue:
            full = queue.pop(0)
            short = full.rpartition("::")[2]
            for header in self.headers:
                uses = rf"(?<![\w.>])((?:\w+::)*{short})(?=<|&|\(| ?\{{|::|>|,|;| \w+ ?[;=({{,)>]|\n)"
                for use in re.finditer(uses, header.code) if short in header.words else ():
                    scope, is_type, public, function = header.scope(use.start())
                    if scope == full or scope.startswith(full + "::") or not self.tags.same(use[1], full, scope):
                        continue
                    if not is_type:  # in a function, or before or behind the name of what it is used for
                        of = function or (public and header.named_by(use)) or ""
                        if not of:
                            continue
                        scope += f"::{of}"
                    while scope not in self.tags.pages and scope.rpartition("::")[0] in self.tags.pages:
                        scope = scope.rpartition("::")[0]
                    if scope in asked:
                        continue
                    asked.add(scope)
                    if not re.search(r"\bdetail\b", scope):
                        found.append(scope)
                    if scope not in self.tags.pages:
                        queue.append(scope)
        return found

    def of(self, name, near):
        """(what is said of the lines, the name in them, file, first, last), or None."""
        tags, short = self.tags, name.rpartition("::")[2]

        def link(member, said):
            return f'<a class="el" href="{member["anchorfile"]}#{member["anchor"]}">{said}</a>'

        names = [name]
        for alias in tags.aliases:
            if alias["owner"] == name.rpartition("::")[0] and tags.same(alias["type"], name, alias["owner"]):
                names.append(f"{alias['owner']}::{alias['name']}")
        outer = tags.outer(name)
        called = {n.rpartition("::")[2] for n in names}

        def named(source):
            ways = [way for n in names for way in source.spellings(n)]
            if outer:
                ways += [way + r"(?:<[^<>;]*>)?::" + short for way in source.spellings(outer)]
            return [AT + f"(?P<named>{way})" + end for end in (GIVEN, r"\b(?!::\w+::)") for way in ways]

        def calls(member):
            def pattern(source):
                f = member["name"]
                if member["free"]:
                    ways = source.spellings(f"{member['owner']}::{f}")
                    return [AT + f"(?P<named>{way})" + r"(?:<[^;{}()]*>)?\(" for way in ways]
                if f == member["owner"].rpartition("::")[2]:  # it is made of one
                    return [AT + f"(?P<named>{way})" + GIVEN for way in source.spellings(member["owner"])]
                return [rf"(?:\.|->)(?P<named>{f})(?:<[^;{{}}()]*>)?\("] if source.mentions(member["owner"]) else []
            return pattern

        def reads(member):
            def pattern(source):
                return [rf"\.(?P<named>{member['name']})\b(?!\()"] if source.mentions(member["owner"]) else []
            return pattern

        def public(member):
            return member["anchor"] and not re.search(r"\bdetail\b", member["owner"]) and (
                member["free"] or member["owner"] != name)

        def gives(member):
            makes = member["name"] == f"make_{short}" and f"{member['owner']}::{short}" == name
            return makes or tags.same(member["type"], name, member["owner"])

        giving = [m for m in tags.functions if public(m) and gives(m)]
        taking = [m for m in tags.functions if public(m) and tags.same(m["arglist"], name, m["owner"])]
        holding = [m for m in tags.variables if public(m) and tags.same(m["type"], name, m["owner"])]
        ways = [(named, "", short)]
        ways += [(calls(m), f"{link(m, m['name'] + '()')} returns it", m["name"]) for m in giving]
        ways += [(reads(m), f"{link(m, m['owner'].rpartition('::')[2] + '::' + m['name'])} is one", m["name"])
                 for m in holding]
        ways += [(calls(m), f"{link(m, m['name'] + '()')} takes it", m["name"]) for m in taking]
        known = {m["name"] for m in giving + holding}

        def untold():  # of what has no comment the tags say nothing
            for owner, member, kind in self.members(name):
                is_free = owner not in tags.pages
                m = {"owner": owner, "name": member, "free": is_free}
                at = html.escape(member if is_free else f"{owner.rpartition('::')[2]}::{member}")
                if member in known or owner == name:
                    continue
                if kind == "call":
                    yield calls(m), f"<code>{at}()</code> returns it", member
                elif not is_free:
                    yield reads(m), f"<code>{at}</code> is one", member

        def inside():
            for user in self.users(name):
                if user not in tags.pages:
                    f = user.rpartition("::")[2]
                    yield (lambda source, user=user: [AT + rf"(?P<named>{way})\b" for way in source.spellings(user)],
                           f"<code>{f}</code> uses it", f)

        def groups():  # each is asked for only if there is nothing before it; users the nearest first
            yield ways
            yield list(untold())
            for way in inside():
                yield [way]

        for some in groups():
            for part in (False, True):
                for sources in (self.programs, self.tests):
                    for patterns, said, word in some:
                        found = self.first(sources, patterns, {word} if said else called, near, part)
                        if found:
                            return (said, *found)
        return None


def block(said, word, source, first, last):
    lines = source.lines[first:last + 1]
    indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    text = "\n".join(line[indent:] for line in lines)
    told = f"In <code>{html.escape(source.path)}</code>{', where ' + said if said else ''}:"
    return (f'<p>{told}</p>\n<pre class="fragment shown" data-from="{html.escape(source.path)}" data-uses="{word}">'
            f"{html.escape(text, quote=False)}</pre>\n")


def place(path, added):
    text = path.read_text("utf-8")
    for end in ("<hr/>The documentation for this", "</div><!-- contents -->"):
        if end in text:
            path.write_text(text.replace(end, f'<h2 class="groupheader">Example</h2>\n{added}{end}', 1), "utf-8")
            return


def write(root, site, tags, without):
    shown = Shown(root, tags)
    lines = others = 0
    done, left = {}, []
    for name, page in sorted(tags.pages.items(), key=lambda entry: entry[0].count("::")):
        path = site / page
        text = path.read_text("utf-8")
        if OWN.search(text):
            done[name] = page
            continue
        if name in without:
            continue
        header = re.search(r"#include &lt;<a [^>]*>([^<]*)</a>", text)
        where = pathlib.PurePosixPath(header[1] if header else "")
        found = shown.of(name, (where.parent.name, where.stem, f"include/{where}"))
        outer = tags.outer(name)
        if found:
            place(path, block(*found))
            lines += 1
        elif outer in done:
            at = outer.rpartition("::")[2]
            place(path, f'<p>It comes with <a class="el shown" href="{done[outer]}">{at}</a>, whose example shows '
                        "it.</p>\n")
            others += 1
        else:
            left.append(name)
            continue
        done[name] = page
    inner = 0
    while left:  # what is used by what has an example, and then what is used by that
        now = [(name, user) for name in left for user in shown.users(name) if user in done]
        if not now:
            break
        for name, user in {name: user for name, user in reversed(now)}.items():
            at = user.rpartition("::")[2]
            place(site / tags.pages[name], "<p>No program has to name it. The library uses it in "
                  f'<a class="el shown" href="{done[user]}">{at}</a>.</p>\n')
            done[name] = tags.pages[name]
            left.remove(name)
            inner += 1
            print(f"used by the library alone: {name.removeprefix(LIBRARY + '::')}, in {at}")
    print(f"examples: {len(done)} of {len(tags.pages)} types, {lines} of them by lines that use them, {others} by what "
          f"they come with, {inner} by what in the library uses them")


def listed(path):
    """Types that have no example, and why: "name: reason" a line."""
    entries = {}
    for line in path.read_text("utf-8").splitlines():
        if line and not line.startswith("#"):
            name, _, reason = line.partition(": ")
            entries[f"{LIBRARY}::{name}"] = reason.strip()
    return entries


def wrong(root, site, pages, without):
    """A sentence for each type without an example, for lines that stand in no file or in the library itself, and for
    what is listed in vain."""
    found = []
    for name, page in sorted(pages.items()):
        text = (site / page).read_text("utf-8")
        has = OWN.search(text) or 'class="el shown"' in text
        if has and name in without:
            found.append(f"{name} has an example and need not be listed")
        elif not has and not without.get(name):
            found.append(f"{name} has no example, nor a reason in the list")
        for path, word, lines in BLOCK.findall(text):
            if path.startswith("include/"):
                found.append(f"{name} is shown by the library's own code")
            lines = html.unescape(lines).splitlines()
            file = [line.strip() for line in (root / path).read_text("utf-8").splitlines()]
            wanted = [line.strip() for line in lines]
            if not 1 <= len(lines) <= MOST:
                found.append(f"{name} is shown in {len(lines)} lines")
            if not any(file[i:i + len(wanted)] == wanted for i in range(len(file))):
                found.append(f"{name}: {path} has no such lines")
            if not any(re.search(rf"\b(basic_)?{re.escape(word.removeprefix('basic_'))}\b", line) for line in lines):
                found.append(f"{name}: its example does not say {word}")
    found += [f"{name} is listed and is no type" for name in without if name not in pages]
    return found


def attempt():
    """Pages of which each but the first has one thing wrong; each is found, and the first is not."""
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        (folder / "a.cpp").write_text("  one = f();\n  two(one);\n  three();\n  one = f();\n" + "  three();\n" * MOST)

        (folder / "include").mkdir()
        (folder / "include/a.hpp").write_text((folder / "a.cpp").read_text())

        def page(lines, word="f", path="a.cpp"):
            return f'<pre class="fragment shown" data-from="{path}" data-uses="{word}">{lines}</pre>'

        sound = "one = f();\ntwo(one);\nthree();"
        planted = {"sound": page(sound), "none": "<p>nothing</p>", "drifted": page(sound.replace("two", "2")),
                   "lengthy": page("\n".join(["one = f();", *["three();"] * MOST])),
                   "silent": page(sound, "g"), "listed": page(sound),
                   "own": page(sound, path="include/a.hpp")}
        for name, text in planted.items():
            (folder / f"{name}.html").write_text(text)
        found = wrong(folder, folder, {name: f"{name}.html" for name in planted}, {"listed": "why", "gone": "why"})
        named = sorted(re.split(r"[ :]", line)[0] for line in found)
        print("\n".join(found))
        return 0 if named == ["drifted", "gone", "lengthy", "listed", "none", "own", "silent"] else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("root", "site", "tags", "without"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    for name in ("check", "try"):
        parser.add_argument(f"--{name}", action="store_true")
    given = parser.parse_args()
    if getattr(given, "try"):
        return attempt()
    tags, without = Tags(given.tags, given.root), listed(given.without)
    if not given.check:
        write(given.root, given.site, tags, without)
        return 0
    problems = wrong(given.root, given.site, tags.pages, without)
    print("\n".join(problems))
    print(f"{len(tags.pages)} types, {len(without)} of them listed without an example, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
