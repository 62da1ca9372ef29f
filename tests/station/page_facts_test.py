#!/usr/bin/env python3
"""What is written twice about the pages: the presets' errors are those of docs/performance.md, rounded; the list of
licences has each package of package-lock.json. usage: page_facts_test.py"""
import json
import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "lib/values"))
from generator import idl, presets  # noqa: E402

NAMES = presets.names(idl.read(TOP / "lib/values", "presets.idl")[-1].declarations[0])
COLUMNS = {"gray": 7, "power_db": 6, "shadow_percent": 5, "scan_ms": 1}  # of the table in docs/performance.md


def measured():
    """Rows of the first table of the section: name -> cells."""
    text = (TOP / "docs/performance.md").read_text(encoding="utf-8").split("\n## Speed against accuracy\n")[1]
    table = text[text.index("\n| point | ms a scan |"):].split("\n\n")[0]
    return {cells[0]: cells for cells in ([cell.strip() for cell in line.strip("|").split("|")]
                                          for line in table.strip().splitlines())}


def shown():
    """Entries of presets.ts: name -> {field: text of the number or null}."""
    text = (TOP / "station/web/src/presets.ts").read_text(encoding="utf-8")
    entries = re.findall(r'^  "?(\w+)"?: \{ (.*) \},$', text, re.M)
    return {name: dict(re.findall(r"(\w+): ([\d.]+|null)", fields)) for name, fields in entries}


class Presets(unittest.TestCase):
    def test_each_number_is_that_of_the_table(self):
        table, page = measured(), shown()
        self.assertEqual(list(page), NAMES)
        for name, fields in page.items():
            self.assertEqual(set(fields), set(COLUMNS), name)
            for field, text in fields.items():
                mean = table[name][COLUMNS[field]].split(" / ")[0]
                if text == "null":
                    self.assertEqual(name, "1996", f"{name} {field}: only 1996 is not comparable")
                    continue
                digits = len(text.partition(".")[2])
                self.assertLessEqual(abs(float(text) - float(mean)), 0.5000001 * 10.0**-digits,
                                     f"{name} {field}: expected docs/performance.md's {mean}, found {text} in "
                                     "presets.ts")
                self.assertEqual(float(text) == 0, float(mean) == 0, f"{name} {field}: rounded to nothing")


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
