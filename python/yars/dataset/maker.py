"""What makes the arrays: the compiled part of YARS. Tests put another maker in its place.

A maker has `objects` (structured: name, latitude, longitude, ...), `elevation(latitudes, longitudes)` [m MSL],
`patches(orders, movers, settings)` -> dict of arrays, `boxes` of the type blocks.RADAR_BOX among them, and
`warm(sample)`, which reads what workers are to share."""
import functools
import hashlib

import numpy as np

from . import DatasetError
from .limits import without_name

OBJECT = np.dtype([("name", "U64"), ("latitude", "f8"), ("longitude", "f8")])


def hasher():
    """(name, function buffers -> 64-bit hash of their bytes, function array -> list of the hashes of its items): XXH3
    of the compiled part, else BLAKE2b."""
    try:
        from yars._core import xxh3, xxh3_items
        return "XXH3-64", xxh3, xxh3_items
    except ImportError:
        def blake2b(*parts):
            state = hashlib.blake2b(digest_size=8)
            for part in parts:
                state.update(part)
            return int.from_bytes(state.digest(), "little")
        return "BLAKE2b-64", blake2b, lambda array: [blake2b(item) for item in array]


def scene_text(path, at):
    """FILE@LAT,LON,HDG as `yars patch --scene` takes it."""
    return str(path) + ("@" + ",".join(f"{number:.12g}" for number in at) if at else "")


def converted(rows, kind):
    """A structured array with the fields of another type, by name."""
    result = np.empty(len(rows), kind)
    for name in result.dtype.names:
        result[name] = rows[name]
    return result


class YarsMaker:
    """The kernels of YARS over one terrain and its scenes."""

    def __init__(self, plan, terrain, scenes):
        """`terrain`: folder or None; `scenes`: list of (path, at, without)."""
        import yars
        self._yars, self._spec = yars, plan
        try:
            # Without the compiled part this raises MissingPart, an Error.
            yars.Terrain  # pylint: disable=pointless-statement
            where = plan.where("terrain")
            self._terrain = yars.Terrain(terrain) if terrain else yars.Terrain()
            where = plan.where("scenes")
            without = sorted({name for _, _, names in scenes for name in names})
            files = [scene_text(path, at) for path, at, _ in scenes]
            self._scene = yars.Scene(files, self._terrain, without=without) if scenes else None
        except (ValueError, yars.Error) as error:
            lines = [scene.line for scene, (path, _, _) in zip(plan.scenes, scenes) if str(path) in str(error)]
            raise DatasetError(f"{f'{plan.path}:{lines[0]}' if lines else where}: {without_name(error)}") from None
        self.objects = self._scene.objects if scenes else np.empty(0, OBJECT)

    def elevation(self, latitude, longitude):
        return self._terrain.elevation(latitude, longitude)

    @functools.lru_cache(maxsize=4)
    def _radar(self, settings):
        plan = self._spec
        arguments = dict(plan.knobs, map_size=plan.size, settings=settings)
        if plan.config:
            arguments["config"] = plan.config
        return self._yars.Radar(*([plan.preset] if plan.preset else []), **arguments)

    def patches(self, orders, movers, settings):
        plan = self._spec
        arguments = {"movers": converted(movers, self._yars.MOVER)} if len(movers) else {}
        try:
            return self._radar(settings).patches(self._terrain, converted(orders, self._yars.PATCH_ORDER),
                                                 scene=self._scene, arrays=plan.arrays, threads=1,
                                                 force=plan.geometry["force"], min_pixels=plan.min_pixels, **arguments)
        except (ValueError, self._yars.Error) as error:
            raise DatasetError(f"{plan.path}: {without_name(error)}") from None

    def warm(self, sample, settings):
        """Reads terrain and scenes of the sample, so that workers share them."""
        self.patches(sample.orders, sample.movers, settings)


def open_maker(plan, terrain, scenes):
    return YarsMaker(plan, terrain, scenes)
