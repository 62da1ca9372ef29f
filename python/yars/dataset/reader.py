"""Reads a data set: `Dataset(DIR)[k]` is a dict of arrays, boxes and parameters of item k.

It has the two methods of a map-style data set of PyTorch, __len__ and __getitem__, and may be given to its DataLoader. Files are opened
at each use, so that an object may be shared by forked processes."""
import collections
import json
import pathlib

import numpy as np

from . import DatasetError, files
from .store import Store

_KEPT_CHUNKS = 4  # of each array


class Dataset:
    """`arrays`: names; `classes`: names by class number; `objects`: list of dicts by object number."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        about = files.read(self.folder / "dataset.json")
        if about is None:
            raise DatasetError(f"{folder}: expected a data set, found no dataset.json; check the path")
        about = json.loads(about)
        self.count, self.block, self.size, self.arrays = (about[name] for name in ("count", "block", "size", "arrays"))
        self._npz = about["files"] == "npz"
        table = json.loads(files.read(self.folder / "objects.json") or b'{"classes":[],"objects":[]}')
        self.classes, self.objects = table["classes"], table["objects"]
        self._kept = collections.OrderedDict()

    def __len__(self):
        return self.count

    def __getitem__(self, item):
        """{array name: (rows, columns), "boxes": structured array, "parameters": line of the manifest}."""
        if not -self.count <= item < self.count:
            raise IndexError(f"expected an item from 0 to {self.count - 1}, found {item}")
        item = int(item) % self.count
        block, at = divmod(item, self.block)
        if self._npz:
            with np.load(self.folder / Store.item_name("items", item, ".npz")) as archive:
                result = {name: archive[name] for name in [*self.arrays, "boxes"] if name in archive}
        else:
            result = {name: self.chunk(name, block)[at] for name in self.arrays}
            if "object" in self.arrays:
                boxes = self._keep(("boxes", block), lambda: np.load(self.folder / Store.boxes_name(block)))
                result["boxes"] = boxes[slice(*np.searchsorted(boxes["item"], (item, item + 1)))]
        result["parameters"] = json.loads(self._lines(block)[at])
        return result

    def chunk(self, name, block):
        """Array (items, rows, columns) of a block."""
        def read():
            data = files.read(self.folder / f"chips.zarr/{name}/{block}.0.0")
            if data is None:
                raise DatasetError(f"{self.folder}: expected block {block} of {name}, found none; complete the data set")
            about = json.loads(files.read(self.folder / f"chips.zarr/{name}/.zarray"))
            if about["compressor"]:
                import numcodecs
                data = numcodecs.get_codec(about["compressor"]).decode(data)
            return np.frombuffer(data, about["dtype"]).reshape(-1, self.size, self.size)
        return self._keep((name, block), read)

    def _lines(self, block):
        def read():
            data = files.read(self.folder / Store.part_name(block))
            if data is None:
                raise DatasetError(f"{self.folder}: expected block {block}, found none; complete the data set")
            return data.split(b"\n")[1:-1]
        return self._keep(("lines", block), read)

    def _keep(self, key, read):
        if key not in self._kept:
            self._kept[key] = read()
            while len(self._kept) > _KEPT_CHUNKS * (len(self.arrays) + 2):
                self._kept.popitem(last=False)
        self._kept.move_to_end(key)
        return self._kept[key]
