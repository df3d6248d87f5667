#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Follows every link of a site that lies in a folder: files and anchors that are not there, whatever a page would
fetch from a network, and what a screen reader could not say: links and columns without a name, pages without a heading.

    links.py FOLDER         a line for each, and 1, if there is one
    links.py --try          plants some in a folder of its own, and finds them
"""

import html.parser
import pathlib
import sys
import tempfile
import urllib.parse

FETCHED = {("img", "src"), ("script", "src"), ("iframe", "src"), ("source", "src"), ("object", "data")}


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.anchors = set()
        self.links = []  # (line, address, whether it is fetched at once)
        self.unnamed = []  # (line, tag) of each link and column that has no text
        self.open = None  # [line, tag, whether it has a name] of the one that is being read
        self.headed = False

    def handle_data(self, data):
        if self.open and data.strip():
            self.open[2] = True

    def handle_endtag(self, tag):
        if self.open and tag == self.open[1]:
            if not self.open[2]:
                self.unnamed.append(tuple(self.open[:2]))
            self.open = None

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        named = any((given.get(name) or "").strip() for name in ("aria-label", "title", "alt"))
        if (tag == "a" and given.get("href") is not None) or tag == "th":
            self.open = [self.getpos()[0], tag, named]
        elif self.open and named:
            self.open[2] = True
        self.headed = self.headed or tag == "h1" or given.get("aria-level") == "1"
        if given.get("id"):
            self.anchors.add(given["id"])
        if tag == "a" and given.get("name"):
            self.anchors.add(given["name"])
        line = self.getpos()[0]
        for name, value in attrs:
            if value is None:
                continue
            if (tag, name) in FETCHED or (tag == "link" and name == "href"):
                self.links.append((line, value, True))
            elif name == "href" or (tag, name) == ("form", "action"):
                self.links.append((line, value, False))


def broken(folder):
    """"page:line: link: why" for each, in order; and how many links there are."""
    folder = folder.resolve()
    pages = {}

    def page(path):
        if path not in pages:
            pages[path] = Page()
            pages[path].feed(path.read_text("utf-8", "replace"))
        return pages[path]

    found, followed = [], 0
    for path in sorted(folder.rglob("*.html")):
        found += [f"{path.relative_to(folder)}:{line}: <{tag}> has no name" for line, tag in page(path).unnamed]
        if not page(path).headed:
            found.append(f"{path.relative_to(folder)}:1: has no heading of the first level")
        for line, address, fetched in page(path).links:
            say = f"{path.relative_to(folder)}:{line}: {address}"
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or parts.netloc:
                if fetched and parts.scheme not in ("data", "javascript"):
                    found.append(say + ": is fetched from elsewhere")
                continue
            followed += 1
            name = urllib.parse.unquote(parts.path)
            target = (path.parent / name).resolve() if name else path
            if target.is_dir():
                target /= "index.html"
            if not target.is_relative_to(folder):
                found.append(say + ": leads out of the site")
            elif not target.exists():
                found.append(say + ": there is no such file")
            elif parts.fragment and target.suffix == ".html":
                anchor = urllib.parse.unquote(parts.fragment)
                if anchor not in page(target).anchors:
                    found.append(say + ": there is no such anchor")
    return found, followed


def attempt():
    """Seven faults and what is good beside them: all of the ones and none of the others are found."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "b.html").write_text('<h1 id="here">x</h1><a href="https://example.org/">away</a>')
        (folder / "index.html").write_text(
            '<a href="b.html">1</a><a href="b.html#here">2</a><a href="#top" id="top">3</a><a href="./">4</a>\n'
            '<a href="c.html">no file</a>\n<a href="b.html#there">no anchor</a>\n'
            '<img src="https://example.org/a.svg">\n<a href="../../etc/hosts">out</a>\n'
            '<a href="b.html"><span></span></a><a href="b.html" aria-label="b"><i></i></a>\n<th></th><th>x</th>\n')
        found, followed = broken(folder)
    lines = sorted(int(f.split(":")[1]) for f in found)
    if lines != [1, 2, 3, 4, 5, 6, 7] or followed != 9:
        print("planted in lines 1 to 7, found:", *found, sep="\n")
        return 1
    print("seven planted, seven found")
    return 0


def main(arguments):
    if arguments == ["--try"]:
        return attempt()
    if len(arguments) != 1 or not pathlib.Path(arguments[0]).is_dir():
        print(__doc__, file=sys.stderr)
        return 2
    found, followed = broken(pathlib.Path(arguments[0]))
    print(*found, sep="\n", end="\n" if found else "")
    print(f"{followed} links within the site, {len(found)} broken")
    if followed == 0:
        print("a site without a link is none")
        return 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
