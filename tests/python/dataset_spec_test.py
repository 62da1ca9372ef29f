#!/usr/bin/env python3
"""Specifications of data sets: every fault is reported at its line.
usage: dataset_spec_test.py BIN (folder of `yars`)"""
import os
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "python"))
if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
    os.environ["YARS_BIN"] = os.path.abspath(sys.argv.pop(1))

from yars.dataset import DatasetError, SpecError, context, keys  # noqa: E402
from yars.dataset.spec import read_spec  # noqa: E402

GOOD = """count: 100
targets:
  - {area: [37, -123, 38, -122]}
geometry:
  range_nm: {uniform: [5, 18]}
  altitude_ft: 15000
"""


def faults_of(text, opened=False):
    """Messages of a specification, without the path of its file."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "specification.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        try:
            if opened:
                context.open_store(path, pathlib.Path(folder) / "out")
            else:
                read_spec(path)
        except SpecError as error:
            return [line.replace(str(path) + ":", "") for line in str(error).splitlines()]
    return []


class Faults(unittest.TestCase):
    def fault(self, text, line, *words, opened=False):
        faults = faults_of(text, opened)
        self.assertTrue(faults, "no fault found")
        self.assertTrue(any(fault.startswith(f"{line}:") and all(word in fault for word in words) for fault in faults),
                        faults)

    def test_good(self):
        self.assertEqual(faults_of(GOOD, opened=True), [])

    def test_unknown_keys_name_a_similar_one(self):
        self.fault(GOOD + "sead: 4\n", 7, 'found "sead"', 'did you mean "seed"?')
        self.fault(GOOD + "output: {blok: 4}\n", 7, 'a key of output, found "blok"', '"block"')
        self.fault(GOOD.replace("uniform:", "unifrom:"), 5, 'found "unifrom"', '"uniform"')
        self.fault(GOOD + "chip: {arrays: [vido]}\n", 7, 'did you mean "video"?')

    def test_absent_and_double_keys(self):
        self.fault(GOOD.replace("count: 100\n", ""), 1, "expected the key count", "found none")
        self.fault(GOOD + "count: 5\n", 7, "expected count once, found it twice")
        self.fault(GOOD.replace("  altitude_ft: 15000\n", ""), 5, "one of altitude_ft and depression_deg", "neither")
        self.fault("count: 10\ngeometry: {range_nm: 9, altitude_ft: 9000}\n", 1, "expected targets, or scenes")

    def test_values(self):
        self.fault(GOOD.replace("100", "many"), 1, "a whole number in [1, 1000000000] for count", 'found "many"')
        self.fault(GOOD.replace("100", "1.5"), 1, "a whole number", "found 1.5")
        self.fault(GOOD.replace("100", "0"), 1, "found 0; the least is 1")
        self.fault(GOOD.replace("100", "1000000001"), 1, "found 1000000001; the greatest is 1000000000")
        for text in ("1e3", "1.0e+3", "1000.0", "+1000"):
            self.assertEqual(faults_of(GOOD.replace("100", text)), [])
        self.fault(GOOD.replace("15000", "1e9"), 6, "[-3000, 600000] ft")
        self.fault(GOOD.replace("15000", ".nan"), 6, "geometry.altitude_ft")
        self.fault(GOOD.replace("15000", "[1, 2]"), 6, "geometry.altitude_ft", "found a list")
        self.fault(GOOD.replace("[5, 18]", "[18, 5]"), 5, "LOW before HIGH", "exchange them")
        self.fault(GOOD.replace("[5, 18]", "[5]"), 5, "two numbers")
        self.fault(GOOD.replace("{uniform: [5, 18]}", "{normal: [5, 0]}"), 5, "a deviation above 0")
        self.fault(GOOD.replace("{uniform: [5, 18]}", "{normal: [5, 1], cut: [900, 950]}"), 5, "next to none")
        self.fault(GOOD.replace("{uniform: [5, 18]}", "{weighted: [[5, 0]]}"), 5, "a weight above 0")
        self.fault(GOOD.replace("{uniform: [5, 18]}", "{choice: []}"), 5, "values in {choice: ...}")
        self.fault(GOOD.replace("{uniform: [5, 18]}", "{log_uniform: [0.01, 5], uniform: [1, 2]}"), 5,
                   "one distribution", "found 2")
        for key in ("knobs: {samples: %s}", "settings: {Sea: {state: %s}}"):
            self.fault(GOOD + "radar: {" + key % ("1" + 400 * "0") + "}\n", 7, "a number below 1e30 for radar.")
        self.fault(GOOD + "chip: {looks: {log_uniform: [1, 2]}}\n", 7, "whole number chip.looks")

    def test_places(self):
        self.fault(GOOD.replace("[37, -123, 38, -122]", "[38, -123, 37, -122]"), 3,
                   "a south of 38 beyond a north of 37")
        self.fault(GOOD.replace("[37, -123, 38, -122]", "[-123, 37, -122, 38]"), 3, "latitude comes first")
        self.fault(GOOD.replace("[37, -123, 38, -122]", "[37, -123]"), 3, "found 2 numbers")
        self.fault(GOOD.replace("{area: [37, -123, 38, -122]}", "{objects: house}"), 3, "scenes in the specification")
        self.fault(GOOD.replace("{area: [37, -123, 38, -122]}", "{weight: 2}"), 3, "one of area, scenes and objects",
                   "none")
        self.fault(GOOD + "scenes: [{generate: town}]\n", 7, "the key at")
        self.fault(GOOD + "scenes: [{generate: castle, at: [1, 2]}]\n", 7, "one of airfield, harbour, bridge, town")

    def test_keys_that_do_not_fit(self):
        self.fault(GOOD + "output: {coco: true}\n", 7, "expected pictures", "add png: true")
        self.fault(GOOD + "output: {geotiff: [power]}\n", 7, "add it to chip.arrays")
        self.fault(GOOD + "chip: {size: 2048}\nradar: {preset: reference}\n", 7, "at most 1024")

    def test_files_that_are_no_specification(self):
        self.fault("a: [1\nb: 2\n", 2, "expected YAML")
        self.assertIn("empty file", faults_of("")[0])
        self.assertIn("UTF-8", faults_of(b"count: \xff\n")[0])
        self.assertIn("a section", faults_of("- 1\n")[0])
        self.assertTrue(faults_of("a: &a [*a]\ncount: *a\n"))
        self.assertIn("YAML", faults_of("[" * 5000)[0])
        self.assertIn("MiB", faults_of("#" * (2 << 20))[0])

    def test_all_faults_at_once(self):
        self.assertGreaterEqual(len(faults_of("count: x\nseed: y\nchip: {size: 1}\ngeometry: {}\n")), 4)

    def test_impossible_geometry(self):
        def geometry(text, *words):
            self.fault(GOOD.replace("  altitude_ft: 15000\n", text), 6, *words, opened=True)
        geometry("  squint_deg: 5\n  altitude_ft: 9000\n", "between blind zone and gimbal (8 to 60 deg)", "found 5")
        geometry("  squint_deg: {choice: [30, 80]}\n  altitude_ft: 9000\n", "found 80")
        geometry("  squint_deg: {uniform: [61, 90]}\n  altitude_ft: 9000\n", "found 61 to 90")
        self.fault(GOOD.replace("[5, 18]", "[1, 4]").replace("15000", "9000\n  squint_deg: 40"), 5, "4.7 to",
                   "found 1 to 4", opened=True)
        self.fault(GOOD.replace("15000", "9000\n  squint_deg: 40") + "chip: {window_nm: 5}\n", 8,
                   "windows of the radar (0.67,", opened=True)
        self.fault(GOOD.replace("15000", "400000\n  squint_deg: 40"), 6, "a line of sight within 60 deg", opened=True)

    def test_force_lifts_the_radar_s_limits(self):
        text = GOOD.replace("15000", "9000\n  squint_deg: 5\n  force: true") + "chip: {window_nm: 5}\n"
        self.assertEqual(faults_of(text, opened=True), [])

    def test_settings_are_checked_by_yars_at_their_line(self):
        self.fault(GOOD + "radar:\n  settings:\n    Sea:\n      state: {uniform: [0, 9]}\n", 10, "[0, 6] for :state",
                   "9", opened=True)
        self.fault(GOOD + "radar:\n  settings:\n    Receiver: {freqency: 9}\n", 9, "freqency", opened=True)
        self.fault(GOOD + "radar:\n  knobs: {map_nose: 9}\n", 8,
                   'expected a knob for radar.knobs, found "map_nose"; did you mean "map_noise"?', opened=True)
        self.fault(GOOD + "radar:\n  config: none.guf\n", 8, "none.guf", opened=True)
        self.fault(GOOD + "radar:\n  settings:\n    HighResolution: {blindZone: {choice: [3, 4]}}\n", 9, "one value",
                   opened=True)


    def test_all_faults_of_settings_at_once(self):
        faults = faults_of(GOOD + "radar:\n  knobs: {map_nose: 9,\n    map_noise: 99}\n  settings:\n"
                                  "    Receiver: {freqency: 9, frequency: 99}\n"
                           "    Foo: {a: 1}\n    Sea: {state: 9}\n", True)
        self.assertEqual([fault.partition(":")[0] for fault in faults], ["8", "9", "11", "11", "12", "13"], faults)
        self.assertFalse([fault for fault in faults if "ignored" in fault or "mapNo" in fault])


class Files(unittest.TestCase):
    """Of what a specification is read, and what it names."""

    def error_of(self, text, **files):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "specification.yaml"
            path.write_text(text)
            for name, content in files.items():
                (pathlib.Path(folder) / name).write_text(content)
            (pathlib.Path(folder) / "empty").mkdir()
            with self.assertRaises(DatasetError) as caught:
                context.try_out(path)
            return str(caught.exception).replace(str(path) + ":", "")

    def test_no_regular_file(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkfifo(folder + "/pipe")
            for path, word in ((folder + "/pipe", "no regular file"), (folder, "a folder")):
                with self.assertRaisesRegex(SpecError, word):
                    read_spec(path)

    def test_check_finds_what_a_run_finds(self):
        try:
            import yars._core  # noqa: F401
        except ImportError:
            self.skipTest("yars._core is not built")
        self.assertRegex(self.error_of(GOOD + "terrain: empty\n"), "^7: .*expected elevation cells")
        self.assertRegex(self.error_of(GOOD + "scenes: [{file: broken}]\n", broken="x"), "^7: ")
        town = "scenes: [{generate: town, triangles: 200, at: [37.5, -122.3]}]\n"
        text = GOOD.replace("{area: [37, -123, 38, -122]}", "{objects: hause}") + town
        self.assertRegex(self.error_of(text), "^3: expected a class of the scenes' objects")
        text = self.error_of(GOOD + town + "terrain: {generate: {south: 85, west: 0, cells_lat: 9}}\n")
        self.assertRegex(text, "^8: cells_lat: expected")
        self.assertNotIn("--", text)

    def test_numbers_of_an_impossible_item_agree(self):
        text = self.error_of(GOOD.replace("15000", "15000\n  squint_deg: {uniform: [0, 8.01]}\n  attempts: 20"))
        found = re.search("in 20 draws, found none: (.*) [(](\\d+) of (\\d+) items", text)
        self.assertTrue(found, text)
        self.assertEqual(sum(map(int, re.findall(r"(\d+) times", found.group(1)))), 20)
        self.assertLessEqual(int(found.group(2)), int(found.group(3)))


class Documentation(unittest.TestCase):
    def test_examples_are_good(self):
        paths = sorted((ROOT / "examples").glob("dataset_*.yaml"))
        self.assertTrue(paths)
        for path in paths:
            context.open_store(path, "out")

    def test_the_tables_have_a_row_for_each_key(self):
        rows = re.findall(r"^(?:## ([\w.]+)$|[|] `(\w+)` [|])", keys.markdown(), re.M)
        found, section = set(), ""
        for heading, name in rows:
            section = heading or section
            if name:
                found.add(f"{section}.{name}".lstrip("."))
        self.assertEqual(found, set(keys.KEYS) - {"terrain.generate"})  # which is the head of a table


if __name__ == "__main__":
    unittest.main()
