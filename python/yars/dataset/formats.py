"""Encodings of arrays, with the same bytes for the same values: Zarr chunks, NPZ, PNG, GeoTIFF."""
import json
import struct
import zlib

import numpy as np

from .errors import DatasetError

# Type and fill value of each array (pixels outside a picture do not exist; the fill value is never seen).
TYPES = {"video": "|u1", "power": "<f4", "shadow": "|u1", "layover": "|u1", "object": "<i4", "material": "|u1",
         "height": "<f4", "grazing_angle": "<f4"}
# Blosc's: 1 by bytes for floats, 2 by bits for flags and codes.
_SHUFFLES = {"power": 1, "height": 1, "grazing_angle": 1, "shadow": 2, "layover": 2, "material": 2}
UNITS = {"video": "1", "power": "1", "shadow": "1", "layover": "1", "object": "1", "material": "1", "height": "m", "grazing_angle": "deg"}
MEANINGS = {"video": "0 black to 255 white", "power": "gamma of level ground, before speckle and noise",
            "shadow": "1: no surface that the radar sees returns here", "layover": "1: two or more visible surfaces at this slant range",
            "object": "index into objects.json of the strongest surface; -1: ground or none",
            "material": "surface material code; 0: land without culture", "height": "above mean sea level",
            "grazing_angle": "between line of sight and surface"}


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


def zarr_metadata(plan):
    """{path: text} of the metadata of a Zarr group, version 2."""
    files = {".zgroup": {"zarr_format": 2}, ".zattrs": {"description": "radar chips of YARS; see dataset.json"}}
    for name in plan.arrays:
        encoder, kind = codec(plan.compression, name), np.dtype(TYPES[name])
        files[f"{name}/.zarray"] = {
            "zarr_format": 2, "shape": [plan.count, plan.size, plan.size], "chunks": [plan.block, plan.size, plan.size],
            "dtype": kind.str, "compressor": encoder and encoder.get_config(), "fill_value": "NaN" if kind.kind == "f" else 0,
            "order": "C", "filters": None}
        files[f"{name}/.zattrs"] = {"_ARRAY_DIMENSIONS": ["item", "row", "column"], "units": UNITS[name], "long_name": MEANINGS[name]}
    files[".zmetadata"] = {"metadata": dict(files), "zarr_consolidated_format": 1}
    return {path: json.dumps(value, indent=1, sort_keys=True) + "\n" for path, value in files.items()}


def zarr_chunk(array, block, encoder):
    """Bytes of a chunk; the last one is filled up to the whole block."""
    if len(array) < block:
        array = np.concatenate([array, np.zeros((block - len(array),) + array.shape[1:], array.dtype)])
    return encoder.encode(np.ascontiguousarray(array)) if encoder else np.ascontiguousarray(array)


class Npz:
    """Bytes of .npz files: a ZIP archive of .npy members with fixed dates, stored or deflated."""

    def __init__(self, compressed):
        self._compressed, self._headers = compressed, {}

    def _header(self, array):
        key = array.dtype, array.shape
        if key not in self._headers:
            text = f"{{'descr': {np.lib.format.dtype_to_descr(array.dtype)!r}, 'fortran_order': False, 'shape': {array.shape!r}, }}"
            text += " " * (-(len(text) + 11) % 64) + "\n"
            self._headers[key] = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode()
        return self._headers[key]

    def encode(self, arrays):
        """One bytes object of {name: array}."""
        parts, directory, at = [], [], 0
        for name, array in arrays.items():
            array = np.ascontiguousarray(array)
            data = self._header(array) + array.tobytes()
            check, size, method = zlib.crc32(data), len(data), 0
            if self._compressed:
                packer = zlib.compressobj(1, zlib.DEFLATED, -15)
                data, method = packer.compress(data) + packer.flush(), 8
            label = (name + ".npy").encode()
            common = struct.pack("<HHHHHIIIHH", 20, 0, method, 0, 33, check, len(data), size, len(label), 0)
            parts += [b"PK\x03\x04" + common + label, data]
            directory.append(b"PK\x01\x02" + struct.pack("<H", 20) + common + struct.pack("<HHHII", 0, 0, 0, 0o600 << 16, at) + label)
            at += 30 + len(label) + len(data)
        index = b"".join(directory)
        end = b"PK\x05\x06" + struct.pack("<HHHHIIH", 0, 0, len(directory), len(directory), len(index), at, 0)
        return b"".join(parts) + index + end


def png(picture):
    """Bytes of an 8-bit grey PNG."""
    rows, columns = picture.shape
    lines = np.zeros((rows, columns + 1), np.uint8)
    lines[:, 1:] = picture

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(lines.tobytes(), 1)) + chunk(b"IEND", b""))


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
