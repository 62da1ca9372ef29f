from collections.abc import Sequence
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arguments import Held

_Path = str | bytes | PathLike[str] | PathLike[bytes]

class Terrain(Held):
    def __init__(self, directory: _Path | None = None) -> None: ...
    @staticmethod
    def generate(
        directory: _Path,
        *,
        # begin: lib/values/generate.py, TerrainGeneration
        south: int = ...,  # [deg] -90 to 89: south edge
        west: int = ...,  # [deg] -180 to 179: west edge
        cells_lat: int = ...,  # 1 to 180: cells northward
        cells_lon: int = ...,  # 1 to 360: cells eastward
        level: int = ...,  # 0 to 2: DTED level
        seed: int = ...,  # seed of the landscape; each seed gives another earth
        # coast: land ends at the sea inside the area's edge; cut: land continues to the edge, for areas that join
        edge: Literal["coast", "cut"] = ...,
        culture: bool = ...,  # surface materials beside each cell, wLLL/nBB.smc.png; on by default
        # culture of airfields: paved, with runway, apron and hangars; soil, for scenes that have these
        airfields: Literal["paved", "soil"] = ...,
        sea: bool = ...,  # also write cells with only sea (a cell without a file is sea)
        threads: int = ...,  # 0 to 256: number of threads, 0 for one per core; the files do not depend on it
        # end: TerrainGeneration
    ) -> str: ...
    @property
    def directory(self) -> str: ...
    def elevation(self, latitude: ArrayLike, longitude: ArrayLike) -> NDArray[np.float64]: ...

class Scene(Held):
    def __init__(
        self,
        files: _Path | Sequence[_Path],
        terrain: Terrain,
        without: str | Sequence[str] = (),
    ) -> None: ...
    @staticmethod
    def generate(
        path: _Path,
        origin: str | tuple[float, float] | tuple[float, float, float],
        *,
        # begin: lib/values/generate.py, SceneGeneration
        kind: Literal["airfield", "harbour", "bridge", "town"] = ...,  # kind of scene
        triangles: int = ...,  # 1 to 8000000: approximate number; an instance counts at each use
        seed: int = ...,  # seed; each seed gives another scene
        # end: SceneGeneration
    ) -> str: ...
    @property
    def terrain(self) -> Terrain: ...
    @property
    def triangles(self) -> int: ...
    @property
    def objects(self) -> NDArray[np.void]: ...
