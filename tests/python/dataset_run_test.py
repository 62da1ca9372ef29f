#!/usr/bin/env python3
"""The data set maker with a made-up radar: equal files from any number of workers and shards; ends and faults that leave a
folder which the same command completes. usage: dataset_run_test.py BIN [unittest options]   (BIN: folder of `yars`)"""
import hashlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "python"))
sys.path.append(str(HERE))
if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
    os.environ["YARS_BIN"] = os.path.abspath(sys.argv.pop(1))

import numpy as np  # noqa: E402

from yars.dataset import Dataset  # noqa: E402

SPEC = """count: {count}
seed: 3
chip: {{size: 16, window_nm: 0.67, arrays: [video, object, shadow]}}
scenes: [{{file: town.flt, at: [37.5, -122.3]}}]
targets:
  - {{area: [37, -123, 38, -122], on: land}}
  - {{objects: house}}
geometry: {{range_nm: {{uniform: [5, 18]}}, altitude_ft: {{uniform: [5000, 20000]}}, squint_deg: {{uniform: [5, 70]}}}}
movers: [{{count: {{uniform: [0, 3]}}}}]
weather: {{sea_state: {{uniform: [0, 5]}}}}
output: {{block: {block}{output}}}
"""


def tree(folder):
    """{path: hash} of all files."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.rglob("*")) if path.is_file()}


def descendants(pid):
    """Processes below a process."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                parents[int(entry)] = int(pathlib.Path(f"/proc/{entry}/stat").read_text().rpartition(")")[2].split()[1])
            except (OSError, ValueError):
                pass
    below = {pid}
    while True:
        more = {child for child, parent in parents.items() if parent in below} - below
        if not more:
            return below - {pid}
        below |= more


def alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False


class Case(unittest.TestCase):
    count, block, output = 200, 8, ""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="yars-dataset-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        (self.folder / "town.flt").write_bytes(b"a scene that the made-up radar does not read")
        self.plan = self.write_spec()
        self.out = self.folder / "out"

    def write_spec(self, name="specification.yaml", **changes):
        values = {"count": self.count, "block": self.block, "output": self.output, **changes}
        path = self.folder / name
        path.write_text(SPEC.format(**values))
        return path

    def command(self, *arguments, out=None, plan=None):
        return [sys.executable, str(HERE / "dataset_fake_maker.py"), str(plan or self.plan), "--out", str(out or self.out), *map(str, arguments)]

    def start(self, *arguments, environment=None, **options):
        return subprocess.Popen(self.command(*arguments), env={**os.environ, **(environment or {})}, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, **options)

    def run_it(self, *arguments, code=0, out=None, plan=None, environment=None, **options):
        done = subprocess.run(self.command(*arguments, out=out, plan=plan), env={**os.environ, **(environment or {})}, capture_output=True, text=True,
                              check=False, timeout=300, **options)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def reference(self):
        out = self.folder / "reference"
        if not out.exists():
            self.run_it("--workers", 1, out=out)
        return tree(out)

    def blocks_there(self):
        return len(list(self.out.glob("parts/*/*.jsonl")))


class EqualFiles(Case):
    count, block = 2000, 16

    def test_workers_and_shards(self):
        whole = self.reference()
        two = self.folder / "two"
        self.run_it("--workers", 2, out=two)
        self.assertEqual(tree(two), whole)
        seven = self.folder / "seven"
        for shard in (3, 0, 6, 1, 5, 2, 4):
            self.assertNotIn("manifest.jsonl", tree(seven))
            self.run_it("--workers", 1, "--shard", f"{shard}/7", out=seven)
        self.assertEqual(tree(seven), whole)

    def test_shards_at_once(self):
        running = [self.start("--workers", 1, "--shard", f"{shard}/3") for shard in range(3)]
        for process in running:
            _, errors = process.communicate(timeout=300)
            self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(tree(self.out), self.reference())

    def test_items_do_not_depend_on_the_block(self):
        self.reference()
        self.run_it(plan=self.write_spec("other.yaml", block=37))
        first, second = Dataset(self.folder / "reference"), Dataset(self.out)
        for item in (0, 36, 37, 1999):
            for name in ("video", "object", "boxes"):
                self.assertEqual(first[item][name].tobytes(), second[item][name].tobytes())
            self.assertEqual(first[item]["parameters"], second[item]["parameters"])


class Formats(Case):
    count, block = 21, 8

    def test_zarr_is_read_by_zarr(self):
        import zarr
        self.run_it()
        group, data = zarr.open_consolidated(str(self.out / "chips.zarr")), Dataset(self.out)
        self.assertEqual(group["video"].shape, (21, 16, 16))
        for item in (0, 20):
            self.assertEqual(group["object"][item].tolist(), data[item]["object"].tolist())
        self.assertEqual(group["shadow"].attrs["_ARRAY_DIMENSIONS"], ["item", "row", "column"])

    def test_xarray_keeps_types_and_zeros(self):
        try:
            import xarray
        except ImportError:
            self.skipTest("xarray is not installed")
        self.run_it()
        data = Dataset(self.out)
        with xarray.open_zarr(self.out / "chips.zarr") as opened:
            for name in data.arrays:
                stored = np.stack([item[name] for item in map(data.__getitem__, range(len(data)))])
                self.assertEqual(opened[name].dtype, stored.dtype)
                self.assertEqual(opened[name].values.tolist(), stored.tolist())
                self.assertIn(0, stored)

    def test_npz_is_read_by_numpy(self):
        self.run_it()
        for compression in ("none", "lz4"):
            out = self.folder / compression
            self.run_it(out=out, plan=self.write_spec("npz.yaml", output=f", format: npz, compression: {compression}"))
            for item in (0, 20):
                with np.load(out / f"items/000000/{item:09d}.npz") as archive:
                    self.assertEqual(archive["video"].tolist(), Dataset(self.out)[item]["video"].tolist())
                    self.assertEqual(archive["boxes"].tobytes(), Dataset(self.out)[item]["boxes"].tobytes())
                self.assertEqual(Dataset(out)[item]["object"].tolist(), Dataset(self.out)[item]["object"].tolist())

    def test_manifest_boxes_and_classes(self):
        self.run_it()
        lines = [json.loads(line) for line in (self.out / "manifest.jsonl").read_text().splitlines()]
        self.assertEqual([line["item"] for line in lines], list(range(21)))
        data = Dataset(self.out)
        self.assertEqual(data.classes, ["car", "house"])
        self.assertEqual(data.objects[7]["name"], "house7")
        boxes = data[5]["boxes"]
        self.assertEqual(boxes["object"].tolist(), [7, 2])  # as the radar gives them; the one without pixels is left out
        self.assertEqual([data.classes[number] for number in boxes["class"]], ["house", "house"])
        self.assertEqual(lines[5]["boxes"], 2)
        self.assertEqual(set(lines[5]["hash"]), {"video", "object", "shadow"})
        self.assertIn("Sea.state", lines[5]["settings"])
        self.assertTrue(any("movers" in line for line in lines))
        self.assertEqual(len(data), 21)
        self.assertEqual(data[-1]["parameters"]["item"], 20)
        with self.assertRaises(IndexError):
            data[21]

    def test_coco_and_png(self):
        self.run_it(plan=self.write_spec("coco.yaml", output=", coco: true, png: true, manifest_boxes: true"))
        coco = json.loads((self.out / "annotations.json").read_text())
        self.assertEqual(len(coco["images"]), 21)
        self.assertEqual(len(coco["annotations"]), 42)
        self.assertEqual(coco["categories"], [{"id": 1, "name": "car"}, {"id": 2, "name": "house"}])
        first = coco["annotations"][0]
        self.assertEqual((first["id"], first["image_id"], first["category_id"], first["bbox"], first["area"]), (1, 0, 2, [1, 1, 4, 2], 8))
        line = json.loads((self.out / "manifest.jsonl").read_text().splitlines()[0])
        self.assertEqual(len(line["box_list"]), 2)
        try:
            import rasterio
        except ImportError:
            self.skipTest("rasterio is not installed")
        with rasterio.open(self.out / coco["images"][3]["file_name"]) as picture:
            self.assertEqual(picture.read(1).tolist(), Dataset(self.out)[3]["video"].tolist())

    def test_geotiff(self):
        try:
            import rasterio
        except ImportError:
            self.skipTest("rasterio is not installed")
        self.run_it(plan=self.write_spec("tif.yaml", output=", geotiff: [video, object]"))
        with rasterio.open(self.out / "geotiff/000000/000000003.object.tif") as raster:
            self.assertEqual(raster.read(1).tolist(), Dataset(self.out)[3]["object"].tolist())
            self.assertIn("Azimuthal", raster.crs.to_wkt())
            self.assertEqual(raster.transform.a, 10.0)
        again = self.folder / "again"
        self.run_it(out=again, plan=self.folder / "tif.yaml")
        self.assertEqual(tree(again), tree(self.out))


class Resume(Case):
    def test_what_is_whole_is_not_made_again(self):
        self.run_it()
        done = self.run_it()
        self.assertIn("0 items made, 200 were there", done.stdout)

    def test_damaged_files_are_made_again(self):
        whole = self.reference()
        self.run_it()
        (self.out / "chips.zarr/video/2.0.0").unlink()
        with open(self.out / "chips.zarr/object/5.0.0", "r+b") as file:
            file.truncate(10)
        (self.out / "parts/0000/0000007.jsonl").unlink()
        part = self.out / "parts/0000/0000009.jsonl"
        part.write_bytes(part.read_bytes()[:-40])
        part = self.out / "parts/0000/0000011.jsonl"
        part.write_bytes(part.read_bytes().replace(b'"item":90', b'"item":80'))
        (self.out / "boxes/0000/0000013.npy").write_bytes(b"")
        done = self.run_it()
        self.assertIn("48 items made", done.stdout)
        self.assertIn("block 2 is made again: chips.zarr/video/2.0.0 is absent", done.stderr)
        self.assertEqual(tree(self.out), whole)

    def test_verify_finds_changed_bytes(self):
        whole = self.reference()
        self.run_it()
        path = self.out / "chips.zarr/video/3.0.0"
        data = bytearray(path.read_bytes())
        data[-3] ^= 1
        path.write_bytes(data)
        self.assertIn("0 items made", self.run_it().stdout)
        done = self.run_it("--verify")
        self.assertIn("8 items made", done.stdout)
        self.assertIn("another content", done.stderr)
        self.assertEqual(tree(self.out), whole)

    def test_another_specification_is_refused(self):
        self.run_it()
        before = tree(self.out)
        for changes in ({"count": 201}, {"block": 9}, {"output": ", compression: zstd"}):
            done = self.run_it(plan=self.write_spec("other.yaml", **changes), code=1)
            self.assertIn("another specification", done.stderr)
        (self.folder / "town.flt").write_bytes(b"another scene")
        self.assertIn("fingerprint", self.run_it(code=1).stderr)
        self.assertEqual(tree(self.out), before)

    def test_comments_may_change(self):
        self.run_it()
        self.plan.write_text("# a comment\n" + self.plan.read_text())
        self.run_it()

    def test_a_folder_with_other_files_is_refused(self):
        self.out.mkdir()
        (self.out / "thesis.tex").write_text("x")
        self.assertIn("other files", self.run_it(code=1).stderr)
        self.assertEqual(list(tree(self.out)), ["thesis.tex"])

    def test_leftovers_of_dead_writers_go(self):
        self.run_it()
        from yars.dataset import files
        (self.out / f".writing-{files._HOST}-999999999-x").write_text("x")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_merge_alone(self):
        self.run_it("--shard", "0/2")
        done = self.run_it("--merge", code=1)
        self.assertIn("run the other shards first", done.stderr)
        self.run_it("--shard", "1/2")
        (self.out / "manifest.jsonl").unlink()
        self.run_it("--merge")
        self.assertEqual(tree(self.out), self.reference())


class Ends(Case):
    """The maker takes 50 ms a block, so that signals find it at work."""
    count, block = 400, 4
    slow = {"FAKE_MAKER_S": "0.05"}

    def begun(self, *arguments, **options):
        process = self.start("--workers", 2, *arguments, environment=self.slow, **options)
        self.addCleanup(process.kill)
        self.assertTrue(wait_for(lambda: self.blocks_there() > 3))
        return process

    def check_end(self, process, code):
        below = descendants(process.pid)
        self.assertGreaterEqual(len(below), 3)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, code, errors)
        self.assertTrue(wait_for(lambda: not any(map(alive, below)), 5.0), "a child is left")
        self.assertLess(self.blocks_there(), 100)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())
        return errors

    def test_interrupt_and_terminate(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(number):
                process = self.begun()
                below = descendants(process.pid)
                process.send_signal(number)
                _, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, code, errors)
                self.assertIn("run the same command again", errors)
                self.assertNotIn("Traceback", errors)
                self.assertTrue(wait_for(lambda: not any(map(alive, below)), 5.0), "a child is left")
                self.assertLess(self.blocks_there(), 100)
                self.run_it()
                self.assertEqual(tree(self.out), self.reference())
                shutil.rmtree(self.out)

    def test_kill_of_the_coordinator_leaves_no_child(self):
        process = self.begun()
        below = descendants(process.pid)
        self.assertGreaterEqual(len(below), 3)
        process.kill()
        process.communicate()
        self.assertTrue(wait_for(lambda: not any(map(alive, below)), 5.0), "a child is left")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_killed_workers_and_host_are_replaced(self):
        process = self.begun()
        for _ in range(6):
            below = sorted(descendants(process.pid))
            if below:
                os.kill(below[-1], signal.SIGKILL)
            time.sleep(0.2)
        if process.poll() is None:
            below = sorted(descendants(process.pid))
            os.kill(below[0], signal.SIGKILL)  # the host process
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(tree(self.out), self.reference())

    def test_a_block_that_kills_its_workers_is_an_error(self):
        done = self.run_it("--workers", 2, environment={"FAKE_MAKER_DEADLY_MAP": "30"}, code=1)
        self.assertIn("block 7: expected its files, found its worker ended by signal 9", done.stderr)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())


class FullDisk(Case):
    def one_error(self, done, *words):
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_no_space(self):
        done = self.run_it("--workers", 2, environment={"FAKE_MAKER_FULL": "20"}, code=1)
        self.one_error(done, "No space left on device", "run the same command again")
        self.assertFalse([name for name in tree(self.out) if ".writing" in name])
        there = self.blocks_there()
        self.assertGreater(there, 1)
        done = self.run_it()
        self.assertIn(f"{8 * there} were there", done.stdout)
        self.assertEqual(tree(self.out), self.reference())

    def test_limit_of_a_file_s_size(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1500, 1500))
        self.one_error(self.run_it(preexec_fn=limit, code=1), "File too large", "ulimit -f")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_a_small_file_system(self):
        small = self.folder / "small"
        small.mkdir()
        if os.geteuid() or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "none", str(small)], capture_output=True, check=False).returncode:
            self.skipTest("needs the right to mount")
        self.addCleanup(subprocess.run, ["umount", "-l", str(small)], check=False)
        self.one_error(self.run_it(out=small / "out", code=1), "No space left on device")
        there = len(list((small / "out").glob("parts/*/*.jsonl")))
        self.assertGreater(there, 0)
        subprocess.run(["mount", "-o", "remount,size=20m", str(small)], check=True)
        self.run_it(out=small / "out")
        self.assertEqual(tree(small / "out"), self.reference())

    def test_no_permission(self):
        if os.geteuid() == 0:
            self.out.mkdir()
            target = self.out / "x" if subprocess.run(["chattr", "+i", str(self.out)], capture_output=True, check=False).returncode == 0 else None
            if target is None:
                self.skipTest("root may write everywhere")
            self.addCleanup(subprocess.run, ["chattr", "-i", str(self.out)], check=False)
        else:
            self.out.mkdir(mode=0o500)
        self.one_error(self.run_it(code=1), "expected")


class Arguments(Case):
    def test_wrong_ones(self):
        for arguments, word in ((("--workers", "0"), "1 to 4096"), (("--shard", "7/7"), "0 to N - 1"), (("--shard", "x"), "i/N")):
            self.assertIn(word, self.run_it(*arguments, code=2).stderr)

    def test_no_specification(self):
        done = self.run_it(plan=self.folder / "none.yaml", code=1)
        self.assertIn("none.yaml: expected a specification, found none", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_absent_scene(self):
        (self.folder / "town.flt").unlink()
        self.assertIn("specification.yaml:4: expected an OpenFlight file, found none", self.run_it(code=1).stderr)

    def test_unknown_class(self):
        text = self.plan.read_text().replace("objects: house", "objects: hause")
        self.plan.write_text(text)
        self.assertIn("specification.yaml:7: expected a class of the scenes' objects (car, house)", self.run_it(code=1).stderr)

    def test_check(self):
        self.assertIn("good; 200 items in 25 blocks", self.run_it("--check").stdout)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
