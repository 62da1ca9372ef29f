#!/usr/bin/env python3
"""The list of licences has each package of package-lock.json, and each runs with the Node.js of each suite.
usage: page_facts_test.py"""
import json
import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
TOP = pathlib.Path(__file__).resolve().parents[2]


OLDEST_NODE = 18  # of Debian 12


class Packages(unittest.TestCase):
    def test_each_runs_with_the_oldest_node(self):
        packages = json.loads((TOP / "station/web/package-lock.json").read_text(encoding="utf-8"))["packages"]
        needs = {path: one["engines"]["node"] for path, one in packages.items() if "engines" in one}
        self.assertIn("node_modules/playwright-core", needs)
        for path, need in needs.items():
            self.assertLessEqual(int(re.fullmatch(r">=(\d+)[\d.]*", need)[1]), OLDEST_NODE, f"{path} needs {need}")


class Licences(unittest.TestCase):
    def test_each_package_stands_in_the_list(self):
        packages = json.loads((TOP / "station/web/package-lock.json").read_text(encoding="utf-8"))["packages"]
        found = {(re.sub(r"^node_modules/(@esbuild/).*", r"\1*", path).removeprefix("node_modules/"), one["version"],
                  one["license"])
                 for path, one in packages.items() if path}
        rows = re.findall(r"^\| (\S+) \| (\d\S*) \| (\S+) \|",
                          (TOP / "station/web/LICENCES.md").read_text(encoding="utf-8"), re.M)
        self.assertEqual(set(rows), found)

    def test_the_pages_have_no_code_of_others(self):
        package = json.loads((TOP / "station/web/package.json").read_text(encoding="utf-8"))
        self.assertNotIn("dependencies", package,
                         "what the pages hold belongs into LICENCES.md, and its licence into dist/")


if __name__ == "__main__":
    unittest.main()
