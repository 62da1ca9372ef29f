"""annotations.json in the form of COCO (https://cocodataset.org/#format-data): images, categories, and for each box the
axis-aligned box, the oriented one as segmentation, its area, and `aspect_deg`, `object`, `pixels` beside them."""
import json

import numpy as np

from . import files
from .blocks import dump


def annotations(store):
    """Parts of the file, as bytes. Categories count from 1; ids of images are items, ids of annotations count from 1."""
    plan = store.plan
    classes = json.loads(files.read(store.path("objects.json")))["classes"]
    categories = [{"id": number + 1, "name": name} for number, name in enumerate(classes)]
    info = {"description": "radar chips of YARS", "version": store.mark}
    yield f'{{"info":{dump(info)},"licenses":[],"categories":{dump(categories)},\n"images":[\n'.encode()
    for block in range(plan.blocks):
        first, last = store.items(block)
        images = [dump({"id": item, "width": plan.size, "height": plan.size, "file_name": picture(store, item)})
                  for item in range(first, last)]
        yield (("" if block == 0 else ",\n") + ",\n".join(images)).encode()
    yield b'\n],\n"annotations":[\n'
    number = 1
    for block in range(plan.blocks):
        boxes = boxes_of(store, block)
        if not len(boxes):
            continue
        lines = _lines(boxes, number)
        yield (("" if number == 1 else ",\n") + ",\n".join(lines)).encode()
        number += len(lines)
    yield b"\n]}\n"


def picture(store, item):
    """Picture of an item, relative to the folder."""
    return store.item_name("png", item, ".png") if store.plan.png else store.item_name("geotiff", item, ".video.tif")


def boxes_of(store, block):
    """Boxes of a block as BOX."""
    if store.plan.format == "zarr":
        return np.load(store.path(store.boxes_name(block)))
    return np.concatenate([np.load(store.path(store.item_name("items", item, ".npz")))["boxes"] for item in range(*store.items(block))])


def _lines(boxes, number):
    corners = boxes["corners"].astype(float)
    low, high = corners.min(axis=1), corners.max(axis=1)
    x, y = corners[:, :, 0], corners[:, :, 1]
    area = 0.5 * np.abs(np.sum(x * np.roll(y, -1, 1) - np.roll(x, -1, 1) * y, axis=1))
    rows = zip(boxes["item"].tolist(), boxes["class"].tolist(), np.round(np.hstack([low, high - low]), 3).tolist(),
               np.round(corners.reshape(-1, 8), 3).tolist(), np.round(area, 3).tolist(), np.round(boxes["aspect_deg"].astype(float), 3).tolist(),
               boxes["object"].tolist(), boxes["pixels"].tolist())
    return [dump({"id": number + at, "image_id": item, "category_id": label + 1, "bbox": box, "segmentation": [outline], "area": size,
                  "iscrowd": 0, "aspect_deg": aspect, "object": thing, "pixels": pixels})
            for at, (item, label, box, outline, size, aspect, thing, pixels) in enumerate(rows)]
