#!/usr/bin/env python3
"""What a data set holds, read by yars.dataset.Dataset, Zarr, xarray, NumPy, COCO readers and rasterio.
usage: dataset_reader_test.py BIN [unittest options]   (BIN: folder of `yars`)"""
import json
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE))
from dataset_run_test import Case, tree  # noqa: E402  takes BIN from the arguments
import numpy as np  # noqa: E402

from yars.dataset import Dataset  # noqa: E402


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
        self.assertEqual((first["id"], first["image_id"], first["category_id"], first["bbox"], first["area"]), (1, 0, 2, [1, 1, 4, 2], 4))
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


if __name__ == "__main__":
    unittest.main()
