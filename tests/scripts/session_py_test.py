#!/usr/bin/env python3
"""Compares the records of python/yars/session.py with `yars status --layout`, and lets it take part in a made-up
session: its errors, its sweeps, the end of a set. usage: session_py_test.py YARS"""
import fcntl
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from yars import session as yars

layout = json.loads(subprocess.run([sys.argv[1], "status", "--layout"], capture_output=True, check=True).stdout)
faults = []


def same(name, found, expected):
    if found != expected:
        faults.append(f"{name}: expected {expected}, found {found}")


offsets, parts, locks = layout["offsets"], layout["containers"], layout["lock_bytes"]
same("Sweep.video", [yars.SWEEP_VIDEO_AT, yars.MOST_SAMPLES], layout["records"]["Sweep"]["fields"]["video"])
same("sizeof Sweep", yars.SWEEP_VIDEO_AT + yars.MOST_SAMPLES, layout["records"]["Sweep"]["size"])
for record, fields in [("ClockState", yars.CLOCK), ("Ownship", yars.OWNSHIP), ("Nav", yars.NAV),
                       ("InputEvent", yars.INPUT_EVENT), ("Outputs", yars.OUTPUTS), ("Mark", yars.MARK),
                       ("GlassFrame", yars.GLASS_FRAME), ("Sweep", yars.SWEEP), ("Caption", yars.CAPTION),
                       ("CaptionLine", yars.CAPTION_LINE)]:
    expected, at = layout["records"][record], 0
    for name, code in fields:
        if not name.startswith("_"):
            same(f"{record}.{name}", [at, struct.calcsize("<" + code)], expected["fields"][name])
        at += struct.calcsize("<" + code)
    same(f"sizeof {record}", at, yars.SWEEP_VIDEO_AT if record == "Sweep" else expected["size"])
state = layout["records"]["RadarState"]
same("sizeof RadarState", yars.RADAR_STATE_SIZE, state["size"])
for name, at, code in yars.RADAR_STATE:
    same(f"RadarState.{name}", [at, struct.calcsize("<" + code)], state["fields"][name])
same("RadarState.legends", [yars.LEGENDS_AT, 8 * yars.LEGENDS], state["fields"]["legends"])


class MadeUpSession:
    """A segment with its header alone, and somebody who takes part in it."""

    def __init__(self):
        self.name = f"py{os.getpid()}"
        self.path = f"/dev/shm/yars.{os.geteuid()}.{self.name}"
        self.file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
        os.ftruncate(self.file, layout["size"])
        self.write(0, struct.pack("<8sQQQ", b"YARSSHM1", layout["size"], int(layout["hash"], 16), layout["version"]))
        self.lock(0, fcntl.F_RDLCK)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.file)
        if os.path.exists(self.path):
            os.unlink(self.path)

    def write(self, at, content):
        os.pwrite(self.file, content, at)

    def read(self, at, size):
        return os.pread(self.file, size, at)

    def publish(self, name, record):
        """A first value by the protocol: version 1 in slot 1, then the state word."""
        part = parts[name]
        self.write(offsets[name] + part["slots"] + part["slot_stride"], struct.pack("<QQ", 2, 1) + record)
        self.write(offsets[name], struct.pack("<Q", 3))

    def latest(self, name, size):
        """The bytes of a container's newest value."""
        part = parts[name]
        version = struct.unpack("<Q", self.read(offsets[name], 8))[0] >> 1
        return self.read(offsets[name] + part["slots"] + version % part["slot_count"] * part["slot_stride"] +
                             part["slot_words"], size)

    def lock(self, byte, kind):
        fcntl.fcntl(self.file, fcntl.F_OFD_SETLK, struct.pack("@hhqqi0q", kind, os.SEEK_SET, byte, 1, 0))

    def publish_sweep(self, number, samples):
        ring = parts["sweeps"]
        slot = offsets["sweeps"] + ring["slots"] + number % ring["slot_count"] * ring["slot_stride"]
        fields = yars.pack("test", yars.SWEEP, {"number": number, "samples": samples, "range_m": 1000.0 * number})
        self.write(slot, struct.pack("<QQ", 2 * number + 2, (len(fields) + samples + 7) // 8))
        self.write(slot + 16, fields + bytes([number % 200] * samples))
        self.write(offsets["sweeps"], struct.pack("<Q", number + 1))


def refuses(fragment, function, *arguments, **values):
    try:
        function(*arguments, **values)
    except yars.YarsError as error:
        if fragment not in str(error):
            faults.append(f"expected an error with '{fragment}', found '{error}'")
    else:
        faults.append(f"expected an error with '{fragment}', found none")


def what_cannot_be_done_is_an_error(session, made_up):
    refuses("publish_ownship: expected an ownship lane, found none; call claim_ownship_lane", session.publish_ownship)
    refuses("publish_nav: expected an ownship lane, found none", session.publish_nav)
    refuses("push_event: expected an input lane, found none; call claim_input_lane", session.push_event, 1, 13)
    refuses("priority: expected a whole number 0 to", session.claim_ownship_lane, -1)
    session.claim_ownship_lane(50)
    refuses("found 'latitude'; did you mean 'latitude_deg'?", session.publish_ownship, latitude=36.5)
    refuses("found 'lattitude_deg'; did you mean 'latitude_deg'?", session.publish_ownship, lattitude_deg=36.5)
    refuses("found 'wingspan'; see yars_records.h", session.publish_ownship, wingspan=13.0)
    refuses("latitude_deg: expected a number, found '36.5'", session.publish_ownship, latitude_deg="36.5")
    refuses("latitude_deg: expected a number from -90 to 90, found nan", session.publish_ownship,
            latitude_deg=float("nan"))
    refuses("heading_deg: expected a number from 0 to 360, found inf", session.publish_ownship,
            heading_deg=float("inf"))
    refuses("ins_latitude_deg: expected a number from -90 to 90, found 91", session.publish_nav, ins_latitude_deg=91)
    refuses("latitude_deg: expected a number, found True", session.publish_ownship, latitude_deg=True)
    refuses("source: expected a text of at most 15", session.publish_ownship, source="sixteen letters!")
    refuses("source: expected a text of at most 23", session.claim_input_lane, 5)
    session.claim_input_lane("panel")
    refuses("kind: expected a whole number 0 to 65535, found 'pb'", session.push_event, "pb", 13)
    refuses("argument: expected a whole number -32768 to", session.push_event, 1, 1.5)
    refuses("text: expected a text of at most 15", session.push_event, yars.Event.SEQUENCE_POINT, text="\udcff")
    session.publish_ownship(latitude_deg=36.5, source="mine")
    same("outputs before there are any", session.outputs(), None)
    each = [(f"{name}_{i}", code) for i in range(10) for name, code in yars.MARK]
    spread = [entry for field in yars.OUTPUTS for entry in (each if field[0] == "marks" else [field])]
    made_up.publish("outputs", yars.pack("test", spread, {
        "target_name": b"4.", "slant_range_m": 9260.0, "cue_count": 2, "mark_count": 3,
        **{f"latitude_deg_{i}": 36.0 + i for i in range(10)}, **{f"sim_time_ns_{i}": i for i in range(10)}}))
    told = session.outputs()
    same("target, ranging, cue", (told["target_name"], told["slant_range_m"], told["cue_count"]), ("4.", 9260.0, 2))
    same("marks", [(mark["latitude_deg"], mark["sim_time_ns"]) for mark in told["marks"]],
         [(36.0, 0), (37.0, 1), (38.0, 2)])
    session.publish_ownship(latitude_deg=36.5, source=b"mine")
    session.push_event(yars.Event.SEQUENCE_POINT, text="2.01")
    lane = offsets["input"] + session.input_lane * parts["input"]["stride"]
    same("events of faulty calls", struct.unpack("<Q", made_up.read(lane, 8))[0], 1)
    event = yars.unpack(yars.INPUT_EVENT, made_up.read(lane + parts["input"]["records"], 56))
    same("event", (event["kind"], event["text"].rstrip(b"\0"), event["number"]), (14, b"2.01", 1))
    own = yars.unpack(yars.OWNSHIP, made_up.latest("ownship", 144))
    same("ownship", (own["latitude_deg"], own["source"].rstrip(b"\0"), own["radar_altitude_m"] > 0),
         (36.5, b"mine", False))
    same("radar altitude is NaN", own["radar_altitude_m"] != own["radar_altitude_m"], True)


def a_caption_is_there_while_its_tour_runs(session, made_up):
    lines = b"Range down: key E.".ljust(48, b"\0") + b"Then once more.".ljust(48, b"\0") + bytes(48)
    record = struct.pack(yars.code_of(yars.CAPTION),
                         *({"step": 3, "steps": 27, "waiting": 1, "title": b"A tour", "lines": lines}
                           .get(name, b"" if code.endswith("s") else 0) for name, code in yars.CAPTION))
    made_up.publish("caption", record)
    same("caption without a tour", session.caption(), None)
    tour = os.open(made_up.path, os.O_RDWR)
    fcntl.fcntl(tour, fcntl.F_OFD_SETLK, struct.pack("@hhqqi0q", fcntl.F_WRLCK, os.SEEK_SET, locks["tour"], 1, 0))
    found = session.caption() or {}
    same("caption", [found.get(name) for name in ("title", "step", "steps", "waiting", "lines")],
         ["A tour", 3, 27, 1, ["Range down: key E.", "Then once more."]])
    os.close(tour)
    same("caption after the tour", session.caption(), None)


def sweeps_come_once_and_the_lost_are_counted(session, made_up):
    same("sweeps at first", session.sweeps(), [])
    made_up.publish_sweep(0, 5)
    made_up.publish_sweep(1, 12)
    found = session.sweeps()
    same("sweeps", [(sweep["number"], sweep["range_m"], sweep["video"]) for sweep in found],
         [(0, 0.0, bytes(5)), (1, 1000.0, bytes([1] * 12))])
    same("sweeps again", session.sweeps(), [])
    slots = parts["sweeps"]["slot_count"]  # radar-model may be writing into the oldest
    for number in range(2, 2 + slots + 5):
        made_up.publish_sweep(number, 1)
    late = session.sweeps()
    same("sweeps of one who is late", (late[0]["number"], late[-1]["number"], session.sweeps_lost),
         (8, slots + 6, 6))


def a_set_runs_while_a_role_is_held(session, made_up):
    same("set_runs of nobody", session.set_runs(), False)
    for byte in (locks["radar-model"], locks["state-machine"]):
        made_up.lock(byte, fcntl.F_WRLCK)
        same(f"set_runs with byte {byte}", session.set_runs(), True)
        made_up.lock(byte, fcntl.F_UNLCK)
    same("set_runs at the end", session.set_runs(), False)


def a_misspelled_field_is_answered_with_the_nearest(session):
    clock = yars.unpack(yars.CLOCK, bytes(struct.calcsize(yars.code_of(yars.CLOCK))))
    refuses("found 'base_sim'; did you mean 'base_sim_ns'?", lambda: clock["base_sim"])
    try:
        clock["zzz"]
        faults.append("clock['zzz'] was taken")
    except KeyError as error:
        same("a KeyError reads as a sentence", str(error).startswith("expected a field of base_sim_ns"), True)
    for name, said in (("rate", "write record['rate']"), ("epok", "write record['epoch']"), ("zzz", "record['NAME']")):
        try:
            getattr(clock, name)
            faults.append(f"clock.{name} was taken")
        except AttributeError as error:
            same(f"clock.{name}", said in str(error), True)
    same("a record is a dict", (clock.get("zzz"), json.loads(json.dumps(clock))["epoch"]), (None, 0))
    refuses("no such session runs; start the set with --session none-there", yars.Session, "none-there")


def nothing_works_after_close(name_of_session):
    session = yars.Session(name_of_session)
    session.close()
    session.close()
    for name in ("set_runs", "heartbeat", "sim_time_ns", "epoch", "radar_state", "outputs", "clock", "sweeps",
                 "caption", "newest_frame", "publish_ownship", "publish_nav", "__enter__"):
        try:
            getattr(session, name)()
            faults.append(f"session.{name}() was taken after close()")
        except ValueError as error:
            same(f"{name} after close()", "found one after close()" in str(error), True)
    for given in (None, 5, b"default"):
        try:
            yars.Session(given)
            faults.append(f"the session {given!r} was taken")
        except TypeError as error:
            same(f"session {given!r}", "session: expected a str" in str(error), True)


def a_name_leads_nowhere_else():
    for name in ("../../x", "", "a/b", "a\x1b[2J", "x" * 41):
        try:
            yars.Session(name)
            faults.append(f"the session {name!r} was taken")
        except yars.YarsError as error:
            same(f"session {name!r}", "1 to 40 letters" in str(error) and "\x1b" not in str(error), True)


def a_map_is_that_of_the_command():
    facts, power = yars.patch_map(sys.argv[1], size=64, seed=3, force=True)
    same("patch_map", (facts["size"], len(power), max(power) > 0.0), (64, 64 * 64, True))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "map.f32"
        subprocess.run([sys.argv[1], "patch", "--size", "64", "--seed", "3", "--force", "--out", str(path)],
                       capture_output=True, check=True)
        same("power of patch_map", power.tobytes() == path.read_bytes(), True)
    facts, power = yars.patch_map(sys.argv[1], size=1100)
    same("a map of 1100 pixels", (facts["size"], len(power)), (1100, 1100 * 1100))
    refuses("yars patch: --size: expected a whole number from 16 to 4096, found '4097'", yars.patch_map, sys.argv[1],
            size=4097)
    refuses("other than 'out'", yars.patch_map, sys.argv[1], out="map.png")
    refuses("expected the program yars", yars.patch_map, "/none/there")
    refuses("makes no map", yars.patch_map, "/bin/true")
    refuses("makes no map", yars.patch_map, "/bin/echo")
    refuses("expected the path of the program yars, found 3", yars.patch_map, 3)
    refuses("a command line can have", yars.patch_map, sys.argv[1], terrain="a\0b")
    refuses("yars patch: --size", yars.patch_map, sys.argv[1], size=True)
    refuses("yars patch: --size: expected a whole number from 16 to 4096, found '0'", yars.patch_map, sys.argv[1],
            size=0)
    same("options that are not given", yars.patch_map(sys.argv[1], size=64, force=False, scene=None)[0]["size"], 64)


a_name_leads_nowhere_else()
a_map_is_that_of_the_command()
with MadeUpSession() as made_up, yars.Session(made_up.name, "session_py_test") as session:
    nothing_works_after_close(made_up.name)
    what_cannot_be_done_is_an_error(session, made_up)
    a_caption_is_there_while_its_tour_runs(session, made_up)
    a_misspelled_field_is_answered_with_the_nearest(session)
    sweeps_come_once_and_the_lost_are_counted(session, made_up)
    a_set_runs_while_a_role_is_held(session, made_up)
print("\n".join(faults) or "yars.session: as the layout")
sys.exit(1 if faults else 0)
