#!/usr/bin/env python3
"""Facts about the compiled part of the package yars: every array of scans and maps against the commands, trades.

usage: core_test.py BUILD     BUILD: a build folder with bin/yars and python/yars.
    Skipped (code 77) where it has no compiled part.
"""
import csv
import itertools
import json
import pickle
import re
import unittest
import warnings

from core_helpers import OPTIONS, PATCH, SCAN, Folder, command, np, option, options, yars
from yars.dataset.keys import PRESETS

# Array -> type, unit; of scans and maps.
ARRAYS = {"power": (np.float32, "1"), "video": (np.uint8, ""), "shadow": (np.bool_, ""), "layover": (np.bool_, ""),
          "slant_range": (np.float64, "m"), "ground_range": (np.float64, "m"), "latitude": (np.float64, "degree"),
          "longitude": (np.float64, "degree"), "height": (np.float32, "m"), "grazing_angle": (np.float32, "degree"),
          "material": (np.uint8, ""), "object": (np.int32, "")}


class Package(unittest.TestCase):
    def test_version(self):
        self.assertEqual(yars.__version__, command("--version", text=True).strip())


class Shapes(unittest.TestCase):
    """Shape, type, unit, axes; no copies."""

    @classmethod
    def setUpClass(cls):
        cls.scan = yars.Radar("draft").scan(yars.Terrain(), **SCAN)
        cls.patch = yars.Radar("draft", map_size=64).patch(yars.Terrain(), **PATCH)

    def test_arrays(self):
        for result, shape in ((self.scan, (182, 240)), (self.patch, (64, 64))):
            for name, (kind, unit) in ARRAYS.items():
                array = getattr(result, name)
                self.assertEqual((name, array.shape, array.dtype.type, result.units[name]), (name, shape, kind, unit))
            self.assertEqual(tuple(len(getattr(result, axis)) for axis in result.axes), shape)
        self.assertEqual((self.scan.axes, self.patch.axes), (("azimuth", "sample"), ("y", "x")))

    def test_values_agree_with_one_another(self):
        for result in (self.scan, self.patch):
            seen = ~result.shadow & np.isfinite(result.grazing_angle)
            self.assertTrue(((result.grazing_angle[seen] >= 0) & (result.grazing_angle[seen] <= 90)).all())
            known = np.isfinite(result.slant_range) & np.isfinite(result.ground_range)
            self.assertTrue((result.slant_range[known] >= result.ground_range[known]).all())
            self.assertTrue((result.object == -1).all())  # the built-in hills have no scene
            self.assertFalse((result.layover & result.shadow).any())

    def test_reads_share_memory_and_outlive_the_result(self):
        for make in (lambda: yars.Radar("draft").scan(yars.Terrain(), **SCAN),
                     lambda: yars.Radar("draft", map_size=64).patch(yars.Terrain(), **PATCH)):
            result = make()
            kept = {name: getattr(result, name) for name in ARRAYS}
            for name, array in kept.items():
                self.assertTrue(np.shares_memory(array, getattr(result, name)), name)
            copies = {name: array.copy() for name, array in kept.items()}
            del result
            make()
            for name, array in kept.items():
                np.testing.assert_array_equal(array, copies[name])

    def test_geometry_of_a_map(self):
        facts, patch = self.patch.facts, self.patch
        middle = 0.25 * sum(patch.latitude[i, j] for i in (31, 32) for j in (31, 32))
        self.assertAlmostEqual(middle, PATCH["target_latitude_deg"], 5)
        self.assertAlmostEqual(patch.y[0], -patch.y[-1])
        self.assertGreater(patch.y[0], 0)
        self.assertGreater(patch.ground_range[0].mean(), patch.ground_range[-1].mean())
        self.assertAlmostEqual(facts["window_m"], 1.3 * 1852, 6)
        self.assertAlmostEqual(patch.x[1] - patch.x[0], facts["window_m"] / 64, 9)

    def test_xarray(self):
        try:
            import xarray
        except ImportError:
            self.skipTest("python3-xarray is not installed")
        for result in (self.scan, self.patch):
            data = result.to_xarray()
            self.assertIsInstance(data, xarray.Dataset)
            for name, (_, unit) in ARRAYS.items():
                np.testing.assert_array_equal(data[name].values, getattr(result, name))
                self.assertEqual((data[name].attrs["units"], data[name].dims), (unit, result.axes))
            self.assertEqual(data.attrs["hash"], f"{result.hash:016x}")
            self.assertEqual(set(result.to_xarray(["video"]).data_vars), {"video"})
            with self.assertRaisesRegex(ValueError, "arrays: expected power, .* found 'vide'"):
                result.to_xarray(["vide"])

    def test_azimuth_does_not_jump_at_north(self):
        for heading in (0, 5, 90, 180, 350, 359.9, -10):
            azimuth = yars.Radar("draft").scan(yars.Terrain(), **{**SCAN, "heading_deg": heading}).azimuth
            self.assertTrue((np.diff(azimuth) > 0).all())
            self.assertTrue(0 <= azimuth[len(azimuth) // 2] < 360)
        try:
            data = yars.Radar("draft").scan(yars.Terrain(), **{**SCAN, "heading_deg": 0}).to_xarray("video")
        except yars.MissingPart:
            self.skipTest("python3-xarray is not installed")
        self.assertLess(abs(data.sel(azimuth=0, method="nearest").azimuth.item()), 0.5)
        self.assertEqual(set(data.data_vars), {"video"})

    def test_north_is_one_heading(self):
        scans = [yars.Radar("draft").scan(yars.Terrain(), **{**SCAN, "heading_deg": heading})
                 for heading in (0, 360, -360, -0.0)]
        self.assertEqual(len({scan.hash for scan in scans}), 1)
        self.assertIn(f"hash {scans[0].hash:016x}>", repr(scans[0]))

    def test_pickling(self):
        radar = pickle.loads(pickle.dumps(yars.Radar("draft", samples=120, settings="( Sea :state 3 )")))
        self.assertEqual(radar.guf, yars.Radar("draft", samples=120, settings="( Sea :state 3 )").guf)
        self.assertEqual(pickle.loads(pickle.dumps(yars.Terrain())).directory, "")
        for result in (self.scan, self.patch):
            with self.assertRaisesRegex(TypeError, "keep its arrays"):
                pickle.dumps(result)


class Commands(Folder):
    """Values against the output of the commands."""

    def test_scans(self):
        for preset, threads in zip(PRESETS, itertools.cycle((1, 2, 2))):
            samples = {"samples": 60} if preset == "reference" else {}
            with self.subTest(preset):
                out, video, lit = self.folder / "p.f32", self.folder / "v.csv", self.folder / "s.csv"
                narrow = {} if preset == "standard" else {"width_deg": 70}
                given = {**SCAN, **samples, **narrow, "threads": threads}
                words = ["scan", "--fidelity", preset, *options(given)]
                printed = command(*words, "--out", str(out), "--shadow", str(lit))
                command(*words, "--out", str(video))
                scan = yars.Radar(preset).scan(yars.Terrain(), **given)
                self.assertEqual(scan.hash, printed["hash"])
                np.testing.assert_array_equal(scan.power, np.fromfile(out, "<f4").reshape(scan.power.shape))
                rows = list(csv.reader(video.read_text().splitlines()))[1:]
                np.testing.assert_array_equal(scan.video, np.array([row[5:] for row in rows], np.uint8))
                edges = np.array([row[1:3] for row in rows], float)
                self.assertLess(np.abs((scan.azimuth - edges.mean(axis=1) + 180) % 360 - 180)
                                [np.abs(edges[:, 0] - edges[:, 1]) < 90].max(), 1e-6)
                rows = list(csv.DictReader(lit.read_text().splitlines()))
                for column, name in (("ground_range_m", "ground_range"), ("latitude_deg", "latitude"),
                                     ("longitude_deg", "longitude"), ("elevation_m", "height")):
                    # Numbers as the command prints them; an empty field is NaN.
                    printed_ones = np.array([float(row[column] or "nan") for row in rows])
                    np.testing.assert_allclose(getattr(scan, name).ravel(), printed_ones, rtol=2e-7, atol=1e-6,
                                               err_msg=column)
                ground = np.isfinite(scan.height.ravel())
                np.testing.assert_array_equal(scan.shadow.ravel()[ground],
                                              np.array([row["lit"] == "0" for row in rows])[ground])

    def test_maps(self):
        for preset in PRESETS:
            size = {"size": 32 if preset == "reference" else 96}
            with self.subTest(preset):
                for threads in (1, 2):
                    out = self.folder / "p.f32"
                    given = {**PATCH, **size, "threads": threads}
                    printed = command("patch", "--fidelity", preset, *options(given), "--out", str(out))
                    patch = yars.Radar(preset).patch(yars.Terrain(), **given)
                    self.assertEqual(patch.hash, printed["hash"])
                    power = np.fromfile(out, "<f4").reshape(patch.power.shape)
                    np.testing.assert_array_equal(patch.power[power >= 0], power[power >= 0])
                    self.assertTrue(np.isnan(patch.power[~(power >= 0)]).all())
                    self.assertEqual(patch.facts["formation_s"], printed["formation_s"])

    def test_pixels_of_a_map(self):
        try:
            import rasterio
        except ImportError:
            self.skipTest("python3-rasterio is not installed")
        out = self.folder / "p.tif"
        command("patch", *options({**PATCH, "size": 96}), "--out", str(out))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            np.testing.assert_array_equal(rasterio.open(out).read(1),
                                          yars.Radar().patch(yars.Terrain(), **PATCH, size=96).video)

    def test_elevation(self):
        radar, terrain = yars.Radar("draft"), yars.Terrain()
        patch = radar.patch(terrain, **PATCH, size=64)
        seen = ~patch.shadow & ~patch.layover
        self.assertLess(np.nanmedian(np.abs(patch.height - terrain.elevation(patch.latitude, patch.longitude))[seen]),
                        30.0)
        scan = radar.scan(terrain, **SCAN)
        np.testing.assert_allclose(scan.height, terrain.elevation(scan.latitude, scan.longitude), atol=0.01)

    def test_errors_name_the_field_and_its_limits(self):
        terrain, radar = yars.Terrain(), yars.Radar()
        nan, inf = float("nan"), float("inf")
        for name, call, faults in (
                ("scan", radar.scan, [("latitude_deg", 91), ("latitude_deg", nan), ("heading_deg", inf),
                                      ("range_nm", -1), ("samples", 5000), ("samples", 0), ("threads", 0),
                                      ("threads", 10**30), ("seed", -1), ("gain", 4), ("band", "Z"),
                                      ("width_deg", 121), ("elevation_deg", -80), ("altitude_ft", -2000),
                                      ("time_s", nan), ("samples", 10.5)]),
                ("patch", radar.patch, [("target_latitude_deg", 100), ("window_nm", 0), ("size", -1), ("size", 10**9),
                                        ("looks", 17), ("map", -1), ("map", 2**32), ("speed_kt", nan),
                                        ("heading_deg", 33), ("heading_deg", 250), ("window_nm", 1.31),
                                        ("altitude_ft", -2000)])):
            for field, value in faults:
                given = {**(SCAN if name == "scan" else PATCH), field: value}
                said = ""
                for code in (2, 1):  # limits of the radar end with 1
                    try:
                        said = command(name, *options(given), code=code)
                        break
                    except AssertionError as failure:
                        problem = failure
                self.assertTrue(said, problem if not said else "")
                with self.assertRaises(ValueError, msg=f"{field} {value}") as caught:
                    call(terrain, **given)
                text = str(caught.exception)
                self.assertTrue(text.startswith(f"yars.Radar.{name}: "), text)
                self.assertRegex(text, "expected .*, found ")
                if getattr(caught.exception, "code", "") == "limit":  # one message, in the words of each
                    words = re.sub(r"`?\b(\w+)=(True|-?[0-9.]+)`?",
                                   lambda found: option(found[1]) + ("" if found[2] == "True" else f" {found[2]}"),
                                   text)
                    words = re.sub(r"\b(\w+)\b",
                                   lambda found: option(found[1]) if found[1] in OPTIONS or found[1] == "window_nm"
                                   else found[1], words)
                    self.assertEqual(words.partition(": ")[2], said.partition(": ")[2])
                elif getattr(caught.exception, "code", "") == "range":
                    self.assertEqual((caught.exception.field, caught.exception.low <= caught.exception.high),
                                     (field, True))
                    self.assertIn(option(field), said)
                else:  # refused before the call
                    self.assertIn(field, text)


class Trades(Folder):
    def test_layout_is_that_of_the_command(self):
        for maps, words, given in ((False, [], {"scene": ["37,-122,15000,60,10"], "ruler_samples": 90}),
                                   (True, ["maps"], {"view": ["37,-122,15000,37.2,-122,0.67"], "ruler_size": 32})):
            rows = yars.trade(maps=maps, presets="1996,draft", knob=["samples=60,90" if not maps else "mapSize=32"],
                              repeat=1, out=str(self.folder / "here.json"), **given)
            self.assertEqual(rows, json.loads((self.folder / "here.json").read_text()))
            texts = [f"--{name.replace('_', '-')}={one}" for name, value in given.items()
                     for one in (value if isinstance(value, list) else [value])]
            command("trade", *words, "--presets=1996,draft",
                    "--knob=" + ("samples=60,90" if not maps else "mapSize=32"), "--repeat=1", *texts,
                    "--out", str(self.folder / "there.json"), "--json")
            there = json.loads((self.folder / "there.json").read_text())
            self.assertEqual((rows["axes"], rows["scenes"]), (there["axes"], there["scenes"]))
            for ours, theirs in zip(rows["points"], there["points"], strict=True):
                times = {name for name in theirs if name.endswith("_ms") or name == "samples_per_second"}
                self.assertEqual({k: v for k, v in ours.items() if k not in times},
                                 {k: v for k, v in theirs.items() if k not in times})

    def test_errors(self):
        for given, pattern in (({"presets": "nix"}, "presets: expected 1996"), ({"out": "a.png"}, "ends in .json"),
                               ({"scene": "1,2"}, "scene: expected LAT,LON"),
                               ({"presets": "none"}, "a preset or a knob"), ({"nonsense": 1}, "found 'nonsense'"),
                               ({"repeat": 0}, "repeat: expected")):
            self.refused(ValueError, pattern, lambda: yars.trade(**given))


if __name__ == "__main__":
    unittest.main()
