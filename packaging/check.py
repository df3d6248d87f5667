# SPDX-License-Identifier: BSD-3-Clause
"""What can be said of the manifests without the services that read them: check.py, from anywhere.

vcpkg.json, CITATION.cff, the workflows and the development container: their fields are known ones, they
agree with README.md and .ci/run, and the workflows may do no more than they must."""

import ast
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
wrong = []


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def check(condition, complaint):
    if not condition:
        wrong.append(complaint)


def vcpkg():
    """The fields of vcpkg's manifests that we use, as its documentation has them."""
    manifest = json.loads(text("packaging/vcpkg/passive-haptics/vcpkg.json"))
    known = {"name", "version", "description", "homepage", "license", "dependencies"}
    check(set(manifest) <= known and {"name", "version"} <= set(manifest),
          f"vcpkg.json: fields {sorted(manifest)}")
    name = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
    check(name.fullmatch(manifest["name"]) and manifest["name"] == "passive-haptics",
          "vcpkg.json: the name is that of its folder, in lower case and hyphens")
    for needed in manifest["dependencies"]:
        plain = {"name": needed} if isinstance(needed, str) else needed
        check(name.fullmatch(plain["name"]) and set(plain) <= {"name", "host"},
              f"vcpkg.json: dependency {needed}")


def citation(yaml):
    cited = yaml.safe_load(text("CITATION.cff"))
    check({"cff-version", "message", "title", "authors"} <= set(cited), "CITATION.cff: a field is missing")
    check(cited["cff-version"] == "1.2.0", "CITATION.cff: its format is 1.2.0")
    readme = " ".join(text("README.md").split())
    for thesis in cited["references"]:
        author = thesis["authors"][0]
        line = (f"{author['given-names']} {author['family-names']}, *{thesis['title']}*, "
                f"{thesis['thesis-type']}, {thesis['institution']['name']}, {thesis['year']}")
        check(line in readme, f"README.md does not cite it so: {line}")


def workflows(yaml):
    for path in sorted((ROOT / ".github/workflows").glob("*.yml")):
        script = path.read_text(encoding="utf-8")
        for used in re.findall(r"uses: *(.*)", script):  # a tag can be moved, a digest cannot
            pinned = r"actions/[a-z-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+"
            check(re.fullmatch(pinned, used), f"{path.name}: no digest and version: {used}")
        flow = yaml.safe_load(script)
        check(flow["permissions"] == {"contents": "read"}, f"{path.name}: it may do more than read")
        for name, job in flow["jobs"].items():
            writes = job.get("permissions", {}) != {}
            check(writes == (name == "publish"), f"{path.name}, {name}: a permission of its own")
            check("timeout-minutes" in job, f"{path.name}, {name}: it has no time limit")
            for step in job["steps"]:
                uses = step.get("uses", "")
                run = re.sub(r"\$\{\{ matrix\.[a-z]+ \}\}", "", step.get("run", ""))  # what stands above
                check("${{" not in run,
                      f"{path.name}, {name}: a script is told values by its environment")
                check(not (writes and "checkout" in uses), f"{path.name}, {name}: it runs our code")


def conan():
    """A component for each companion, and one for the core."""
    rooms = re.search(r"set\(companion_rooms ([^)]*)\)", text("CMakeLists.txt")).group(1).split()
    recipe = ast.parse(text("conan/conanfile.py"))
    named = [ast.literal_eval(node.value) for node in recipe.body if isinstance(node, ast.Assign)]
    check([list(some) for some in named] == [rooms],
          f"conanfile.py: its components are {named}, the companions of CMakeLists.txt {rooms}")


def packages(script):
    """What `apt-get install`, or what .ci/run has in its place, is told there; no options, no shell."""
    found = set()
    for line in re.findall(r"(?:apt-get install|apt_get_installs) ([^&>`|;]*)", script.replace("\\\n", " ")):
        found |= {word for word in line.split() if re.fullmatch(r"[a-z0-9][a-z0-9+.-]+", word)}
    return found


def container():
    """Debian 12 with what README.md names, the tools of .ci/run, and of no more than these few."""
    json.loads(text(".devcontainer/devcontainer.json"))
    dockerfile = text(".devcontainer/Dockerfile")
    check("FROM debian:12\n" in dockerfile, "Dockerfile: not Debian 12")
    run = text(".ci/run")
    steps = {name: re.search(rf"^{name}\(\) {{\n(.*?)^}}", run, re.M | re.S).group(1)
             for name in ("tools", "firmware")}
    tools = {word for some in re.findall(r"missing\+=\((.*?)\)", steps["tools"]) for word in some.split()}
    needed = packages(text("README.md")) | tools | packages(steps["firmware"])
    check({"g++", "catch2", "clang-format-14", "qemu-system-arm"} <= needed,
          "the packages that README.md and .ci/run name are not where they were")
    extra = {"ca-certificates", "git", "lintian", "python3-yaml"}
    check(packages(dockerfile) == needed | extra,
          f"Dockerfile: packages {sorted(packages(dockerfile) ^ (needed | extra))}")


def main():
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(__doc__)
        return
    vcpkg()
    conan()
    container()
    try:
        import yaml
    except ImportError:
        print("skipped: no PyYAML (Debian: python3-yaml) to read CITATION.cff and the workflows")
    else:
        citation(yaml)
        workflows(yaml)
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
