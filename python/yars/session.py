"""Python client of a running YARS session, the counterpart of yars.h. Needs Python 3.9+ alone: no NumPy, no compiled part.
Without a session: patch_map() makes a patch map by the command `yars patch`.
Inputs to the session: ownship, navigators, events. Outputs: radar state, outputs, sweeps, frames of the display.
Errors: YarsError. No error means only that a record was sent; `yars status` shows the refused ones.
Platform: Linux on x86-64, where a store of an aligned 64-bit word is atomic and stores stay in order.
Usage: docs/attach.md. Segment: docs/shared_memory.md. A test compares all offsets here with `yars status --layout`."""
import array
import difflib
import enum
import fcntl
import json
import math
import mmap
import os
import pathlib
import re
import stat
import struct
import subprocess
import tempfile
import time
import typing

from . import Error

MAGIC, LINE, SLOTS = 0x314D485353524159, 64, 4
# begin: lib/values/generate.py
VERSION, SIZE, HASH = 3, 27471872, 0xEB33F49407411935
AT_CLOCK, AT_OWNSHIP_PRIORITY, AT_OWNSHIP, AT_NAV = 448, 1024, 1088, 4416
AT_RADAR_STATE, AT_MODEL_STATUS, AT_OUTPUTS, AT_SWEEPS = 7744, 13440, 16320, 543680
AT_INPUT, AT_PROCESSES, AT_TRAFFIC, AT_FRAMES, AT_CAPTION = 4934656, 5051392, 13587584, 13840128, 26423936
FRAMES, FRAME_STRIDE, FRAME_WORDS, FRAME_PIXELS, MOST_FRAME_BYTES = 3, 4194376, 8, 72, 4194304
SWEEPS, SWEEP_STRIDE, MOST_SAMPLES = 1024, 4288, 4096
RADAR_MODEL_BYTE, STATE_MACHINE_BYTE, TRAFFIC_BYTE, TOUR_BYTE, FIRST_OWNSHIP_BYTE = 1, 2, 5, 7, 8
FIRST_INPUT_BYTE, FIRST_PROCESS_BYTE, OWNSHIP_LANES, INPUT_LANES, PROCESSES = 16, 32, 4, 16, 32
INPUT_DEPTH = 128
LATEST_PICTURE_ID, PROCESS_STRIDE = 9007199254740992, 40
INPUT_STRIDE, INPUT_POPPED, INPUT_RECORDS = 7296, 64, 128
SWEEP_VIDEO_AT = 144

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
        raise Refused(f"{what}: {name}: expected a number from {least} to {greatest}{', or NaN' if may_be_nan else ''}, found {value!r}")


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
        if not re.fullmatch("[0-9A-Za-z_][0-9A-Za-z_-]{0,39}", name):
            raise Refused(f"session: expected 1 to 40 letters, digits, '-' or '_', and no '-' at the front, found {name!a}")
        self.path = f"/dev/shm/yars.{os.geteuid()}.{name}"
        remedy = (f"start the set with --session {name}, or give the name of a session that runs "
                  "(`yars --session NAME status`)")
        try:
            self.descriptor = os.open(self.path, os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW)
        except FileNotFoundError:
            raise YarsError(f"{self.path}: no such session runs; {remedy}") from None
        except OSError as problem:
            raise YarsError(f"{self.path}: expected a segment, found: {problem.strerror}") from None
        status = os.fstat(self.descriptor)
        if not stat.S_ISREG(status.st_mode) or status.st_uid != os.geteuid():
            os.close(self.descriptor)
            raise YarsError(f"{self.path}: expected a file of this user")
        # The write lock on byte 0 is free only if no process is attached.
        if self._lock(0, fcntl.F_WRLCK):
            os.close(self.descriptor)
            raise YarsError(f"{self.path}: a leftover: its programs have died; {remedy}")
        if not self._lock(0, fcntl.F_RDLCK) or not self._is_at_path():
            os.close(self.descriptor)
            raise YarsError(f"{self.path}: it is just ending; try again")
        size = os.fstat(self.descriptor).st_size
        self.memory = mmap.mmap(self.descriptor, size)
        self.words = memoryview(self.memory).cast("Q")
        found = (self.words[0], self.words[1], self.words[2], self.words[3] & 0xFFFFFFFF)
        self.lane = self.input_lane = self.process = None
        self.events = 0
        self.next_sweep = None
        self.sweeps_lost = 0
        if found != (MAGIC, SIZE, HASH, VERSION):
            self.close()
            raise YarsError(f"{self.path}: expected layout version {VERSION}, hash {HASH:016x}, found version "
                            f"{found[3]}, hash {found[2]:016x}; take the Python package yars of its build")
        self.process = self._claim(FIRST_PROCESS_BYTE, PROCESSES)
        if self.process is not None:
            entry = AT_PROCESSES + PROCESS_STRIDE * self.process
            self._store(entry + 16, shown.ljust(24, b"\0"))
            self.heartbeat()
            self.words[(entry + 8) // 8] = os.getpid()

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Releases all lanes and detaches. The last process that detaches removes the segment. Other methods are a ValueError
        from then on; a second close() does nothing."""
        if self.lane is not None:
            for at in (self._ownship_at(), self._nav_at()):
                self.words[at // 8] = ((self.words[at // 8] >> 1) + 1) << 1
            self._release(FIRST_OWNSHIP_BYTE + self.lane)
        if self.input_lane is not None:
            self._release(FIRST_INPUT_BYTE + self.input_lane)
        if self.process is not None:
            self.words[(AT_PROCESSES + PROCESS_STRIDE * self.process + 8) // 8] = 0
            self._release(FIRST_PROCESS_BYTE + self.process)
        self._lock(0, fcntl.F_UNLCK)
        if self._lock(0, fcntl.F_WRLCK) and self._is_at_path():
            os.unlink(self.path)
        self.words.release()
        self.memory.close()
        os.close(self.descriptor)
        self.__class__ = _ClosedSession

    def set_runs(self) -> bool:
        """True while radar-model or state-machine is attached, even if stopped or hanging. False for a short time if
        both were killed, until the set restarts them. When it is False, close this Session and make a new one:
        a set that starts later may have another segment."""
        return self._is_held(RADAR_MODEL_BYTE) or self._is_held(STATE_MACHINE_BYTE)

    # ---- time
    def clock(self) -> "Record | None":
        return self._read(AT_CLOCK, CLOCK)

    def epoch(self) -> int:
        clock = self.clock()
        return clock["epoch"] if clock else 0

    def sim_time_ns(self) -> int:
        clock = self.clock()
        if not clock or not clock["running"]:
            return clock["base_sim_ns"] if clock else 0
        return clock["base_sim_ns"] + int(clock["rate"] * (time.monotonic_ns() - clock["base_monotonic_ns"]))

    def heartbeat(self) -> None:
        """Shows in `yars status` that this program is alive. Call it about once a second."""
        if self.process is not None:
            self.words[(AT_PROCESSES + PROCESS_STRIDE * self.process) // 8] = time.monotonic_ns()

    # ---- writing
    def claim_ownship_lane(self, priority: int) -> None:
        """Claims a lane. The radar uses the lane with the highest priority among those with fresh records. The flight
        models of YARS have priority 10."""
        if not isinstance(priority, int) or not 0 <= priority <= 0xFFFFFFFF:
            raise YarsError(f"claim_ownship_lane: priority: expected {EXPECTED['I']}, found {priority!r}; take 50")
        self.lane = self._claim(FIRST_OWNSHIP_BYTE, OWNSHIP_LANES)
        if self.lane is None:
            raise YarsError("ownship lane: all are taken; `yars status` names the holders")
        for at in (self._ownship_at(), self._nav_at()):
            self.words[at // 8] = ((self.words[at // 8] >> 1) + 1) << 1
        at = AT_OWNSHIP_PRIORITY + 4 * self.lane
        self.memory[at:at + 4] = struct.pack("<I", priority)

    def publish_ownship(self, **values: typing.Any) -> None:
        """Publishes the record Ownship (fields: yars_records.h). Call it 20 to 100 times a second.
        Defaults: radar_altitude_m NaN (no radar altimeter), epoch of the session, other fields 0. A number beyond the limits
        of its field, or NaN elsewhere, is a ValueError."""
        self._needs(self.lane, "publish_ownship", "an ownship lane", "claim_ownship_lane(priority)")
        values = {"epoch": self.epoch(), "radar_altitude_m": math.nan, **values}
        check_limits("publish_ownship", OWNSHIP_LIMITS, values)
        self._publish("publish_ownship", self._ownship_at(), OWNSHIP, values)

    def publish_nav(self, **values: typing.Any) -> None:
        """Publishes the record Nav: positions and velocity of the navigators. Without it the navigators have no error.
        Defaults: magnetic_variation_deg NaN (the configuration's), epoch of the session, other fields 0."""
        self._needs(self.lane, "publish_nav", "an ownship lane", "claim_ownship_lane(priority)")
        values = {"epoch": self.epoch(), "magnetic_variation_deg": math.nan, **values}
        check_limits("publish_nav", NAV_LIMITS, values)
        self._publish("publish_nav", self._nav_at(), NAV, values)

    def claim_input_lane(self, source: "str | bytes") -> None:
        """Claims a free and empty input lane. `source`: name of the sender, at most 23 characters."""
        name = text_bytes("claim_input_lane: source", source, 24)
        for lane in range(INPUT_LANES):
            if self._claim(FIRST_INPUT_BYTE + lane, 1) is None:
                continue
            at = AT_INPUT + lane * INPUT_STRIDE
            if self.words[at // 8] == self.words[(at + INPUT_POPPED) // 8]:
                self._store(at + 24, name.ljust(24, b"\0"))
                self.input_lane = lane
                return
            self._release(FIRST_INPUT_BYTE + lane)
        raise YarsError("input lane: all are taken; `yars status` names the sources")

    def push_event(self, kind: int, argument: int = 0, x: float = 0.0, y: float = 0.0, text: "str | bytes" = "") -> None:
        """Sends an input event. `kind`: an Event, which names the argument. Example: push_event(Event.PUSH_BUTTON, 13)."""
        self._needs(self.input_lane, "push_event", "an input lane", "claim_input_lane(source)")
        record = pack("push_event", INPUT_EVENT, {
            "session_time_ns": self.sim_time_ns(), "monotonic_ns": time.monotonic_ns(), "x": x, "y": y, "kind": kind,
            "argument": argument, "number": self.events + 1, "text": text})
        at = AT_INPUT + self.input_lane * INPUT_STRIDE
        number = self.words[at // 8]
        if number - self.words[(at + INPUT_POPPED) // 8] >= INPUT_DEPTH:
            self.words[at // 8 + 1] += 1
            raise YarsError("input lane: full; check with `yars status` that state-machine runs")
        self.events += 1
        self._store(at + INPUT_RECORDS + number % INPUT_DEPTH * 56, record)
        self.words[at // 8] = number + 1

    # ---- reading
    def radar_state(self) -> "Record | None":
        """Dict of the numbers and texts of the record RadarState (yars_records.h), such as mode
        and range. `legends`: list of the legends, with that of button n at index n. None before the first record."""
        record = self._read_bytes(AT_RADAR_STATE, RADAR_STATE_SIZE)
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
        outputs = self._read(AT_OUTPUTS, OUTPUTS)
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
        caption = self._read(AT_CAPTION, CAPTION) if self._is_held(TOUR_BYTE) else None
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
        end = self.words[AT_SWEEPS // 8]
        if self.next_sweep is None:
            self.next_sweep = max(0, end - SWEEPS + 1)
        begin = min(max(self.next_sweep, end - SWEEPS), end)
        self.sweeps_lost += max(0, begin - self.next_sweep)
        self.next_sweep = begin
        while self.next_sweep < end:
            slot = (AT_SWEEPS + LINE + self.next_sweep % SWEEPS * SWEEP_STRIDE) // 8
            whole = 2 * self.next_sweep + 2
            record = b""
            if self.words[slot] == whole:
                used = min(self.words[slot + 1], (SWEEP_VIDEO_AT + MOST_SAMPLES) // 8)
                record = bytes(self.words[slot + 2:slot + 2 + used])
            if len(record) >= SWEEP_VIDEO_AT and self.words[slot] == whole:
                sweep = unpack(SWEEP, record[:SWEEP_VIDEO_AT])
                sweep["video"] = record[SWEEP_VIDEO_AT:SWEEP_VIDEO_AT + sweep["samples"]]
                found.append(sweep)
            else:
                self.sweeps_lost += 1
            self.next_sweep += 1
        return found

    def newest_frame(self, after: int = 0) -> "tuple[Record, bytes] | None":
        """(frame, pixels) of a display started with --publish. None if there is no frame, or if the id of the newest
        frame is `after`. `frame`: dict of the record GlassFrame; pass its "id" as `after` of the next call. `pixels`:
        rows from the top; 4 bytes per pixel: red, green, blue, 255."""
        for _ in range(8):
            offsets = [AT_FRAMES + i * FRAME_STRIDE for i in range(FRAMES)]
            ids = [self.words[offset // 8] for offset in offsets]
            number = max((i for i in ids if i <= LATEST_PICTURE_ID), default=0)
            if number in (0, after):
                return None
            at = offsets[ids.index(number)]
            frame = unpack(GLASS_FRAME, self.memory[at + 8:at + 72])
            size = min(4 * frame["width"] * frame["height"], FRAME_STRIDE - FRAME_PIXELS)
            pixels = self.memory[at + FRAME_PIXELS:at + FRAME_PIXELS + size]
            if self.words[at // 8] == number and frame["id"] == number:
                return frame, pixels
        return None

    # ---- the containers
    def _ownship_at(self):
        return AT_OWNSHIP + self.lane * value_size(OWNSHIP)

    def _nav_at(self):
        return AT_NAV + self.lane * value_size(NAV)

    def _store(self, at, record):
        for i, (word,) in enumerate(struct.iter_unpack("<Q", record)):
            self.words[at // 8 + i] = word

    def _needs(self, lane, what, expected, remedy):
        if lane is None:
            raise YarsError(f"{what}: expected {expected}, found none; call {remedy} first")

    def _publish(self, what, at, fields, values):
        record = pack(what, fields, values)
        version = (self.words[at // 8] >> 1) + 1
        slot = (at + LINE + version % SLOTS * slot_stride(fields)) // 8
        odd = (self.words[slot] + 1) | 1
        self.words[slot] = odd
        self.words[slot + 1] = version
        self._store(8 * (slot + 2), record)
        self.words[slot] = odd + 1
        self.words[at // 8] = version << 1 | 1

    def _read_bytes(self, at, size):
        stride = (size + 16 + LINE - 1) // LINE * LINE
        for _ in range(9):
            state = self.words[at // 8]
            if state & 1 == 0:
                return None
            slot = (at + LINE + (state >> 1) % SLOTS * stride) // 8
            before = self.words[slot]
            if before % 2 or self.words[slot + 1] != state >> 1:
                continue
            record = bytes(self.words[slot + 2:slot + 2 + size // 8])
            if self.words[slot] == before:
                return record
        return None

    def _read(self, at, fields):
        record = self._read_bytes(at, struct.calcsize(code_of(fields)))
        return unpack(fields, record) if record is not None else None

    # ---- locks of the open file description: the kernel releases them when this program ends
    def _lock(self, byte, kind):
        try:
            fcntl.fcntl(self.descriptor, fcntl.F_OFD_SETLK, struct.pack("@hhqqi0q", kind, os.SEEK_SET, byte, 1, 0))
            return True
        except OSError:
            return False

    def _is_held(self, byte):
        """True if another open file description holds the lock of this byte."""
        query = struct.pack("@hhqqi0q", fcntl.F_WRLCK, os.SEEK_SET, byte, 1, 0)
        return struct.unpack_from("@h", fcntl.fcntl(self.descriptor, fcntl.F_OFD_GETLK, query))[0] != fcntl.F_UNLCK

    def _claim(self, first, count):
        for i in range(count):
            if self._lock(first + i, fcntl.F_WRLCK):
                self.memory[32 + 4 * (first + i):36 + 4 * (first + i)] = struct.pack("<i", os.getpid())
                return i
        return None

    def _release(self, byte):
        self.memory[32 + 4 * byte:36 + 4 * byte] = bytes(4)
        self._lock(byte, fcntl.F_UNLCK)

    def _is_at_path(self):
        try:
            here, there = os.fstat(self.descriptor), os.stat(self.path)
        except FileNotFoundError:
            return False
        return (here.st_dev, here.st_ino) == (there.st_dev, there.st_ino)


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


def slot_stride(fields):
    return (struct.calcsize(code_of(fields)) + 16 + LINE - 1) // LINE * LINE


def value_size(fields):
    return LINE + SLOTS * slot_stride(fields)
