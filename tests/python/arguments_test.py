#!/usr/bin/env python3
"""Facts about arguments of the compiled part of the package yars: values, paths, messages;
terrain and scenes that are made up.

usage: arguments_test.py BUILD     BUILD: a build folder with bin/yars and python/yars.
    Skipped (code 77) where it has no compiled part.
"""
import decimal
import fractions
import os
import pathlib
import pickle
import unittest
import warnings

from core_helpers import PATCH, SCAN, Folder, command, np, yars


class Arguments(Folder):
    def test_wrong_types(self):
        terrain, radar = yars.Terrain(), yars.Radar("draft")
        for call in (lambda: radar.scan(None), lambda: radar.scan("hills"), lambda: radar.patch(None),
                     lambda: radar.scan(terrain, "town.flt"), lambda: yars.Scene("x.flt", None),
                     lambda: yars.Scene(3, terrain), lambda: yars.Terrain(3), lambda: radar.scan(),
                     lambda: radar.patches(None, np.zeros(0, yars.PATCH_ORDER)),
                     lambda: radar.patches(terrain, np.zeros(0, yars.PATCH_ORDER), 5),
                     lambda: radar.patches(terrain, np.zeros(0, yars.PATCH_ORDER), threads=1.5),
                     lambda: terrain.elevation(1)):
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
                              (lambda: yars.Radar(samples=-1), "samples"),
                              (lambda: yars.Radar(samples=float("nan")), "nan|samples"),
                              (lambda: yars.Radar(map_size=10**9), "mapSize"), 
                              (lambda: yars.Radar(settings="( Sea :state 99 )"), "state"),
                              (lambda: yars.Radar(settings="( Sea"), "expected"),
                              (lambda: yars.Radar(settings="( Nothing :a 1 )"), "Nothing"),
                              (lambda: yars.Radar(name="x) ( Sea"), "name")):
            self.refused(ValueError, pattern, call)
        for value in ([1], (1,), np.array([1]), 1j, b"1", None):
            self.refused(TypeError, "yars.Radar: samples: expected a number", lambda: yars.Radar(samples=value))
        self.refused(ValueError, "knobs of algorithm, .*samples.*map_size.*found 'bogus'", lambda: yars.Radar(bogus=3))
        self.refused(ValueError, "preset: expected one of 1996, draft", lambda: yars.Radar(""))
        self.refused(ValueError, "config: expected a path", lambda: yars.Radar(config=""))
        path = yars.Scene.generate(self.folder / "a.flt", kind="bridge", triangles=100, origin=(1, 2))
        self.refused(yars.Error, "config: expected a text of GUF", lambda: yars.Radar(config=path))
        for value in (99, np.int32(99), np.array(99), 99.0, np.float32(99)):
            self.assertEqual(yars.Radar("fine", samples=value).samples, 99)
        self.refused(ValueError, "subBeams, found the number 3.9",
                     lambda: yars.Radar("standard", sub_beams=np.array(3.9)))

    def test_truth_values_of_numpy(self):
        terrain, radar = yars.Terrain(), yars.Radar("draft")
        steep = {**SCAN, "elevation_deg": -80.0}
        self.assertEqual(radar.scan(terrain, **steep, force=np.bool_(True)).hash,
                         radar.scan(terrain, **steep, force=True).hash)
        with self.assertRaises(ValueError):
            radar.scan(terrain, **steep, force=np.bool_(False))

    def test_elevation(self):
        terrain = yars.Terrain()
        for latitude, longitude in ((91, 0), (float("nan"), 0), (0, 181), (0, float("inf"))):
            self.refused(ValueError, "(latitude|longitude)_deg: expected -(90|180) to (90|180) deg, found",
                         lambda: terrain.elevation(latitude, longitude))
        for value in ("a", None, 1j, b"3", True, [["1"]], np.array(["1"]), np.array([None])):
            self.refused(TypeError, "latitude: expected numbers of degrees, found", lambda: terrain.elevation(value, 3))
        self.refused(ValueError, r"broadcast, found \(2,\) and \(3,\)", lambda: terrain.elevation([1, 2], [1, 2, 3]))
        masked = terrain.elevation(np.ma.array([37.5, 95.0, 37.5], mask=[False, True, False]), -122.5)
        self.assertEqual((np.isnan(masked).tolist(), masked[0]),
                         ([False, True, False], terrain.elevation(37.5, -122.5)))
        self.assertEqual(terrain.elevation(np.zeros((0, 3)), 1.0).shape, (0, 3))
        self.assertEqual(terrain.elevation(37.5, -122.5).shape, ())
        grid = terrain.elevation(np.linspace(37, 38, 7)[:, None], np.linspace(-123, -122, 5))
        self.assertEqual(grid.shape, (7, 5))
        self.assertEqual(grid[3, 2], terrain.elevation(37.5, -122.5))
        whole = np.linspace(-90, 90, 37)
        np.testing.assert_array_equal(terrain.elevation(whole, -180.0),
                                      [float(terrain.elevation(one, -180.0)) for one in whole])

    def test_made_up_terrain_and_scenes(self):
        folder = yars.Terrain.generate(self.folder / "land", south=37, west=-123, cells_lat=1, cells_lon=1, level=0,
                                       culture=False)
        self.assertFalse(list(pathlib.Path(folder).rglob("*.smc.png")))
        command("terrain", "generate", "--out", str(self.folder / "same"), "--south=37", "--west=-123", "--cells-lat=1",
                "--cells-lon=1", "--level=0", "--no-culture", "--json")
        files = sorted(path.relative_to(folder) for path in pathlib.Path(folder).rglob("*.dt0"))
        self.assertTrue(files)
        for file in files:
            self.assertEqual((pathlib.Path(folder) / file).read_bytes(), (self.folder / "same" / file).read_bytes())
        area = {"south": 36, "west": -124, "cells_lat": 2, "cells_lon": 2, "level": 0}
        kept = [yars.Terrain.generate(self.folder / name, **area, seed=seed) and
                sorted(path.name for path in (self.folder / name).rglob("*.*"))
                for name, seed in (("mix", 1), ("mix", 9), ("other", 9))]
        self.assertTrue(kept[0])
        self.assertEqual(kept[1], kept[2], "no cell of the landscape before, also where there is sea now")
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

        path = yars.Scene.generate(self.folder / "town.flt", kind="town", triangles=500, seed=np.int64(2),
                                   origin=(37.5, -122.5, 30))
        command("scene", "generate", "--out", str(self.folder / "b.flt"), "--kind=town", "--triangles=500", "--seed=2",
                "--origin=37.5,-122.5,30", "--json")
        self.assertEqual(pathlib.Path(path).read_bytes(), (self.folder / "b.flt").read_bytes())
        scene = yars.Scene(path, terrain)
        self.assertEqual(len(pickle.loads(pickle.dumps(scene)).objects), len(scene.objects))
        for call in (lambda: yars.Radar("draft").scan(yars.Terrain(), scene, **SCAN),
                     lambda: yars.Radar("draft").patch(yars.Terrain(), scene, **PATCH),
                     lambda: yars.Radar("draft").patches(yars.Terrain(), np.zeros(0, yars.PATCH_ORDER), scene)):
            self.refused(ValueError, "expected a scene on the terrain of this call, the built-in hills, "
                                     "found one on '.*land'", call)
        for call, pattern in ((lambda: yars.Scene.generate(self.folder / "a.png", origin=(1, 2)), "ends in .flt"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", kind="city", origin=(1, 2)),
                               "kind: expected one of airfield"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(91, 2)),
                               "origin: expected LATITUDE"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(1,)),
                               "origin: expected .latitude, longitude"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt"), "expected origin"),
                              (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(1, 2), out="b.flt"),
                               "found 'out'"),
                              (lambda: yars.Terrain.generate(folder, south=37, west=-122, cells_lat=1, cells_lon=1,
                                                             level=0), "without cells of another"),
                              (lambda: yars.Terrain.generate(folder, south=37, west=-123, cells_lat=1, cells_lon=1,
                                                             level=1), "without cells of another"),
                              (lambda: yars.Scene(path + "@36,-121,1e308", terrain), "in degrees"),
                              (lambda: yars.Terrain.generate(self.folder / "a.png"), "folder"),
                              (lambda: yars.Terrain.generate(self.folder / "x", south=89, cells_lat=3), "north pole")):
            self.refused(ValueError, pattern, call)
        self.refused(yars.Error, "expected", lambda: yars.Scene.generate(folder + "/../town.flt/a.flt", origin=(1, 2)))

    def test_errors_of_made_up_places_and_trades_have_their_fields(self):
        for call, field, high in (
                (lambda: yars.Terrain.generate(self.folder / "x", south=89, cells_lat=3), "cells_lat", 1.0),
                (lambda: yars.Scene.generate(self.folder / "a.flt", origin=(91, 2)), "origin", None),
                (lambda: yars.trade(width_deg=121), "width_deg", 120.0),
                (lambda: yars.trade(base="fast"), "base", None),
                (lambda: yars.trade(presets="draft", scene=["37.5,-121.5,-1000,0,5"]), "scene", None),
                (lambda: yars.trade(maps=True, presets="draft", view=["37.5,-121.5,-1000,37.7,-121.5,0.67"]), "view",
                 None),
                (lambda: yars.trade(maps=True, presets="draft", scene_without=["tower"]), "scene_without", None)):
            with self.assertRaises(ValueError) as caught:
                call()
            self.assertEqual((caught.exception.field, caught.exception.high), (field, high))
        self.refused(ValueError, "width_deg: expected 1 to 120 deg", lambda: yars.trade(width_deg=121))
        self.refused(TypeError, "knob: expected a text", lambda: yars.trade(knob=3))

    def test_faults_of_guf_are_structures(self):
        unknown, wrong = yars._core.guf_faults("( Receiver :freqency 9 )\n( Sea :state 9 )")
        self.assertEqual([unknown[name] for name in ("kind", "line", "form", "slot", "nearest")],
                         ["slot", 1, "Receiver", "freqency", "frequency"])
        self.assertEqual([wrong[name] for name in ("kind", "line", "slot", "found", "low", "high")],
                         ["value", 2, "state", "the number 9", 0.0, 6.0])

    def test_arrays_are_no_whole_numbers(self):
        terrain, radar = yars.Terrain(), yars.Radar("draft")
        wanted = radar.scan(terrain, **SCAN)
        for kind in (np.array, np.float64, lambda value: np.ma.array(value), fractions.Fraction, decimal.Decimal):
            self.assertEqual(
                radar.scan(terrain, **{**SCAN, "latitude_deg": kind(SCAN["latitude_deg"])}).facts["latitude"],
                wanted.facts["latitude"])
        for value in (np.array([37.8]), [37.8], (37.8,), np.zeros((1, 1)), 1j, b"37", None, True, False, np.bool_(True),
                      terrain, "37.8"):
            self.refused(TypeError, "yars.Radar.scan: latitude_deg: expected",
                         lambda: radar.scan(terrain, **{**SCAN, "latitude_deg": value}))
        for value in (10 ** 400, float("nan"), float("inf")):
            self.refused(ValueError, "yars.Radar.scan: latitude_deg: expected",
                         lambda: radar.scan(terrain, **{**SCAN, "latitude_deg": value}))
        self.refused(ValueError, "gain: expected a whole number",
                     lambda: radar.scan(terrain, **SCAN, gain=np.array(2.9)))
        self.refused(ValueError, "seed: expected a whole number from 0 to 18446744073709551615",
                     lambda: radar.scan(terrain, seed=2 ** 64))
        for value in (2, "no", [True], 1.0):
            self.refused(TypeError, "force: expected True or False", lambda: radar.scan(terrain, **SCAN, force=value))
        for name in ("alt", "help", "json", "lat-x", "\udcff", ""):
            self.refused(ValueError, "yars.Radar.scan: expected arguments of latitude_deg, longitude_deg",
                         lambda: radar.scan(terrain, **{name: 1}))

    def test_messages_are_in_words_of_python(self):
        terrain, radar = yars.Terrain(), yars.Radar("draft")
        self.refused(ValueError, r"give force=True", lambda: radar.scan(terrain, **{**SCAN, "elevation_deg": -80}))
        self.refused(ValueError, "gain: expected a whole number from 0 to 3, found int 4",
                     lambda: radar.scan(terrain, **{**SCAN, "gain": 4}))
        self.refused(yars.Error, r"make one with `yars terrain generate --out DIR`", lambda: yars.Terrain("/absent"))
        self.refused(ValueError, "found 1e\\+308", lambda: terrain.elevation(1e308, 0))
        self.refused(yars.Error, "expected a folder, found none", lambda: yars.trade(terrain, out="/absent/x.json"))
        path = yars.Scene.generate(self.folder / "a.flt", kind="town", triangles=500, origin=(37, -122))
        (self.folder / "cut.flt").write_bytes(pathlib.Path(path).read_bytes()[:5000])
        for _ in range(2):
            self.refused(yars.Error, "cannot; because of .*cut.flt: expected a whole record",
                         lambda: yars.Scene(self.folder / "cut.flt", terrain))

    def test_the_north_and_east_edge_of_the_outermost_cells(self):
        folder = yars.Terrain.generate(self.folder / "land", south=37, west=-123, cells_lat=1, cells_lon=1, level=0,
                                       edge="cut", sea=True)
        terrain = yars.Terrain(folder)
        inside = np.array([terrain.elevation(38 - 1e-9, -122.5), terrain.elevation(37.5, -122 - 1e-9),
                           terrain.elevation(38 - 1e-9, -122 - 1e-9)])
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # the edges are no sea outside
            edges = terrain.elevation([38, 37.5, 38], [-122.5, -122, -122])
        np.testing.assert_allclose(edges, inside, atol=0.01)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for _ in range(2):
                self.assertEqual(terrain.elevation([37.5, 36.5, 38.5], -122.5)[1:].tolist(), [0, 0])
        self.assertEqual(["found 2 of 3 outside" in str(one.message) for one in caught], [True, True])
        self.assertEqual({one.filename for one in caught}, {__file__})
        rows = command("terrain", "profile", "--terrain", folder, "--from", "38", "-122.5", "--to", "38", "-122.4",
                       "--step=5000", text=True)
        self.assertAlmostEqual(float(rows.splitlines()[1].split(",")[3]), edges[0], 1)

    def test_names_of_files_have_any_bytes(self):
        folder = os.path.join(os.fsencode(self.folder), b"l\xffd")
        self.assertEqual(yars.Terrain.generate(folder, south=37, west=-123, cells_lat=1, cells_lon=1, level=0),
                         os.fsdecode(folder))
        for given in (folder, os.fsdecode(folder), pathlib.Path(os.fsdecode(folder))):
            terrain = yars.Terrain(given)
            self.assertEqual(terrain.directory, os.fsdecode(folder))
            file = os.path.join(folder, b"a.flt")
            yars.Scene.generate(file, kind="bridge", triangles=100, origin=(37.5, -122.5, 0))
            for files in (file, os.fsdecode(file), pathlib.Path(os.fsdecode(file)), [file],
                          (os.fsdecode(file) + "@37.5,-122.5,10",)):
                self.assertGreater(len(yars.Scene(files, terrain).objects), 1)
            repr(terrain).encode()
        self.refused(yars.Error, r"\\xff", lambda: yars.Terrain(b"/absent\xff"))
        with open(os.path.join(folder, b"c.guf"), "w") as file:
            file.write(yars.Radar("draft").guf)
        self.assertEqual(yars.Radar(config=os.path.join(folder, b"c.guf")).fidelity, "draft")
        for value in (3, [], True, 1.5):
            self.refused(TypeError, "expected a path", lambda: yars.Terrain(value))
        self.refused(ValueError, "expected a path .*empty", lambda: yars.Terrain(""))
        self.refused(ValueError, "expected a path", lambda: yars.Terrain("a\0b"))

    def test_paths_are_absolute(self):
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        yars.Terrain.generate("land", south=37, west=-123, cells_lat=1, cells_lon=1, level=0, edge="cut")
        yars.Scene.generate("a.flt", kind="bridge", triangles=100, origin=(37.5, -122.5, 0))
        terrain, other = yars.Terrain("land"), yars.Terrain("./land/../land/")
        scene, wanted = yars.Scene("a.flt", terrain), terrain.elevation(37.5, -122.5)
        os.chdir("/")
        self.assertEqual(terrain.directory, str(self.folder / "land"))
        self.assertEqual(pickle.loads(pickle.dumps(terrain)).elevation(37.5, -122.5), wanted)
        self.assertEqual(len(pickle.loads(pickle.dumps(scene)).objects), len(scene.objects))
        scan = [yars.Radar("draft").scan(one, scene, latitude_deg=37.4, longitude_deg=-122.5, range_nm=10, seed=1).hash
                for one in (terrain, other)]
        self.assertEqual(scan[0], scan[1])  # one folder, however spelled


if __name__ == "__main__":
    unittest.main()
