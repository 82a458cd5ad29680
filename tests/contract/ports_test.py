#!/usr/bin/env python3
"""Tests that run beside each other listen at ports of their own."""
import collections
import pathlib
import re
import unittest

TESTS = pathlib.Path(__file__).resolve().parents[1]
NUMBER = re.compile(r"^(?:[A-Z_]*PORT)\s*=\s*(\d+)\b", re.MULTILINE)


def ports(text):
    """The numbers that a script gives its ports."""
    return [int(number) for number in NUMBER.findall(text)]


class Ports(unittest.TestCase):
    def test_numbers_are_found(self):
        self.assertEqual(ports("PORT = 18471\nTLS_PORT = 18472  # with a word\nOTHER = 5\nx = PORT + 1\n"), [18471, 18472])

    def test_no_two_tests_have_one(self):
        used = collections.defaultdict(list)
        for script in sorted([*TESTS.glob("loop/*.py"), *TESTS.glob("browser/*.py"), *TESTS.glob("cli/*.py")]):
            for port in ports(script.read_text(encoding="utf-8")):
                used[port].append(script.name)
        self.assertGreater(len(used), 10)
        self.assertEqual({port: names for port, names in used.items() if len(names) > 1}, {})


if __name__ == "__main__":
    unittest.main()
