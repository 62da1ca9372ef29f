#!/usr/bin/env python3
"""Facts about many maps in one call of the package yars.

usage: series_test.py BUILD     BUILD: a build folder with bin/yars and python/yars.
    Skipped (code 77) where it has no compiled part.
"""
import resource
import unittest

from core_helpers import PATCH, Folder, np, orders_of, program, yars


def plane_of(origin, latitude, longitude):
    """Azimuthal equidistant plane [m] about an origin, for points within some kilometres:
    ellipsoid by its two radii of curvature."""
    a, e2 = 6378137.0, 0.00669437999014
    middle = np.radians(0.5 * (origin[0] + latitude))
    w = 1 - e2 * np.sin(middle) ** 2
    return (np.radians(longitude - origin[1]) * np.cos(middle) * a / np.sqrt(w),
            np.radians(latitude - origin[0]) * a * (1 - e2) / w ** 1.5)


class Series(Folder):
    NAMES = ("video", "power", "shadow", "layover", "object", "material", "height", "grazing_angle")

    def setUp(self):
        super().setUp()
        self.terrain = yars.Terrain()
        path = yars.Scene.generate(self.folder / "town.flt", kind="town", triangles=4000, seed=1,
                                   origin=(37.62, -122.4, 20))
        self.scene = yars.Scene(path, self.terrain)
        self.radar = yars.Radar("standard", map_size=96)
        self.patches = [{**PATCH, "window_nm": 0.67},
                        {**PATCH, "window_nm": 0.67, "heading_deg": 355, "longitude_deg": -122.45},
                        {**PATCH, "window_nm": 1.3}]
        for patch in self.patches:
            del patch["seed"]

    def test_equal_to_single_maps(self):
        for threads in (1, 2):
            maps = self.radar.patches(self.terrain, orders_of(*self.patches), self.scene, arrays=self.NAMES,
                                      threads=threads)
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
            x, y = plane_of((centre["target_latitude_deg"], centre["target_longitude_deg"]), one["latitude"],
                            one["longitude"])
            up = np.radians(geo["up_deg"])
            pixel_m = geo["window_m"] / 96
            corners = []
            for along, across in ((0.5, -0.5), (0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5)):
                a, b = along * one["length_m"], across * one["width_m"]
                east, north = (x + a * np.sin(heading) + b * np.cos(heading),
                               y + a * np.cos(heading) - b * np.sin(heading))
                right, ahead = east * np.cos(up) - north * np.sin(up), east * np.sin(up) + north * np.cos(up)
                # Flat earth: a point above the plane appears at its slant range.
                over = one["base_msl_m"] - geo["plane_msl_m"]
                ground = np.hypot(right, ahead + geo["distance_m"])
                height = np.sqrt(geo["slant_range_m"] ** 2 - geo["distance_m"] ** 2)
                shown = np.sqrt(max(ground ** 2 + (height - over) ** 2 - height ** 2, 0.0)) / ground
                corners.append((48 + right * shown / pixel_m,
                                48 - ((ahead + geo["distance_m"]) * shown - geo["distance_m"]) / pixel_m))
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
        without, with_one = (self.radar.patches(self.terrain, orders, arrays=["video"], movers=given)
                             for given in (None, movers))
        self.assertEqual(without["hash"][0], with_one["hash"][0])
        self.assertNotEqual(without["hash"][1], with_one["hash"][1])
        for field, value in (("order", 2), ("order", -1), ("latitude", 91), ("heading", np.nan), ("heading", 361),
                             ("speed_kt", -1), ("cross_section_m2", -1), ("height_m", np.inf)):
            bad = np.repeat(movers, 2)
            bad[field][1] = value
            self.refused(ValueError, rf"movers\[1\]: {field}: expected .* to .*, found {value}",
                         lambda: self.radar.patches(self.terrain, orders, movers=bad))

    def test_none(self):
        maps = self.radar.patches(self.terrain, np.zeros(0, yars.PATCH_ORDER), self.scene, arrays=self.NAMES)
        for name in self.NAMES:
            self.assertEqual(maps[name].shape, (0, 96, 96))
        self.assertEqual((len(maps["hash"]), len(maps["geo"]), len(maps["boxes"])), (0, 0, 0))
        self.assertEqual(set(self.radar.patches(self.terrain, orders_of(self.patches[0]), arrays=())),
                         {"hash", "geo", "boxes"})
        self.assertIn("video", self.radar.patches(self.terrain, orders_of(self.patches[0]), arrays="video"))

    def test_faults(self):
        good = orders_of(*self.patches)
        for field, value in (("latitude", np.nan), ("longitude", 181), ("altitude_ft", np.inf), ("window_nm", 0),
                             ("window_nm", np.nan), ("looks", 0), ("looks", 17), ("time_s", -1), ("heading", np.nan),
                             ("speed_kt", np.nan), ("heading", -361), ("speed_kt", 10001), ("speed_kt", -1),
                             ("altitude_ft", 600001), ("altitude_ft", -3001)):
            bad = good.copy()
            bad[field][2] = value
            for force in (False, True):
                self.refused(ValueError, rf"orders\[2\]: {field}: expected .* to .*, found {value}",
                             lambda: self.radar.patches(self.terrain, bad, force=force))
        bad = good.copy()
        bad["heading"][1] = 20
        self.refused(ValueError, r"orders\[1\]: BLIND ZONE", lambda: self.radar.patches(self.terrain, bad))
        self.assertTrue(np.isnan(self.radar.patches(self.terrain, bad, arrays=["power"], force=True)["power"][1]).any())
        for given in (np.zeros(3), good[None], good.astype(good.dtype.newbyteorder(">")), [1, 2], good[["latitude"]]):
            self.refused((ValueError, TypeError), "orders: expected an array of (one axis|the type)",
                         lambda: self.radar.patches(self.terrain, given))
        self.refused(ValueError, "movers: expected an array",
                     lambda: self.radar.patches(self.terrain, good, movers=np.zeros(2)))
        self.refused(ValueError, "arrays: expected video, .* found 'vide'",
                     lambda: self.radar.patches(self.terrain, good, arrays=["vide"]))
        self.refused(TypeError, "movers: expected an array of the type yars.MOVER, found list",
                     lambda: self.radar.patches(self.terrain, good, movers=[1]))
        for name, value in (("threads", 1.5), ("min_pixels", -1), ("force", 1)):
            self.refused((ValueError, TypeError), f"{name}: expected",
                         lambda: self.radar.patches(self.terrain, good, **{name: value}))
        for threads in (0, -1, 1000):
            self.refused(ValueError, "threads: expected a whole number from 1 to 256",
                         lambda: self.radar.patches(self.terrain, good, threads=threads))
        np.testing.assert_array_equal(self.radar.patches(self.terrain, np.repeat(good, 2)[::2])["hash"],
                                      self.radar.patches(self.terrain, good)["hash"])

    def test_results_are_the_callers_own(self):
        maps = self.radar.patches(self.terrain, orders_of(*self.patches), self.scene)
        for name, array in maps.items():
            self.assertTrue(array.flags.writeable, name)
        hashes = maps["hash"].copy()
        maps["video"][:] = 0
        np.testing.assert_array_equal(self.radar.patches(self.terrain, orders_of(*self.patches), self.scene)["hash"],
                                      hashes)

    def test_huge_numbers_of_maps(self):
        if resource.getrlimit(resource.RLIMIT_AS)[0] == resource.RLIM_INFINITY:
            said = program("import resource, numpy as np, yars\n"
                           "radar, terrain = yars.Radar('draft', map_size=1024), yars.Terrain()\n"
                           "orders = np.zeros(100000, yars.PATCH_ORDER)\n"
                           f"orders[:] = {orders_of(self.patches[0])[0].item()!r}\n"
                           "resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))\n"
                           "try:\n    radar.patches(terrain, orders, arrays=['power'])\n"
                           "except MemoryError:\n    print('refused')")
            self.assertEqual(said, ("refused\n", "", 0))


if __name__ == "__main__":
    unittest.main()
