"""Encodings of arrays, with the same bytes for the same values: Zarr chunks, NPZ, PNG, GeoTIFF, JSON,
and annotations for COCO readers."""
import io
import json

import numpy as np

from . import DatasetError

_ENCODE = json.JSONEncoder(separators=(",", ":"), allow_nan=False).encode
_TYPES = {"video": "|u1", "power": "<f4", "shadow": "|u1", "layover": "|u1", "object": "<i4", "material": "|u1",
         "height": "<f4", "grazing_angle": "<f4"}
# Blosc's: 1 by bytes for floats, 2 by bits for flags and codes.
_SHUFFLES = {"power": 1, "height": 1, "grazing_angle": 1, "shadow": 2, "layover": 2, "material": 2}
UNITS = {"video": "1", "power": "1", "shadow": "1", "layover": "1", "object": "1", "material": "1", "height": "m",
         "grazing_angle": "deg"}
_INT16_OBJECTS = 32767  # indices up to 32766 and -1
MEANINGS = {"video": "0 black to 255 white", "power": "gamma of level ground, before speckle and noise",
            "shadow": "1: no surface that the radar sees returns here",
            "layover": "1: two or more visible surfaces at this slant range",
            "object": "index into objects.json of the strongest surface; -1: ground or none",
            "material": "surface material code; 0: land without culture", "height": "above mean sea level",
            "grazing_angle": "between line of sight and surface"}


def dump(value):
    """One line of JSON; what is not finite is null."""
    try:
        return _ENCODE(value)
    except ValueError:
        return _ENCODE(_finite(value))


def _finite(value):
    if isinstance(value, dict):
        return {name: _finite(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def types(objects):
    """{array: type} of a data set over scenes with so many objects: indices of few objects take 16 bits."""
    return {**_TYPES, "object": "<i2"} if objects <= _INT16_OBJECTS else _TYPES


def codec(name, array):
    """Encoder of an array's chunks: None for uncompressed ones.
    The order of bytes before compression is the fastest of each kind."""
    if name == "none":
        return None
    try:
        import numcodecs
        import numcodecs.blosc
    except ImportError:
        raise DatasetError("expected the Python package numcodecs for output.compression, found none; "
                           "install python3-numcodecs, or write compression: none") from None
    numcodecs.blosc.use_threads = False  # one process a core; and bytes do not depend on threads
    return numcodecs.Blosc(cname=name, clevel=1, shuffle=_SHUFFLES.get(array, numcodecs.Blosc.NOSHUFFLE))


def _config(encoder):
    """Settings that rebuild an encoder, without those that are None, which numcodecs 0.16 adds."""
    return {key: value for key, value in encoder.get_config().items() if value is not None}


def zarr_metadata(plan, kinds):
    """{path: text} of the metadata of a Zarr group, version 2. `kinds`: types of the arrays."""
    files = {".zgroup": {"zarr_format": 2}, ".zattrs": {"description": "radar chips of YARS; see dataset.json"}}
    for name in plan.arrays:
        encoder, kind = codec(plan.compression, name), np.dtype(kinds[name])
        files[f"{name}/.zarray"] = {
            "zarr_format": 2, "shape": [plan.count, plan.size, plan.size], "chunks": [plan.block, plan.size, plan.size],
            "dtype": kind.str, "compressor": encoder and _config(encoder), "order": "C", "filters": None,
            # xarray takes a fill value for absent ones: 0 would be NaN
            "fill_value": "NaN" if kind.kind == "f" else None}
        files[f"{name}/.zattrs"] = {"_ARRAY_DIMENSIONS": ["item", "row", "column"], "units": UNITS[name],
                                    "long_name": MEANINGS[name]}
    files[".zmetadata"] = {"metadata": dict(files), "zarr_consolidated_format": 1}
    return {path: json.dumps(value, indent=1, sort_keys=True) + "\n" for path, value in files.items()}


def zarr_chunk(array, block, encoder):
    """Bytes of a chunk; the last one is filled up to the whole block."""
    if len(array) < block:
        array = np.concatenate([array, np.zeros((block - len(array),) + array.shape[1:], array.dtype)])
    return encoder.encode(np.ascontiguousarray(array)) if encoder else np.ascontiguousarray(array)


def npy_head(kind, count):
    """Begin of the .npy file of an array of one axis. The bytes of the array follow it."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": np.lib.format.dtype_to_descr(kind), "fortran_order": False,
                                                "shape": (count,)})
    return head.getvalue()


def npz(arrays, compressed):
    """Bytes of an .npz file of {name: array}. NumPy gives its members a fixed date."""
    stream = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(stream, **arrays)
    return stream.getvalue()


def png(picture):
    """Bytes of an 8-bit grey PNG."""
    try:
        import PIL.Image
    except ImportError:
        raise DatasetError("expected the Python package PIL for output.png, found none; install python3-pil") from None
    stream = io.BytesIO()
    PIL.Image.fromarray(picture).save(stream, "PNG", compress_level=1)
    return stream.getvalue()


def geotiff(picture, geo):
    """Bytes of a GeoTIFF on the azimuthal equidistant plane about the aircraft. `geo`: one row of the maker's geo."""
    try:
        import rasterio
    except ImportError:
        raise DatasetError("expected the Python package rasterio for output.geotiff, found none; "
                           "install python3-rasterio") from None
    x0, x_column, x_row, y0, y_column, y_row = (float(number) for number in geo["plane_from_pixel"])
    plane = (f"+proj=aeqd +lat_0={float(geo['origin_latitude'])!r} +lon_0={float(geo['origin_longitude'])!r} "
             "+datum=WGS84 +units=m +no_defs")
    with rasterio.MemoryFile() as memory:
        with memory.open(driver="GTiff", width=picture.shape[1], height=picture.shape[0], count=1,
                         dtype=picture.dtype.name, crs=plane,
                         transform=rasterio.Affine(x_column, x_row, x0, y_column, y_row, y0),
                         compress="deflate") as raster:
            raster.write(picture, 1)
        return memory.read()


# annotations.json in the form of COCO (https://cocodataset.org/#format-data)

def coco(store):
    """Parts of annotations.json, as bytes. Categories count from 1; ids of images are items, ids of annotations count
    from 1. A box is cut off at the picture's edges; one without any area there is left out."""
    plan = store.plan
    with open(store.path("objects.json"), "rb") as file:
        classes = json.load(file)["classes"]
    categories = [{"id": number + 1, "name": name} for number, name in enumerate(classes)]
    info = {"description": "radar chips of YARS", "version": store.mark}
    yield f'{{"info":{dump(info)},"licenses":[],"categories":{dump(categories)},\n"images":[\n'.encode()
    for block in range(plan.blocks):
        images = [dump({"id": item, "width": plan.size, "height": plan.size, "file_name": _picture(store, item)})
                  for item in range(*store.items(block))]
        yield (("" if block == 0 else ",\n") + ",\n".join(images)).encode()
    yield b'\n],\n"annotations":[\n'
    number = 1
    for block in range(plan.blocks):
        lines = _coco_lines(_boxes_of(store, block), plan.size, number)
        if lines:
            yield (("" if number == 1 else ",\n") + ",\n".join(lines)).encode()
            number += len(lines)
    yield b"\n]}\n"


def _picture(store, item):
    """Picture of an item, relative to the folder."""
    return store.item_name("png", item, ".png") if store.plan.png else store.item_name("geotiff", item, ".video.tif")


def _boxes_of(store, block):
    """Boxes of a block as blocks.BOX."""
    if store.plan.format == "zarr":
        return np.load(store.path(store.boxes_name(block)))
    return np.concatenate([np.load(store.path(store.item_name("items", item, ".npz")))["boxes"]
                           for item in range(*store.items(block))])


def cut_off(corners, size):
    """Corners (columns, rows) of the part of a convex polygon within [0, size]^2; fewer than three: none. Sutherland
    and Hodgman, "Reentrant Polygon Clipping", Communications of the ACM 17 (1974)."""
    for axis, sign, edge in ((0, -1.0, 0.0), (0, 1.0, size), (1, -1.0, 0.0), (1, 1.0, size)):
        inside, result = [sign * (corner[axis] - edge) <= 0.0 for corner in corners], []
        for at, corner in enumerate(corners):
            before = corners[at - 1]
            if inside[at] != inside[at - 1]:
                share = (edge - before[axis]) / (corner[axis] - before[axis])
                point = [before[other] + share * (corner[other] - before[other]) for other in (0, 1)]
                point[axis] = float(edge)
                result.append(point)
            if inside[at]:
                result.append(corner)
        corners = result
    return corners


def _coco_lines(boxes, size, number):
    lines = []
    for item, thing, label, pixels, aspect, corners in boxes[["item", "object", "class", "pixels", "aspect_deg",
                                                              "corners"]].tolist():
        outline = [[round(value, 3) for value in corner] for corner in cut_off(corners.tolist(), size)]
        # Edges through a corner of the picture.
        outline = [corner for at, corner in enumerate(outline) if corner != outline[at - 1]]
        if len(outline) < 3:
            continue
        columns, rows = zip(*outline)
        box = [min(columns), min(rows), round(max(columns) - min(columns), 3), round(max(rows) - min(rows), 3)]
        if box[2] <= 0.0 or box[3] <= 0.0:
            continue
        lines.append(dump({"id": number + len(lines), "image_id": item, "category_id": label + 1, "bbox": box,
                           "segmentation": [[value for corner in outline for value in corner]], "area": pixels,
                           "iscrowd": 0, "aspect_deg": round(aspect, 3), "object": thing}))
    return lines
