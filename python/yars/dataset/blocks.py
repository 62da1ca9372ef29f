"""Makes one block: draws its items, has the radar make their arrays, writes arrays, boxes and the block's part.

All work is done by array operations over the block. The part is written last, so a block with a part is whole."""
import re

import numpy as np

from . import DatasetError, files, formats
from .formats import dump
from .sampling import Sample

BOX = np.dtype([("item", "<i8"), ("object", "<i4"), ("class", "<i4"), ("pixels", "<i4"), ("aspect_deg", "<f4"),
                ("corners", "<f4", (4, 2))])
# Boxes as the radar makes them: `order` where BOX has `item`, and room for `class`.
# So they are completed and stored where they are.
_OF_RADAR = ("item", "object", "pixels", "aspect_deg", "corners")
RADAR_BOX = np.dtype({"names": ["order", *_OF_RADAR[1:]], "formats": [BOX[name] for name in _OF_RADAR],
                      "offsets": [BOX.fields[name][1] for name in _OF_RADAR], "itemsize": BOX.itemsize})


def slice_sample(sample, first, last):
    """Items [first, last) of a sample."""
    low, high = np.searchsorted(sample.movers["order"], (first, last))
    movers = sample.movers[low:high].copy()
    movers["order"] -= first
    return Sample(sample.items[first:last], sample.orders[first:last], movers, sample.entry[first:last],
                  sample.scene[first:last], sample.object[first:last], sample.attempt[first:last])


# A row of a structured array as JSON is made by one format: it takes half the time of json.dumps on a dict.
_NOT_FINITE = re.compile(r"(?<=[:,\[])-?(?:nan|inf)\b")


def _template(kind):
    """Format of a row of numbers: %r for each number of _flat."""
    parts = (f'"{name}":' + ("[" + ",".join(["%r"] * kind[name].shape[0]) + "]" if kind[name].shape else "%r")
             for name in kind.names)
    return "{" + ",".join(parts) + "}"


def _flat(rows):
    """Tuples of the numbers of a structured array of numbers and vectors."""
    kinds = [(f"{name}{at}", rows.dtype[name].base) for name in rows.dtype.names
             for at in range(rows.dtype[name].shape[0] if rows.dtype[name].shape else 1)]
    return rows.view(kinds).tolist()


class BlockMaker:
    """Makes blocks of a data set. `class_ids`: index of each object's class in `classes`; -1: ignored."""

    def __init__(self, plan, store, sampler, maker, class_ids):
        self.plan, self.store, self.sampler, self.maker = plan, store, sampler, maker
        self._class_ids = np.asarray(class_ids, np.int32)
        self._ignores = bool((self._class_ids < 0).any())
        self._types = formats.types(len(maker.objects))
        self._encoders = ({name: formats.codec(plan.compression, name) for name in plan.arrays} if plan.format == "zarr"
                          else {})
        self._drawn = sampler.settings.drawn()
        if plan.geotiff:
            import rasterio  # noqa: F401  loaded before the fork: shared by all workers

    def draw(self, blocks):
        """{block: Sample} of several blocks, drawn together."""
        ranges = [np.arange(*self.store.items(block)) for block in blocks]
        sample = self.sampler.draw(np.concatenate(ranges))
        edges = np.cumsum([0] + [len(items) for items in ranges])
        return {block: slice_sample(sample, edges[at], edges[at + 1]) for at, block in enumerate(blocks)}

    def make(self, block, sample=None):
        """Makes and writes a block. Returns (items, redraws). Raises DatasetError."""
        sample = sample or self.draw([block])[block]
        arrays, checks, geo, boxes = self.compute(sample)
        names = {}

        def put(name, *parts):
            files.write(self.store.path(name), *parts)
            names[name] = [sum(memoryview(part).nbytes for part in parts), f"{self.store.hash(*parts):016x}"]
        hashes = {}
        for name, array in arrays.items():
            hashes[name] = checks if name == "video" else self.store.hash_items(array)
            if self.plan.format == "zarr":
                put(f"chips.zarr/{name}/{block}.0.0", formats.zarr_chunk(array, self.plan.block, self._encoders[name]))
        if self.plan.format == "zarr" and boxes is not None:
            put(self.store.boxes_name(block), formats.npy_head(BOX, len(boxes)), boxes.view(np.uint8))
        edges = (np.searchsorted(boxes["item"], sample.items[0] + np.arange(len(sample.items) + 1)) if boxes is not None
                 else None)
        self._write_items(sample, arrays, geo, boxes, edges, put)
        lines = self._lines(sample, geo, hashes, boxes, edges)
        head = dump({"block": block, "dataset": self.store.mark, "files": names,
                     "lines": f"{self.store.hash(lines):016x}"})
        files.write(self.store.path(self.store.part_name(block)), head.encode() + b"\n", lines)
        return len(sample.items), int(sample.attempt.sum())

    def compute(self, sample):
        """(arrays, video hashes, geo, boxes) of a sample: one call of the radar for each run of equal settings."""
        runs = self.sampler.run_of(sample.items)
        edges = np.concatenate([[0], np.flatnonzero(np.diff(runs)) + 1, [len(runs)]])
        results, found = [], []
        for first, last in zip(edges[:-1], edges[1:]):
            part = slice_sample(sample, first, last)
            result = self.maker.patches(part.orders, part.movers, self.sampler.settings.text(int(runs[first])))
            results.append(result)
            if "object" in self.plan.arrays:
                found.append(self._boxes(result["boxes"], part.items))
        def joined(name):
            return results[0][name] if len(results) == 1 else np.concatenate([result[name] for result in results])
        shape = (len(runs), self.plan.size, self.plan.size)
        arrays = {}
        for name in self.plan.arrays:
            arrays[name] = np.ascontiguousarray(joined(name), self._types[name])
            if arrays[name].shape != shape:
                raise DatasetError(f"expected the array {name} with the shape {shape}, found {arrays[name].shape}; "
                                   "this is a fault of YARS")
        boxes = (found[0] if len(found) == 1 else np.concatenate(found)) if found else None
        return arrays, joined("hash").tolist(), joined("geo"), boxes

    def _boxes(self, rows, items):
        """Boxes of the radar as BOX, in their order, in the memory of `rows` if no class is ignored."""
        if rows.dtype != RADAR_BOX:
            raise DatasetError(f"expected boxes of the type {RADAR_BOX}, found {rows.dtype}; this is a fault of YARS")
        classes = self._class_ids[rows["object"]]
        boxes = rows.view(BOX)
        if self._ignores:
            wanted = classes >= 0
            # Whole rows are copied faster than structured ones.
            boxes, classes = rows.view(f"V{BOX.itemsize}")[wanted].view(BOX), classes[wanted]
        boxes["item"] = items[boxes["item"]]
        boxes["class"] = classes
        return boxes

    def _write_items(self, sample, arrays, geo, boxes, edges, put):
        """Files of single items: NPZ, PNG, GeoTIFF."""
        plan = self.plan
        if plan.format != "npz" and not plan.png and not plan.geotiff:
            return
        for at, item in enumerate(sample.items.tolist()):
            if plan.format == "npz":
                content = {name: array[at] for name, array in arrays.items()}
                content["geo"], content["order"] = geo[at:at + 1], sample.orders[at:at + 1]
                if boxes is not None:
                    content["boxes"] = boxes[edges[at]:edges[at + 1]]
                put(self.store.item_name("items", item, ".npz"), formats.npz(content, plan.compression != "none"))
            if plan.png:
                put(self.store.item_name("png", item, ".png"), formats.png(arrays["video"][at]))
            for name in plan.geotiff:
                put(self.store.item_name("geotiff", item, f".{name}.tif"), formats.geotiff(arrays[name][at], geo[at]))

    def _lines(self, sample, geo, hashes, boxes, edges):
        """One line of JSON for each item."""
        names = list(hashes)
        form = ('{"item":%r,"hash":{' + ",".join(f'"{name}":"%016x"' for name in names) + '},"order":' +
                _template(sample.orders.dtype) +
                ',"target":%r,"target_scene":%r,"target_object":%r,"redraws":%r,"geo":' + _template(geo.dtype) +
                ',"boxes":%r,"movers":')
        mover_names = sample.movers.dtype.names[1:]
        movers = [[] for _ in sample.items]
        for row in sample.movers.tolist():
            movers[row[0]].append(dict(zip(mover_names, row[1:])))
        runs = self.sampler.run_of(sample.items).tolist()
        settings = {run: self._settings(run) for run in set(runs)} if self._drawn else {}
        counts = np.diff(edges).tolist() if edges is not None else [0] * len(runs)
        lines = []
        for at, (item, checks, order, entry, scene, thing, redraws, place, count) in enumerate(zip(
                sample.items.tolist(), zip(*hashes.values()), _flat(sample.orders), sample.entry.tolist(),
                sample.scene.tolist(), sample.object.tolist(), sample.attempt.tolist(), _flat(geo), counts)):
            line = form % (item, *checks, *order, entry, scene, thing, redraws, *place, count)
            if "nan" in line or "inf" in line:
                line = _NOT_FINITE.sub("null", line)
            more = {}
            if settings:
                more["settings"] = settings[runs[at]]
            if self.plan.manifest_boxes and boxes is not None:
                more["box_list"] = [dict(zip(BOX.names[1:], _plain(box)[1:]))
                                    for box in boxes[edges[at]:edges[at + 1]].tolist()]
            lines.append(line + (dump(movers[at]) if movers[at] else "[]") + ("," + dump(more)[1:] if more else "}"))
        return ("\n".join(lines) + "\n").encode()

    def _settings(self, run):
        values = self.sampler.settings.values(run)
        rain = self.sampler.settings.rain(run)
        return {**values, "rain": rain} if self.plan.rain else values


def _plain(values):
    return [value.tolist() if isinstance(value, np.ndarray) else value for value in values]
