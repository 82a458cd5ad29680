#!/usr/bin/env python3
"""No C++ file of the program has more than 400 lines and no function more than 60, but for those listed with a reason."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("src", "server", "db")
FILE_LINES = 400
FUNCTION_LINES = 60

# Files that may be longer: path: (lines at most, why they are not split).
LONG_FILES: dict[str, tuple[int, str]] = {}

# Functions that may be longer: (path, name): (lines at most, why they are not split).
LONG_FUNCTIONS: dict[tuple[str, str], tuple[int, str]] = {
    ("server/routes/operation_roles.hpp", "kOperations"): (120, "a table, one row for each operation of the API"),
    ("server/driving/link_events.cpp", "Driving::received_status"): (
        85, "one switch over the robot's states, whose cases share what was decided before it"),
}


def without_comments_and_literals(text: str) -> str:
    """The same lines without comments; texts and characters are emptied. Raw strings keep their line ends."""

    def blank(match: re.Match) -> str:
        found = match[0]
        lines = "\n" * found.count("\n")
        return lines if found.startswith("/") else '""' + lines

    return re.sub(
        r'//[^\n]*|/\*.*?\*/|\bR"([^()\s\\]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Za-z_])\'(?:\\.|[^\'\\\n])+\'',
        blank, text, flags=re.DOTALL)


def name_of(head: str) -> str:
    """The name of what a head, the text before an opening brace, defines: of a function what its parameters follow."""
    variable = re.search(r"(\w+)\s*=\s*\[", head)
    if variable:
        return variable[1]
    function = re.search(r"([\w:~]+|operator\s*\S+?)\s*\(", head)
    return function[1] if function else head


def kind_of(head: str) -> str:
    """What a brace after this head opens at the level of a namespace or class: a scope, a function, or else something."""
    plain = head
    for brackets in (r"\([^()]*\)", r"<[^<>]*>"):
        while re.search(brackets, plain):
            plain = re.sub(brackets, "", plain)
    if re.search(r"\b(namespace|class|struct|enum|union|extern)\b", plain) and "=" not in plain:
        return "scope"
    return "function" if "(" in head or re.search(r"=\s*\[", head) else "initialiser"


def functions(text: str) -> list[tuple[str, int, int]]:
    """Functions at the level of a namespace or class, lambdas of constants too: name, line of the opening brace, and
    lines from there to the closing one. What is inside a function belongs to it. The text is as clang-format leaves it: a space
    stands before the brace of a body, none before that of an initialiser."""
    found = []
    blocks: list[tuple[str, int, str]] = []  # kind, first line, head
    head = ""
    parentheses = 0
    line = 1
    for character in without_comments_and_literals(text):
        line += character == "\n"
        parentheses += {"(": 1, ")": -1}.get(character, 0)
        inside = any(kind == "function" for kind, _, _ in blocks)
        if character == "{":
            initialises = inside or parentheses > 0 or bool(re.search(r"[\w>]$", head))
            kind = "initialiser" if initialises else kind_of(head.strip())
            blocks.append((kind, line, head))
            head = ""
        elif character == "}":
            kind, first, head = blocks.pop()
            if kind == "function":
                found.append((name_of(head), first, line - first + 1))
            if kind != "initialiser":
                head = ""
        elif (character == ";" and parentheses == 0) or (character == "#" and not head.strip()):
            head = ""
        elif not inside:
            head += character
    if blocks or parentheses:
        raise ValueError("braces or parentheses are not closed")
    return found


def sources() -> list[pathlib.Path]:
    files = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.[ch]pp"))]
    assert len(files) > 500, "the sources are elsewhere"
    return files


class Sizes(unittest.TestCase):
    def test_functions_are_measured_from_brace_to_brace(self):
        text = """namespace a {
/// { not code
struct S {
  int f() const { return '{'; }
  S(int x)
      : x_(x),
        y_{1} {
    if (x) {
    }
  }
};
constexpr auto kTable = [] {
  return 1;
}();
int S::g(std::function<void()> h = {}) {
  const auto in = [&] {
  };
  return R"(}
})" ? 1 : 2;
}
}  // namespace a
"""
        measured = {name: lines for name, _, lines in functions(text)}
        self.assertEqual(measured["f"], 1)
        self.assertEqual(measured["kTable"], 3)
        self.assertEqual(measured["S"], 4, "a constructor, with the initialisers of its members")
        self.assertEqual(measured["S::g"], 6)

    def test_no_file_is_too_long(self):
        for path in sources():
            name = path.relative_to(ROOT).as_posix()
            most = LONG_FILES.get(name, (FILE_LINES, ""))[0]
            lines = path.read_text(encoding="utf-8").count("\n")
            self.assertLessEqual(lines, most, f"{name} has {lines} lines: split it, or list it here with the reason")

    def test_no_function_is_too_long(self):
        for path in sources():
            file = path.relative_to(ROOT).as_posix()
            for name, first, lines in functions(path.read_text(encoding="utf-8")):
                most = LONG_FUNCTIONS.get((file, name), (FUNCTION_LINES, ""))[0]
                self.assertLessEqual(
                    lines, most, f"{file}:{first}: {name} has {lines} lines: split it, or list it here with the reason")

    def test_what_is_listed_is_still_too_long(self):
        for name in LONG_FILES:
            lines = (ROOT / name).read_text(encoding="utf-8").count("\n")
            self.assertGreater(lines, FILE_LINES, f"{name} need not be listed any more")
        for file, name in LONG_FUNCTIONS:
            lines = [of for found, _, of in functions((ROOT / file).read_text(encoding="utf-8")) if found == name]
            self.assertGreater(max(lines, default=0), FUNCTION_LINES, f"{name} of {file} need not be listed any more")


if __name__ == "__main__":
    unittest.main()
