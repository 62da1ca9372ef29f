#!/usr/bin/env python3
"""What a data set holds, read by yars.dataset.Dataset, Zarr, xarray, NumPy, COCO readers and rasterio.
usage: dataset_reader_test.py BIN [unittest options]   (BIN: folder of `yars`)"""
import json
import multiprocessing
import pathlib
import pickle
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE))
from dataset_run_test import Case, tree  # noqa: E402  takes BIN from the arguments
import numpy as np  # noqa: E402

from yars.dataset import Dataset, DatasetError, blocks  # noqa: E402


class Formats(Case):
    count, block = 21, 8

    def test_zarr_is_read_by_zarr(self):
        import zarr
        self.have_whole()
        group, data = zarr.open_consolidated(str(self.out / "chips.zarr")), Dataset(self.out)
        self.assertEqual(group["video"].shape, (21, 16, 16))
        for item in (0, 20):
            self.assertEqual(group["object"][item].tolist(), data[item]["object"].tolist())
        self.assertEqual(group["shadow"].attrs["_ARRAY_DIMENSIONS"], ["item", "row", "column"])
        about = json.loads((self.out / "chips.zarr/video/.zarray").read_text())["compressor"]
        self.assertEqual(set(about), {"id", "cname", "clevel", "shuffle", "blocksize"})  # with numcodecs of any version

    def test_xarray_keeps_types_and_zeros(self):
        try:
            import xarray
        except ImportError:
            self.skipTest("xarray is not installed")
        self.have_whole()
        data = Dataset(self.out)
        with xarray.open_zarr(self.out / "chips.zarr") as opened:
            for name in data.arrays:
                stored = np.stack([item[name] for item in map(data.__getitem__, range(len(data)))])
                self.assertEqual(opened[name].dtype, stored.dtype)
                self.assertEqual(opened[name].values.tolist(), stored.tolist())
                self.assertIn(0, stored)

    def test_npz_is_read_by_numpy(self):
        self.have_whole()
        for compression in ("none", "lz4"):
            out = self.folder / compression
            self.run_it(out=out, plan=self.write_spec("npz.yaml", output=f", format: npz, compression: {compression}"))
            for item in (0, 20):
                with np.load(out / f"items/000000/{item:09d}.npz") as archive:
                    self.assertEqual(archive["video"].tolist(), Dataset(self.out)[item]["video"].tolist())
                    self.assertEqual(archive["boxes"].tobytes(), Dataset(self.out)[item]["boxes"].tobytes())
                self.assertEqual(Dataset(out)[item]["object"].tolist(), Dataset(self.out)[item]["object"].tolist())

    def test_manifest_boxes_and_classes(self):
        self.have_whole()
        lines = [json.loads(line) for line in (self.out / "manifest.jsonl").read_text().splitlines()]
        self.assertEqual([line["item"] for line in lines], list(range(21)))
        data = Dataset(self.out)
        self.assertEqual(data.classes, ["car", "house"])
        self.assertEqual(data.objects[7]["name"], "house7")
        boxes = data[5]["boxes"]
        # As the radar gives them; the one without pixels is left out.
        self.assertEqual(boxes["object"].tolist(), [7, 2])
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
        self.assertEqual((first["id"], first["image_id"], first["category_id"], first["bbox"], first["area"]),
                         (1, 0, 2, [1, 1, 4, 2], 4))
        line = json.loads((self.out / "manifest.jsonl").read_text().splitlines()[0])
        self.assertEqual(len(line["box_list"]), 2)
        try:
            import rasterio
        except ImportError:
            self.skipTest("rasterio is not installed")
        with rasterio.open(self.out / coco["images"][3]["file_name"]) as picture:
            self.assertEqual(picture.read(1).tolist(), Dataset(self.out)[3]["video"].tolist())

    def test_coco_is_cut_off_at_the_picture(self):
        from yars.dataset import formats
        self.assertEqual(formats.cut_off([[1.0, 1.0], [3.0, 1.0], [3.0, 2.0]], 16),
                         [[1.0, 1.0], [3.0, 1.0], [3.0, 2.0]])
        self.assertEqual(formats.cut_off([[-1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [-1.0, 2.0]], 16),
                         [[0.0, 1.0], [3.0, 1.0], [3.0, 2.0], [0.0, 2.0]])
        self.assertEqual(len(formats.cut_off([[8.0, -6.0], [22.0, 8.0], [8.0, 22.0], [-6.0, 8.0]], 16)), 8)
        self.assertEqual(formats.cut_off([[17.0, 1.0], [20.0, 1.0], [20.0, 2.0]], 16), [])
        boxes = np.zeros(3, blocks.BOX)
        boxes["corners"] = [[[-4, 2], [4, 2], [4, 6], [-4, 6]], [[20, 2], [24, 2], [24, 6], [20, 6]],
                            [[2, 2], [4, 2], [4, 6], [2, 6]]]
        boxes["pixels"], boxes["item"] = [7, 5, 0], [0, 0, 1]
        lines = [json.loads(line) for line in formats._coco_lines(boxes, 16, 3)]
        self.assertEqual([(line["id"], line["image_id"], line["bbox"], line["area"]) for line in lines],
                         [(3, 0, [0, 2, 4, 4], 7), (4, 1, [2, 2, 2, 4], 0)])
        self.assertEqual(sorted(lines[0]["segmentation"][0]), [0, 0, 2, 2, 4, 4, 6, 6])

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


def collate(items):
    """Pictures as one array each; boxes and parameters, whose number differs, as lists. As docs/datasets.md has it."""
    return {name: [item[name] for item in items] if name in ("boxes", "parameters")
            else np.stack([item[name] for item in items])
            for name in items[0]}


def load_batches(pickled, batches, answers):
    """A worker of a loader that starts processes anew."""
    data = pickle.loads(pickled)
    for batch in batches:
        answers.put(collate([data[item] for item in batch]))


class Reading(Case):
    count, block = 21, 8

    def setUp(self):
        super().setUp()
        self.have_whole()
        self.data = Dataset(self.out)

    def test_mixed_order_gives_what_the_order_gives(self):
        items = [self.data[item] for item in range(21)]
        for compression in ("none", "zstd", "lz4"):
            out = self.folder / compression
            self.run_it(out=out, plan=self.write_spec(f"{compression}.yaml", output=f", compression: {compression}"))
            data = Dataset(out)
            for item in (20, 3, 9, 4, 8, 0, 20, 19, 1):
                for name in ("video", "object", "shadow", "boxes"):
                    self.assertEqual(data[item][name].tobytes(), items[item][name].tobytes())
                self.assertEqual(data[item]["parameters"], items[item]["parameters"])

    def test_arrays_may_be_written_to(self):
        for item in (5, 6, 7):
            chip = self.data[item]
            before = {name: chip[name].tobytes() for name in ("video", "boxes")}
            chip["video"][:] = 0
            chip["boxes"]["pixels"] = -1
            self.assertEqual({name: self.data[item][name].tobytes() for name in before}, before)

    def test_movers_are_a_list(self):
        numbers = [len(self.data[item]["parameters"]["movers"]) for item in range(21)]
        self.assertEqual({0, 1, 2, 3}, set(numbers))

    def test_the_scene_of_a_target_is_named(self):
        self.assertEqual({self.data[item]["parameters"]["target_scene"] for item in range(21)}, {-1})
        text = self.plan.read_text().replace("  - {objects: house}", "  - {scenes: all}")
        self.plan.write_text(text)
        self.run_it(out=self.folder / "scenes")
        parameters = [line["parameters"] for line in map(Dataset(self.folder / "scenes").__getitem__, range(21))]
        self.assertEqual([line["target_scene"] for line in parameters],
                         [-1 if line["target"] == 0 else 0 for line in parameters])

    def test_label_bounds(self):
        chip = self.data[4]
        bounds = self.data.label_bounds(4)
        self.assertEqual(bounds.shape, (len(chip["boxes"]), 4))
        for thing, (left, top, right, bottom) in zip(chip["boxes"]["object"], bounds):
            rows, columns = np.nonzero(chip["object"] == thing)
            self.assertEqual((left, top, right, bottom), (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1))
        chip["object"][chip["object"] == 7] = -1
        self.assertEqual(self.data.label_bounds(chip)[0].tolist(), [0, 0, 0, 0])
        chip["boxes"] = chip["boxes"][:0]
        self.assertEqual(self.data.label_bounds(chip).shape, (0, 4))

    def test_a_loader_with_processes(self):
        whole = len(pickle.dumps(self.data))
        self.data[3], self.data[4]
        pickled = pickle.dumps(self.data)
        self.assertEqual(len(pickled), whole)  # without what was read
        context = multiprocessing.get_context("spawn")
        answers, batches = context.Queue(), [[5, 17, 2], [11, 0, 20]]
        worker = context.Process(target=load_batches, args=(pickled, batches, answers))
        worker.start()
        for batch in batches:
            answer = answers.get(timeout=60)
            self.assertEqual(answer["video"].shape, (3, 16, 16))
            self.assertEqual(answer["video"].tobytes(), b"".join(self.data[item]["video"].tobytes() for item in batch))
            self.assertEqual([line["item"] for line in answer["parameters"]], batch)
        worker.join()

    def test_indices(self):
        self.assertEqual(self.data[np.int64(-21)]["parameters"]["item"], 0)
        for index in (1.0, "1", None, slice(0, 3), [1, 2], True, np.arange(3)):
            with self.assertRaisesRegex(TypeError, "expected the number of an item, found"):
                self.data[index]
        for index in (21, -22):
            with self.assertRaisesRegex(IndexError, "expected an item from -21 to 20"):
                self.data[index]
        with self.assertRaisesRegex(DatasetError, "one of the arrays video, object, shadow, found 'power'"):
            self.data.chunk("power", 0)
        for block in (3, -1):
            with self.assertRaisesRegex(IndexError, "a block from 0 to 2"):
                self.data.chunk("video", block)
        with self.assertRaises(TypeError):
            self.data.chunk("video", 1.5)
        self.assertEqual(len(self.data.chunk("video", 2)), 5)  # items of the last block
        import yars.dataset
        self.assertIn("Dataset", dir(yars.dataset))

    def test_npz_has_no_chunks(self):
        out = self.folder / "npz"
        self.run_it(out=out, plan=self.write_spec("npz.yaml", output=", format: npz"))
        with self.assertRaisesRegex(DatasetError, "format: zarr for chunks, found npz"):
            Dataset(out).chunk("video", 0)

    def test_chunks_that_were_cut_off_are_an_error(self):
        for compression in ("none", "zstd"):
            out = self.folder / compression
            self.run_it(out=out, plan=self.write_spec(f"{compression}.yaml", output=f", compression: {compression}"))
            path = out / "chips.zarr/video/1.0.0"
            path.write_bytes(path.read_bytes()[:-7])
            for read in (lambda data: data[9], lambda data: data.chunk("video", 1)):
                with self.assertRaisesRegex(DatasetError, "found a damaged one"):
                    read(Dataset(out))

    def test_damaged_files_are_one_error(self):
        for name in ("dataset.json", "objects.json"):
            path = self.out / name
            data = path.read_bytes()
            for content, word in ((None, f"found no {name}"), (b"{", "damaged"), (b"[]", "damaged"),
                                  (b"\xff", "damaged")):
                path.unlink() if content is None else path.write_bytes(content)
                with self.assertRaisesRegex(DatasetError, word):
                    Dataset(self.out)
                path.write_bytes(data)
        for name, item in (("chips.zarr/video/0.0.0", 1), ("boxes/0000/0000001.npy", 9),
                           ("parts/0000/0000002.jsonl", 17)):
            path = self.out / name
            whole = path.read_bytes()
            for content in (None, b"", b"x" * 30, whole[:len(whole) // 2], whole[:20]):
                path.unlink(missing_ok=True) if content is None else path.write_bytes(content)
                with self.assertRaisesRegex(DatasetError, "run `yars dataset"):
                    Dataset(self.out)[item]
        with self.assertRaisesRegex(DatasetError, "expected a data set, found"):
            Dataset(self.plan)


if __name__ == "__main__":
    unittest.main()
