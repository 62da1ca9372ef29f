#!/usr/bin/env python3
"""Draws of data sets: known answers of Philox, distributions, independence, one value for any partition of the items.
usage: dataset_sampling_test.py [BIN]"""
import math
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "python"))
if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
    os.environ["YARS_BIN"] = os.path.abspath(sys.argv.pop(1))

from yars.dataset import DatasetError, distributions, sampling  # noqa: E402
from yars.dataset.limits import Limits  # noqa: E402
from yars.dataset.settings import Settings  # noqa: E402
from yars.dataset.spec import read_spec  # noqa: E402

LIMITS = Limits(8.0, 60.0, 60.0, {0.67: (4.7, 20.0), 1.3: (4.7, 40.0)}, 4.7, 2)
SPEC = """count: 100000
seed: 11
chip: {window_nm: {choice: [0.67, 1.3]}, looks: {uniform: [1, 4]}}
scenes: [{file: a.flt, at: [37.5, -122.5]}, {file: b.flt, at: [37.6, -122.6]}]
targets:
  - {area: [37, -123, 38, -122], on: land}
  - {weight: 2, scenes: [1], north_m: {uniform: [-500, 500]}}
  - {objects: house, east_m: {normal: [0, 50]}}
geometry: {range_nm: {log_uniform: [3, 18]}, altitude_ft: {uniform: [500, 25000]}, squint_deg: {uniform: [0, 70]},
           speed_kt: {normal: [460, 30]}}
movers: [{count: {uniform: [0, 3]}, speed_kt: {uniform: [5, 40]}}, {count: 1}]
radar: {settings: {Receiver: {frequency: {choice: [9.3, 9.6]}}}, every: 10}
weather: {sea_state: {uniform: [0, 5]}, rain: {cells: {choice: [0, 2]}, area: [37, -123, 38, -122]}}
"""


def elevation(latitude, longitude):
    return np.maximum(0.0, 900.0 * np.sin(40.0 * np.asarray(latitude)) * np.cos(40.0 * np.asarray(longitude)))


def sampler_of(text, ground=elevation):
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(text)
        file.flush()
        plan = read_spec(file.name)
    objects = np.array([("house", 37.51, -122.51), ("car", 37.52, -122.52), ("house", 37.53, -122.53)],
                       [("name", "U8"), ("latitude", "f8"), ("longitude", "f8")])
    centres = np.array([scene.at[:2] for scene in plan.scenes]).reshape(-1, 2)
    return sampling.Sampler(plan, LIMITS,
                            sampling.World(ground, centres, objects, [str(name) for name in objects["name"]]))


def kolmogorov(values, cumulative):
    """Largest distance between the distribution function of values and the law's, in units of 1 / sqrt(n)."""
    values = np.sort(values)
    law, count = cumulative(values), len(values)
    steps = np.arange(count + 1) / count
    return max(np.max(steps[1:] - law), np.max(law - steps[:-1])) * math.sqrt(count)


class Philox(unittest.TestCase):
    """Known answers: kat_vectors of Random123 1.14, philox4x32 10."""

    def test_known_answers(self):
        ones = 0xFFFFFFFF
        for counter, key, answer in (
                ((0, 0, 0, 0), (0, 0), "6627e8d5 e169c58d bc57ac4c 9b00dbd8"),
                ((ones,) * 4, (ones,) * 2, "408f276d 41c83b0e a20bc7c6 6d5451fd"),
                ((0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344), (0xA4093822, 0x299F31D0),
                 "d16cfe09 94fdcceb 5001e420 24126ea1")):
            words = distributions.philox4x32([np.array([word], np.uint64) for word in counter],
                                             [np.array([word], np.uint64) for word in key])
            self.assertEqual(" ".join(f"{int(word[0]):08x}" for word in words), answer)

    def test_fields_do_not_disturb_each_other(self):
        few = distributions.Streams(5, ["a", "b"]).uniform(np.arange(50))
        many = distributions.Streams(5, ["c", "b", "a"]).uniform(np.arange(50))
        self.assertTrue((few[0] == many[2]).all() and (few[1] == many[1]).all())

    def test_uniform_and_uncorrelated(self):
        count = 200000
        streams = distributions.Streams(5, ["a", "b", "c"])
        u = streams.uniform(np.arange(count))
        for row in u:
            self.assertLess(kolmogorov(row, lambda value: value), 2.0)
            for lag in (1, 2, 64, 1000):
                self.assertLess(abs(np.corrcoef(row[:-lag], row[lag:])[0, 1]) * math.sqrt(count), 4.5)
        self.assertLess(np.abs(np.corrcoef(u)[np.triu_indices(3, 1)]).max() * math.sqrt(count), 4.5)
        again = streams.uniform(np.arange(count), attempt=1)
        self.assertLess(abs(np.corrcoef(u[0], again[0])[0, 1]) * math.sqrt(count), 4.5)
        other = distributions.Streams(6, ["a"]).uniform(np.arange(count))
        self.assertLess(abs(np.corrcoef(u[0], other[0])[0, 1]) * math.sqrt(count), 4.5)

    def test_items_beyond_32_bits_differ(self):
        streams = distributions.Streams(5, ["a"])
        u = streams.uniform(np.array([7, 7 + 2**32, 7 + 2**40]))[0]
        self.assertEqual(len(set(u.tolist())), 3)


class Distributions(unittest.TestCase):
    def setUp(self):
        self.u = distributions.Streams(1, ["x"]).uniform(np.arange(100000))[0]

    def test_each_has_its_distribution_function(self):
        normal = np.vectorize(lambda value: 0.5 * math.erfc(-value / math.sqrt(2.0)))
        low, high = normal(-1.0), normal(2.0)
        for law, cumulative in (
                (distributions.Uniform([(2.0, 5.0)]), lambda x: (x - 2.0) / 3.0),
                (distributions.Uniform([(0.0, 1.0), (3.0, 6.0)]), lambda x: np.where(x < 2, x, x - 2.0) / 4.0),
                (distributions.LogUniform(2.0, 50.0), lambda x: np.log(x / 2.0) / math.log(25.0)),
                (distributions.Normal(3.0, 2.0, -1e9, 1e9), lambda x: normal((x - 3.0) / 2.0)),
                (distributions.Normal(3.0, 2.0, 1.0, 7.0), lambda x: (normal((x - 3.0) / 2.0) - low) / (high - low))):
            values = law.sample(self.u)
            self.assertLess(kolmogorov(values, cumulative), 2.0, law.plain())
            self.assertTrue(values.min() >= min(law.ends()) and values.max() <= max(law.ends()))

    def test_weights(self):
        values = distributions.Choice([1, 2, 3], [1, 0, 3]).sample(self.u)
        self.assertEqual(set(values.tolist()), {1, 3})
        self.assertAlmostEqual((values == 3).mean(), 0.75, delta=0.006)
        whole = distributions.Uniform([(2, 4)], whole=True).sample(self.u)
        self.assertEqual(np.unique(whole).tolist(), [2, 3, 4])
        self.assertAlmostEqual((whole == 4).mean(), 1 / 3, delta=0.006)

    def test_normal_quantile_inverts_the_distribution_function(self):
        for x in np.linspace(-8.0, 5.0, 53):
            self.assertAlmostEqual(float(distributions.normal_quantile(0.5 * math.erfc(-x / math.sqrt(2.0)))), x,
                                   delta=1e-9)

    def test_ends_of_the_draw(self):
        ends = np.array([0.0, 1.0 - 2.0**-53])
        for law in (distributions.Uniform([(2.0, 5.0)]), distributions.LogUniform(2.0, 5.0),
                    distributions.Normal(3.0, 1.0, 2.0, 5.0),
                    distributions.Choice([2.0, 5.0]), distributions.Uniform([(2, 5)], True),
                    distributions.Uniform([(3.0, 3.0)])):
            values = law.sample(ends)
            self.assertTrue(np.isfinite(values).all() and values.min() >= 2 and values.max() <= 5)


class Geodesy(unittest.TestCase):
    def test_known_geodesics(self):
        # Vincenty's Flinders Peak to Buninyong is on GRS80, which equals WGS84 here to 0.1 mm (Geoscience Australia,
        # GDA technical manual).
        latitude, longitude, azimuth = sampling.direct(
            -(37 + 57 / 60 + 3.72030 / 3600), 144 + 25 / 60 + 29.52440 / 3600, 306 + 52 / 60 + 5.37 / 3600, 54972.271)
        self.assertAlmostEqual(float(latitude), -(37 + 39 / 60 + 10.15610 / 3600), delta=2e-8)
        self.assertAlmostEqual(float(longitude), 143 + 55 / 60 + 35.38390 / 3600, delta=2e-8)
        self.assertAlmostEqual(float(azimuth) % 360, 127 + 10 / 60 + 25.07 / 3600 + 180, delta=1e-5)

    def test_there_and_back(self):
        rng = np.random.default_rng(1)
        lat, lon, bearing, distance = (rng.uniform(-85, 85, 500), rng.uniform(-180, 180, 500),
                                       rng.uniform(0, 360, 500), rng.uniform(1, 4e5, 500))
        there = sampling.direct(lat, lon, bearing, distance)
        back = sampling.direct(there[0], there[1], there[2] + 180.0, distance)
        self.assertLess(np.abs(back[0] - lat).max(), 1e-9)
        self.assertLess(np.abs(sampling.wrapped(back[1] - lon) * np.cos(np.radians(lat))).max(), 1e-8)


class Items(unittest.TestCase):
    def test_equal_for_any_partition(self):
        sampler = sampler_of(SPEC)
        whole = sampler.draw(np.arange(600))
        for size in (7, 64, 599):
            parts = [sampler_of(SPEC).draw(np.arange(first, min(first + size, 600))) for first in range(0, 600, size)]
            self.assertEqual(np.concatenate([part.orders for part in parts]).tobytes(), whole.orders.tobytes())
            self.assertEqual(np.concatenate([part.attempt for part in parts]).tolist(), whole.attempt.tolist())
            self.assertEqual(np.concatenate([part.movers["latitude"] for part in parts]).tolist(),
                             whole.movers["latitude"].tolist())
        for item in range(0, 600, 50):
            self.assertEqual(sampler_of(SPEC).draw(np.array([item])).orders.tobytes(), whole.orders[item].tobytes())
        order = np.random.default_rng(2).permutation(600)
        self.assertEqual(sampler.draw(order).orders.tobytes(), whole.orders[order].tobytes())

    def test_a_new_field_does_not_change_the_others(self):
        first = sampler_of(SPEC).draw(np.arange(200))
        second = sampler_of(SPEC.replace("movers: [", "movers: [{count: 2}, ")).draw(np.arange(200))
        self.assertEqual(first.orders.tobytes(), second.orders.tobytes())

    def test_another_seed_gives_other_items(self):
        first, second = (sampler_of(SPEC).draw(np.arange(50)),
                         sampler_of(SPEC.replace("seed: 11", "seed: 12")).draw(np.arange(50)))
        self.assertFalse((first.orders["heading"] == second.orders["heading"]).any())

    def test_every_item_is_possible(self):
        sampler = sampler_of(SPEC)
        sample = sampler.draw(np.arange(4000))
        orders = sample.orders
        ground = elevation(orders["latitude"], orders["longitude"])
        self.assertTrue((orders["altitude_ft"] * 0.3048 > ground).all())
        north = (orders["target_latitude"] - orders["latitude"]) * 111.1
        east = (orders["target_longitude"] - orders["longitude"]) * 111.3 * np.cos(np.radians(37.5))
        distance_nm = np.hypot(north, east) / 1.852
        self.assertTrue((distance_nm > 4.65).all() and (distance_nm < 18.1).all())
        off = np.abs(sampling.wrapped(np.degrees(np.arctan2(east, north)) - orders["heading"]))
        self.assertTrue((off > 7.5).all() and (off < 60.5).all())
        area = sample.entry == 0
        self.assertTrue((elevation(orders["target_latitude"], orders["target_longitude"])[area] > 0).all())
        self.assertEqual(set(sample.object[sample.entry == 2].tolist()), {0, 2})
        self.assertTrue((np.abs(orders["target_latitude"][sample.entry == 1] - 37.6) < 500 / 110000).all())
        self.assertAlmostEqual((sample.entry == 1).mean(), 0.5, delta=0.05)
        self.assertTrue((sample.attempt > 0).any())
        self.assertEqual(set(np.bincount(sample.movers["order"], minlength=4000).tolist()), {1, 2, 3, 4})

    def test_runs_share_settings(self):
        sampler = sampler_of(SPEC)
        self.assertEqual(sampler.run_of(np.arange(25)).tolist(), [0] * 10 + [1] * 10 + [2] * 5)
        texts = [sampler.settings.text(run) for run in range(40)]
        self.assertEqual(texts, [sampler_of(SPEC).settings.text(run) for run in range(40)])
        self.assertEqual(len(set(texts)), 40)
        self.assertTrue(any("RainCell" in text for text in texts) and any("RainCell" not in text for text in texts))
        self.assertIsInstance(Settings.fields(sampler.plan), list)

    def test_an_impossible_item_is_one_clear_error(self):
        sampler = sampler_of(SPEC.replace("[500, 25000]", "[500, 600]"),
                             lambda latitude, longitude: np.full(np.shape(latitude), 5000.0))
        with self.assertRaisesRegex(DatasetError, "item 0 in 100 draws, found none: .*aircraft beneath the ground"):
            sampler.draw(np.arange(10))

    def test_values_on_a_limit(self):
        text = SPEC.replace("{log_uniform: [3, 18]}", "4.7").replace("{uniform: [0, 70]}", "{choice: [8, 60]}")
        self.assertEqual(sampler_of(text, lambda latitude, longitude: np.full(np.shape(latitude), 1.0))
                         .draw(np.arange(64)).attempt.sum(), 0)

    def test_depression_gives_the_altitude(self):
        text = (SPEC.replace("altitude_ft: {uniform: [500, 25000]}", "depression_deg: 10")
                .replace("{log_uniform: [3, 18]}", "10"))
        sample = sampler_of(text).draw(np.arange(64))
        ground = elevation(sample.orders["target_latitude"], sample.orders["target_longitude"])
        height = sample.orders["altitude_ft"] * 0.3048 - ground
        self.assertLess(np.abs(np.degrees(np.arctan2(height, 18520.0)) - 10.0).max(), 1e-3)

    def test_pinned_values(self):
        """These values are part of every data set that was ever made: a change makes all of them unrepeatable."""
        sample = sampler_of(SPEC).draw(np.array([0, 1, 99999]))
        found = [[round(float(order[name]), 6)
                  for name in ("target_latitude", "target_longitude", "heading", "altitude_ft", "speed_kt")]
                 for order in sample.orders]
        self.assertEqual(found, PINNED)


PINNED = [[37.603011, -122.6, 241.021682, 10871.387794, 431.132194],
          [37.139622, -122.531206, 114.905229, 2679.354295, 428.09856],
          [37.855868, -122.611156, 318.865023, 24512.245597, 479.946037]]

if __name__ == "__main__":
    unittest.main()
