from collections.abc import Iterable
from os import PathLike
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import NDArray

from ._core import MOVER as MOVER
from ._core import PATCH_ORDER as PATCH_ORDER
from .arguments import Held
from .places import Scene as Scene
from .places import Terrain as Terrain
from .recordings import Recording as Recording

_Preset = Literal["1996", "draft", "standard", "fine", "reference"]

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
        # begin: lib/values/generate.py, ScanRequest
        latitude_deg: float = ...,  # [deg] -90 to 90: latitude of the aircraft
        longitude_deg: float = ...,  # [deg] -180 to 180: longitude of the aircraft
        altitude_ft: float = ...,  # [ft] -3000 to 600000: altitude of the aircraft above mean sea level
        heading_deg: float = ...,  # [deg] -360 to 360: true heading; also the ground track
        range_nm: float = ...,  # [NM] 0.1 to 1000: range of the scan
        width_deg: float = ...,  # [deg] 1 to 120: width of the scan in azimuth
        elevation_deg: float = ...,  # [deg] -90 to 90: antenna elevation above the horizontal
        force: bool = ...,  # allow angles beyond the gimbal limits, and an aircraft below the ground
        samples: int | None = ...,  # 1 to 4096: samples of a sweep; left out: the configuration's
        gain: int = ...,  # 0 to 3: receiver gain
        band: Literal["A", "B", "C", "D", "E"] = ...,  # band of the radar; a jammer acts only in its own bands
        channel: int = ...,  # 1 to 8: frequency channel
        time_s: float = ...,  # [s] 0 to 576460752: sim time of the first sweep, for moving targets
        threads: int = ...,  # 1 to 256: number of threads
        seed: int | None = ...,  # seed of the noise; left out: the configuration's
        speed_kt: float = ...,  # [kt] 0 to 10000: speed over ground, for the number of looks beside the track
        # end: ScanRequest
    ) -> Scan: ...
    def patch(
        self,
        terrain: Terrain,
        scene: Scene | None = None,
        *,
        # begin: lib/values/generate.py, PatchRequest
        latitude_deg: float = ...,  # [deg] -90 to 90: latitude of the aircraft
        longitude_deg: float = ...,  # [deg] -180 to 180: longitude of the aircraft
        altitude_ft: float = ...,  # [ft] -3000 to 600000: altitude of the aircraft above mean sea level
        heading_deg: float = ...,  # [deg] -360 to 360: true heading; also the ground track
        speed_kt: float = ...,  # [kt] 0 to 10000: speed over ground
        target_latitude_deg: float = ...,  # [deg] -90 to 90: latitude of the map's centre
        target_longitude_deg: float = ...,  # [deg] -180 to 180: longitude of the map's centre
        window_nm: float | None = ...,  # [NM] 0.01 to 200: side of the map; left out: the configuration's at power-up
        force: bool = ...,  # ignore the radar's limits; the blind zone stays blank
        looks: int | None = ...,  # 1 to 16: number of looks to average; left out: that of ML1
        # [pixels] 16 to 4096: per side; up to 1024 with the preset reference; left out: the configuration's
        size: int | None = ...,
        time_s: float = ...,  # [s] 0 to 576460752: sim time at the start, for moving targets
        threads: int | None = ...,  # 1 to 256: number of threads; left out: one for each processor
        seed: int | None = ...,  # seed of the noise; left out: the configuration's
        map: int = ...,  # 0 to 4294967295: number of the map; selects the noise together with the seed
        # end: PatchRequest
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

@overload
def trade(
    terrain: Terrain | None = None, radar: Radar | None = None, *, maps: Literal[False] = False,
    csv: str | bytes | PathLike[str] | None = None, out: str | bytes | PathLike[str] | None = None,
        # begin: lib/values/generate.py, ScanTradeRequest
        presets: str | list[str] | None = ...,  # preset names separated by commas, or all, or none; left out: all
        # KNOB=VALUE,VALUE,...: values of one setting of the base; repeatable; left out: none
        knob: str | list[str] | None = ...,
        base: str = ...,  # preset in which a knob changes one setting
        # reference: this preset; same: the reference algorithm with the other settings of each candidate
        ruler: Literal["reference", "same"] = ...,
        # 1 to 1000: timed runs with warm caches; their median counts. Of the reference algorithm one run
        repeat: int = ...,
        # place and range of a scan: LAT,LON,ALT_FT,HDG,RANGE_NM; repeatable; left out: three ranges in the middle of
        # the terrain
        scene: str | list[str] | None = ...,
        width_deg: float = ...,  # [deg] 1 to 120: width of the scan in azimuth
        ruler_samples: int = ...,  # 1 to 4096: samples per sweep of the ruler reference
        # end: ScanTradeRequest
) -> dict[str, Any]: ...
@overload
def trade(
    terrain: Terrain | None = None, radar: Radar | None = None, *, maps: Literal[True],
    csv: str | bytes | PathLike[str] | None = None, out: str | bytes | PathLike[str] | None = None,
        # begin: lib/values/generate.py, MapTradeRequest
        presets: str | list[str] | None = ...,  # preset names separated by commas, or all, or none; left out: all
        # KNOB=VALUE,VALUE,...: values of one setting of the base; repeatable; left out: none
        knob: str | list[str] | None = ...,
        base: str = ...,  # preset in which a knob changes one setting
        # reference: this preset; same: the reference algorithm with the other settings of each candidate
        ruler: Literal["reference", "same"] = ...,
        # 1 to 1000: timed runs with warm caches; their median counts. Of the reference algorithm one run
        repeat: int = ...,
        # OpenFlight file, as FILE or FILE@LAT,LON,HDG; repeatable; left out: the configuration's alone
        scene: str | list[str] | None = ...,
        # name of objects or groups to leave out of scenes, with * and ?; repeatable; left out: none
        scene_without: str | list[str] | None = ...,
        # place and window of a map: LAT,LON,ALT_FT,TARGET_LAT,TARGET_LON,WINDOW_NM; repeatable; left out: three windows
        # in the middle of the terrain
        view: str | list[str] | None = ...,
        ruler_size: int = ...,  # [pixels] 16 to 1024: edge of the map of the ruler reference
        # end: MapTradeRequest
) -> dict[str, Any]: ...
