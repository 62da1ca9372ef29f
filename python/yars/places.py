"""Terrain and scenes in this process: what scans and maps are computed over. Both stay in memory for later calls."""
import os

import numpy

from . import _core
from .arguments import Held, Request, Said, absolute, instance, kind_error, number, path, several, text

_TERRAIN = Request("yars.Terrain.generate", _core.TerrainGeneration, _core.TerrainGeneration_fields)
_SCENE = Request("yars.Scene.generate", _core.SceneGeneration, _core.SceneGeneration_fields, ("origin",))


def _degrees(where, value):
    """Array of numbers, and which of them are masked."""
    masked = numpy.ma.getmaskarray(value) if isinstance(value, numpy.ma.MaskedArray) else None
    try:
        given = numpy.asarray(value)
        if given.dtype.kind == "O":  # such as fractions; numbers of Python that NumPy has no type for
            if any(one is None or isinstance(one, (str, bytes, bool, complex)) for one in given.flat):
                raise TypeError
            given = given.astype(float)
    except OverflowError:
        raise ValueError(f"{where}: expected degrees, found a number that is too large") from None
    except (TypeError, ValueError):
        raise kind_error(where, "numbers of degrees", value) from None
    if given.dtype.kind not in "iuf":
        raise TypeError(f"{where}: expected numbers of degrees, "
                        f"found {'text' if given.dtype.kind in 'US' else given.dtype.name}")
    return given.astype(float), masked


class Terrain(Held):
    """Elevation, and the scenes in its folder.

    Terrain(directory=None): folder of elevation cells (DTED, HGT, DED, packs, rasters), as str, bytes or os.PathLike;
    None: the built-in hills. What has been read stays in memory for later scans and maps, up to 512 MiB for each use.
    The folder's path is absolute from then on: os.chdir() changes nothing. A Terrain can be pickled; another process
    opens the folder again. Errors: yars.Error for a folder that is missing or has no cell.

    >>> terrain = yars.Terrain()
    >>> terrain
    <yars.Terrain, the built-in hills>
    >>> terrain.elevation([37.5, 37.6], -122.5).shape
    (2,)
    """

    def __init__(self, directory=None):
        folder = None
        if directory is not None:
            folder = absolute(path("yars.Terrain: directory", directory,
                                          "a path (str, bytes or os.PathLike) of a folder, "
                                          "or None for the built-in hills"))
        self._made(folder)

    def _make(self, *arguments):
        with Said("yars.Terrain"):
            return _core.open_terrain(arguments[0] or b"")

    @property
    def directory(self):
        """Absolute path of the folder of the cells; empty: the built-in hills."""
        return os.fsdecode(self._arguments[0] or b"")

    def elevation(self, latitude, longitude):
        """Elevation [m] above mean sea level at positions [deg], bilinear between posts of the finest level.

        latitude, longitude: numbers or arrays that broadcast; result: float64 of their shape, NaN where void or masked.
        The north and the east edge of the outermost cells belong to these.
        Positions outside count as sea, with a warning.
        """
        where = "yars.Terrain.elevation"
        self._core  # an object without __init__ is the first fault  # pylint: disable=pointless-statement
        latitudes, masked_latitudes = _degrees(f"{where}: latitude", latitude)
        longitudes, masked_longitudes = _degrees(f"{where}: longitude", longitude)
        try:
            latitudes, longitudes = numpy.broadcast_arrays(latitudes, longitudes)
        except ValueError:
            raise ValueError(f"{where}: expected latitude and longitude of shapes that broadcast, "
                             f"found {latitudes.shape} and {longitudes.shape}") from None
        masks = [numpy.broadcast_to(mask, latitudes.shape) for mask in (masked_latitudes, masked_longitudes)
                 if mask is not None]
        if not any(mask.any() for mask in masks):
            with Said(where):
                return self._core.elevation(latitudes, longitudes)
        known = ~numpy.logical_or.reduce(masks)
        heights = numpy.full(latitudes.shape, numpy.nan)
        with Said(where):
            heights[known] = self._core.elevation(latitudes[known], longitudes[known])
        return heights

    @staticmethod
    def generate(directory, **fields):
        """Writes a made-up landscape as DTED cells.

        As `yars terrain generate`: fields south, west [deg], cells_lat, cells_lon, level, seed, edge ("coast"
        or "cut"), culture (False: none), airfields ("paved" or "soil"), sea, threads. Returns the directory. A folder
        with cells of another area or another level is refused, so that a Terrain of it has no cells but these.
        Errors: ValueError for fields, yars.Error for files that cannot be written.
        """
        where = "yars.Terrain.generate"
        folder = path(f"{where}: directory", directory)
        request = _TERRAIN.of(fields)
        with Said(where):
            _core.generate_terrain(folder, request)
        return os.fsdecode(folder)

    def __repr__(self):
        return f"<yars.Terrain, {ascii(self.directory) if self._arguments[0] else 'the built-in hills'}>"


class Scene(Held):
    """Polygonal scenes on a terrain.

    Scene(files, terrain, without=()): files, one or a list: FILE or FILE@LAT,LON,HDG (OpenFlight), or a folder of them;
    as str, bytes or os.PathLike. without: names of objects or groups to leave out, with the wildcards * and ?. Paths
    are absolute from then on. A Scene can be pickled; another process reads the files again.
    Errors: ValueError for a text that is no scene, yars.Error for a file that cannot be read.
    """

    def __init__(self, files, terrain, without=()):
        where = "yars.Scene"
        instance(f"{where}: terrain", terrain, Terrain)
        expected = "a path, or a list of paths (str, bytes or os.PathLike), with @LAT,LON,HDG at will"
        given = several(files)
        if given is not None and not given:
            raise ValueError(f"{where}: files: expected {expected}, found an empty list")
        paths = tuple(absolute(path(f"{where}: files", file, expected))
                      for file in ([files] if given is None else given))
        names = [without] if isinstance(without, str) else several(without)
        if names is None:
            raise kind_error(f"{where}: without", "a name or a list of names", without)
        self._made(paths, terrain, tuple(text(f"{where}: without", name, "a name") for name in names))

    def _make(self, *arguments):
        paths, terrain, without = arguments
        with Said("yars.Scene"):
            return _core.read_scene(list(paths), terrain._core, list(without))

    @property
    def terrain(self):
        """The Terrain that the scene was read for."""
        return self._arguments[1]

    @property
    def triangles(self):
        """Number of triangles of all files."""
        return self._core.triangles

    @property
    def objects(self):
        """Structured array of all objects, shape (objects,).

        name; latitude, longitude [deg] of the middle; base_msl_m [m MSL]; height_m; length_m, width_m of the box of
        least area seen from above; heading_deg true of its longer side, [0, 180); material: DFAD code of most of its
        surface. The labels of maps are indices into this array.
        The first object of each file has its faces outside objects, and no name.
        """
        return self._core.objects

    @staticmethod
    def generate(path, origin=None, **fields):  # pylint: disable=redefined-outer-name
        """Writes a made-up scene as an OpenFlight file.

        As `yars scene generate`: fields kind ("airfield", "harbour", "bridge" or "town"), triangles (about as many),
        seed; origin=(latitude, longitude) or (latitude, longitude, heading) [deg]. Returns the path.
        Errors: ValueError for fields, yars.Error for a file that cannot be written.
        """
        where = "yars.Scene.generate"
        file = _path(f"{where}: path", path)
        request = _SCENE.of(fields)
        expected = "(latitude, longitude) or (latitude, longitude, heading)"
        if origin is None:
            raise ValueError(f"{where}: expected origin={expected}, found none")
        if not isinstance(origin, str):
            numbers = several(origin)
            if numbers is None:
                raise kind_error(f"{where}: origin", expected, origin)
            if len(numbers) not in (2, 3):
                raise ValueError(f"{where}: origin: expected {expected}, found a sequence of length {len(numbers)}")
            origin = [number(f"{where}: origin[{at}]", one) for at, one in enumerate(numbers)]
        with Said(where):
            _core.generate_scene(file, request, origin)
        return os.fsdecode(file)

    def __repr__(self):
        return f"<yars.Scene {len(self.objects)} objects, {self.triangles} triangles>"


_path = path  # generate() has an argument of this name
