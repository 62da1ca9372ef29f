#!/usr/bin/env python3
"""Facts about yars.Recording, by a recording of a short set in lockstep:
against `yars replay --print`, cut short, damaged.

usage: recording_test.py BUILD     Skipped (code 77) where the build has no compiled part or lacks a program.
"""
import json
import os
import pathlib
import pickle
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings

sys.dont_write_bytecode = True
BUILD = pathlib.Path(sys.argv.pop(1)).resolve().parent
SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ("yars", "flight-model", "input-monitor", "state-machine", "radar-model")
sys.path.insert(0, str(BUILD / "python"))
if not list((BUILD / "python/yars").glob("_core*.so")) or not all((BUILD / "bin" / name).exists() for name in PROGRAMS):
    print("no compiled part, or no programs, in this build: skipped")
    sys.exit(77)
import numpy as np

import yars

TICKS = 5001
FOLDER = tempfile.TemporaryDirectory()
FILE = pathlib.Path(FOLDER.name, "run.yars")


def setUpModule():
    script = pathlib.Path(FOLDER.name, "script")
    script.write_text("0 power opr\n0 elevation -3\n2 sp 1\n3 tdc 0.5 0\n4 tdc 0 0\n5 tdc release\n")
    session = f"pyrec{os.getpid()}"
    plan = ["--lockstep", f"flight-model,input-monitor,state-machine,radar-model,recorder@{TICKS - 1}"]
    roles = [["yars", "--session", session, "record", "--sweeps", "--patches", *plan, str(FILE)],
             ["flight-model", "--session", session, "--source", f"route:{SOURCE}/config/routes/default.route", *plan],
             ["input-monitor", "--session", session, "--source", f"script:{script}", *plan],
             ["state-machine", "--session", session, *plan], ["radar-model", "--session", session, *plan]]
    running = [subprocess.Popen([BUILD / "bin" / role[0], *role[1:]], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                text=True, env={**os.environ, "YARS_USER_CONFIG": ""}) for role in roles]
    for role, process in zip(roles, running):
        _, errors = process.communicate(timeout=200)
        assert process.returncode == 0, f"{role[0]}: {process.returncode}: {errors}"


def tearDownModule():
    FOLDER.cleanup()


class Whole(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            cls.recording = yars.Recording(FILE)

    def test_what_it_is(self):
        self.assertEqual((self.recording.first_tick, self.recording.last_tick), (0, TICKS - 1))
        self.assertTrue({"ModelTick", "AppliedEvent", "RadarState", "Sweep", "PatchMap", "Outputs"}
                        <= set(self.recording.kinds))
        self.assertEqual(set(self.recording.header), {"configuration", "terrain"})
        self.assertFalse(self.recording.cut_short)

    def test_fields_are_those_of_the_records(self):
        layout = json.loads(subprocess.run([BUILD / "bin/yars", "status", "--layout"], capture_output=True,
                                           check=True).stdout)["records"]
        for kind in ("ModelTick", "AppliedEvent", "RadarState", "ModelStatus", "Nav", "Ownship", "PatchMap", "Outputs",
                     "RecorderStatus", "Traffic", "WorldState", "Sweep"):
            record = self.recording.records(kind)
            fields = {name: offset for name, offset in layout[kind]["fields"].items() if name != "video"}
            self.assertEqual({name: [at, kind.itemsize] for name, (kind, at) in record.dtype.fields.items()}, fields,
                             kind)
            if kind != "Sweep":
                self.assertEqual(record.dtype.itemsize, layout[kind]["size"])
            self.assertEqual({name.partition(".")[0] for name in yars.Recording.units(kind)}, set(record.dtype.names))
        self.assertEqual(yars.Recording.units("ModelTick")["ownship.latitude_deg"], "deg")
        marks = self.recording.records("RadarState")["marks"]
        self.assertEqual((marks.ndim, "latitude_deg" in marks.dtype.names), (2, True))

    def test_records_are_those_of_replay(self):
        printed = [json.loads(line) for line in
                   subprocess.run([BUILD / "bin/yars", "replay", "--print", FILE], capture_output=True, check=True,
                                  text=True).stdout.splitlines()]
        states = [one for one in printed if "state" in one]
        ours = self.recording.records("RadarState")
        self.assertEqual([one["tick"] for one in states], ours["tick"].tolist())
        for name in ours.dtype.names:
            if (ours.dtype[name].kind in "fiu" and ours.dtype[name].shape == () and
                    all(type(one["state"].get(name)) in (int, float) for one in states)):
                np.testing.assert_array_equal(ours[name], [one["state"][name] for one in states], err_msg=name)
        events = [one for one in printed if "event" in one]
        self.assertEqual(len(self.recording.records("AppliedEvent")), len(events))
        worlds, ours = [one["world"] for one in printed if "world" in one], self.recording.records("WorldState")
        self.assertGreaterEqual(len(ours), 1)
        self.assertEqual([(one["edit"], one["tick"]) for one in worlds],
                         list(zip(ours["edit"].tolist(), ours["tick"].tolist(), strict=True)))

    def test_ticks(self):
        ticks = self.recording.records("ModelTick")["tick"]
        np.testing.assert_array_equal(ticks, np.arange(TICKS))
        self.assertEqual(self.recording.records("ModelTick", 100, 200)["tick"].tolist(), list(range(100, 201)))
        self.assertEqual(self.recording.records("ModelTick", first_tick=np.int64(TICKS - 3))["tick"].tolist(),
                         [TICKS - 3, TICKS - 2, TICKS - 1])
        self.assertEqual(len(self.recording.records("ModelTick", 300, 200)), 0)
        state = self.recording.records("RadarState")
        some = self.recording.records("RadarState", 1000, 2000)
        np.testing.assert_array_equal(some, state[(state["tick"] >= 1000) & (state["tick"] <= 2000)])

    def test_sweeps_and_maps(self):
        headers, video = self.recording.sweeps()
        self.assertGreater(len(headers), 500)
        self.assertEqual(video.shape, (len(headers), headers["samples"].max()))
        self.assertGreater(video.max(), 50)
        np.testing.assert_array_equal(self.recording.records("Sweep"), headers)
        some, part = self.recording.sweeps(int(headers["tick"][100]), int(headers["tick"][110]))
        np.testing.assert_array_equal(part, video[np.isin(headers["tick"], some["tick"])])
        headers, pictures = self.recording.maps()
        self.assertGreaterEqual(len(pictures), 1)
        for header, picture in zip(headers, pictures, strict=True):
            self.assertEqual((picture.shape, picture.dtype), ((header["size"], header["size"]), np.uint8))
            # The hash that the model published with the map: of its fields but id and ticks, then of its pixels.
            fields = header.tobytes()
            at = headers.dtype.fields["hash"][1]
            self.assertNotEqual(yars._core.xxh3(fields[24:at] + picture.tobytes()), 0)
        self.assertEqual(headers["fidelity"][0], b"standard")
        kept = pictures[0].copy()
        first = pictures[0]
        del headers, pictures
        np.testing.assert_array_equal(first, kept)

    def test_pickling_and_read_only_arrays(self):
        again = pickle.loads(pickle.dumps(self.recording))
        self.assertEqual((again.file, again.kinds), (self.recording.file, self.recording.kinds))
        self.assertIn("ticks 0 to", repr(again))
        for array in (again.records("ModelTick"), *again.sweeps(), again.maps()[1][0]):
            self.assertFalse(array.flags.writeable)

    def test_faults(self):
        for call, pattern in ((lambda: self.recording.records("Ownships"),
                               "kind: expected one of ModelTick, .*Traffic, WorldState, FlightSource, "
                               "found 'Ownships'"),
                              (lambda: yars.Recording.units(""), "kind: expected one of"),
                              (lambda: self.recording.records("Nav", 1.5), "first_tick: expected a whole number"),
                              (lambda: self.recording.sweeps(None, 2 ** 70), "last_tick: expected a whole number"),
                              (lambda: self.recording.records("\udcff"), "kind: expected the name of a kind")):
            self.assertRaisesRegex(ValueError, pattern, call)
        for call in (lambda: self.recording.maps(True), lambda: self.recording.maps("1"),
                     lambda: self.recording.records(3)):
            self.assertRaisesRegex(TypeError, "yars.Recording.*: expected ", call)
        self.assertEqual(len(self.recording.records("Nav")), 0)
        self.assertRaisesRegex(yars.Error, "expected a recording made by yars record, found another kind of file",
                               lambda: yars.Recording(__file__))
        self.assertRaisesRegex(yars.Error, "expected a recording that can be read",
                               lambda: yars.Recording(FILE.with_name("absent")))
        self.assertRaisesRegex(yars.Error, "expected a recording in a regular file",
                               lambda: yars.Recording(FILE.parent))
        self.assertRaises(TypeError, lambda: yars.Recording(3))


class Broken(unittest.TestCase):
    def opened(self, data):
        path = FILE.with_name("broken.yars")
        path.write_bytes(data)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            recording = yars.Recording(path)
        return recording, [str(one.message) for one in caught]

    def test_cut_short(self):
        whole = yars.Recording(FILE).records("ModelTick")
        recording, said = self.opened(FILE.read_bytes()[:FILE.stat().st_size // 2])
        self.assertRegex(said[0], "cut short; it is read to its last whole block")
        self.assertTrue(recording.cut_short)
        part = recording.records("ModelTick")
        self.assertTrue(0 < len(part) < len(whole))
        self.assertEqual(part.tobytes(), whole[:len(part)].tobytes())

    def test_damaged(self):
        data = bytearray(FILE.read_bytes())
        blocks = [found.start() for found in re.finditer(rb"YBLK", bytes(data))]
        first, last = struct.unpack_from("<qq", data, blocks[3] + 16)
        data[blocks[3] + 100] ^= 0xFF
        recording, said = self.opened(bytes(data))
        self.assertEqual(said, [])
        with self.assertWarnsRegex(UserWarning, f"found 1 damaged; missing ticks: {first} to {last}"):
            ticks = recording.records("ModelTick")["tick"]
        missing = np.setdiff1d(np.arange(TICKS), ticks)
        self.assertGreater(len(missing), 100)
        self.assertTrue(((missing >= first) & (missing <= last)).all())
        self.assertTrue((np.diff(ticks) > 0).all())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            recording.records("ModelTick")  # said once

    def test_any_byte(self):
        data = FILE.read_bytes()
        rng = np.random.default_rng(1)
        for at in rng.integers(0, len(data), 40):
            changed = bytearray(data)
            changed[at] ^= int(rng.integers(1, 256))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    recording, _ = self.opened(bytes(changed))
                    for kind in recording.kinds:
                        recording.records(kind)
                    recording.sweeps()
                    recording.maps()
                except yars.Error as problem:
                    self.assertIn("expected", str(problem))


if __name__ == "__main__":
    unittest.main()
