#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what doxygen reads beside the headers: our pages, each with the links of GitHub turned into
its own, a page for each example with what it prints, one for each other file that a page links to, and
what has been built, the live page and those of the experiments.

    pages.py --root REPOSITORY --builds build --pages OUT --site HTML
"""

import argparse
import html
import pathlib
import re
import shutil
import sys

# In the order of the menu: file and label.
TASKS = ["buzz", "encoders", "force", "knob", "six_dof", "surfaces", "late", "numbers", "c_sharp"]
GUIDE = [
    ("docs/tutorial.md", "tutorial"),
    ("docs/loop.md", "loop"),
    ("docs/parts.md", "parts"),
    ("examples/README.md", "examples"),
    ("docs/guarantees.md", "guarantees"),
    ("docs/errors.md", "errors"),
    ("docs/troubleshooting.md", "troubleshooting"),
    ("docs/events.md", "events"),
]
TITLES = {"README.md": "passive_haptics"}
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".h": "c", ".c": "c", ".py": "py", ".cs": "cs"}
# Doxygen shows nothing of a namespace that has no comment, its functions and aliases included.
NAMES = """/** @namespace passive_haptics
@brief All of the library; simulation, identification, design and others have a namespace inside. */
"""
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")
FENCE = re.compile(r"^\s*(```|~~~)")


def slug(title):
    """The anchor that GitHub gives a heading."""
    kept = re.sub(r"[^\w\- ]", "", re.sub(r"[`*]", "", title).lower())
    return kept.strip().replace(" ", "-") if not title.startswith("-") else kept.replace(" ", "-")


def label_of(path):
    return re.sub(r"\W+", "_", path).strip("_").lower()


class Site:
    def __init__(self, root):
        self.root = root
        self.labels = {}  # of a file or folder
        self.anchors = {}  # of a heading: (file, slug) to label
        self.sources = []  # files and folders that pages link to, each once
        self.problems = []

    def add(self, path, label):
        """Its headings get labels, so that others can link to them."""
        self.labels[path] = label
        fenced = False
        used = {}
        for line in (self.root / path).read_text("utf-8").splitlines():
            if FENCE.match(line):
                fenced = not fenced
            heading = None if fenced else re.match(r"#{1,6} +(.*)", line)
            if heading:
                name = slug(heading[1])
                again = used.get(name, 0)
                used[name] = again + 1
                name += f"-{again}" if again else ""
                anchor = f"{label}_" + (re.sub(r"\W", "", name.replace("-", "_")) or "top")
                anchor = re.sub(r"[^A-Za-z0-9_]", "x", anchor)
                self.anchors.setdefault((path, name), anchor)

    def target(self, page, link):
        """What doxygen is told in place of `link`, which stands in the file `page`."""
        if "://" in link or link.startswith("mailto:"):
            return link
        path, _, anchor = link.partition("#")
        full = (self.root / page).parent / path if path else self.root / page
        full = full.resolve()
        try:
            name = full.relative_to(self.root.resolve()).as_posix()
        except ValueError:
            self.problems.append(f"{page}: {link} leads out of the repository")
            return link
        if not full.exists():
            self.problems.append(f"{page}: {link} does not exist")
            return link
        if anchor:
            if (name, anchor) in self.anchors:
                return "@ref " + self.anchors[name, anchor]
            self.problems.append(f"{page}: {link}: no such heading")
        if name in self.labels:
            return "@ref " + self.labels[name]
        if name.startswith("include/") and full.is_file() and full.suffix == ".hpp":
            return "@ref " + name.removeprefix("include/")
        self.labels[name] = "source_" + label_of(name)
        self.sources.append(name)
        return "@ref " + self.labels[name]

    @staticmethod
    def code(span):
        """`Code` as doxygen takes it: it ends a span of one backtick at an apostrophe, and makes a link
        of what follows `)::`."""
        if ")::" in span:
            inner = html.escape(span.strip("`")).replace("::", "\\::")
            return f"<code>{inner}</code>"
        return f"``{span[1:-1]}``" if "'" in span and not span.startswith("``") else span

    def links(self, page, line):
        """The line with its links turned; what stands in `code` is left alone."""
        def turned(found):
            if found[1]:  # an image
                return f"![{found[2]}]({pathlib.PurePosixPath(found[3]).name})"
            return f"[{found[2]}]({self.target(page, found[3])})"

        parts = re.split(r"(`+[^`]*`+)", line)
        # A link whose text is code: the code is put back afterwards.
        codes = [self.code(p) for p in parts[1::2]]
        text = "".join(p if i % 2 == 0 else f"\x00{i // 2}\x00" for i, p in enumerate(parts))
        text = LINK.sub(turned, text)
        # Doxygen sees no bold text that begins with a bracket.
        text = re.sub(r"\*\*(\([^*]+)\*\*", r"<b>\1</b>", text)
        return re.sub("\x00(\\d+)\x00", lambda m: codes[int(m[1])], text)

    def page(self, path):
        """The page as doxygen reads it."""
        label = self.labels[path]
        lines = []
        fenced = False
        used = {}
        first = True
        for line in (self.root / path).read_text("utf-8").splitlines():
            if FENCE.match(line):
                fenced = not fenced
                lines.append(re.sub(r"```(sh|text|toml|yaml|json|ini|cmake|bash|xml)\s*$", "```", line))
                continue
            if fenced:
                lines.append(line)
                continue
            finds = re.match(r"<!-- finds: (.*) -->$", line)
            if finds:  # search.py reads it there
                lines.append(f'@htmlonly[block]\n<p class="finds" hidden>{html.escape(finds[1])}</p>\n@endhtmlonly\n')
            if re.match(r"<!--.*-->$", line):
                continue
            heading = re.match(r"(#{1,6}) +(.*)", line)
            if not heading:
                lines.append(self.links(path, line))
                continue
            name = slug(heading[2])
            again = used.get(name, 0)
            used[name] = again + 1
            name += f"-{again}" if again else ""
            title = heading[2].replace("`", "")  # the menu shows no code
            if first:
                anchor = "mainpage" if label == "index" else label
                lines.append(f"# {TITLES.get(path, title)} {{#{anchor}}}")
                lines.append("")
                lines.append(f"@anchor {self.anchors[path, name]}")
            else:
                lines.append(f"{heading[1]} {title} {{#{self.anchors[path, name]}}}")
            first = False
        return "\n".join(lines) + "\n"


def listing(path, text):
    """A file in a fence that none of its lines closes."""
    language = LANGUAGES.get(path.suffix, "")
    mark = "~~~~~~" if "```" in text else "```"
    kind = f"{{.{language}}}" if language else ""
    return f"{mark}{kind}\n{text.rstrip()}\n{mark}\n"


def opening(text):
    """The comment that a source begins with, in paragraphs, and the rest."""
    comment = []
    lines = text.splitlines()
    at = 1 if lines and "SPDX" in lines[0] else 0
    while at < len(lines) and lines[at].startswith("//"):
        comment.append(lines[at][2:].removeprefix(" "))
        at += 1
    return comment, "\n".join(lines[at:]).strip("\n")


def example_page(source, label):
    comment, code = opening(source.read_text("utf-8"))
    out = [f"# {source.stem} {{#{label}}}", "", "@verbatim", *comment, "@endverbatim", ""]
    if not comment:
        out = out[:2]
    out.append(listing(source, code))
    printed = source.with_name(re.sub("_by_hand$", "", source.stem) + ".txt")
    if printed.exists():
        out += ["## What it prints {#" + label + "_prints}", "",
                "A test compares it, letter by letter.", "", listing(printed, printed.read_text("utf-8"))]
    return "\n".join(out) + "\n"


TYPE = r"^(?:[^\n;{}/]*\) )?(?:struct|class|using|concept) (\w+)\b(?!;)"
# Short for a namespace inside where a program includes the line that says so.
SHORT = {"ph": "", "passive_haptics": "", "sim": "simulation", "env": "environment"}


def uses(text, inner):
    """(namespace inside, name) of all that `text` calls by its full name; `inner`: the namespaces there are."""
    names = {**{name: name for name in inner}, **SHORT}
    names.update(re.findall(r"namespace (\w+) = (?:ph|passive_haptics)::(\w+);", text))
    found = set()
    for first, *rest in (m.split("::") for m in re.findall(r"\b\w+(?:::\w+)+", text)):
        if first in names:
            inside = names[first]
            found.add((inside, rest[0]))
            if not inside and len(rest) > 1:
                found.add((rest[0], rest[1]))
    return found


def shown_at(root, examples, problems):
    """What header.awk puts at a function or a type: for each that composes something its header, its name, the program
    that is shown and the pages of others that call it; for each type or alias its header, its name, "=", and up to
    three pages of programs that use it, or the test that tries it."""
    folder = root / "include/passive_haptics"
    core = (folder / "passive_haptics.hpp").read_text("utf-8")
    texts = {p: p.read_text("utf-8") for p in sorted(examples, key=lambda p: (p.parent.name != "first", p.name))}
    tests = {p.relative_to(root).as_posix(): p.read_text("utf-8") for p in sorted((root / "tests").rglob("*.cpp"))
             if "compile_fail" not in p.parts}
    codes = {p: p.read_text("utf-8") for p in sorted(folder.rglob("*.hpp"))}
    inside_of = {p: next((n for n in re.findall(r"^namespace (\w+) \{$", code, re.M)
                          if n not in ("passive_haptics", "detail")), "") for p, code in codes.items()}
    of_examples = {p: uses(text, inside_of.values()) for p, text in texts.items()}
    of_tests = {p: uses(text, inside_of.values()) for p, text in tests.items()}
    lines = []
    for header, code in codes.items():
        path = header.relative_to(folder).as_posix()
        inside = inside_of[header]
        included = f"<passive_haptics/{path}>"
        for name in sorted(set(re.findall(r"\bauto\s(make_\w+)\(", code))):
            calls = [p for p, text in texts.items()
                     if re.search(rf"ph::{name}[<(]", text) and (included in text or included in core)]
            if calls:
                others = [f"example_{label_of(p.stem)}" for p in calls[1:] if p.parent.name == "first"]
                lines.append(" ".join([path, name, calls[0].as_posix(), *others]))
            else:
                problems.append(f"{path}: no program of examples/ calls {name}")
        for name in sorted(set(re.findall(TYPE, code, re.M))):
            told = [f"example_{label_of(p.stem)}" for p, used in of_examples.items() if (inside, name) in used][:3]
            if not told:  # the test of the header first
                tried = sorted((p for p, used in of_tests.items() if (inside, name) in used),
                               key=lambda p: (not p.endswith(f"/{header.stem}.cpp"), p))
                told = tried[:1]
            if told:
                lines.append(" ".join([path, name, "=", *told]))
    return "\n".join(lines) + "\n"


def built_pages(builds):
    """(folder, title, description) of each page that a build has left behind."""
    for page in sorted(builds.glob("*/*/index.html")):
        text = page.read_text("utf-8", "replace")[:20000]
        title = re.search(r"<title>([^<]*)</title>", text)
        if page.parent.parent.name == "docs" or not title:
            continue
        about = re.search(r'<meta name="description" content="([^"]*)"', text)
        yield page.parent, html.unescape(title[1]), html.unescape(about[1]) if about else ""


def built(builds, site):
    """The pages `experiments` and `live`; what they show is copied into the site."""
    out = ["# The experiments {#experiments}", ""]
    found = list(built_pages(builds))
    for folder, title, about in found:
        name = f"{folder.parent.name}_{folder.name}" if folder.parent.name != folder.name else folder.name
        copied = site / "experiments" / name
        copied.mkdir(parents=True, exist_ok=True)
        for file in folder.iterdir():
            if file.suffix in (".html", ".svg", ".json", ".md"):
                shutil.copy(file, copied)
        title = title.removeprefix("passive_haptics: ")
        out += [f'- <a href="experiments/{name}/index.html"><b>{html.escape(title)}</b></a> '
                f"{html.escape(about)}"]
    if not found:
        out += ["None had been run when this site was built: `cmake --workflow --preset demo` runs the first, and",
                "the next build of the site finds its page."]
    live = ["# The live page {#live}", ""]
    if (builds / "page" / "index.html").exists():
        (site / "live").mkdir(exist_ok=True)  # it is one file
        shutil.copy(builds / "page" / "index.html", site / "live")
        live += ["The library itself, compiled for the browser, on a simulated device: nothing is fetched.", "",
                 "@htmlonly", '<p><a href="live/index.html">On a page of its own</a></p>',
                 '<iframe class="live" src="live/index.html" title="The live page"></iframe>',
                 "@endhtmlonly"]
    else:
        live += ["It had not been built when this site was."]
    return "\n".join(out) + "\n", "\n".join(live) + "\n"


def readable(path):
    """True of a folder, and of a file that is text."""
    if path.is_dir():
        return True
    try:
        path.read_text("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("root", "builds", "pages", "site"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    given = parser.parse_args()
    root = given.root
    site = Site(root)
    guide = [(path, label) for path, label in GUIDE if (root / path).exists()]
    named = {path for path, _ in guide}
    practice = [(p.relative_to(root).as_posix(), p.stem) for p in sorted((root / "docs").glob("*.md"))]
    practice = [entry for entry in practice if entry[0] not in named]
    design = [(p.relative_to(root).as_posix(), "design_" + p.stem)
              for p in sorted((root / "docs" / "design").glob("*.md"))]
    project = [("CHANGELOG.md", "changelog"), ("CONTRIBUTING.md", "contributing"), ("SECURITY.md", "security")]
    tasks = [(f"docs/tasks/{name}.md", f"task_{name}") for name in TASKS]
    forgotten = {p.relative_to(root).as_posix() for p in (root / "docs" / "tasks").glob("*.md")} - {t[0] for t in tasks}
    site.problems += [f"{path}: stands in no menu" for path in sorted(forgotten)]
    for path, label in [("README.md", "index"), *tasks, *guide, *practice, *design, *project]:
        site.add(path, label)
    examples = [p for p in sorted((root / "examples").rglob("*.cpp"))
                if p.parent == root / "examples" or p.parent.name in ("tutorial", "first")]
    for source in examples:
        site.labels[source.relative_to(root).as_posix()] = "example_" + label_of(source.stem)

    for folder in (given.pages, given.site):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
    order = iter(range(10, 1000))

    def write(label, text):
        (given.pages / f"{next(order):03d}_{label}.md").write_text(text, "utf-8")

    def menu(label, title, text, entries):
        write(label, f"# {title} {{#{label}}}\n\n{text}\n\n" + "".join(f"- @subpage {e}\n" for e in entries))

    (given.pages / "names.dox").write_text(NAMES, "utf-8")
    (given.pages / "examples.txt").write_text(shown_at(root, examples, site.problems), "utf-8")
    write("index", site.page("README.md"))
    menu("tasks", "What do you have?", "A page each: what to compose, the whole program, which numbers, and what to read next.",
         [label for _, label in tasks])
    for path, label in tasks:
        write(label, site.page(path))
    for path, label in guide:
        text = site.page(path)
        if label == "examples":
            text += "\n## The programs {#examples_programs}\n\n" + "".join(
                f"- @subpage {site.labels[p.relative_to(root).as_posix()]}\n" for p in examples)
        write(label, text)
        if label == "examples":
            for source in examples:
                name = site.labels[source.relative_to(root).as_posix()]
                write(name, example_page(source, name))
    experiments, live = built(given.builds, given.site)
    write("live", live)
    write("experiments", experiments)
    menu("practice", "Devices, builds and interfaces", "What stands around a tick.", [e[1] for e in practice])
    for path, label in practice:
        write(label, site.page(path))
    menu("design", "Design", "Why it is as it is: formulas, proofs and what was measured.",
         [e[1] for e in design])
    for path, label in design:
        write(label, site.page(path))
    menu("project", "The project", "What has changed, and how to take part.", [e[1] for e in project])
    for path, label in project:
        write(label, site.page(path))
    texts = []
    for name in site.sources:  # grows while it is read: a folder brings its files
        label = site.labels[name]
        full = root / name
        if full.is_dir():
            lines = []
            files = sorted(full.iterdir())
            for file in files:
                if len(files) > 50 or not readable(file):  # a corpus of bytes
                    lines.append(f"- {file.name}\n")
                    continue
                link = site.target(f"{name}/-", file.name)
                lines.append(f"- [{file.name}]({link})\n")
            texts.append((label, f"# {name} {{#{label}}}\n\n" + "".join(lines)))
        else:
            texts.append((label, f"# {name} {{#{label}}}\n\n" + listing(full, full.read_text("utf-8"))))
    if texts:
        menu("sources", "Files that the pages name", "As they stand in the repository.", [t[0] for t in texts])
        for label, text in texts:
            write(label, text)
    for problem in site.problems:
        print(problem, file=sys.stderr)
    return 1 if site.problems else 0


if __name__ == "__main__":
    sys.exit(main())
