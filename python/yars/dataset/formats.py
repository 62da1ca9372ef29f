"""Encodings of arrays, with the same bytes for the same values: Zarr chunks, NPZ, PNG, GeoTIFF."""
import io
import json

import numpy as np

from . import DatasetError

_TYPES = {"video": "|u1", "power": "<f4", "shadow": "|u1", "layover": "|u1", "object": "<i4", "material": "|u1",
         "height": "<f4", "grazing_angle": "<f4"}
# Blosc's: 1 by bytes for floats, 2 by bits for flags and codes.
_SHUFFLES = {"power": 1, "height": 1, "grazing_angle": 1, "shadow": 2, "layover": 2, "material": 2}
UNITS = {"video": "1", "power": "1", "shadow": "1", "layover": "1", "object": "1", "material": "1", "height": "m", "grazing_angle": "deg"}
_INT16_OBJECTS = 32767  # indices up to 32766 and -1
MEANINGS = {"video": "0 black to 255 white", "power": "gamma of level ground, before speckle and noise",
            "shadow": "1: no surface that the radar sees returns here", "layover": "1: two or more visible surfaces at this slant range",
            "object": "index into objects.json of the strongest surface; -1: ground or none",
            "material": "surface material code; 0: land without culture", "height": "above mean sea level",
            "grazing_angle": "between line of sight and surface"}


def types(objects):
    """{array: type} of a data set over scenes with so many objects: indices of few objects take 16 bits."""
    return {**_TYPES, "object": "<i2"} if objects <= _INT16_OBJECTS else _TYPES


def codec(name, array):
    """Encoder of an array's chunks: None for uncompressed ones. The order of bytes before compression is the fastest of each kind."""
    if name == "none":
        return None
    try:
        import numcodecs
        import numcodecs.blosc
    except ImportError:
        raise DatasetError("expected the Python package numcodecs for output.compression, found none; install python3-numcodecs, or "
                           "write compression: none") from None
    numcodecs.blosc.use_threads = False  # one process a core; and bytes do not depend on threads
    return numcodecs.Blosc(cname=name, clevel=1, shuffle=_SHUFFLES.get(array, numcodecs.Blosc.NOSHUFFLE))


def zarr_metadata(plan, kinds):
    """{path: text} of the metadata of a Zarr group, version 2. `kinds`: types of the arrays."""
    files = {".zgroup": {"zarr_format": 2}, ".zattrs": {"description": "radar chips of YARS; see dataset.json"}}
    for name in plan.arrays:
        encoder, kind = codec(plan.compression, name), np.dtype(kinds[name])
        files[f"{name}/.zarray"] = {
            "zarr_format": 2, "shape": [plan.count, plan.size, plan.size], "chunks": [plan.block, plan.size, plan.size],
            "dtype": kind.str, "compressor": encoder and encoder.get_config(), "order": "C", "filters": None,
            "fill_value": "NaN" if kind.kind == "f" else None}  # xarray takes a fill value for absent ones: 0 would be NaN
        files[f"{name}/.zattrs"] = {"_ARRAY_DIMENSIONS": ["item", "row", "column"], "units": UNITS[name], "long_name": MEANINGS[name]}
    files[".zmetadata"] = {"metadata": dict(files), "zarr_consolidated_format": 1}
    return {path: json.dumps(value, indent=1, sort_keys=True) + "\n" for path, value in files.items()}


def zarr_chunk(array, block, encoder):
    """Bytes of a chunk; the last one is filled up to the whole block."""
    if len(array) < block:
        array = np.concatenate([array, np.zeros((block - len(array),) + array.shape[1:], array.dtype)])
    return encoder.encode(np.ascontiguousarray(array)) if encoder else np.ascontiguousarray(array)


def npy_room(kind, count):
    """Array of one axis to be filled. Its `base` has the bytes of its .npy file, the header included."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": np.lib.format.dtype_to_descr(kind), "fortran_order": False, "shape": (count,)})
    file = np.empty(head.tell() + count * kind.itemsize, np.uint8)
    file[:head.tell()] = np.frombuffer(head.getvalue(), np.uint8)
    return file[head.tell():].view(kind)


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
        raise DatasetError("expected the Python package rasterio for output.geotiff, found none; install python3-rasterio") from None
    x0, x_column, x_row, y0, y_column, y_row = (float(number) for number in geo["plane_from_pixel"])
    plane = (f"+proj=aeqd +lat_0={float(geo['origin_latitude'])!r} +lon_0={float(geo['origin_longitude'])!r} +datum=WGS84 "
             "+units=m +no_defs")
    with rasterio.MemoryFile() as memory:
        with memory.open(driver="GTiff", width=picture.shape[1], height=picture.shape[0], count=1, dtype=picture.dtype.name, crs=plane,
                         transform=rasterio.Affine(x_column, x_row, x0, y_column, y_row, y0), compress="deflate") as raster:
            raster.write(picture, 1)
        return memory.read()
