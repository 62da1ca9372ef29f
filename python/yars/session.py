"""Python client of a running YARS session: calls libyars-client by ctypes. Needs Python 3.9+ and that library: no
NumPy. Without a session: patch_map() makes a patch map by the command `yars patch`.
Inputs to the session: ownship, navigators, events. Outputs: radar state, outputs, sweeps, frames of the display.
Errors: YarsError; MissingPart, an ImportError, if the library is not found. No error means only that a record was sent;
`yars status` shows the refused ones.
Usage: docs/attach.md. A test compares the records here with `yars status --layout`."""
import array
import ctypes
import difflib
import enum
import functools
import json
import math
import pathlib
import struct
import subprocess
import tempfile
import typing

from . import Error, MissingPart, __version__

# begin: lib/values/generate.py
SWEEP_VIDEO_AT, MOST_SAMPLES = 144, 4096

# Records: (name, struct code) in order; names that begin with an underscore are reserved.
CLOCK = [("base_sim_ns", "q"), ("base_monotonic_ns", "q"), ("rate", "d"), ("running", "I"), ("epoch", "I"),
         ("reposition_latitude_deg", "d"), ("reposition_longitude_deg", "d"), ("reposition_altitude_m", "d"),
         ("reposition_heading_deg", "d"), ("followed", "I"), ("_reserved", "4s"), ("reposition_speed_mps", "d"),
         ("_reserved", "16s")]
OWNSHIP = [("source_time_ns", "q"), ("latitude_deg", "d"), ("longitude_deg", "d"), ("altitude_msl_m", "d"),
           ("heading_deg", "d"), ("pitch_deg", "d"), ("roll_deg", "d"), ("velocity_north_mps", "d"),
           ("velocity_east_mps", "d"), ("velocity_down_mps", "d"), ("radar_altitude_m", "d"), ("epoch", "I"),
           ("flags", "I"), ("source", "16s"), ("flight_time_s", "d"), ("_reserved", "24s")]
NAV = [("source_time_ns", "q"), ("mission_latitude_deg", "d"), ("mission_longitude_deg", "d"),
       ("ins_latitude_deg", "d"), ("ins_longitude_deg", "d"), ("velocity_north_mps", "d"), ("velocity_east_mps", "d"),
       ("velocity_down_mps", "d"), ("magnetic_variation_deg", "d"), ("epoch", "I"), ("flags", "I"),
       ("_reserved", "48s")]
INPUT_EVENT = [("session_time_ns", "q"), ("monotonic_ns", "q"), ("x", "d"), ("y", "d"), ("kind", "H"),
               ("argument", "h"), ("number", "I"), ("text", "16s")]
GLASS_FRAME = [("id", "Q"), ("tick", "q"), ("sim_time_ns", "q"), ("width", "I"), ("height", "I"), ("_reserved", "32s")]
SWEEP = [("tick", "q"), ("sim_time_ns", "q"), ("apex_latitude_deg", "d"), ("apex_longitude_deg", "d"),
         ("apex_altitude_msl_m", "d"), ("azimuth_left_deg", "d"), ("azimuth_right_deg", "d"), ("ground_track_deg", "d"),
         ("elevation_deg", "d"), ("range_m", "d"), ("hash", "Q"), ("epoch", "I"), ("scan", "I"), ("number", "I"),
         ("samples", "I"), ("flags", "I"), ("mode", "B"), ("gain", "B"), ("direction", "B"), ("_reserved", "33s")]
OUTPUTS = [("tick", "q"), ("sim_time_ns", "q"), ("cue_latitude_deg", "d"), ("cue_longitude_deg", "d"),
           ("cue_elevation_m", "d"), ("target_latitude_deg", "d"), ("target_longitude_deg", "d"),
           ("target_elevation_m", "d"), ("target_name", "8s"), ("slant_range_m", "d"), ("bearing_deg", "d"),
           ("depression_deg", "d"), ("steering_deg", "d"), ("approach_deg", "d"), ("epoch", "I"), ("cue_count", "I"),
           ("target_count", "I"), ("steering", "B"), ("mark_count", "B"), ("_reserved", "2s"), ("marks", "320s"),
           ("_reserved", "64s")]
MARK = [("latitude_deg", "d"), ("longitude_deg", "d"), ("elevation_m", "d"), ("sim_time_ns", "q")]
CAPTION_LINE = [("text", "48s")]
CAPTION = [("sim_time_ns", "q"), ("step", "I"), ("steps", "I"), ("waiting", "I"), ("_reserved", "4s"), ("title", "48s"),
           ("lines", "144s"), ("_reserved", "64s")]
# Limits of numbers that programs publish: name, least, greatest, whether NaN stands for no value.
OWNSHIP_LIMITS = [("latitude_deg", -90, 90, False), ("longitude_deg", -180, 180, False),
                  ("altitude_msl_m", -1000, 200000, False), ("heading_deg", 0, 360, False),
                  ("pitch_deg", -90, 90, False), ("roll_deg", -180, 180, False),
                  ("velocity_north_mps", -10000, 10000, False), ("velocity_east_mps", -10000, 10000, False),
                  ("velocity_down_mps", -10000, 10000, False), ("radar_altitude_m", 0, 200000, True),
                  ("flight_time_s", 0, 1e10, False)]
NAV_LIMITS = [("mission_latitude_deg", -90, 90, False), ("mission_longitude_deg", -180, 180, False),
              ("ins_latitude_deg", -90, 90, False), ("ins_longitude_deg", -180, 180, False),
              ("velocity_north_mps", -10000, 10000, False), ("velocity_east_mps", -10000, 10000, False),
              ("velocity_down_mps", -10000, 10000, False), ("magnetic_variation_deg", -180, 180, True)]
# The numbers and texts of the radar state: name, offset, struct code; the legends are of 8 characters each.
RADAR_STATE = [("tick", 0, "q"), ("range_nm", 8, "d"), ("scan_width_deg", 16, "d"), ("antenna_elevation_deg", 24, "d"),
               ("cursor_latitude_deg", 32, "d"), ("cursor_longitude_deg", 40, "d"), ("cursor_elevation_m", 48, "d"),
               ("cursor_bearing_deg", 56, "d"), ("cursor_range_nm", 64, "d"), ("tdc_x", 72, "d"), ("tdc_y", 80, "d"),
               ("window_nm", 88, "d"), ("events_applied", 96, "Q"), ("epoch", 104, "I"), ("flags", 108, "I"),
               ("scan_restart", 112, "I"), ("boxed", 116, "I"), ("power", 120, "B"), ("mode", 121, "B"),
               ("master", 122, "B"), ("resume_mode", 123, "B"), ("range_index", 124, "B"), ("scan", 125, "B"),
               ("gain", 126, "B"), ("brightness", 127, "B"), ("contrast", 128, "B"), ("cursor_function", 129, "B"),
               ("navigator", 130, "B"), ("channel", 131, "B"), ("band", 132, "B"), ("points_drawn", 133, "B"),
               ("window_index", 134, "B"), ("recall", 135, "B"), ("sequence_point", 136, "8s"), ("message", 144, "32s"),
               ("message_until_tick", 176, "q"), ("frame_latitude_deg", 672, "d"), ("frame_longitude_deg", 680, "d"),
               ("frame_track_deg", 688, "d"), ("ground_mode", 696, "B"), ("map_request", 700, "I"),
               ("map_latitude_deg", 704, "d"), ("map_longitude_deg", 712, "d"), ("map_window_nm", 720, "d"),
               ("map_newest", 728, "Q"), ("map_old", 736, "Q"), ("map_stored", 744, "Q"), ("map_shown", 752, "Q"),
               ("cursor_believed_latitude_deg", 760, "d"), ("cursor_believed_longitude_deg", 768, "d"),
               ("update_north_m", 856, "d"), ("update_east_m", 864, "d"), ("cursor_moved_tick", 872, "q"),
               ("update_seconds", 880, "i"), ("vtr_request", 884, "I"), ("target_latitude_deg", 888, "d"),
               ("target_longitude_deg", 896, "d"), ("target_elevation_m", 904, "d"), ("target_name", 912, "8s"),
               ("steering_line_deg", 920, "d"), ("cue_latitude_deg", 928, "d"), ("cue_longitude_deg", 936, "d"),
               ("cue_elevation_m", 944, "d"), ("cue_count", 952, "I"), ("target_count", 956, "I"),
               ("steering_line", 960, "B"), ("mark_count", 961, "B"), ("velocity_taken", 964, "I"),
               ("velocity_updated_tick", 968, "q"), ("velocity_shown_until_tick", 976, "q"),
               ("velocity_along_mps", 984, "d"), ("velocity_across_mps", 992, "d"),
               ("velocity_vertical_mps", 1000, "d"), ("magnetic_variation_deg", 1328, "d"),
               ("asked_latitude_deg", 1336, "d"), ("asked_longitude_deg", 1344, "d"), ("asked_tick", 1352, "q"),
               ("asked_for", 1360, "I")]
RADAR_STATE_SIZE, LEGENDS_AT, LEGENDS = 1392, 504, 21


class Event(enum.IntEnum):
    """Kind of the action. input_event.hpp lists the text forms of the kinds."""

    NONE = 0
    PUSH_BUTTON = 1       # argument: 1..20
    TDC = 2               # x right, y up: -1..1, held until changed
    TDC_PRESS = 3
    TDC_RELEASE = 4
    CASTLE_UP = 5
    ACQUISITION = 6       # argument: +1 fwd, -1 aft
    FREEZE = 7
    ELEVATION = 8         # x: [deg] above the horizontal, independent of the elevation before
    ELEVATION_STEP = 9    # argument: steps of 0.5 deg, up positive
    MASTER_MODE = 10      # argument: Master
    RADAR_MODE = 11       # argument: Mode
    POWER = 12            # argument: Power
    NAVIGATOR = 13        # argument: Navigator, or -1 to toggle
    SEQUENCE_POINT = 14   # text: name of the sequence point
    ALTIMETER = 15        # argument: 1 the radar altimeter works, 0 it has failed
    CONTRAST = 16         # argument: +1 up, -1 down
    NAVIGATOR_ERROR = 17  # by the instructor; argument: Navigator; x, y: [ft] position error north, east
    NAVIGATOR_DRIFT = 18  # by the instructor; argument: Navigator; x, y: [ft/s] velocity error north, east
    NEXT = 19             # asks a tour that waits for the pilot to go on
    CURSOR = 20           # x right, y down: [0, 1] position on the display, from its upper left corner


class Power(enum.IntEnum):
    OFF = 0
    STANDBY = 1
    OPERATE = 2


class Mode(enum.IntEnum):
    RBM = 0
    HRM = 1
    PATCH = 2
    BEACON = 3
    PVU = 4
    AIR_TO_AIR = 5
    RANGING = 6
    MENU = 7


class Master(enum.IntEnum):
    AIR_TO_GROUND = 0
    AIR_TO_AIR = 1
    RANGING = 2


class ScanWidth(enum.IntEnum):
    FULL = 0
    HALF = 1
    QUARTER = 2


class CursorFunction(enum.IntEnum):
    MAP = 0
    UPDATE = 1
    CUE = 2
    TARGET = 3
    MARK = 4


class Navigator(enum.IntEnum):
    MISSION = 0
    INS = 1


class PointKind(enum.IntEnum):
    STEER = 0
    INITIAL = 1
    TARGET = 2
    STEER_OFFSET = 3
    TARGET_OFFSET = 4


class Recall(enum.IntEnum):
    NONE = 0
    NEWEST = 1
    OLD = 2
    STORE = 3


class SteeringLine(enum.IntEnum):
    NONE = 0
    LINE_OF_SIGHT = 1
    SLEWING = 2
    FIXED = 3


class SteeringCommand(enum.IntEnum):
    NONE = 0
    AZIMUTH = 1
    BANK = 2


class RadarFlags(enum.IntFlag):
    """Bits of RadarState::flags."""

    DECLUTTER = 1
    FREEZE = 2                      # frozen by the pilot, by SNIFF in HRM or by leaving HRM; the scan stops at its end
    SNIFF = 4
    IPVU = 8
    VTR = 16
    SET = 32
    MENU = 64
    MULTI_LOOK2 = 128
    PROGRESSIVE = 256               # PROG; else STAB
    ALTIMETER_FAILED = 512
    CURSOR_VALID = 1024
    TDC_PRESSED = 2048
    FROZEN_BY_HRM_EXIT = 4096       # leaving a high resolution mode froze the picture
    RANGE_SET = 8192                # since power-up a range was selected, by height or by the pilot
    MAPPING = 16384                 # a map was commanded and is not complete
    UPDATE_SHOWN = 32768            # update_north_m and update_east_m are valid
    UPDATE_INVALID = 65536          # INV: the cursor's position is too old for an INS update
    TARGET_DESIGNATED = 131072
    VELOCITY_SHOWN = 262144         # velocity_along_mps, velocity_across_mps and velocity_vertical_mps are valid
    MAP_WINDOW_BLANK = 524288       # no window was selected; the range selected map_window_nm
    RECALLED_BY_HRM_EXIT = 1048576  # leaving a high resolution mode recalled the newest map
    VARIATION_KNOWN = 2097152       # magnetic_variation_deg is known; else it is 0, and bearings count from true north


class SweepFlags(enum.IntFlag):
    BLANK = 1       # no video: the sweep is beyond the gimbal limits, or the ownship is invalid
    NOISE_ONLY = 2  # SNIFF: receiver noise and jamming, no returns
    SCAN_START = 4  # first sweep of its scan
    SCAN_END = 8    # last sweep of its scan
    NOT_READY = 16  # terrain or scenes were not loaded completely, or not in the wanted detail


class ModelFlags(enum.IntFlag):
    FROZEN = 1  # the scan has stopped at its end
    SCANNING = 2
    STALE = 4   # no fresh ownship


class OwnshipFlags(enum.IntFlag):
    ON_GROUND = 1


class NavFlags(enum.IntFlag):
    ATTITUDE_INVALID = 1  # the display crosses out the pitch ball, its symbol of the aircraft's pitch
    # the attitude is that of the attitude and heading reference system: the pitch ball is square instead of round
    ATTITUDE_FROM_AHRS = 2
# end: lib/values/generate.py

_ARGUMENT = -2  # YARS_CLIENT_ARGUMENT of yars_client.h
# Expected values by struct code, for messages.
EXPECTED = {"d": "a number", "q": "a whole number of 64 bits", "Q": "a whole number of 64 bits, 0 or more",
            "I": "a whole number 0 to 4294967295", "H": "a whole number 0 to 65535", "B": "a whole number 0 to 255",
            "h": "a whole number -32768 to 32767"}  # covers the codes of OWNSHIP, NAV and INPUT_EVENT


class YarsError(Error):
    """Its message says what is wrong, mostly with the expected value, the found one and a remedy."""


class Refused(YarsError, ValueError):
    """A value that a record does not take, or a call of a session after close(); also a ValueError."""


class UnknownField(YarsError, KeyError):
    """A field that a record does not have; also a KeyError."""
    __str__ = Exception.__str__


def meant(name, names):
    """"did you mean 'latitude_deg'?", or where the names are listed."""
    near = difflib.get_close_matches(str(name), names, 1)
    # The beginning of one name, as `latitude` of latitude_deg, is not near by its letters.
    near = near or [known for known in names if known.startswith(str(name)) and name][:1]
    return f"did you mean '{near[0]}'?" if near else "see yars_records.h"


class Record(dict):
    """The fields of a record by name. A field that the record does not have is an error that names the nearest one."""

    def __missing__(self, name):
        raise UnknownField(f"expected a field of {', '.join(self)}, found {name!r}; {meant(name, self)}")

    def __getattr__(self, name):
        field = name if name in self else (difflib.get_close_matches(name, self, 1) or [None])[0]
        how = f"write record['{field}']" if field else "the fields of a record are items: record['NAME']"
        raise AttributeError(f"expected a method of dict, found {name!r}; {how}")


def code_of(fields):
    return "<" + "".join(code for _, code in fields)


def text_bytes(what, text, size):
    """The bytes of a text (str or bytes) for a field of `size` bytes, which also holds a terminating zero."""
    found = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    if not isinstance(found, (bytes, bytearray)) or len(found) >= size or any(not 32 <= byte <= 126 for byte in found):
        raise Refused(f"{what}: expected a text of at most {size - 1} printable ASCII characters, found {text!a}; "
                      "give a str or bytes")
    return bytes(found)


def text_of(field):
    """The text in a field of bytes, which ends before the first zero byte."""
    return field.split(b"\0")[0].decode("ascii", "replace")


def pack(what, fields, values):
    """The bytes of a record; fields without a value are 0. An unknown name or a value of another type is an error,
    because a misspelt latitude would put the aircraft on the equator."""
    names = [name for name, _ in fields if not name.startswith("_")]
    for name in values:
        if name not in names:
            raise YarsError(f"{what}: expected fields of {', '.join(names)}, found {name!r}; {meant(name, names)}")
    parts = []
    for name, code in fields:
        value = values.get(name, b"" if code.endswith("s") else 0)
        if code.endswith("s"):
            value = text_bytes(f"{what}: {name}", value, int(code[:-1]))
        try:
            parts.append(struct.pack("<" + code, value))
        except (struct.error, OverflowError):
            raise Refused(f"{what}: {name}: expected {EXPECTED[code]}, found {value!r}; see yars_records.h") from None
    return b"".join(parts)


def check_limits(what, limits, values):
    """Refuses numbers beyond their limits, which the reader of the record would refuse without a word to its writer."""
    for name, least, greatest, may_be_nan in limits:
        value = values.get(name, 0.0)
        if isinstance(value, bool):
            raise Refused(f"{what}: {name}: expected a number, found {value}")
        if not isinstance(value, (int, float)) or least <= value <= greatest or (may_be_nan and math.isnan(value)):
            continue  # pack() refuses other types
        raise Refused(f"{what}: {name}: expected a number from {least} to "
                      f"{greatest}{', or NaN' if may_be_nan else ''}, found {value!r}")


def unpack(fields, record):
    return Record({name: value for (name, _), value in zip(fields, struct.unpack(code_of(fields), record))
                   if not name.startswith("_")})


def patch_map(yars: "str | pathlib.Path" = "yars", **options: typing.Any) -> "tuple[Record, array.array]":
    """facts, power = patch_map(lat=37.45, lon=-122.65, target_lat=37.51, target_lon=-122.45, size=4096): a patch map
    without a session. `options` are those of `yars patch` with _ for -; True for a flag, a list for a repeated option,
    None or False for an option that is not given.
    `facts` is the command's JSON. `power` has facts["size"] rows of as many floats, the far edge first: gamma of level
    ground before speckle and noise, -1 in the blind zone. `yars`: the program."""
    for name in set(options) & {"out", "pixels", "json", "help"}:
        raise YarsError(f"patch_map: expected an option of `yars patch` other than {name!r}; the map is returned")
    words = [f"--{name.replace('_', '-')}" + ("" if value is True else f"={value}") for name, values in options.items()
             for value in (values if isinstance(values, (list, tuple)) else [values])
             if value is not None and value is not False]
    if not isinstance(yars, (str, pathlib.Path)):
        raise YarsError(f"patch_map: expected the path of the program yars, found {yars!r}; give yars=PATH")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "map.f32"
        try:
            # --out comes first. So an option that lacks its value cannot take it.
            done = subprocess.run([yars, "patch", "--json", "--out", str(path), *words], capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL)
        except OSError as problem:
            raise YarsError(f"{yars}: expected the program yars, found: {problem.strerror}; give yars=PATH") from None
        except ValueError as problem:
            raise YarsError(f"patch_map: expected options that a command line can have, found: {problem}") from None
        if done.returncode != 0:
            raise YarsError(done.stderr.strip() or f"yars patch: ended with code {done.returncode}")
        power = array.array("f")
        try:
            facts = Record(json.loads(done.stdout))
            power.frombytes(path.read_bytes())
        except (OSError, ValueError):
            raise YarsError(f"{yars}: expected the program yars, found one that makes no map; give yars=PATH") from None
    return facts, power


class _Cursor(ctypes.Structure):  # yars_client_cursor
    _fields_ = [("next", ctypes.c_uint64), ("lost", ctypes.c_uint64), ("begun", ctypes.c_uint64)]


@functools.cache
def _library():
    """libyars-client of this version: beside the package, in a build of the sources, in the prefix of the package, or
    where the system looks. PyDLL keeps Python's other threads waiting:
    calls are short, and one session serves one thread at a time."""
    name = f"libyars-client.so.{__version__.rpartition('.')[0]}"
    here = pathlib.Path(__file__).absolute()  # in a build tree a link, which is not followed
    places = [here.with_name(name)]
    if here.parents[1].name == "python":
        places += sorted((here.parents[2] / "build").glob(f"*/python/yars/{name}"),
                         key=lambda path: path.parts[-4] != "release")
    if len(here.parents) > 3 and here.parents[3].name == "lib":
        places += [here.parents[3] / name, *sorted(here.parents[3].glob(f"*-linux-gnu/{name}"))]
    found = []
    for place in [*filter(pathlib.Path.is_file, places), name]:
        try:
            library = ctypes.PyDLL(str(place))
        except OSError as problem:
            found.append(str(problem))
            continue
        library.yars_client_error.restype = ctypes.c_char_p
        library.yars_client_sim_time_ns.restype = ctypes.c_int64
        library.yars_client_epoch.restype = ctypes.c_uint32
        return library
    raise MissingPart(f"yars.session: expected the library {name}, found: {'; '.join(found)}; "
                      "install the Debian package yars; of a checkout build the target yars_client_library")


class Session:
    """with Session("default", "my-program") as session: ..."""

    sweeps_lost: int
    lane: typing.Any  # number, or None while none is claimed; so are these
    input_lane: typing.Any
    next_sweep: typing.Any

    def __init__(self, name: str = "default", program: str = "python") -> None:
        for what, given in (("session", name), ("program", program)):
            if not isinstance(given, str):
                raise TypeError(f"yars.Session: {what}: expected a str, found {given!r}")
        shown = text_bytes("program", program[:23], 24)
        self.lane = self.input_lane = self.next_sweep = None
        self.sweeps_lost = 0
        self._cursor = _Cursor()
        self._handle = ctypes.c_void_p()
        # Escaped, because C reads a name up to its first zero.
        self._result(_library().yars_client_attach(name.encode("unicode_escape"), shown, ctypes.byref(self._handle)))

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Withdraws what was published, releases all lanes and detaches. The last process that detaches removes the
        segment. Other methods are a ValueError from then on; a second close() does nothing."""
        _library().yars_client_detach(self._handle)
        self.__class__ = _ClosedSession

    def set_runs(self) -> bool:
        """True while radar-model or state-machine is attached, even if stopped or hanging. False for a short time if
        both were killed, until the set restarts them. When it is False, close this Session and make a new one:
        a set that starts later may have another segment."""
        return bool(self._call("set_runs"))

    # ---- time
    def clock(self) -> "Record | None":
        return self._read("clock", CLOCK)

    def epoch(self) -> int:
        return self._call("epoch")

    def sim_time_ns(self) -> int:
        return _library().yars_client_sim_time_ns(self._handle)

    def heartbeat(self) -> None:
        """Shows in `yars status` that this program is alive. Call it about once a second."""
        self._call("heartbeat")

    # ---- writing
    def claim_ownship_lane(self, priority: int) -> None:
        """Claims a lane. The radar uses the lane with the highest priority among those with fresh records. The flight
        models of YARS have priority 10."""
        if not isinstance(priority, int) or not 0 <= priority <= 0xFFFFFFFF:
            raise YarsError(f"claim_ownship_lane: priority: expected {EXPECTED['I']}, found {priority!r}; take 50")
        self.lane = self._call("claim_ownship", ctypes.c_uint32(priority))

    def publish_ownship(self, **values: typing.Any) -> None:
        """Publishes the record Ownship (fields: yars_records.h). Call it 20 to 100 times a second.
        Defaults: radar_altitude_m NaN (no radar altimeter), epoch of the session, other fields 0. A number beyond the
        limits of its field, or NaN elsewhere, is a ValueError."""
        self._needs(self.lane, "publish_ownship", "an ownship lane", "claim_ownship_lane(priority)")
        values = {"epoch": self.epoch(), "radar_altitude_m": math.nan, **values}
        check_limits("publish_ownship", OWNSHIP_LIMITS, values)
        self._call("publish_ownship", pack("publish_ownship", OWNSHIP, values))

    def publish_nav(self, **values: typing.Any) -> None:
        """Publishes the record Nav: positions and velocity of the navigators. Without it the navigators have no error.
        Defaults: magnetic_variation_deg NaN (the configuration's), epoch of the session, other fields 0."""
        self._needs(self.lane, "publish_nav", "an ownship lane", "claim_ownship_lane(priority)")
        values = {"epoch": self.epoch(), "magnetic_variation_deg": math.nan, **values}
        check_limits("publish_nav", NAV_LIMITS, values)
        self._call("publish_nav", pack("publish_nav", NAV, values))

    def claim_input_lane(self, source: "str | bytes") -> None:
        """Claims a free and empty input lane. `source`: name of the sender, at most 23 characters."""
        self.input_lane = self._call("claim_input", text_bytes("claim_input_lane: source", source, 24))

    def push_event(self, kind: int, argument: int = 0, x: float = 0.0, y: float = 0.0,
                   text: "str | bytes" = "") -> None:
        """Sends an input event. `kind`: an Event, which names the argument.
        Example: push_event(Event.PUSH_BUTTON, 13)."""
        self._needs(self.input_lane, "push_event", "an input lane", "claim_input_lane(source)")
        values = {"x": x, "y": y, "kind": kind, "argument": argument, "text": text}
        self._call("push_event", pack("push_event", INPUT_EVENT, values))

    # ---- reading
    def radar_state(self) -> "Record | None":
        """Dict of the numbers and texts of the record RadarState (yars_records.h), such as mode
        and range. `legends`: list of the legends, with that of button n at index n. None before the first record."""
        record = self._read_bytes("radar_state", RADAR_STATE_SIZE)
        if record is None:
            return None
        state = {name: struct.unpack_from("<" + code, record, at)[0] for name, at, code in RADAR_STATE}
        state = Record({name: text_of(value) if isinstance(value, bytes) else value for name, value in state.items()})
        state["legends"] = [text_of(record[LEGENDS_AT + 8 * i:LEGENDS_AT + 8 * i + 8]) for i in range(LEGENDS)]
        return state

    def outputs(self) -> "Record | None":
        """Dict of the record Outputs (yars_records.h): what the radar reports to the rest of the
        aircraft. Cue; designated target with ranging and steering (NaN: no target); `marks`, a list of dicts, oldest
        first. The elevation of a point is NaN while it is unknown. None before the first record."""
        outputs = self._read("outputs", OUTPUTS)
        if outputs is None:
            return None
        outputs["target_name"] = text_of(outputs["target_name"])
        size = struct.calcsize(code_of(MARK))
        records = (outputs["marks"][size * i:size * (i + 1)] for i in range(outputs["mark_count"]))
        outputs["marks"] = [unpack(MARK, record) for record in records if len(record) == size]
        return outputs

    def caption(self) -> "Record | None":
        """Dict of the record Caption (yars_records.h) of the tour that runs; `lines` is a list of
        texts. None while no tour runs, or while it shows no caption."""
        caption = self._read("caption", CAPTION)
        if caption is None:
            return None
        size = struct.calcsize(code_of(CAPTION_LINE))
        lines = [text_of(caption["lines"][at:at + size]) for at in range(0, len(caption["lines"]), size)]
        return Record({**caption, "title": text_of(caption["title"]), "lines": [line for line in lines if line]})

    def sweeps(self) -> "list[Record]":
        """List of the sweeps since the last call, oldest first. The first call returns all sweeps in the segment, those
        of the last seconds. Each is a dict of the record Sweep with `video`: bytes from near to far, 0 black to 255
        white. Sweeps that were overwritten before they could be read are counted in session.sweeps_lost."""
        found = []
        record = ctypes.create_string_buffer(SWEEP_VIDEO_AT + MOST_SAMPLES)
        while self._call("read_sweep", ctypes.byref(self._cursor), record):
            sweep = unpack(SWEEP, record[:SWEEP_VIDEO_AT])
            sweep["video"] = record[SWEEP_VIDEO_AT:SWEEP_VIDEO_AT + sweep["samples"]]
            found.append(sweep)
        self.next_sweep, self.sweeps_lost = self._cursor.next, self._cursor.lost
        return found

    def newest_frame(self, after: int = 0) -> "tuple[Record, bytes] | None":
        """(frame, pixels) of a display started with --publish. None if there is no frame, or if the id of the newest
        frame is `after`. `frame`: dict of the record GlassFrame; pass its "id" as `after` of the next call. `pixels`:
        rows from the top; 4 bytes per pixel: red, green, blue, 255."""
        record = ctypes.create_string_buffer(struct.calcsize(code_of(GLASS_FRAME)))
        pixels = ctypes.c_void_p()
        if not self._call("read_frame", ctypes.c_uint64(after), record, ctypes.byref(pixels)):
            return None
        frame = unpack(GLASS_FRAME, record.raw)
        return frame, ctypes.string_at(pixels, 4 * frame["width"] * frame["height"])

    # ---- the library
    def _call(self, function, *arguments):
        return self._result(getattr(_library(), "yars_client_" + function)(self._handle, *arguments))

    @staticmethod
    def _result(code):
        """What a function of the library returned, if it is no failure."""
        if code >= 0:
            return code
        error = Refused if code == _ARGUMENT else YarsError
        raise error(_library().yars_client_error().decode("utf-8", "replace"))

    def _needs(self, lane, what, expected, remedy):
        if lane is None:
            raise YarsError(f"{what}: expected {expected}, found none; call {remedy} first")

    def _read_bytes(self, what, size):
        record = ctypes.create_string_buffer(size)
        return record.raw if self._call("read_" + what, record) else None

    def _read(self, what, fields):
        record = self._read_bytes(what, struct.calcsize(code_of(fields)))
        return unpack(fields, record) if record is not None else None


class _ClosedSession(Session):
    """A session after close()."""

    def __getattribute__(self, name):
        if name.startswith("__") or name == "close" or name in object.__getattribute__(self, "__dict__"):
            return object.__getattribute__(self, name)
        raise Refused(f"session: {name}: expected an open session, found one after close(); make a new Session")

    def __enter__(self):
        raise Refused("session: expected an open session, found one after close(); make a new Session")

    def close(self):
        pass
