#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Gives the site its search: reads what doxygen has written, page by page and section by section, writes
search_index.js beside it, and puts the box on every page. What a section is also found by, in words that it
does not use, stands in it as `<!-- finds: WORDS -->` (pages.py keeps that as a hidden line).

    search.py --site HTML --tags tags.xml --script search.js

A word weighs more in a heading than in a text, and more in a task than in the reference; search.js only adds up.
"""

import argparse
import collections
import html.parser
import json
import math
import pathlib
import re
import shutil
import sys
import xml.etree.ElementTree

# How much a hit counts there, by the beginning of a page's label; the first that fits. A menu is a list of others.
MENUS = {"tasks", "practice", "design", "project", "sources"}
PAGES = [("task_", 3.0), ("index", 1.0), ("source_", 0.15), ("example_", 0.5), ("changelog", 0.1),
         ("contributing", 0.5), ("design_", 0.9), ("", 1.4)]
KINDS = {"task_": "task", "source_": "file", "example_": "example", "design_": "design"}
NAMES = 0.7  # of a header, a type or a function
EXACT = 4  # and so much more if the name has an underscore: who types that wants the name itself
FOUND, HEADING, NAME, PAGE, TEXT = 12.0, 6.0, 9.0, 2.5, 1.5  # what a word counts by where it stands
MOST = 60  # sections that a word leads to

WORD = re.compile(r"[a-z0-9_#+µ]+")
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}
BOX = ('<form id="find" role="search"><input type="search" placeholder="Search" aria-label="Search the documentation" '
       'autocomplete="off" spellcheck="false"><div id="found" role="listbox" aria-label="Found" hidden></div>'
       '<div id="find-count" role="status"></div></form>')


def words(text):
    """Small letters; a name with underscores also counts by its parts, but for the library's, which is everywhere."""
    for word in WORD.findall(text.lower()):
        word = word if word == "c++" else word.strip("_+")
        if not word or (len(word) == 1 and word != "c") or len(word) > 40:
            continue
        yield word, 1.0
        if "_" in word and word != "passive_haptics":
            for part in word.split("_"):
                if len(part) > 1:
                    yield part, 0.5


class Sections(html.parser.HTMLParser):
    """[anchor, heading, text, words that find it] of each section under <div class="contents">."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.found = [["", "", "", ""]]
        self.open = []  # what is inside of the contents
        self.heading = None  # being read: [anchor, text]
        self.hidden = 0  # depth at which a hidden line began
        self.quiet = 0
        self.title = ""
        self.in_title = False

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        classes = (given.get("class") or "").split()
        if tag == "div" and "title" in classes:
            self.in_title = True
        if not self.open and not (tag == "div" and "contents" in classes):
            return
        if tag in VOID:
            return
        self.open.append(tag)
        if re.fullmatch("h[1-6]", tag):
            self.heading = [given.get("id", ""), ""]
        elif self.heading is not None and given.get("id"):
            self.heading[0] = self.heading[0] or given["id"]
        if "finds" in classes:
            self.hidden = len(self.open)
        if tag in ("script", "style") or "toc" in classes or "summary" in classes:
            self.quiet = self.quiet or len(self.open)

    def handle_endtag(self, tag):
        if self.in_title and tag == "div":
            self.in_title = False
        if tag not in self.open:
            return
        while self.open:
            if self.hidden == len(self.open):
                self.hidden = 0
            if self.quiet == len(self.open):
                self.quiet = 0
            closed = self.open.pop()
            if re.fullmatch("h[1-6]", closed) and self.heading is not None:
                self.found.append([self.heading[0], " ".join(self.heading[1].split()), "", ""])
                self.heading = None
            if closed == tag:
                break

    def handle_data(self, data):
        if self.in_title:
            self.title += data
        if not self.open or self.quiet:
            return
        if self.heading is not None:
            self.heading[1] += data
        else:
            self.found[-1][3 if self.hidden else 2] += data + ("" if data.endswith((" ", "\n")) else " ")


def read(path):
    page = Sections()
    page.feed(path.read_text("utf-8", "replace"))
    return page


class Index:
    def __init__(self):
        self.entries = []  # [address, heading, where, first words]
        self.words = collections.defaultdict(dict)  # word: {entry: weight}
        self.names = collections.defaultdict(list)  # name: entry, factor, entry, factor, ...

    def add(self, address, heading, where, text, prior, parts, brief=""):
        """`parts`: (text, weight) of what it is found by, beside its text."""
        entry = len(self.entries)
        said = " ".join((brief or text).split())
        self.entries.append([address, heading, where, said[:160].rsplit(" ", 1)[0] + " …" if len(said) > 160 else said])
        counts = collections.Counter()
        for word, share in words(text):
            counts[word] += share
        length = 40 + sum(counts.values())
        weights = collections.defaultdict(float)
        for word, count in counts.items():  # BM25's saturation, and its length
            weights[word] = TEXT * count * 2.2 / (count + 1.2 * (0.3 + 0.7 * length / 200))
        for part, weight in parts:
            for word, share in dict(sorted(words(part), key=lambda found: found[1])).items():
                weights[word] += weight * share
        for word, weight in weights.items():
            self.words[word][entry] = prior * weight

    def favour(self, name, factor):
        """What was added last is what who types this name means, if it has an underscore; no part of a name does."""
        if "_" in name and re.fullmatch(r"\w+", name):
            self.names[name.lower()] += [len(self.entries) - 1, factor]

    def text(self):
        """As a script, for a page that was opened from a disk may not fetch anything else."""
        many = len(self.entries)
        out = {}
        for word, hits in sorted(self.words.items()):
            rare = math.log(1 + many / len(hits)) / math.log(1 + many)
            best = sorted(hits.items(), key=lambda hit: (-hit[1], hit[0]))[:MOST]
            flat = []
            for entry, weight in best:
                flat += [entry, max(1, round(100 * weight * rare))]
            out[word] = flat
        index = {"entries": self.entries, "words": out, "names": self.names}
        return "var search_index = " + json.dumps(index, ensure_ascii=False, separators=(",", ":")) + ";\n"


def clean(name):
    return name.replace("passive_haptics::", "")


def build(site, tags):
    index = Index()
    root = xml.etree.ElementTree.parse(tags).getroot()
    structs = {}
    for compound in root.iter("compound"):
        if compound.get("kind") in ("struct", "class", "concept"):
            structs[clean(compound.findtext("name"))] = compound.findtext("filename")
    seen = set()
    for compound in root.iter("compound"):
        kind, name, file = compound.get("kind"), compound.findtext("name"), compound.findtext("filename")
        file = file if file.endswith(".html") else file + ".html"
        if kind == "page":
            page = read(site / file)
            title = compound.findtext("title") or name
            prior = 0.3 if name in MENUS else next(weight for begin, weight in PAGES if name.startswith(begin))
            where = next((said for begin, said in KINDS.items() if name.startswith(begin)), "guide")
            for number, (anchor, heading, text, finds) in enumerate(page.found):
                if number == 0:
                    whole = " ".join(part[2] for part in page.found)  # the page by itself stands for all of it
                    index.add(file, title, where, text, prior * 1.15,
                              [(title, HEADING), (finds, FOUND), (name.split("_", 1)[-1], PAGE), (whole, 0.4)])
                elif anchor:
                    index.add(f"{file}#{anchor}", heading, f"{where}: {title}", text, prior,
                              [(heading, HEADING), (title, PAGE), (finds, FOUND)])
            continue
        if kind in ("file", "struct", "class", "concept"):
            if not (site / file).exists() or "::detail::" in name:
                continue
            page = read(site / file)
            text = " ".join(part[2] for part in page.found)
            short = clean(name)
            inner = short.count("::") > 0 and short.split("::")[-1] in ("on", "traits", "state")
            own = short.split("::")[-1].removesuffix(".hpp")
            index.add(file, short, "header" if kind == "file" else kind, text, NAMES * (0.3 if inner else 1.0),
                      [(own, NAME)], page.found[0][2])
            index.favour(own, EXACT if kind == "file" else EXACT + 1)
        for member in compound.iter("member"):
            address = f"{member.findtext('anchorfile')}#{member.findtext('anchor')}"
            named = member.findtext("name")
            if address in seen or "detail" in name or named.startswith(("operator", "~")) or not member.findtext("anchor"):
                continue
            seen.add(address)
            said = " ".join(f"{member.findtext('type') or ''} {named}{member.findtext('arglist') or ''}".split())
            owner = clean(name) if kind in ("struct", "class") else ""
            weight = NAMES * (0.5 if owner else 1.0)
            stands_for = re.match(r"(?:typename )?(\w+)", member.findtext("type") or "")
            if member.get("kind") == "typedef" and not owner and stands_for and stands_for[1] in structs:
                address, said = structs[stands_for[1]], f"short for {member.findtext('type')}"
            index.add(address, f"{owner}::{named}" if owner else named, member.get("kind"), said, weight,
                      [(named, NAME if not owner else HEADING)])
            if not owner:
                index.favour(named, EXACT + 2)
    return index


# What doxygen's pages lack, in each of its versions: a box, a language, landmarks and a heading.
MENDED = [
    ("</head>", '<script defer src="search.js"></script>\n</head>'),
    ('<html xmlns="http://www.w3.org/1999/xhtml">', '<html xmlns="http://www.w3.org/1999/xhtml" lang="en">'),
    ('<div id="top">', '<div id="top" role="banner">'),
    ('<div id="titlearea">', '<div id="titlearea">' + BOX),
    ('<div id="side-nav"', '<div role="navigation" aria-label="Pages" id="side-nav"'),
    ('<div id="doc-content">', '<div id="doc-content" role="main">'),
    ('<div id="nav-path"', '<div role="contentinfo" id="nav-path"'),
    ('<div class="title">', '<div class="title" role="heading" aria-level="1">'),
]


def mend(site):
    """On every page that has none yet; how many there were."""
    count = 0
    for path in site.glob("*.html"):
        text = path.read_text("utf-8")
        if 'id="find"' in text or '<div id="titlearea">' not in text:
            continue
        for old, new in MENDED:
            text = text.replace(old, new, 1)
        if 'class="title"' not in text:  # a list of members has none
            title = re.search(r"<title>(?:[^<:]*: )?([^<]*)</title>", text)[1]
            text = text.replace('<div class="contents">', '<div class="header"><div class="headertitle"><div class="title" '
                                f'role="heading" aria-level="1">{title}</div></div></div>\n<div class="contents">', 1)
            text = text.replace("<h3>", "<h2>").replace("</h3>", "</h2>")
        # Two headers may have one name: a page says which it is of.
        folders = re.findall(r'<li class="navelem"><a class="el" href="dir_[^"]*">([^<]*)</a></li>', text)
        text = re.sub(r'(<div class="title"[^>]*>)([\w.]+\.hpp)( File Reference)?(?=<)',
                      lambda found: found[1] + "/".join([*folders[1:], found[2]]), text, count=1)
        # All names are in one namespace, and need not say so again.
        text = re.sub(r'(<td class="mem(?:name|ItemRight|TemplItemRight)"[^\n]*|<div class="title"[^\n]*)',
                      lambda found: re.sub(r"(?<![:\w])passive_haptics::(?=\w)", "", found[1]), text)
        # A drawing has a name, and so has the link from an icon; a column without a heading heads nothing.
        text = re.sub(r'<a href="([^"]*)"><span class="icondoc"></span></a>',
                      r'<a href="\1" aria-label="source"><span class="icondoc"></span></a>', text)
        text = re.sub(r'<th( class="markdownTableHead\w*")></th>', r"<td\1></td>", text)
        text = re.sub(r'(<object [^>]*)(></object>\s*<div class="caption">\s*)([^<]+)', r'\1 role="img" aria-label="\3"\2\3', text)
        path.write_text(text, "utf-8")
        count += 1
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("site", "tags", "script"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    given = parser.parse_args()
    index = build(given.site, given.tags)
    text = index.text()
    (given.site / "search_index.js").write_text(text, "utf-8")
    shutil.copy(given.script, given.site / "search.js")
    pages = mend(given.site)
    print(f"search: {len(index.entries)} sections and names, {len(index.words)} words, "
          f"{len(text.encode()) // 1000} kB, a box on {pages} pages")
    return 0


if __name__ == "__main__":
    sys.exit(main())
