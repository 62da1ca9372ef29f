#!/usr/bin/env python3
"""Compares every number of examples/yars.py with `yars status --layout`. usage: yars_py_test.py YARS"""
import json
import pathlib
import struct
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
import yars

layout = json.loads(subprocess.run([sys.argv[1], "status", "--layout"], capture_output=True, check=True).stdout)
faults = []


def same(name, found, expected):
    if found != expected:
        faults.append(f"{name}: expected {expected}, found {found}")


same("VERSION", yars.VERSION, layout["version"])
same("SIZE", yars.SIZE, layout["size"])
same("HASH", f"{yars.HASH:016x}", layout["hash"])
for name, key in [("AT_CLOCK", "clock"), ("AT_OWNSHIP_PRIORITY", "ownship_priority"), ("AT_OWNSHIP", "ownship"),
                  ("AT_NAV", "nav"), ("AT_RADAR_STATE", "radar_state"), ("AT_INPUT", "input"),
                  ("AT_PROCESSES", "processes"), ("AT_FRAMES", "frames")]:
    same(name, getattr(yars, name), layout["offsets"][key])
locks, parts = layout["lock_bytes"], layout["containers"]
same("FIRST_OWNSHIP_BYTE", yars.FIRST_OWNSHIP_BYTE, locks["first_ownship_lane"])
same("FIRST_INPUT_BYTE", yars.FIRST_INPUT_BYTE, locks["first_input_lane"])
same("FIRST_PROCESS_BYTE", yars.FIRST_PROCESS_BYTE, locks["first_process"])
same("OWNSHIP_LANES", yars.OWNSHIP_LANES, parts["ownship"]["count"])
same("INPUT", (yars.INPUT_LANES, yars.INPUT_STRIDE, yars.INPUT_DEPTH, yars.INPUT_POPPED, yars.INPUT_RECORDS),
     tuple(parts["input"][key] for key in ("count", "stride", "depth", "popped", "records")))
same("INPUT dropped, source", (8, 24), (parts["input"]["dropped"], parts["input"]["source"]))
same("PROCESSES", (yars.PROCESSES, yars.PROCESS_STRIDE), (parts["processes"]["count"], parts["processes"]["stride"]))
same("FRAMES", (yars.FRAMES, yars.FRAME_STRIDE, 8, yars.FRAME_PIXELS),
     tuple(parts["frames"][key] for key in ("slot_count", "slot_stride", "slot_words", "slot_pixels")))
for name, fields in [("ownship", yars.OWNSHIP), ("nav", yars.NAV), ("clock", yars.CLOCK)]:
    same(f"{name} slots", (yars.LINE, yars.SLOTS, yars.slot_stride(fields), yars.value_size(fields)),
         tuple(parts[name][key] for key in ("slots", "slot_count", "slot_stride", "stride")))
for record, fields in [("ClockState", yars.CLOCK), ("Ownship", yars.OWNSHIP), ("Nav", yars.NAV),
                       ("InputEvent", yars.INPUT_EVENT), ("GlassFrame", yars.GLASS_FRAME)]:
    expected, at = layout["records"][record], 0
    for name, code in fields:
        if not name.startswith("_"):
            same(f"{record}.{name}", [at, struct.calcsize("<" + code)], expected["fields"][name])
        at += struct.calcsize("<" + code)
    same(f"sizeof {record}", at, expected["size"])
state = layout["records"]["RadarState"]
same("sizeof RadarState", yars.RADAR_STATE_SIZE, state["size"])
for name, at, code in yars.RADAR_STATE:
    same(f"RadarState.{name}", [at, struct.calcsize("<" + code)], state["fields"][name])
same("RadarState.legends", [yars.LEGENDS_AT, 8 * yars.LEGENDS], state["fields"]["legends"])
print("\n".join(faults) or "yars.py: as the layout")
sys.exit(1 if faults else 0)
