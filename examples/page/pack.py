#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Packs page, style, script, the WebAssembly modules and what the native run computed into one html file.

    pack.py SOURCE_DIR OUTPUT VERSION NATIVE_COMPILER NAME=MODULE.wasm:NATIVE.json ...

A page of the file system may fetch nothing, so the modules stand in it: gzip, then base64.
"""
import base64
import gzip
import json
import pathlib
import sys


def shortened(text):
    """Without indentation and lines that are only a comment; the licence line stays."""
    lines = text.split("\n")
    kept = [line for i, line in enumerate(lines) if i == 0 or not line.lstrip().startswith("//")]
    return "\n".join(line.lstrip() for line in kept)


def main():
    source, output, version, compiler, *named = sys.argv[1:]
    source = pathlib.Path(source)
    modules = {}
    for entry in named:
        name, files = entry.split("=", 1)
        wasm, native = files.split(":", 1)
        packed = gzip.compress(pathlib.Path(wasm).read_bytes(), compresslevel=9, mtime=0)
        modules[name] = {
            "wasm": base64.b64encode(packed).decode(),
            "native": json.loads(pathlib.Path(native).read_text(encoding="utf-8")),
            "compiler": compiler,
        }
    read = lambda name: (source / name).read_text(encoding="utf-8")
    page = read("page.in.html")
    for mark, text in [
        ("@STYLE@", shortened(read("page.css"))),
        ("@SCRIPT@", shortened(read("words.js")) + shortened(read("page.js"))),
        ("@VERSION@", version),
        ("@MODULES@", json.dumps(modules, separators=(",", ":"))),
    ]:
        if page.count(mark) != 1:
            sys.exit(f"pack.py: {mark} stands {page.count(mark)} times in page.in.html; once is needed")
        page = page.replace(mark, text)
    data = page.encode()
    pathlib.Path(output).write_bytes(data)
    print(f"{output}: {len(data) / 1000:.0f} kB, {len(gzip.compress(data, 9, mtime=0)) / 1000:.1f} kB gzip")


if __name__ == "__main__":
    main()
