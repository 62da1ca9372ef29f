"""Terrain, scenes and a radar in this process: scans of the real beam map and patch maps as NumPy arrays.

    radar = yars.Radar("standard", samples=480)
    scan = radar.scan(yars.Terrain("DIR"), latitude_deg=36.5, longitude_deg=-121.5, altitude_ft=15000, heading_deg=30,
                      range_nm=20, seed=1)
    scan.power, scan.units["power"], scan.to_xarray()

Arguments are the fields of ScanRequest and PatchRequest of the C++ library, which has the limits. The arrays are bit
for bit those of the commands `yars scan` and `yars patch`, and `hash` is the hash that they print. Arrays cannot be
written: copy them first. Errors: TypeError and ValueError for arguments, yars.Error for files. Errors of the library
have the attributes code, field, expected, found, action, low and high. Problems of single files are warnings. While a
picture is computed other threads of Python run.
"""
import functools
import json
import os
import re

import numpy

from . import Error, _core, _require
from ._core import MOVER, PATCH_ORDER
from .arguments import (Held, Request, Said, absolute, instance, kind_error, number, path, plain, several,
                        shown, text, truth, whole)
from .places import Scene, Terrain
from .recordings import Recording

__all__ = ["Radar", "Scan", "Patch", "Terrain", "Scene", "Recording", "trade", "PATCH_ORDER", "MOVER"]

# Unit of each array; "1": a ratio; "": none. Meaning of each, for xarray and help.
UNITS = {"power": "1", "video": "", "shadow": "", "layover": "", "object": "", "material": "", "height": "m",
         "grazing_angle": "degree", "slant_range": "m", "ground_range": "m", "latitude": "degree",
         "longitude": "degree", "azimuth": "degree", "sample": "", "x": "m", "y": "m"}
MEANINGS = {
    "power": "received power before noise and azimuth smear, full scale 1 (scan); gamma of level ground with equal "
             "return, before speckle and noise, NaN in the blind zone (patch)",
    "video": "brightness, 0 black to 255 white",
    "shadow": "True: no surface that the radar sees returns here",
    "layover": "True: two or more separate surfaces that the radar sees have this slant range",
    "object": "index into Scene.objects of what returns here; -1: ground or shadow",
    "material": "surface material code of DFAD; 0: land without culture, 6: water",
    "height": "of the surface above mean sea level",
    "grazing_angle": "between line of sight and surface, along the line of sight",
    "slant_range": "from the aircraft",
    "ground_range": "over ground from the aircraft",
    "latitude": "WGS84, north positive", "longitude": "WGS84, east positive",
    "azimuth": "true bearing of the sweep's middle", "sample": "number of the sample, from near to far",
    "x": "from the map's centre, to the right of the line of sight",
    "y": "from the map's centre, away from the aircraft",
}
ARRAYS = ("power", "video", "shadow", "layover", "slant_range", "ground_range", "latitude", "longitude", "height",
          "grazing_angle", "material", "object")
# Of a patch map: labels that are computed with it; latitude, longitude and ranges are those of its plane.
PATCHES = ("video", "shadow", "layover", "object", "material")


def _array(name, shape):
    def get(self):
        return self._result.array(name)

    unit = f" [{UNITS[name]}]" if UNITS[name] else ""
    return property(get, doc=f"Array {shape}{unit}: {MEANINGS[name]}.")


class _Picture:
    """Arrays with units and axes. Each array lies in the memory of the result; it is computed when first asked for."""

    axes = ()
    _shape = ""

    def __init_subclass__(cls):
        for name in ARRAYS:
            setattr(cls, name, _array(name, cls._shape))

    def __init__(self, result):
        if not isinstance(result, (_core.ScanResult, _core.PatchResult)):
            raise TypeError(f"yars.{type(self).__name__}: expected one that a method of yars.Radar makes, found a call "
                            f"with {shown(result)}")
        self._result = result

    def __getattr__(self, name):
        if name == "_result":
            raise TypeError(f"yars.{type(self).__name__}: expected one that a method of yars.Radar makes, found one of "
                            f"{type(self).__name__} without a result")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    @property
    def units(self):
        """Unit of each array by its name: "m", "degree", "1" for ratios, "" for none."""
        return {name: UNITS[name] for name in (*ARRAYS, *self.axes)}

    @property
    def hash(self):
        """Hash of the video, as `yars scan` and `yars patch` print it: a number of 64 bits (XXH3).

        Of a scan: of the hashes of its sweeps; each is that of a sweep's record, which has place, settings and video.
        Of a patch map: of the pixels of its video, row after row.
        """
        return self._result.hash

    @property
    def facts(self):
        """Numbers of the whole picture, by name: position [deg], altitude and ranges [m], angles [deg], fidelity."""
        return self._result.facts()

    def to_xarray(self, arrays=ARRAYS):
        """xarray.Dataset of the arrays named, with coordinates, units and meanings. Needs python3-xarray.

        arrays: names, or one name. Latitude, longitude, ranges are coordinates. Attributes are the facts, and the hash
        as 16 hexadecimal digits. to_zarr() and pickle keep all; to_netcdf() needs python3-netcdf4.
        """
        xarray = _require("xarray", f"yars.{type(self).__name__}.to_xarray")
        coordinates = {"latitude", "longitude", "slant_range", "ground_range"}
        variables, coords = {}, {}
        names = [arrays] if isinstance(arrays, str) else several(arrays)
        if names is None:
            raise kind_error(f"yars.{type(self).__name__}.to_xarray: arrays",
                             "the name of an array, or a list of names", arrays)
        for name in names:
            if name not in ARRAYS:
                raise ValueError(f"yars.{type(self).__name__}.to_xarray: arrays: expected {', '.join(ARRAYS)}, found "
                                 f"{name!r}")
            attributes = {"units": UNITS[name], "long_name": MEANINGS[name]}
            (coords if name in coordinates else variables)[name] = (self.axes, getattr(self, name), attributes)
        for axis in self.axes:
            coords[axis] = ((axis,), getattr(self, axis), {"units": UNITS[axis], "long_name": MEANINGS[axis]})
        attributes = {key: int(value) if isinstance(value, bool) else value for key, value in self.facts.items()}
        return xarray.Dataset(variables, coords, {**attributes, "hash": f"{self.hash:016x}"})

    def __reduce__(self):
        name = f"yars.{type(self).__name__}"
        raise TypeError(f"{name}: expected an object that can be pickled, found a picture in memory; keep its arrays, "
                        "or to_xarray()")

    def __repr__(self):
        shape = " x ".join(str(length) for length in self.video.shape)
        return (f"<yars.{type(self).__name__} {shape} {' x '.join(self.axes)}, {self.facts['fidelity']}, "
                f"hash {self.hash:016x}>")


class Scan(_Picture):
    """One scan of the real beam map: arrays of shape (azimuth, sample), sweeps clockwise, samples from near to far.

    >>> scan = yars.Radar("draft").scan(yars.Terrain(), latitude_deg=37.8, longitude_deg=-122.5, range_nm=10, seed=1)
    >>> scan.power.shape == (len(scan.azimuth), len(scan.sample))
    True
    >>> scan.units["slant_range"], scan.axes
    ('m', ('azimuth', 'sample'))
    """

    axes = ("azimuth", "sample")
    _shape = "(azimuth, sample)"

    @property
    def azimuth(self):
        """Array (azimuth,) [degree]: true bearing of each sweep's middle, at the aircraft.

        Ascends without a jump at north: the middle sweep is in [0, 360), and others are below 0 or above 360 where the
        scan passes north. So data.sel(azimuth=0, method="nearest") of to_xarray() finds the sweep to the north of a
        scan with heading 0.
        """
        return self._result.array("azimuth")

    @property
    def sample(self):
        """Array (sample,): numbers of the samples. Their ground ranges are `ground_range`."""
        return numpy.arange(self.video.shape[1])


class Patch(_Picture):
    """One patch map: arrays of shape (y, x). Row 0 is the far edge, column 0 the left one as seen from the aircraft.

    latitude, longitude, slant_range and ground_range are those of the pixel on the map's plane; height, grazing_angle,
    material and object are those of the surface with the strongest return there.

    >>> radar = yars.Radar("draft", map_size=64)
    >>> patch = radar.patch(yars.Terrain(), latitude_deg=37.5, longitude_deg=-122.5, heading_deg=350,
    ...                     target_latitude_deg=37.62, target_longitude_deg=-122.4, window_nm=1.3)
    >>> patch.video.shape, patch.video.dtype.name
    ((64, 64), 'uint8')
    >>> bool(patch.ground_range[0, 0] > patch.ground_range[-1, 0])  # row 0 is the far edge
    True
    """

    axes = ("y", "x")
    _shape = "(y, x)"

    @property
    def x(self):
        """Array (x,) [m]: pixel centres to the right of the line of sight to the map's centre."""
        return self._result.array("x")

    @property
    def y(self):
        """Array (y,) [m]: pixel centres from the map's centre away from the aircraft; descends."""
        return self._result.array("y")


_SCAN = Request("yars.Radar.scan", _core.ScanRequest, _core.ScanRequest_fields)
_PATCH = Request("yars.Radar.patch", _core.PatchRequest, _core.PatchRequest_fields)
_THREADS = next([int(end) for end in field[3:]] for field in _core.PatchRequest_fields if field[0] == "threads")
_TRADES = [Request("yars.trade", *of, ("csv", "out"))
           for of in ((_core.ScanTradeRequest, _core.ScanTradeRequest_fields),
                      (_core.MapTradeRequest, _core.MapTradeRequest_fields))]
_PRESETS = ("1996", "draft", "standard", "fine", "reference")  # generated


@functools.lru_cache(maxsize=None)
def _knobs():
    """Names of the slots of the form Fidelity, in lower case."""
    slots = re.findall(r":(\w+)", re.search(r"\( Fidelity\b(.*?)\)\s", _core.make_radar("", b"", "", []).guf, re.S)[1])
    return tuple(_knob_name(slot) for slot in slots if slot != "preset")


def _knob_name(slot):
    return re.sub("[A-Z]", lambda letter: "_" + letter[0].lower(), slot)


def _slot(name):
    return re.sub("_([a-z0-9])", lambda letter: letter[1].upper(), name)


def _knob(name, value):
    """A knob's value as number, truth value or text."""
    where = f"yars.Radar: {name}"
    value = plain(value)
    if isinstance(value, bool):
        return value
    if isinstance(value, (int, float)):
        return number(where, value)
    if isinstance(value, str):
        return text(where, value)
    if hasattr(value, "__index__") and not hasattr(value, "ndim"):
        return float(value.__index__())
    if (isinstance(value, (bytes, complex)) or value is None or not hasattr(value, "__float__") or
            getattr(value, "ndim", 0)):
        raise kind_error(where, "a number, True, False or a name", value)
    return float(value)


def _check_text_file(file):
    """Refuses a file of other bytes than text, whose faults the reader of GUF would name by line."""
    try:
        with open(file, "rb") as opened:
            other = b"\0" in opened.read(4096)
    except OSError:
        return  # the reader of GUF says what is wrong
    if other:
        raise Error("yars.Radar: config: expected a text of GUF, found a file of other bytes, "
                    f"{ascii(os.fsdecode(file))}; give a file such as `yars config print` makes")


class Radar(Held):
    """A radar: a configuration, and the pictures that it gives over a terrain.

    preset: 1996, draft, standard, fine or reference; None: that of the file, else standard.
    config: a GUF file, or the name of one that came with YARS, such as apg68.guf; None: the built-in APG-70.
    settings: GUF text with forms that replace those of the file, such as "( Sea :state 3 )". knobs: slots of the form
    Fidelity in lower case, such as samples=480, map_size=256, sub_beams=8. Errors: ValueError for a wrong value or
    name, yars.Error for the file. A Radar can be pickled.

    >>> yars.Radar("fine", samples=320).samples
    320
    >>> yars.Radar("fast")
    Traceback (most recent call last):
    ValueError: yars.Radar: preset: expected one of 1996, draft, standard, fine, reference, found 'fast'
    """

    def __init__(self, preset=None, *, config=None, settings="", **knobs):
        where = "yars.Radar"
        preset = plain(preset) if preset is None or not hasattr(preset, "ndim") else preset
        presets = f"one of {', '.join(_PRESETS)}, or None"
        if preset is not None and (isinstance(preset, bool) or not isinstance(preset, (str, int))):
            raise kind_error(f"{where}: preset", presets, preset)
        if preset == "":
            raise ValueError(f"{where}: preset: expected {presets}, found an empty text")
        if config is not None:
            config = path(f"{where}: config", config, "a path (str, bytes or os.PathLike) of a GUF file, or None")
            config = absolute(_core.installed_file(config))
            _check_text_file(config)
        settings = text(f"{where}: settings", settings, "GUF text, such as '( Sea :state 3 )'")
        for name in knobs:
            if _knob_name(name) not in _knobs():
                raise ValueError(f"{where}: expected preset, config, settings or knobs of {', '.join(_knobs())}; found "
                                 f"{ascii(name)[:60]}")
        knobs = [(_slot(name), _knob(name, value)) for name, value in knobs.items()]
        self._made("" if preset is None else str(preset), config or b"", settings, knobs)

    def _make(self, *arguments):
        with Said("yars.Radar"):
            return _core.make_radar(*arguments)

    def __repr__(self):
        return f"<yars.Radar {self.name!r}, {self.fidelity}>"

    @property
    def name(self):
        """Name of the radar in its configuration."""
        return self._core.name

    @property
    def fidelity(self):
        """Name of the preset."""
        return self._core.fidelity

    @property
    def map_size(self):
        """Pixels on an edge of a patch map: the knob map_size. The option `size` of patch() is for one map alone."""
        return self._core.map_size

    @property
    def samples(self):
        """Samples of a sweep."""
        return self._core.samples

    @property
    def guf(self):
        """The whole configuration as GUF text."""
        return self._core.guf

    def scan(self, terrain, scene=None, **fields):
        """One scan of the real beam map, as `yars scan`. Returns a Scan.

        terrain: Terrain. scene: Scene on it; None: the scenes in the terrain's folder, and of the configuration.
        fields: latitude_deg, longitude_deg, altitude_ft [ft MSL], heading_deg (true), range_nm, width_deg,
        elevation_deg, gain, band A to E, channel, samples, time_s, threads, seed, force (beyond gimbal limits, below
        ground).
        """
        places = self._places("yars.Radar.scan", terrain, scene)
        request = _SCAN.of(fields)
        with Said("yars.Radar.scan"):
            return Scan(self._core.scan(*places, request))

    def patch(self, terrain, scene=None, **fields):
        """One patch map, as `yars patch`. Returns a Patch.

        terrain, scene: as scan(). fields: latitude_deg, longitude_deg, altitude_ft [ft MSL], heading_deg (true),
        speed_kt, target_latitude_deg, target_longitude_deg, window_nm, looks, size [pixels], map (number, selects the
        noise with the seed), time_s, threads, seed, force (beyond the radar's limits).
        """
        places = self._places("yars.Radar.patch", terrain, scene)
        request = _PATCH.of(fields)
        with Said("yars.Radar.patch"):
            return Patch(self._core.patch(*places, request))

    def patches(self, terrain, orders, scene=None, *, movers=None, arrays=PATCHES, threads=1, force=False,
                min_pixels=0):
        """Many patch maps in one call. Returns a dict of arrays.

        orders: structured array of dtype PATCH_ORDER, shape (n,). movers: structured array of dtype MOVER; each names
        its order. arrays: of video, power, shadow, layover, object, material, height, grazing_angle; each has the shape
        (n, map_size, map_size). Also: hash (n,) of each video; geo (n,), the place of the pixels on an azimuthal
        equidistant plane about the aircraft (plane_from_pixel: GDAL's affine, metres east and north) and numbers of
        each map; boxes, with the footprint of each object in each picture (column, row), its aspect and its pixels; of
        objects with fewer pixels than min_pixels there are none. The arrays are the caller's own, and can be written.
        There is no progress: call it in blocks of some hundred orders to show one.
        Errors: ValueError names the order and the field that is beyond the limits of the options of patch(), or the
        order that is beyond the radar's; force leaves the radar's limits out.

        >>> import numpy
        >>> orders = numpy.zeros(2, yars.PATCH_ORDER)
        >>> for field, value in dict(latitude=37.5, longitude=-122.5, altitude_ft=12000, heading=350, speed_kt=480,
        ...                          looks=1, target_latitude=37.62, target_longitude=-122.4, window_nm=1.3).items():
        ...     orders[field] = value
        >>> orders["map"] = 1, 2
        >>> maps = yars.Radar("draft", map_size=64).patches(yars.Terrain(), orders)
        >>> maps["video"].shape, maps["geo"]["plane_from_pixel"].shape
        ((2, 64, 64), (2, 6))
        """
        where = "yars.Radar.patches"
        places = self._places(where, terrain, scene)
        for name, rows in (("orders", orders), *((("movers", movers),) if movers is not None else ())):
            if not isinstance(rows, numpy.ndarray):
                raise kind_error(f"{where}: {name}",
                                 f"an array of the type yars.{'PATCH_ORDER' if name == 'orders' else 'MOVER'}", rows)
        names = [arrays] if isinstance(arrays, str) else several(arrays)
        if names is None:
            raise kind_error(f"{where}: arrays", "the name of an array, or a list of names", arrays)
        names = [text(f"{where}: arrays", name, "the name of an array") for name in names]
        numbers = (whole(f"{where}: threads", threads, *_THREADS), truth(f"{where}: force", force),
                   whole(f"{where}: min_pixels", min_pixels, 0, 2 ** 31 - 1))
        with Said(where):
            return self._core.patches(places[0], orders, places[1], movers, names, *numbers)

    def _places(self, where, terrain, scene):
        """Terrain and scene of a call as the compiled part has them."""
        self._core  # an object without __init__ is the first fault  # pylint: disable=pointless-statement
        instance(f"{where}: terrain", terrain, Terrain)
        instance(f"{where}: scene", scene, Scene, optional=True)
        return terrain._core, scene and scene._core


def trade(terrain=None, radar=None, *, maps=False, csv=None, out=None, **fields):
    """Speed against accuracy of presets and knobs, as `yars trade`; with maps=True as `yars trade maps`.

    Returns a dict of the layout of `yars trade --out FILE.json`, which yars.plot.trade_front draws: points, a dict for
    each candidate with mean, worst, worst_scene and scenes of each column (None: no value); scenes; axes.
    terrain: Terrain; None: that of the radar's configuration, else the built-in hills. radar: Radar whose configuration
    is used; its fidelity is not. fields: those of ScanTradeRequest or MapTradeRequest (yars/results.pyi), such as
    presets="1996,standard", knob=["samples=120,240"], base, ruler, repeat, scene or view (lists of texts), width_deg.
    out, csv: files to write.
    >>> rows = yars.trade(presets="draft", scene="37,-122,15000,60,10", repeat=1, ruler_samples=60)
    >>> rows["points"][0]["point"], rows["scenes"]
    ('draft', ['37 -122 15000 ft 60 deg 10 NM'])

    Other threads of Python run meanwhile, and make the times larger. Errors: ValueError for fields, yars.Error for
    files.
    """
    where = "yars.trade"
    instance(f"{where}: terrain", terrain, Terrain, optional=True)
    instance(f"{where}: radar", radar, Radar, optional=True)
    maps = truth(f"{where}: maps", maps)
    request = _TRADES[maps].of(fields)
    files = [b"" if file is None else path(f"{where}: {name}", file) for name, file in (("csv", csv), ("out", out))]
    radar = Radar() if radar is None else radar
    with Said(where):
        return json.loads(_core.trade(terrain and terrain._core, radar._core, request, *files))
