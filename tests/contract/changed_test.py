#!/usr/bin/env python3
"""Which tests tests/changed.py finds for a change, in a small tree and in this one."""
import pathlib
import subprocess
import sys
import unittest

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS))
from changed import folders_to_test  # noqa: E402

SOURCES = {
    "src/core/angles.hpp": "",
    "src/map/graph.hpp": '#include "core/angles.hpp"\n',
    "src/map/graph.cpp": '#include "map/graph.hpp"\n',
    "src/mapping/edges.cpp": '#include "map/graph.hpp"\n',
    "src/mapping/edges.hpp": "",
    "src/wire/json.hpp": "",
    "server/app.cpp": '#include "server/app.hpp"\n#include "mapping/edges.hpp"\n',
    "server/app.hpp": "",
    "tests/support/floor.hpp": '#include "wire/json.hpp"\n',
    "tests/support/cube.hpp": "",
    "tests/unit/core/angles_test.cpp": '#include "core/angles.hpp"\n',
    "tests/unit/map/graph_test.cpp": '#include "map/graph.hpp"\n#include "support/floor.hpp"\n',
    "tests/unit/mapping/edges_test.cpp": '#include "mapping/edges.hpp"\n',
    "tests/unit/server/app_test.cpp": '#include "server/app.hpp"\n',
    "tests/fuzz/texts_test.cpp": 'open(project_folder() / "proto/examples");\n',
    "tests/contract/examples_test.cpp": "",
}


class Changed(unittest.TestCase):
    def expect(self, path, *folders):
        self.assertEqual(folders_to_test([path], SOURCES), sorted([*folders, "contract"]), path)

    def test_a_change_is_tested_in_its_module_and_in_those_that_depend_on_it(self):
        self.expect("src/core/angles.cpp", "core", "map", "mapping", "server")
        self.expect("src/map/graph.cpp", "map", "mapping", "server")
        self.expect("src/mapping/edges.cpp", "mapping", "server")
        self.expect("server/app.cpp", "server")

    def test_a_file_that_is_gone_or_no_source_counts_for_its_module(self):
        self.expect("src/mapping/loops.cpp", "mapping", "server")
        self.expect("src/mapping/CMakeLists.txt", "mapping", "server")

    def test_a_test_is_run_when_it_or_what_it_uses_of_the_support_has_changed(self):
        self.expect("tests/unit/mapping/edges_test.cpp", "mapping")
        self.expect("tests/support/floor.cpp", "map")
        self.expect("tests/support/cube.hpp")
        self.expect("src/wire/json.cpp", "map")

    def test_who_reads_the_contract_is_tested_with_it(self):
        self.expect("proto/examples/a.json", "fuzz", "server")

    def test_how_all_is_built_is_tested_with_all(self):
        for path in ("CMakeLists.txt", "cmake/tidy.sh", "tests/support/main.cpp"):
            self.expect(path, "core", "fuzz", "map", "mapping", "server")

    def test_a_document_is_tested_by_the_contract_alone(self):
        self.expect("README.md")
        self.assertEqual(folders_to_test([], SOURCES), ["contract"])

    def test_this_tree_has_the_folders_that_are_named(self):
        done = subprocess.run([sys.executable, "-B", TESTS / "changed.py"], capture_output=True, text=True)
        if "git knows of no checkout" in done.stderr:
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        printed = done.stdout
        self.assertIn("contract", printed.split())
        for folder in printed.split():
            self.assertTrue((TESTS / folder).is_dir() or (TESTS / "unit" / folder).is_dir(), folder)


if __name__ == "__main__":
    unittest.main(verbosity=2)
