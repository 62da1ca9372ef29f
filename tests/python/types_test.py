#!/usr/bin/env python3
"""Facts about types and documents of the compiled names: stubs against the objects, docstrings, doctests, and a user's
program under mypy where Debian's mypy is installed; with YARS_TEST_FULL against NumPy's types, too.

usage: types_test.py BUILD     Skipped (code 77) where the build has no compiled part.
"""
import ast
import doctest
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy

from core_helpers import BUILD, option, yars
from yars import _core, places, recordings, results

PROGRAM = '''
import numpy as np
from numpy.typing import NDArray

import yars

terrain = yars.Terrain("DIR")
height: NDArray[np.float64] = terrain.elevation([37.0, 37.5], -122.0)
path: str = yars.Scene.generate("town.flt", kind="town", triangles=1000, seed=1, origin=(37.5, -122.3))
scene = yars.Scene(path, terrain, without=["tower*"])
radar = yars.Radar("draft", map_size=128, settings="( Sea :state 3 )")
scan = radar.scan(terrain, scene, latitude_deg=37.8, longitude_deg=-122.5, altitude_ft=15000,
                  heading_deg=30, range_nm=10, seed=1)
power: NDArray[np.float32] = scan.power
shadow: NDArray[np.bool_] = scan.shadow
unit: str = scan.units["power"]
patch = radar.patch(terrain, latitude_deg=37.5, longitude_deg=-122.5, target_latitude_deg=37.6,
                    target_longitude_deg=-122.4, window_nm=1.3)
video: NDArray[np.uint8] = patch.video
orders = np.zeros(3, yars.PATCH_ORDER)
maps = radar.patches(terrain, orders, scene, arrays=("video", "object"), threads=2)
recording = yars.Recording("flight.yars")
headers, sweeps = recording.sweeps(first_tick=100)
rows = yars.trade(terrain, radar, presets="draft", repeat=1)
'''
FAULTS = ('yars.Radar("fast")', 'yars.Radar().scan("hills")', 'yars.Radar().scan(yars.Terrain(), range=3)',
          'yars.Recording("f").records(3)')
FAULTS_OF_ARRAYS = ('yars.Radar().patches(yars.Terrain(), [1, 2])',)


def stubbed(name):
    """Public names of a stub, with those of its classes."""
    names = set()
    for one in ast.parse((BUILD / "python/yars" / name).read_text()).body:
        if isinstance(one, (ast.ClassDef, ast.FunctionDef)):
            names.add(one.name)
            if isinstance(one, ast.ClassDef):
                names |= {f"{one.name}.{part.name}" for part in one.body if isinstance(part, ast.FunctionDef)}
        elif isinstance(one, ast.AnnAssign):
            names.add(one.target.id)
    return {name for name in names if not any(part.startswith("_") for part in name.split("."))}


def there(module, classes):
    names = set()
    for name, value in vars(module).items():
        if (name.startswith("_") or inspect.ismodule(value) or
                getattr(value, "__module__", module.__name__) != module.__name__):
            continue
        names.add(name)
        if inspect.isclass(value) and name in classes:
            names |= {f"{name}.{part}" for part in vars(value) if not part.startswith("_")}
    return names


class Stubs(unittest.TestCase):
    def test_names(self):
        core = there(_core, {"Terrain", "Scene", "Recording", "Radar", "ScanResult", "PatchResult"})
        self.assertEqual(stubbed("_core.pyi"), {name for name in core})
        for module, classes in ((places, {"Terrain", "Scene"}), (recordings, {"Recording"})):
            self.assertEqual(stubbed(f"{module.__name__.rpartition('.')[2]}.pyi"), there(module, classes))
        ours = {name for name in there(results, {"Radar"})
                if not isinstance(getattr(results, name.partition(".")[0]), numpy.dtype)}
        found = ({name for name in stubbed("results.pyi") if name.partition(".")[0] not in ("Scan", "Patch")} |
                 {"Scan", "Patch"})
        self.assertEqual(found, ours)
        for picture in (yars.Scan, yars.Patch):
            stub = ast.parse((BUILD / "python/yars/results.pyi").read_text())
            named = {part.name for one in stub.body
                     if isinstance(one, ast.ClassDef) and one.name in ("_Picture", picture.__name__)
                     for part in one.body if isinstance(part, ast.FunctionDef)}
            self.assertEqual(named | {"axes"}, {name for name in dir(picture) if not name.startswith("_")})

    def test_options_are_those_of_the_commands(self):
        for kind, name, command, aside in ((ast.ClassDef, "scan", ["scan"], set()),
                                           (ast.ClassDef, "patch", ["patch"], set())):
            said = subprocess.run([BUILD / "bin/yars", *command, "--help"], capture_output=True, text=True,
                                  check=True).stdout
            options = {word[2:].replace("-", "_") for line in said.splitlines() for word in line.split()[:1]
                       if word.startswith("--")}
            options -= {"terrain", "scene", "scene_without", "fidelity", "repeat", "size" if name == "scan" else "",
                        "color", "out", "shadow", "json", "pixels", "help"}
            stub = ast.parse((BUILD / "python/yars/results.pyi").read_text())
            radar = next(one for one in stub.body if isinstance(one, kind) and one.name == "Radar")
            method = next(part for part in radar.body if isinstance(part, ast.FunctionDef) and part.name == name)
            request = _core.ScanRequest_fields if name == "scan" else _core.PatchRequest_fields
            self.assertEqual([one.arg for one in method.args.kwonlyargs], [row[0] for row in request])
            self.assertEqual({option(row[0]) for row in request}, {"--" + one.replace("_", "-") for one in options})

    def test_a_program_of_a_user(self):
        mypy = shutil.which("mypy", path="/usr/bin")
        if not mypy:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "user.py").write_text(PROGRAM + "\n".join(FAULTS + FAULTS_OF_ARRAYS) + "\n")
            environment = {**os.environ, "MYPYPATH": str(BUILD / "python"), "MYPY_CACHE_DIR": folder}
            options, faults = ["--strict", "--follow-imports=silent"], FAULTS + FAULTS_OF_ARRAYS
            if "YARS_TEST_FULL" not in os.environ:  # NumPy's types take mypy seven times as long as all else
                options += ["--no-site-packages", "--ignore-missing-imports", "--allow-subclassing-any",
                            "--no-warn-return-any"]
                faults = FAULTS
            done = subprocess.run([mypy, *options, "user.py"], cwd=folder, capture_output=True, text=True, timeout=300,
                                  env=environment, check=False)
            found = {int(line) for line in re.findall(r"^user\.py:(\d+): error", done.stdout, re.M)}
            first = PROGRAM.count("\n") + 1
            self.assertEqual(found, set(range(first, first + len(faults))), done.stdout + done.stderr)


class Documents(unittest.TestCase):
    def test_every_public_name_has_a_docstring(self):
        for name in ("Terrain", "Scene", "Recording", "Radar", "Scan", "Patch", "trade"):
            value = getattr(yars, name)
            self.assertTrue(value.__doc__, name)
            for part, member in inspect.getmembers(value) if inspect.isclass(value) else ():
                if not part.startswith("_") and part != "axes":
                    self.assertTrue(inspect.getdoc(member), f"{name}.{part}")

    def test_arrays_say_shape_and_unit(self):
        for picture, shape in ((yars.Scan, "(azimuth, sample)"), (yars.Patch, "(y, x)")):
            for name in results.ARRAYS:
                said = inspect.getdoc(getattr(picture, name))
                self.assertIn(shape, said)
                unit = results.UNITS[name]
                self.assertTrue(not unit or f"[{unit}]" in said, said)

    def test_errors_are_named(self):
        for value in (yars.Terrain, yars.Scene, yars.Recording, yars.Radar, yars.trade, yars.Radar.patches,
                      yars.Recording.records, yars.Scene.generate, yars.Terrain.generate):
            self.assertIn("Error", inspect.getdoc(value), value)

    def test_examples(self):
        for module, examples in ((results, 8), (places, 3)):
            done = doctest.testmod(module, extraglobs={"yars": yars})
            self.assertEqual(done.failed, 0)
            self.assertGreaterEqual(done.attempted, examples)


if __name__ == "__main__":
    unittest.main()
