#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/benchmarks.md, and one table of another page if the outline asks for it, from docs/results/*.json.

usage: tables.py [--check]

docs/results/outline.json says what stands where; every other file there is one table (docs/results/README.md has the
format). Numbers are written with the digits that they have in the file. --check writes nothing: it shows how the pages
differ from what the results give and ends with 1 when they do. Ends with 2 when a file does not follow the format.
"""

import argparse
import difflib
import json
import pathlib
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
RESULTS = ROOT / "docs" / "results"
PAGE = ROOT / "docs" / "benchmarks.md"
WIDTH = 120
KEYS = {  # of each object: those that have to be there, those that may
    "file": ({"title", "rows_are", "columns", "rows"}, {"note", "command"}),
    "column": ({"figure"}, {"unit", "least", "most"}),
    "row": ({"data", "values"}, {"seeds", "bounds", "command"}),
    "bound": (set(), {"least", "most"}),
    "share": ({"count", "of"}, set()),
    "outline": ({"title", "text", "sections"}, {"compared_in"}),
    "section": ({"title", "results"}, {"text"}),
    "compared_in": ({"file", "results", "begin", "end"}, set()),
}


class Number(str):
    """A number as it is written in the file, so that 1.00 stays 1.00."""


class Malformed(Exception):
    """A file that does not follow the format, and where."""


def checked(thing, kind, where):
    required, optional = KEYS[kind]
    if not isinstance(thing, dict):
        raise Malformed(f"{where}: {json.dumps(thing)} is no object ({kind})")
    if missing := required - thing.keys():
        raise Malformed(f"{where}: lacks {', '.join(sorted(missing))}")
    if unknown := thing.keys() - required - optional:
        raise Malformed(f"{where}: does not know {', '.join(sorted(unknown))}")
    return thing


def read(file):
    try:
        return json.loads(file.read_text(), parse_float=Number, parse_int=Number)
    except ValueError as error:
        raise Malformed(f"{file.name}: {error}") from error


def read_table(file):
    table = checked(read(file), "file", file.name)
    figures = [checked(column, "column", file.name)["figure"] for column in table["columns"]]
    for row in table["rows"]:
        where = f"{file.name}, {row.get('data')}" if isinstance(row, dict) else file.name
        checked(row, "row", where)
        if "command" not in row and "command" not in table:
            raise Malformed(f"{where}: names no command, and neither does its file")
        if len(row["values"]) != len(figures):
            raise Malformed(f"{where}: has {len(row['values'])} values for {len(figures)} columns")
        for value in row["values"]:
            if isinstance(value, dict):
                checked(value, "share", where)
        for figure, bound in row.get("bounds", {}).items():
            checked(bound, "bound", where)
            if figure not in figures:
                raise Malformed(f"{where}: bounds '{figure}', which is no column")
    return table


def text_of(value):
    return f"{value['count']} of {value['of']}" if isinstance(value, dict) else str(value)


def number_of(value, where):
    if isinstance(value, dict):
        return float(value["count"]) / float(value["of"])
    if not isinstance(value, Number):
        raise Malformed(f"{where}: {json.dumps(value)} is no number to hold against a bound")
    return float(value)


def bound_text(bound):
    return ", ".join(f"{sign} {text_of(bound[key])}" for key, sign in (("least", "≥"), ("most", "≤")) if key in bound)


def holds(value, bound, where):
    number = number_of(value, where)
    return all(number >= number_of(bound[key], where) if key == "least" else number <= number_of(bound[key], where) for key in bound)


def cell(value, column, row, where):
    if value is None:
        return ""
    text = text_of(value)
    own = row.get("bounds", {}).get(column["figure"])
    bound = own or {key: column[key] for key in ("least", "most") if key in column}
    remarks = [bound_text(own)] if own else []
    if bound and not holds(value, bound, where):
        remarks.append("not held")
    return f"{text} ({', '.join(remarks)})" if remarks else text


def heading(column):
    unit = f" ({column['unit']})" if column.get("unit") else ""
    bound = bound_text(column)
    return column["figure"] + unit + (f", {bound}" if bound else "")


def table_lines(table):
    seeded = any(row.get("seeds") for row in table["rows"])
    commanded = any("command" in row for row in table["rows"])
    head = [table["rows_are"], *(["seeds"] if seeded else []), *map(heading, table["columns"]), *(["command"] if commanded else [])]
    lines = [head, ["---"] * len(head)]
    for row in table["rows"]:
        where = f"{table['title']}, {row['data']}"
        cells = [cell(value, column, row, where) for value, column in zip(row["values"], table["columns"])]
        seeds = [", ".join(row.get("seeds") or [])] if seeded else []
        command = [f"`{row['command']}`" if "command" in row else ""] if commanded else []
        lines.append([row["data"], *seeds, *cells, *command])
    return ["| " + " | ".join(line) + " |" for line in lines]


def wrapped(text):
    return textwrap.wrap(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def page(outline, tables):
    lines = [f"# {outline['title']}"]
    for paragraph in outline["text"]:
        lines += ["", *wrapped(paragraph)]
    for section in outline["sections"]:
        lines += ["", f"## {section['title']}"]
        if "text" in section:
            lines += ["", *wrapped(section["text"])]
        for name in section["results"]:
            table = tables[name]
            command = [f"`{table['command']}`"] if "command" in table else []
            lines += ["", *wrapped(f"**{table['title']}.** {table.get('note', '')}"), *command, "", *table_lines(table)]
    return "\n".join(lines) + "\n"


def with_table(text, table, begin, end):
    """The text with the table between its two marks, which stay."""
    if text.count(begin) != 1 or text.count(end) != 1:
        raise Malformed(f"the page that compares has to have '{begin}' and '{end}' once each")
    before, rest = text.split(begin)
    return before + begin + "\n\n" + "\n".join(table_lines(table)) + "\n\n" + end + rest.split(end)[1]


def written_pages():
    """The text that each page has to have, by its file."""
    outline = checked(read(RESULTS / "outline.json"), "outline", "outline.json")
    tables = {file.stem: read_table(file) for file in sorted(RESULTS.glob("*.json")) if file.name != "outline.json"}
    listed = [name for section in outline["sections"] for name in checked(section, "section", "outline.json")["results"]]
    if sorted(listed) != sorted(tables):
        raise Malformed(f"outline.json: has to list each of {', '.join(tables)} once, and lists {', '.join(listed)}")
    pages = {PAGE: page(outline, tables)}
    if "compared_in" in outline:
        compared = checked(outline["compared_in"], "compared_in", "outline.json")
        other = ROOT / compared["file"]
        pages[other] = with_table(other.read_text(), tables[compared["results"]], compared["begin"], compared["end"])
    return pages


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only say whether the pages are what the results give")
    options = parser.parse_args()
    try:
        pages = written_pages()
    except Malformed as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    stale = False
    for file, text in pages.items():
        standing = file.read_text() if file.is_file() else ""
        if standing == text:
            continue
        if not options.check:
            file.write_text(text)
            continue
        stale = True
        name = str(file.relative_to(ROOT))
        sys.stdout.writelines(difflib.unified_diff(standing.splitlines(True), text.splitlines(True), name, f"{name}, by the results"))
    if stale:
        print("tests/bench/tables.py writes what the results give")
    sys.exit(1 if stale else 0)


if __name__ == "__main__":
    main()
