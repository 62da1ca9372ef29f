from collections.abc import Iterable
from os import PathLike
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._core import MOVER as MOVER
from ._core import PATCH_ORDER as PATCH_ORDER
from .arguments import Held
from .places import Scene as Scene
from .places import Terrain as Terrain
from .recordings import Recording as Recording

_Preset = Literal["1996", "draft", "standard", "fine", "reference"]
_Band = Literal["A", "B", "C", "D", "E"]

UNITS: dict[str, str]
MEANINGS: dict[str, str]
ARRAYS: tuple[str, ...]
PATCHES: tuple[str, ...]

class _Picture:
    axes: tuple[str, str]
    @property
    def power(self) -> NDArray[np.float32]: ...
    @property
    def video(self) -> NDArray[np.uint8]: ...
    @property
    def shadow(self) -> NDArray[np.bool_]: ...
    @property
    def layover(self) -> NDArray[np.bool_]: ...
    @property
    def slant_range(self) -> NDArray[np.float64]: ...
    @property
    def ground_range(self) -> NDArray[np.float64]: ...
    @property
    def latitude(self) -> NDArray[np.float64]: ...
    @property
    def longitude(self) -> NDArray[np.float64]: ...
    @property
    def height(self) -> NDArray[np.float32]: ...
    @property
    def grazing_angle(self) -> NDArray[np.float32]: ...
    @property
    def material(self) -> NDArray[np.uint8]: ...
    @property
    def object(self) -> NDArray[np.int32]: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def hash(self) -> int: ...
    @property
    def facts(self) -> dict[str, Any]: ...
    def to_xarray(self, arrays: str | Iterable[str] = ...) -> Any: ...  # xarray.Dataset; xarray may be absent

class Scan(_Picture):
    @property
    def azimuth(self) -> NDArray[np.float64]: ...
    @property
    def sample(self) -> NDArray[np.int64]: ...

class Patch(_Picture):
    @property
    def x(self) -> NDArray[np.float64]: ...
    @property
    def y(self) -> NDArray[np.float64]: ...

class Radar(Held):
    def __init__(
        self,
        preset: _Preset | None = None,
        *,
        config: str | bytes | PathLike[str] | PathLike[bytes] | None = None,
        settings: str = "",
        **knobs: float | bool | str,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def fidelity(self) -> str: ...
    @property
    def map_size(self) -> int: ...
    @property
    def samples(self) -> int: ...
    @property
    def guf(self) -> str: ...
    def scan(
        self,
        terrain: Terrain,
        scene: Scene | None = None,
        *,
        lat: float = ...,
        lon: float = ...,
        alt_ft: float = ...,
        heading: float = ...,
        range_nm: float = ...,
        scan_width: float = ...,
        elevation: float = ...,
        force: bool = False,
        samples: int | None = None,
        gain: int = ...,
        band: _Band = "A",
        channel: int = ...,
        time_s: float = ...,
        threads: int = 1,
        seed: int | None = None,
    ) -> Scan: ...
    def patch(
        self,
        terrain: Terrain,
        scene: Scene | None = None,
        *,
        lat: float = ...,
        lon: float = ...,
        alt_ft: float = ...,
        heading: float = ...,
        speed_kt: float = ...,
        target_lat: float = ...,
        target_lon: float = ...,
        window_nm: float | None = None,
        force: bool = False,
        looks: int | None = None,
        size: int | None = None,
        time_s: float = ...,
        threads: int | None = None,
        seed: int | None = None,
        map: int = 1,
    ) -> Patch: ...
    def patches(
        self,
        terrain: Terrain,
        orders: NDArray[np.void],
        scene: Scene | None = None,
        *,
        movers: NDArray[np.void] | None = None,
        arrays: str | Iterable[str] = ...,
        threads: int = 1,
        force: bool = False,
        min_pixels: int = 0,
    ) -> dict[str, NDArray[Any]]: ...

def trade(
    terrain: Terrain | None = None,
    radar: Radar | None = None,
    *,
    maps: bool = False,
    presets: str | list[str] = "all",
    knob: str | list[str] | None = None,
    base: _Preset = "standard",
    ruler: Literal["reference", "same"] = "reference",
    repeat: int = 5,
    csv: str | bytes | PathLike[str] | None = None,
    out: str | bytes | PathLike[str] | None = None,
    scene: str | list[str] | None = None,
    scan_width: float = ...,
    ruler_samples: int = ...,
    view: str | list[str] | None = None,
    ruler_size: int = ...,
    scene_without: str | list[str] | None = None,
) -> dict[str, Any]: ...
