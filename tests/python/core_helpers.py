"""What the tests of the compiled part share: the build, the package of it, places of a scan and of a map, the commands.

Import it first: it takes the build's folder of programs from the arguments,
and ends the program (code 77) without a compiled part."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
BUILD = pathlib.Path(sys.argv.pop(1)).resolve().parent
sys.path.insert(0, str(BUILD / "python"))
if not list((BUILD / "python/yars").glob("_core*.so")):
    print("no compiled part in this build: skipped")
    sys.exit(77)
import numpy as np

import yars

YARS = str(BUILD / "bin/yars")
SCAN = {"latitude_deg": 37.8, "longitude_deg": -122.5, "altitude_ft": 15000, "heading_deg": 30, "range_nm": 10,
        "seed": 7}
PATCH = {"latitude_deg": 37.5, "longitude_deg": -122.5, "altitude_ft": 12000, "heading_deg": 350,
         "target_latitude_deg": 37.62, "target_longitude_deg": -122.4, "window_nm": 1.3, "seed": 3}


OPTIONS = {"latitude_deg": "lat", "longitude_deg": "lon", "altitude_ft": "alt-ft", "heading_deg": "heading",
           "width_deg": "scan-width", "elevation_deg": "elevation", "target_latitude_deg": "target-lat",
           "target_longitude_deg": "target-lon"}


def option(name):
    """The option of a field of a request."""
    return "--" + OPTIONS.get(name, name.replace("_", "-"))


def options(arguments):
    return [f"{option(name)}={value}" for name, value in arguments.items()]


def command(*words, code=0, text=False):
    as_json = ["--json"] if words[0] in ("scan", "patch") and not text else []
    done = subprocess.run([YARS, *words, *as_json], capture_output=True, text=True, timeout=300,
                          env={**os.environ, "YARS_USER_CONFIG": ""})
    if done.returncode != code:
        raise AssertionError(f"yars {' '.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}")
    if text:
        return done.stdout
    return json.loads(done.stdout) if code == 0 else done.stderr.strip()


def program(text, *, timeout=60, warnings="error"):
    """Output and messages of a Python program with this package, and its exit code."""
    done = subprocess.run([sys.executable, "-W", warnings, "-c", text], capture_output=True, text=True, timeout=timeout,
                          check=False, env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
    return done.stdout, done.stderr, done.returncode


class Folder(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        self.addCleanup(self._folder.cleanup)

    def refused(self, kind, pattern, call):
        with self.assertRaisesRegex(kind, pattern) as caught:
            call()
        self.assertNotIn("internal", str(caught.exception))


def order_of(patch):
    return {"latitude": patch["latitude_deg"], "longitude": patch["longitude_deg"], "altitude_ft": patch["altitude_ft"],
            "heading": patch["heading_deg"], "speed_kt": 480.0,
            "target_latitude": patch["target_latitude_deg"], "target_longitude": patch["target_longitude_deg"],
            "window_nm": patch["window_nm"], "looks": 1, "map": 1}


def orders_of(*patches):
    orders = np.zeros(len(patches), yars.PATCH_ORDER)
    for i, patch in enumerate(patches):
        for name, value in order_of(patch).items():
            orders[name][i] = value
    return orders
