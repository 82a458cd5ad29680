#!/usr/bin/env python3
"""Prints which folders of tests a change can have an effect on, one a line: `driving`, `scenario`, ..., always `contract`.

What has changed is what differs from where this branch left origin/main, committed or not; where there is no
origin/main, from the commit before the last. A folder of tests is named if its sources include, through however many
headers, a module of which any file has changed, or read a folder in which one has.
usage: changed.py      from anywhere; the checkout is the one that this file is in
"""
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
READ = re.compile(r'project_folder\(\)\s*/\s*"([^"/]+)')
# A change here is one of every test.
OF_ALL = ("CMakeLists.txt", "CMakePresets.json", "cmake/", "deploy/install-deps.sh", "src/CMakeLists.txt", "tests/CMakeLists.txt",
          "tests/unit/CMakeLists.txt", "tests/support/CMakeLists.txt", "tests/support/main.cpp")
TESTS = re.compile(r"tests/(?:unit/)?(\w+)$")


def node_of(path):
    """What the file at this path (from the root) belongs to: a module `src/map`, `db` or `server`, a folder of tests
    `tests/unit/map`, `tests/fuzz` or `tests/contract`, one thing of the tests' support without its ending, or else the
    folder at the root that it is in."""
    parts = pathlib.PurePosixPath(path).parts
    if parts[0] == "src":
        return "/".join(parts[:2])
    if parts[:2] == ("tests", "unit"):
        return "/".join(parts[:3])
    if parts[:2] == ("tests", "support"):
        return str(pathlib.PurePosixPath(path).with_suffix(""))
    if parts[0] == "tests":
        return "/".join(parts[:2])
    return parts[0]


def included_node(header):
    """The node of what is included as `header`: by a path from src/, from the root or from tests/."""
    first = header.split("/")[0]
    if first in ("db", "server"):
        return first
    if first in ("support", "unit", "fuzz", "contract"):
        return node_of("tests/" + header)
    return node_of("src/" + header)


def uses(sources):
    """For each node those that it uses, itself left out. sources: text by path from the root."""
    found = {}
    for path, text in sources.items():
        used = found.setdefault(node_of(path), set())
        used.update(included_node(header) for header in INCLUDE.findall(text))
        used.update(READ.findall(text))
    if "server" in found:
        found["server"].add("proto")  # its CMakeLists.txt puts the contract into the program
    return {node: used - {node} for node, used in found.items()}


def folders_to_test(changed, sources):
    """The names of the folders of tests that a change of these paths can have an effect on, and `contract`, sorted."""
    graph = uses(sources)
    if any(path == of_all or of_all.endswith("/") and path.startswith(of_all) for path in changed for of_all in OF_ALL):
        affected = set(graph)
    else:
        affected = {node_of(path) for path in changed}
    before = None
    while before != len(affected):
        before = len(affected)
        affected.update(node for node, used in graph.items() if used & affected)
    tests = {match[1] for node in affected & set(graph) if (match := TESTS.match(node))}
    return sorted(tests | {"contract"})


def git(root, *arguments):
    done = subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True)
    return done.stdout.splitlines() if done.returncode == 0 else None


def changed_paths(root):
    """Paths from the root of what has changed, of files that are gone too; None where git cannot tell."""
    base = git(root, "merge-base", "HEAD", "origin/main") or git(root, "rev-parse", "--verify", "--quiet", "HEAD~1")
    if not base:
        return git(root, "ls-files")  # the first commit: all is new
    return git(root, "diff", "--name-only", "--no-renames", base[0]) + git(root, "ls-files", "--others", "--exclude-standard")


def main():
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    root = pathlib.Path(__file__).resolve().parents[1]
    sources = {}
    for folder in ("src", "db", "server", "tests/support", "tests/unit", "tests/fuzz", "tests/contract"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            sources[path.relative_to(root).as_posix()] = path.read_text(encoding="utf-8")
    paths = changed_paths(root)
    if paths is None:
        sys.exit("changed.py: git knows of no checkout here, so nobody can tell what has changed")
    print(*folders_to_test(paths, sources), sep="\n")


if __name__ == "__main__":
    main()
