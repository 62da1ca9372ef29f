"""Reads a data set: `Dataset(DIR)[k]` is a dict of arrays, boxes and parameters of item k.

It has the two methods of a map-style data set of PyTorch, __len__ and __getitem__, and may be given to its DataLoader.
Files are opened at each use, so that an object may be shared by forked processes;
sent to another process it goes without what it has read."""
import bisect
import collections
import json
import mmap
import operator
import pathlib

import numpy as np

from . import DatasetError, files
from .blocks import BOX
from .store import Store

_KEPT_CHUNKS = 4  # of each array


class Dataset:
    """`arrays`: names; `classes`: names by class number; `objects`: list of dicts by object number."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        about = self._table("dataset.json", "a data set", ("count", "block", "size", "arrays", "files"))
        self.count, self.block, self.size, self.arrays = (about[name] for name in ("count", "block", "size", "arrays"))
        self._npz = about["files"] == "npz"
        table = self._table("objects.json", "the data set's objects", ("classes", "objects"))
        self.classes, self.objects = table["classes"], table["objects"]
        self._kept, self._kinds, self._touched = collections.OrderedDict(), {}, None

    def _table(self, name, what, keys):
        """Object of a JSON file with keys."""
        path = self.folder / name
        try:
            data = files.read(path)
        except DatasetError as error:
            raise DatasetError(f"{path}: expected {what}, "
                               f"found: {str(error).partition('found: ')[2] or error}") from None
        if data is None:
            action = "check the path" if name == "dataset.json" else "run `yars dataset` again: it makes the file"
            raise DatasetError(f"{self.folder}: expected {what}, found no {name}; {action}")
        try:
            table = json.loads(data)
            if all(key in table for key in keys):
                return table
        except (ValueError, TypeError):
            pass
        raise DatasetError(f"{path}: expected {what} as JSON, found a damaged file; run `yars dataset` again: "
                           "it makes the file")

    def __getstate__(self):
        return {**vars(self), "_kept": collections.OrderedDict(), "_kinds": {}, "_touched": None}

    def __len__(self):
        return self.count

    def _number(self, item):
        """Item as an int from 0; negative ones count from the end."""
        if isinstance(item, (bool, np.bool_)):
            item = None
        try:
            number = operator.index(item)
        except TypeError:
            raise TypeError(f"Dataset: expected the number of an item, found {type(item).__name__}; "
                            "write a whole number, or [data[k] for k in range(0, 10)] for several") from None
        if not -self.count <= number < self.count:
            raise IndexError(f"expected an item from {-self.count} to {self.count - 1}, found {number}")
        return number % self.count

    def __getitem__(self, item):
        """{array name: (rows, columns), "boxes": structured array, "parameters": line of the manifest}. Arrays are
        copies, which may be written to. `boxes` is there if `object` is among the arrays."""
        item = self._number(item)
        block, at = divmod(item, self.block)
        if self._npz:
            result = self._archive(item)
        else:
            result = {name: self._chip(name, block, at) for name in self.arrays}
            if "object" in self.arrays:
                result["boxes"] = self._boxes(block, item)
            self._touched = block
        result["parameters"] = json.loads(self._lines(block)[at])
        return result

    def _boxes(self, block, item):
        """Boxes of an item. The file is an .npy of BOX, sorted by item: few of its pages are read."""
        def read():
            path = self.folder / Store.boxes_name(block)
            data = self._mapped(path, block)
            begin = 10 + int.from_bytes(data[8:10], "little")
            try:
                boxes = np.empty(0, BOX) if len(data) == begin else np.frombuffer(data, BOX, offset=begin)
            except ValueError as error:
                raise self._damaged(path, error) from None
            return boxes, boxes["item"]
        boxes, items = self._keep(("boxes", block), read)
        first = bisect.bisect_left(items, item)
        return boxes[first:bisect.bisect_left(items, item + 1, first)].copy()

    def label_bounds(self, item):
        """Bounds of the pixels that bear each box's object as label: (boxes, 4) of left, top, right, bottom in pixels
        from the upper left corner, right and bottom behind the last pixel. Zeros: no pixel does."""
        chip = item if isinstance(item, dict) else self[item]
        if "boxes" not in chip:
            raise DatasetError(f"{self.folder}: expected the array object, found {', '.join(self.arrays)}; "
                               "add object to chip.arrays")
        numbers = chip["boxes"]["object"]
        order = np.argsort(numbers)
        rows, columns = np.nonzero(chip["object"] >= 0)
        labels = chip["object"][rows, columns]
        place = np.minimum(np.searchsorted(numbers, labels, sorter=order), max(len(numbers) - 1, 0))
        known = numbers[order[place]] == labels if len(numbers) else np.zeros(len(labels), bool)
        at, rows, columns = order[place[known]] if len(numbers) else place[known], rows[known], columns[known]
        bounds = np.tile(np.array([self.size, self.size, 0, 0]), (len(numbers), 1))
        for column, function, values in ((0, np.minimum, columns), (1, np.minimum, rows), (2, np.maximum, columns + 1),
                                         (3, np.maximum, rows + 1)):
            function.at(bounds[:, column], at, values)
        bounds[bounds[:, 2] == 0] = 0
        return bounds

    def chunk(self, name, block):
        """Array (items, rows, columns) of a block; for reading only."""
        self._check_chunk(name, block)
        return self._keep((name, block), lambda: self._decode(name, block))

    def _check_chunk(self, name, block):
        if self._npz:
            raise DatasetError(f"{self.folder}: expected a data set with format: zarr for chunks, found npz; "
                               "read its items one by one")
        if name not in self.arrays:
            raise DatasetError(f"{self.folder}: expected one of the arrays {', '.join(self.arrays)}, found {name!r}; "
                               "name another, or add it to chip.arrays of the specification")
        blocks = -(-self.count // self.block)
        if isinstance(block, bool) or not isinstance(block, (int, np.integer)):
            raise TypeError(f"Dataset.chunk: expected the number of a block, found {type(block).__name__}; "
                            "write a whole number from 0")
        if not 0 <= block < blocks:
            raise IndexError(f"expected a block from 0 to {blocks - 1}, found {block}")

    def _kind(self, name):
        """(type, decoder or None) of an array's chunks."""
        if name not in self._kinds:
            about = self._table(f"chips.zarr/{name}/.zarray", f"the array {name}", ("dtype", "compressor"))
            decoder = None
            if about["compressor"]:
                import numcodecs
                decoder = numcodecs.get_codec(about["compressor"])
            self._kinds[name] = np.dtype(about["dtype"]), decoder
        return self._kinds[name]

    def _chip(self, name, block, at):
        """(rows, columns) of an item. Of a block that is touched for the first time only this item is decoded, where
        numcodecs can: from version 0.16 on it decodes whole chunks only."""
        decoder = self._kind(name)[1]
        decodes_items = decoder is None or hasattr(decoder, "decode_partial")
        if not decodes_items or (name, block) in self._kept or self._touched == block:
            return self._keep((name, block), lambda: self._decode(name, block))[at].copy()
        return self._decode(name, block, at)

    def _decode(self, name, block, at=None):
        kind, decoder = self._kind(name)
        path = self.folder / f"chips.zarr/{name}/{block}.0.0"
        pixels = self.size * self.size
        count = min(self.block, self.count - block * self.block)
        try:
            data = self._mapped(path, block)
            whole = self.block * pixels * kind.itemsize
            # The header of Blosc has both sizes; it would read beyond the end of a file that was cut off.
            sizes = ((int.from_bytes(data[4:8], "little"), int.from_bytes(data[12:16], "little")) if decoder
                     else (len(data), len(data)))
            if sizes != (whole, len(data)):
                raise self._damaged(path, "its size differs from what it says")
            if at is None:
                data = decoder.decode(data) if decoder else data
                return np.frombuffer(data, kind, count * pixels).reshape(count, self.size, self.size)
            if decoder:
                data, at = decoder.decode_partial(data, at * pixels, pixels), 0
            return np.frombuffer(data, kind, pixels, at * pixels * kind.itemsize).reshape(self.size, self.size).copy()
        except DatasetError:
            raise
        except (RuntimeError, ValueError) as error:
            raise self._damaged(path, error) from None

    @staticmethod
    def _mapped(path, block):
        """Content of a file, of which only what is used is read."""
        try:
            with open(path, "rb") as file:
                return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        except FileNotFoundError:
            raise DatasetError(f"{path}: expected block {block}, found none; run `yars dataset` again: "
                               "it completes the data set") from None
        except ValueError:
            raise DatasetError(f"{path}: expected block {block}, found an empty file; run `yars dataset` again: "
                               "it makes it again") from None
        except OSError as error:
            raise files.failure(path, error, "to read") from None

    def _archive(self, item):
        """Arrays of an .npz file."""
        path = self.folder / Store.item_name("items", item, ".npz")
        try:
            with np.load(path) as archive:
                return {name: archive[name] for name in [*self.arrays, "boxes"] if name in archive}
        except FileNotFoundError:
            raise DatasetError(f"{path}: expected item {item}, found none; run `yars dataset` again: "
                               "it completes the data set") from None
        except Exception as error:  # pylint: disable=broad-except  zipfile and NumPy have many
            raise self._damaged(path, error) from None

    @staticmethod
    def _damaged(path, error):
        return DatasetError(f"{path}: expected a file of the data set, found a damaged one ({error}); "
                            "run `yars dataset --verify`: it makes it again")

    def _lines(self, block):
        """Lines of the items of a block."""
        def read():
            path = self.folder / Store.part_name(block)
            lines = bytes(self._mapped(path, block)).split(b"\n")[1:-1]
            if len(lines) != min(self.block, self.count - block * self.block):
                raise self._damaged(path, f"{len(lines)} lines")
            return lines
        return self._keep(("lines", block), read)

    def _keep(self, key, read):
        if key not in self._kept:
            self._kept[key] = read()
            while len(self._kept) > _KEPT_CHUNKS * (len(self.arrays) + 2):
                self._kept.popitem(last=False)
        self._kept.move_to_end(key)
        return self._kept[key]
