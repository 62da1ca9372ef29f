#!/usr/bin/env python3
"""Data sets by the kernels of YARS: 96 chips of a town have the same bytes from one worker, two workers and three
shards; the video's hash is that of `yars patch`. Needs yars._core. YARS_TEST_FULL, by scripts/test --full: 2,000 chips,
seven shards, and three Dask workers, one of which is killed after each fifth of the blocks.
usage: dataset_kernels_test.py BIN [unittest options]
BIN: folder of `yars`. PYTHONPATH: folder of the built package."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE))
from dataset_run_test import Case, tree, wait_for  # noqa: E402  takes BIN from the arguments

try:
    import yars._core  # noqa: F401
except ImportError:
    print("yars._core is not built: skipped")
    sys.exit(77)
import numpy as np  # noqa: E402

from yars.dataset import Dataset, limits  # noqa: E402
from yars.dataset.maker import scene_text  # noqa: E402

SPEC = """count: {count}
seed: 5
chip: {{size: {size}, window_nm: 0.67, arrays: [video, shadow, layover, object, material]}}
terrain: {{generate: {{south: 37, west: -123, level: 0, edge: cut}}}}
scenes: [{{generate: town, triangles: {triangles}, at: [37.5, -122.5, 20]}}]
targets: [{{scenes: all, north_m: {{uniform: [-200, 200]}}, east_m: {{uniform: [-200, 200]}}}}]
geometry: {{range_nm: {{uniform: [5, 12]}}, altitude_ft: {{uniform: [8000, 25000]}}, squint_deg: {{uniform: [10, 60]}}}}
{more}output: {{block: 16}}
"""
MORE = ("movers: [{count: {uniform: [0, 2]}, north_m: {uniform: [-300, 300]}}]\n"
        "weather: {sea_state: {uniform: [0, 5]}}\n")


FULL = "YARS_TEST_FULL" in os.environ


class Kernels(Case):
    count, size, triangles, more = 2000 if FULL else 96, 128, 10000, MORE

    def write_spec(self, name="specification.yaml", **changes):
        path = self.folder / name
        path.write_text(SPEC.format(count=self.count, size=self.size, triangles=self.triangles, more=self.more,
                                    **changes))
        return path

    def command(self, *arguments, out=None, plan=None):
        return [sys.executable, "-m", "yars.dataset", str(plan or self.plan), "--out", str(out or self.out),
                *map(str, arguments)]


class EqualFiles(Kernels):
    def test_workers_shards_and_dask(self):
        whole = self.reference()
        self.assertIn("manifest.jsonl", whole)
        with self.subTest("two workers"):
            self.run_it("--workers", 2)
            self.assertEqual(tree(self.out), whole)
        shards = (3, 0, 6, 1, 5, 2, 4) if FULL else (1, 0, 2)
        with self.subTest("shards"):
            for shard in shards:
                self.run_it("--workers", 1, "--shard", f"{shard}/{len(shards)}", out=self.folder / "shards")
            self.assertEqual(tree(self.folder / "shards"), whole)
        if FULL:
            with self.subTest("Dask"):
                self.by_dask(whole)

    def by_dask(self, whole):
        try:
            from dataset_dask_test import Cluster, hosts_of
        except SystemExit:
            self.skipTest("distributed is not installed")
        shutil.rmtree(self.out)
        (self.folder / "cluster").mkdir()
        cluster = Cluster(self.folder / "cluster", 3, {})
        self.addCleanup(cluster.close)
        blocks = self.count // 16
        cluster.kill_when(lambda kills: self.blocks_there() >= blocks // 5 * (kills + 1))
        self.run_it("--dask", cluster.address)
        self.assertGreaterEqual(cluster.kills, 3)
        self.assertEqual(tree(self.out), whole)
        self.assertTrue(wait_for(lambda: not hosts_of(self.out)), "a host process is left")


class Values(Kernels):
    count, size, triangles, more = 40, 64, 5000, ""

    def test_video_is_that_of_the_command(self):
        self.run_it()
        data = Dataset(self.out)
        for item in (0, 39):
            order = data[item]["parameters"]["order"]
            scene = next((self.out / "scenes").glob("*.flt"))
            run = subprocess.run(
                [limits.command(), "patch", "--json", "--terrain", str(self.out / "terrain"),
                 "--scene", scene_text(scene, None), f"--lat={order['latitude']!r}", f"--lon={order['longitude']!r}",
                 f"--alt-ft={order['altitude_ft']!r}", f"--heading={order['heading']!r}",
                 f"--speed-kt={order['speed_kt']!r}", f"--target-lat={order['target_latitude']!r}",
                 f"--target-lon={order['target_longitude']!r}", "--window-nm=0.67", f"--looks={order['looks']}",
                 "--size=64", "--seed=5", f"--map={order['map']}"], capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(f"{json.loads(run.stdout)['hash']:016x}", data[item]["parameters"]["hash"]["video"])

    def test_labels_fit_boxes(self):
        self.run_it()
        chip = Dataset(self.out)[3]
        numbers, counts = np.unique(chip["object"][chip["object"] >= 0], return_counts=True)
        self.assertEqual(chip["boxes"]["object"].tolist(), numbers.tolist())
        self.assertEqual(chip["boxes"]["pixels"].tolist(), counts.tolist())
        self.assertEqual(set(np.unique(chip["shadow"])) | {0, 1}, {0, 1})


if __name__ == "__main__":
    unittest.main()
