from collections.abc import Sequence
from os import PathLike

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
        south: int = ...,
        west: int = ...,
        cells_lat: int = ...,
        cells_lon: int = ...,
        level: int = 1,
        seed: int = ...,
        edge: str = "coast",
        culture: bool = True,
        airfields: str = "paved",
        sea: bool = False,
        threads: int = 0,
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
        *,
        origin: str | tuple[float, float] | tuple[float, float, float],
        kind: str = "airfield",
        triangles: int = 20000,
        seed: int = 1,
    ) -> str: ...
    @property
    def terrain(self) -> Terrain: ...
    @property
    def triangles(self) -> int: ...
    @property
    def objects(self) -> NDArray[np.void]: ...
