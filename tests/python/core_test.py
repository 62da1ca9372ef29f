#!/usr/bin/env python3
"""Facts about the compiled part of the package yars: every array of scans and maps against the commands, errors, threads,
memory.

usage: core_test.py BUILD     BUILD: a build folder with bin/yars and python/yars. Skipped (code 77) where it has no compiled part.
"""
import csv
import json
import os
import pathlib
import pickle
import resource
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

sys.dont_write_bytecode = True
BUILD = pathlib.Path(sys.argv.pop(1)).resolve().parent
sys.path.insert(0, str(BUILD / "python"))
if not list((BUILD / "python/yars").glob("_core*.so")):
    print("no compiled part in this build: skipped")
    sys.exit(77)
import numpy as np

import yars

YARS = str(BUILD / "bin/yars")
# Array -> type, unit; of scans and maps.
ARRAYS = {"power": (np.float32, "1"), "video": (np.uint8, ""), "shadow": (np.bool_, ""), "layover": (np.bool_, ""),
          "slant_range": (np.float64, "m"), "ground_range": (np.float64, "m"), "latitude": (np.float64, "degree"),
          "longitude": (np.float64, "degree"), "height": (np.float32, "m"), "grazing_angle": (np.float32, "degree"),
          "material": (np.uint8, ""), "object": (np.int32, "")}
SCAN = {"lat": 37.8, "lon": -122.5, "alt_ft": 15000, "heading": 30, "range_nm": 10, "seed": 7}
PATCH = {"lat": 37.5, "lon": -122.5, "alt_ft": 12000, "heading": 350, "target_lat": 37.62, "target_lon": -122.4, "window_nm": 1.3, "seed": 3}
PRESETS = ("1996", "draft", "standard", "fine", "reference")


def options(arguments):
    return [f"--{name.replace('_', '-')}={value}" for name, value in arguments.items()]


def command(*words, code=0):
    done = subprocess.run([YARS, *words], capture_output=True, text=True, timeout=300, env={**os.environ, "YARS_USER_CONFIG": ""})
    if done.returncode != code:
        raise AssertionError(f"yars {' '.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}")
    return json.loads(done.stdout) if code == 0 else done.stderr.strip()


class Folder(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        self.addCleanup(self._folder.cleanup)

    def refused(self, kind, pattern, call):
        with self.assertRaisesRegex(kind, pattern) as caught:
            call()
        self.assertNotIn("internal", str(caught.exception))


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
        self.assertAlmostEqual(middle, PATCH["target_lat"], 5)
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
        for preset in PRESETS:
            samples = {"samples": 60} if preset == "reference" else {}
            with self.subTest(preset):
                for threads in (1, 2):
                    out, video, lit = self.folder / "p.f32", self.folder / "v.csv", self.folder / "s.csv"
                    given = {**SCAN, **samples, "threads": threads}
                    words = ["scan", "--fidelity", preset, *options(given)]
                    printed = command(*words, "--out", str(out), "--shadow", str(lit))
                    command(*words, "--out", str(video))
                    scan = yars.Radar(preset).scan(yars.Terrain(), **given)
                    self.assertEqual(scan.hash, printed["hash"])
                    np.testing.assert_array_equal(scan.power, np.fromfile(out, "<f4").reshape(scan.power.shape))
                    rows = list(csv.reader(video.read_text().splitlines()))[1:]
                    np.testing.assert_array_equal(scan.video, np.array([row[5:] for row in rows], np.uint8))
                    edges = np.array([row[1:3] for row in rows], float)
                    self.assertLess(np.abs((scan.azimuth - edges.mean(axis=1) + 180) % 360 - 180)[np.abs(edges[:, 0] - edges[:, 1]) < 90].max(), 1e-6)
                    rows = list(csv.DictReader(lit.read_text().splitlines()))
                    for column, name in (("ground_range_m", "ground_range"), ("latitude_deg", "latitude"),
                                         ("longitude_deg", "longitude"), ("elevation_m", "height")):
                        # Numbers as the command prints them; an empty field is NaN.
                        printed_ones = np.array([float(row[column] or "nan") for row in rows])
                        np.testing.assert_allclose(getattr(scan, name).ravel(), printed_ones, rtol=2e-7, atol=1e-6, err_msg=column)
                    ground = np.isfinite(scan.height.ravel())
                    np.testing.assert_array_equal(scan.shadow.ravel()[ground], np.array([row["lit"] == "0" for row in rows])[ground])

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
            np.testing.assert_array_equal(rasterio.open(out).read(1), yars.Radar().patch(yars.Terrain(), **PATCH, size=96).video)

    def test_elevation(self):
        radar, terrain = yars.Radar("draft"), yars.Terrain()
        patch = radar.patch(terrain, **PATCH, size=64)
        seen = ~patch.shadow & ~patch.layover
        self.assertLess(np.nanmedian(np.abs(patch.height - terrain.elevation(patch.latitude, patch.longitude))[seen]), 30.0)
        scan = radar.scan(terrain, **SCAN)
        np.testing.assert_allclose(scan.height, terrain.elevation(scan.latitude, scan.longitude), atol=0.01)

    def test_errors_are_those_of_the_commands(self):
        terrain, radar = yars.Terrain(), yars.Radar()
        for name, call, faults in (
                ("scan", radar.scan, [{"lat": 91}, {"lat": float("nan")}, {"heading": float("inf")}, {"range_nm": -1}, {"samples": 5000},
                                      {"samples": 0}, {"samples": -3}, {"threads": 0}, {"threads": 10**30}, {"seed": -1}, {"gain": 4},
                                      {"band": "Z"}, {"lat": "x"}, {"alt": 3}, {"scan_width": 121}, {"elevation": -80}, {"alt_ft": -2000},
                                      {"time_s": float("nan")}, {"samples": 10.5}]),
                ("patch", radar.patch, [{"target_lat": 100}, {"window_nm": 0}, {"size": -1}, {"size": 10**9}, {"looks": 17},
                                        {"map": -1}, {"map": 2**32}, {"speed_kt": float("nan")}, {"lat": 60}, {"heading": 33}, {"heading": 250},
                                        {"window_nm": 1.31}, {"alt_ft": -2000}])):
            for fault in faults:
                given = {**(SCAN if name == "scan" else PATCH), **fault}
                said = ""
                for code in (2, 1):  # limits of the radar end with 1
                    try:
                        said = command(name, *options(given), code=code)
                        break
                    except AssertionError as failure:
                        problem = failure
                self.assertTrue(said, problem if not said else "")
                with self.assertRaises(ValueError, msg=str(fault)) as caught:
                    call(terrain, **given)
                text = str(caught.exception)
                self.assertIn(text.split(": ", 1)[-1] if text.startswith("yars") else text, said.replace("'nan'", "'nan'"), fault)


class Arguments(Folder):
    def test_wrong_types(self):
        terrain, radar = yars.Terrain(), yars.Radar("draft")
        for call in (lambda: radar.scan(None), lambda: radar.scan("hills"), lambda: radar.patch(None), lambda: radar.scan(terrain, "town.flt"),
                     lambda: yars.Scene("x.flt", None), lambda: yars.Scene(3, terrain), lambda: yars.Terrain(3), lambda: radar.scan(),
                     lambda: radar.patches(None, np.zeros(0, yars.PATCH_ORDER)), lambda: radar.patches(terrain, np.zeros(0, yars.PATCH_ORDER), 5),
                     lambda: radar.patches(terrain, np.zeros(0, yars.PATCH_ORDER), threads=1.5), lambda: terrain.elevation(1)):
            with self.assertRaises((TypeError, ValueError)):
                call()

    def test_files(self):
        with self.assertRaisesRegex(yars.Error, "expected"):
            yars.Terrain(self.folder / "absent")
        (self.folder / "empty").mkdir()
        with self.assertRaisesRegex(yars.Error, "expected"):
            yars.Terrain(self.folder / "empty")
        for text in (b"", b"no scene at all"):
            (self.folder / "bad.flt").write_bytes(text)
            with self.assertRaisesRegex((yars.Error, ValueError), "expected"):
                yars.Scene(f"{self.folder}/bad.flt@37,-122,0", yars.Terrain())
        with self.assertRaisesRegex((yars.Error, ValueError), "expected"):
            yars.Scene("absent.flt@37,-122,0", yars.Terrain())
        with self.assertRaisesRegex(yars.Error, "expected"):
            yars.Radar(config=self.folder / "absent.guf")
        with self.assertRaises(ValueError):
            yars.Scene([], yars.Terrain())

    def test_radar(self):
        for call, pattern in ((lambda: yars.Radar("fast"), "1996, draft"), (lambda: yars.Radar(sample=3), "sample"),
                              (lambda: yars.Radar(samples=-1), "samples"), (lambda: yars.Radar(samples=float("nan")), "nan|samples"),
                              (lambda: yars.Radar(map_size=10**9), "mapSize"), (lambda: yars.Radar(samples=[1]), "samples"),
                              (lambda: yars.Radar(settings="( Sea :state 99 )"), "state"), (lambda: yars.Radar(settings="( Sea"), "expected"),
                              (lambda: yars.Radar(settings="( Nothing :a 1 )"), "Nothing"), (lambda: yars.Radar(name="x) ( Sea"), "name")):
            self.refused(ValueError, pattern, call)
        self.assertEqual(yars.Radar("fine", samples=np.int32(99)).samples, 99)

    def test_truth_values_of_numpy(self):
        terrain, radar = yars.Terrain(), yars.Radar("draft")
        steep = {**SCAN, "elevation": -80.0}
        self.assertEqual(radar.scan(terrain, **steep, force=np.bool_(True)).hash, radar.scan(terrain, **steep, force=True).hash)
        with self.assertRaises(ValueError):
            radar.scan(terrain, **steep, force=np.bool_(False))

    def test_elevation(self):
        terrain = yars.Terrain()
        for latitude, longitude in ((91, 0), (float("nan"), 0), (0, 181), (0, float("inf"))):
            self.refused(ValueError, "latitudes from -90 to 90", lambda: terrain.elevation(latitude, longitude))
        self.refused(ValueError, "expected numbers", lambda: terrain.elevation("a", 3))
        self.assertEqual(terrain.elevation(np.zeros((0, 3)), 1.0).shape, (0, 3))
        self.assertEqual(terrain.elevation(37.5, -122.5).shape, ())
        grid = terrain.elevation(np.linspace(37, 38, 7)[:, None], np.linspace(-123, -122, 5))
        self.assertEqual(grid.shape, (7, 5))
        self.assertEqual(grid[3, 2], terrain.elevation(37.5, -122.5))
        whole = np.linspace(-90, 90, 37)
        np.testing.assert_array_equal(terrain.elevation(whole, -180.0), [float(terrain.elevation(one, -180.0)) for one in whole])

    def test_made_up_terrain_and_scenes(self):
        folder = yars.Terrain.generate(self.folder / "land", south=37, west=-123, cells_lat=1, cells_lon=1, level=0, culture=False)
        self.assertFalse(list(pathlib.Path(folder).rglob("*.smc.png")))
        command("terrain", "generate", "--out", str(self.folder / "same"), "--south=37", "--west=-123", "--cells-lat=1", "--cells-lon=1",
                "--level=0", "--no-culture", "--json")
        files = sorted(path.relative_to(folder) for path in pathlib.Path(folder).rglob("*.dt0"))
        self.assertTrue(files)
        for file in files:
            self.assertEqual((pathlib.Path(folder) / file).read_bytes(), (self.folder / "same" / file).read_bytes())
        terrain = yars.Terrain(folder)
        rng = np.random.default_rng(4)
        latitude, longitude = rng.uniform(36.5, 38.5, 500), rng.uniform(-123.5, -121.5, 500)
        latitude[:50] = np.round(latitude[:50], 3)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            together = terrain.elevation(latitude, longitude)
        self.assertTrue(1 <= len(caught) <= 6)  # positions outside the folder
        self.assertIn("the ground there counts as sea", str(caught[0].message))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            alone = [float(terrain.elevation(*one)) for one in zip(latitude, longitude)]
        np.testing.assert_array_equal(together, alone)

        path = yars.Scene.generate(self.folder / "town.flt", kind="town", triangles=500, seed=np.int64(2), origin=(37.5, -122.5, 30))
        command("scene", "generate", "--out", str(self.folder / "b.flt"), "--kind=town", "--triangles=500", "--seed=2", "--origin=37.5,-122.5,30",
                "--json")
        self.assertEqual(pathlib.Path(path).read_bytes(), (self.folder / "b.flt").read_bytes())
        scene = yars.Scene(path, terrain)
        self.assertEqual(len(pickle.loads(pickle.dumps(scene)).objects), len(scene.objects))
        for call in (lambda: yars.Radar("draft").scan(yars.Terrain(), scene, **SCAN), lambda: yars.Radar("draft").patch(yars.Terrain(), scene, **PATCH),
                     lambda: yars.Radar("draft").patches(yars.Terrain(), np.zeros(0, yars.PATCH_ORDER), scene)):
            self.refused(ValueError, "expected a scene on the terrain of this call, the built-in hills, found one on '.*land'", call)
        for call, pattern in ((lambda: yars.Scene.generate(self.folder / "a.png", origin=(1, 2)), "ends in .flt"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", kind="city", origin=(1, 2)), "--kind: expected airfield"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(91, 2)), "--origin"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(1,)), "--origin"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt"), "--origin"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(1, 2), out="b.flt"), "found out"),
                              (lambda: yars.Terrain.generate(self.folder / "a.png"), "folder"),
                              (lambda: yars.Terrain.generate(self.folder / "x", south=89, cells_lat=3), "north pole")):
            self.refused(ValueError, pattern, call)
        self.refused(yars.Error, "expected", lambda: yars.Scene.generate(folder + "/../town.flt/a.flt", origin=(1, 2)))


class Trades(Folder):
    def test_layout_is_that_of_the_command(self):
        for maps, words, given in ((False, [], {"scene": ["37,-122,15000,60,10"]}),
                                   (True, ["maps"], {"view": ["37,-122,15000,37.2,-122,0.67"], "ruler_size": 32})):
            rows = yars.trade(maps=maps, presets="1996,draft", knob=["samples=60,90" if not maps else "mapSize=32"], repeat=1,
                              out=str(self.folder / "here.json"), **given)
            self.assertEqual(rows, json.loads((self.folder / "here.json").read_text()))
            texts = [f"--{name.replace('_', '-')}={one}" for name, value in given.items() for one in (value if isinstance(value, list) else [value])]
            command("trade", *words, "--presets=1996,draft", "--knob=" + ("samples=60,90" if not maps else "mapSize=32"), "--repeat=1", *texts,
                    "--out", str(self.folder / "there.json"), "--json")
            there = json.loads((self.folder / "there.json").read_text())
            self.assertEqual((rows["axes"], rows["scenes"]), (there["axes"], there["scenes"]))
            for ours, theirs in zip(rows["points"], there["points"], strict=True):
                times = {name for name in theirs if name.endswith("_ms") or name == "samples_per_second"}
                self.assertEqual({k: v for k, v in ours.items() if k not in times}, {k: v for k, v in theirs.items() if k not in times})

    def test_errors(self):
        for given, pattern in (({"presets": "nix"}, "--presets: expected 1996"), ({"out": "a.png"}, "ends in .json"), ({"scene": "1,2"}, "--scene"),
                               ({"presets": "none"}, "a preset or a knob"), ({"nonsense": 1}, "--nonsense"), ({"repeat": 0}, "--repeat")):
            self.refused(ValueError, pattern, lambda: yars.trade(**given))


class Threads(Folder):
    def test_others_run_while_a_picture_is_computed(self):
        radar, terrain = yars.Radar("reference", samples=200), yars.Terrain()
        count, done = 0, threading.Event()

        def compute():
            radar.scan(terrain, **SCAN)
            done.set()

        thread = threading.Thread(target=compute)
        thread.start()
        while not done.is_set():
            count += 1
            os.sched_yield()
        thread.join()
        # With the lock held, this loop counts at most to its first switch and after the scan.
        self.assertGreater(count, 50)

    def test_two_threads_on_one_terrain(self):
        terrain = yars.Terrain()
        radar = yars.Radar("draft", map_size=64)
        hashes = []

        def compute():
            for _ in range(5):
                hashes.append((radar.scan(terrain, **SCAN).hash, radar.patch(terrain, **PATCH).hash))

        threads = [threading.Thread(target=compute) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual((len(hashes), len(set(hashes))), (15, 1))

    def test_a_kept_scan_keeps_no_threads(self):
        before = len(os.listdir("/proc/self/task"))
        kept = [yars.Radar("draft").scan(yars.Terrain(), **SCAN, threads=4) for _ in range(3)]
        self.assertEqual(len(os.listdir("/proc/self/task")), before)
        self.assertEqual(len({scan.hash for scan in kept}), 1)

    def test_a_child_of_fork_computes(self):
        program = ("import os, numpy as np, yars\nradar, terrain = yars.Radar('draft', map_size=32), yars.Terrain()\n"
                   f"orders = np.zeros(2, yars.PATCH_ORDER)\nfor name, value in {order_of(PATCH)!r}.items(): orders[name] = value\n"
                   "first = radar.patches(terrain, orders, threads=3)['hash']\nread, write = os.pipe()\nchild = os.fork()\n"
                   "if child == 0:\n    os.write(write, radar.patches(terrain, orders, threads=3)['hash'].tobytes())\n    raise SystemExit\n"
                   "_, status = os.waitpid(child, 0)\nprint(status, os.read(read, 16) == first.tobytes())")
        done = subprocess.run([sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
        self.assertEqual(done.stdout, "0 True\n", done.stderr)


def order_of(patch):
    return {"latitude": patch["lat"], "longitude": patch["lon"], "altitude_ft": patch["alt_ft"], "heading": patch["heading"], "speed_kt": 480.0,
            "target_latitude": patch["target_lat"], "target_longitude": patch["target_lon"], "window_nm": patch["window_nm"], "looks": 1, "map": 1}


def orders_of(*patches):
    orders = np.zeros(len(patches), yars.PATCH_ORDER)
    for i, patch in enumerate(patches):
        for name, value in order_of(patch).items():
            orders[name][i] = value
    return orders


def plane_of(origin, latitude, longitude):
    """Azimuthal equidistant plane [m] about an origin, for points within some kilometres: ellipsoid by its two radii of curvature."""
    a, e2 = 6378137.0, 0.00669437999014
    middle = np.radians(0.5 * (origin[0] + latitude))
    w = 1 - e2 * np.sin(middle) ** 2
    return (np.radians(longitude - origin[1]) * np.cos(middle) * a / np.sqrt(w), np.radians(latitude - origin[0]) * a * (1 - e2) / w ** 1.5)


class Series(Folder):
    NAMES = ("video", "power", "shadow", "layover", "object", "material", "height", "grazing_angle")

    def setUp(self):
        super().setUp()
        self.terrain = yars.Terrain()
        path = yars.Scene.generate(self.folder / "town.flt", kind="town", triangles=4000, seed=1, origin=(37.62, -122.4, 20))
        self.scene = yars.Scene(path, self.terrain)
        self.radar = yars.Radar("standard", map_size=96)
        self.patches = [{**PATCH, "window_nm": 0.67}, {**PATCH, "window_nm": 0.67, "heading": 355, "lon": -122.45}, {**PATCH, "window_nm": 1.3}]
        for patch in self.patches:
            del patch["seed"]

    def test_equal_to_single_maps(self):
        for threads in (1, 2):
            maps = self.radar.patches(self.terrain, orders_of(*self.patches), self.scene, arrays=self.NAMES, threads=threads)
            self.assertEqual(set(maps), {*self.NAMES, "hash", "geo", "boxes"})
            for i, patch in enumerate(self.patches):
                one = self.radar.patch(self.terrain, self.scene, **patch, looks=1, threads=threads)
                self.assertEqual(int(maps["hash"][i]), one.hash)
                for name in self.NAMES:
                    np.testing.assert_array_equal(maps[name][i], getattr(one, name), err_msg=name)
                geo, size = maps["geo"][i], 96
                self.assertEqual((geo["up_deg"], geo["window_m"], geo["slant_range_m"]),
                                 (one.facts["up"], one.facts["window_m"], one.facts["slant_range_m"]))
                # Distance over ground of each pixel from the aircraft, on the plane and by the map.
                column, row = np.meshgrid(np.arange(size) + 0.5, np.arange(size) + 0.5)
                c = geo["plane_from_pixel"]
                east, north = c[0] + c[1] * column + c[2] * row, c[3] + c[4] * column + c[5] * row
                np.testing.assert_allclose(np.hypot(east, north), one.ground_range, rtol=1e-9)
                # Differences of positions against those of the pixel in the middle.
                x, y = plane_of((one.latitude[48, 48], one.longitude[48, 48]), one.latitude, one.longitude)
                turn = np.hypot(x - (east - east[48, 48]), y - (north - north[48, 48])) / geo["window_m"]
                self.assertLess(turn.max(), 0.002)
        self.assertTrue((maps["object"] >= 0).any())

    def test_boxes(self):
        maps = self.radar.patches(self.terrain, orders_of(*self.patches), self.scene)
        objects, boxes = self.scene.objects, maps["boxes"]
        self.assertGreater(len(boxes), 30)
        for box in boxes:
            one, geo = objects[box["object"]], maps["geo"][box["order"]]
            self.assertEqual(box["pixels"], (maps["object"][box["order"]] == box["object"]).sum())
            centre = self.patches[box["order"]]
            heading = np.radians(one["heading_deg"])
            x, y = plane_of((centre["target_lat"], centre["target_lon"]), one["latitude"], one["longitude"])
            up = np.radians(geo["up_deg"])
            pixel_m = geo["window_m"] / 96
            corners = []
            for along, across in ((0.5, -0.5), (0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5)):
                a, b = along * one["length_m"], across * one["width_m"]
                east, north = x + a * np.sin(heading) + b * np.cos(heading), y + a * np.cos(heading) - b * np.sin(heading)
                right, ahead = east * np.cos(up) - north * np.sin(up), east * np.sin(up) + north * np.cos(up)
                # Flat earth: a point above the plane appears at its slant range.
                over = one["base_msl_m"] - geo["plane_msl_m"]
                ground = np.hypot(right, ahead + geo["distance_m"])
                height = np.sqrt(geo["slant_range_m"] ** 2 - geo["distance_m"] ** 2)
                shown = np.sqrt(max(ground ** 2 + (height - over) ** 2 - height ** 2, 0.0)) / ground
                corners.append((48 + right * shown / pixel_m, 48 - ((ahead + geo["distance_m"]) * shown - geo["distance_m"]) / pixel_m))
            found = box["corners"].astype(float)
            apart = min(np.hypot(*(np.roll(corners, k, 0) - found).T).max() for k in range(4))
            self.assertLess(apart, 1.0, (one, found, corners))
            self.assertTrue(0 <= box["aspect_deg"] < 180)
            off = np.degrees(np.arctan2(right, ahead + geo["distance_m"]))
            self.assertLess(abs((box["aspect_deg"] - (geo["up_deg"] + off - one["heading_deg"]) + 90) % 180 - 90), 0.5)

    def test_movers(self):
        orders = orders_of(*self.patches[:2])
        movers = np.zeros(1, yars.MOVER)
        movers[0] = (1, 37.62, -122.4, 90, 0, 1e6, 5)
        without, with_one = (self.radar.patches(self.terrain, orders, arrays=["video"], movers=given) for given in (None, movers))
        self.assertEqual(without["hash"][0], with_one["hash"][0])
        self.assertNotEqual(without["hash"][1], with_one["hash"][1])
        for field, value in (("order", 2), ("order", -1), ("latitude", 91), ("heading", np.nan), ("cross_section_m2", 0), ("height_m", np.inf)):
            bad = movers.copy()
            bad[field] = value
            self.refused(ValueError, "movers: expected an order of this call", lambda: self.radar.patches(self.terrain, orders, movers=bad))

    def test_none(self):
        maps = self.radar.patches(self.terrain, np.zeros(0, yars.PATCH_ORDER), self.scene, arrays=self.NAMES)
        for name in self.NAMES:
            self.assertEqual(maps[name].shape, (0, 96, 96))
        self.assertEqual((len(maps["hash"]), len(maps["geo"]), len(maps["boxes"])), (0, 0, 0))
        self.assertEqual(set(self.radar.patches(self.terrain, orders_of(self.patches[0]), arrays=())), {"hash", "geo", "boxes"})
        self.assertIn("video", self.radar.patches(self.terrain, orders_of(self.patches[0]), arrays="video"))

    def test_faults(self):
        good = orders_of(*self.patches)
        for field, value in (("latitude", np.nan), ("longitude", 181), ("altitude_ft", np.inf), ("window_nm", 0), ("window_nm", np.nan),
                             ("looks", 0), ("looks", 17), ("time_s", -1), ("heading", np.nan), ("speed_kt", np.nan)):
            bad = good.copy()
            bad[field][2] = value
            self.refused(ValueError, r"orders\[2\]", lambda: self.radar.patches(self.terrain, bad))
            self.refused(ValueError, r"orders\[2\]", lambda: self.radar.patches(self.terrain, bad, force=True))
        bad = good.copy()
        bad["heading"][1] = 20
        self.refused(ValueError, r"orders\[1\]: BLIND ZONE", lambda: self.radar.patches(self.terrain, bad))
        self.assertTrue(np.isnan(self.radar.patches(self.terrain, bad, arrays=["power"], force=True)["power"][1]).any())
        for given in (np.zeros(3), good[None], good.astype(good.dtype.newbyteorder(">")), [1, 2], good[["latitude"]]):
            self.refused((ValueError, TypeError), "orders: expected an array of one axis|incompatible", lambda: self.radar.patches(self.terrain, given))
        self.refused(ValueError, "movers: expected an array", lambda: self.radar.patches(self.terrain, good, movers=np.zeros(2)))
        self.refused(ValueError, "arrays: expected video, .* found 'vide'", lambda: self.radar.patches(self.terrain, good, arrays=["vide"]))
        for threads in (0, -1, 1000):
            self.refused(ValueError, "threads: expected 1 to 256", lambda: self.radar.patches(self.terrain, good, threads=threads))
        np.testing.assert_array_equal(self.radar.patches(self.terrain, np.repeat(good, 2)[::2])["hash"], self.radar.patches(self.terrain, good)["hash"])

    def test_huge_numbers_of_maps(self):
        if resource.getrlimit(resource.RLIMIT_AS)[0] == resource.RLIM_INFINITY:
            program = ("import resource, numpy as np, yars\nradar, terrain = yars.Radar('draft', map_size=1024), yars.Terrain()\n"
                       "resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))\n"
                       "try:\n    radar.patches(terrain, np.zeros(100000, yars.PATCH_ORDER), arrays=['power'])\n"
                       "except MemoryError:\n    print('refused')")
            done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60,
                                  env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
            self.assertEqual(done.stdout, "refused\n", done.stderr)


class Memory(unittest.TestCase):
    def test_thousands_of_calls(self):
        def resident_kb():
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4

        terrain, radar = yars.Terrain(), yars.Radar("draft", map_size=32, samples=30)
        orders = orders_of(PATCH)
        small = {**SCAN, "scan_width": 5}

        def calls(count):
            for _ in range(count):
                radar.scan(terrain, **small).latitude
                radar.patches(terrain, orders)
                terrain.elevation([37.0, 37.5], -122.5)
                try:
                    radar.scan(terrain, lat=91)
                except ValueError:
                    pass

        calls(500)
        before = resident_kb()
        calls(2500)
        self.assertLess(resident_kb() - before, 4096)


if __name__ == "__main__":
    unittest.main()
