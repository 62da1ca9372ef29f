#!/usr/bin/env python3
"""Facts about `python -m yars`: it says what is installed, and what is missing with the Debian package that brings it.

usage: installed_test.py BUILD/bin
"""
import json
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
BUILD = pathlib.Path(sys.argv.pop(1)).resolve().parent
# Runs the module with some modules of others hidden, however this Python is equipped.
RUN = """import runpy, sys
class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ABSENT:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
ABSENT = %r
sys.meta_path.insert(0, Absent())
sys.path.insert(0, %r)
sys.argv[1:] = %r
runpy.run_module("yars", run_name="__main__")
"""


def run(*arguments, absent=(), **environment):
    program = RUN % (absent, str(BUILD / "python"), list(arguments))
    return subprocess.run([sys.executable, "-I", "-B", "-c", program], capture_output=True, text=True, timeout=120,
                          env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", **environment}, check=False)


def as_json(**options):
    return json.loads(run("--json", **options).stdout)


class Installed(unittest.TestCase):
    def test_everything_missing_is_no_error(self):
        done = run(absent=("numpy", "matplotlib", "zarr"), PATH="/nonexistent")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("compiled part: missing: expected the Python module numpy", done.stdout)
        for package in ("python3-numpy", "python3-matplotlib", "python3-zarr"):
            self.assertIn(f"missing; Debian package {package} ", done.stdout)

    def test_the_package_and_its_compiled_part(self):
        found = as_json()
        self.assertEqual(found["folder"], str(BUILD / "python/yars"))
        built = [str(path) for path in (BUILD / "python/yars").glob("_core*.so")]
        if built and {package["name"]: package["version"] for package in found["packages"]}["numpy"]:
            self.assertEqual((found["compiled"]["file"], found["compiled"]["problem"]), (built[0], None))
        else:
            self.assertIsNone(found["compiled"]["file"])
            self.assertIn("expected", found["compiled"]["problem"])

        self.assertRegex(found["session"]["file"] or "", r"/python/yars/libyars-client\.so\.\d+\.\d+$")

    def test_programs_of_the_build_and_of_another_version(self):
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder, "radar-model")
            other.write_text("#!/bin/sh\necho 0.0.9\n")
            other.chmod(other.stat().st_mode | stat.S_IXUSR)
            found = {one["name"]: one for one in as_json(YARS_BIN=folder)["programs"]}
            self.assertEqual((found["radar-model"]["path"], found["radar-model"]["version"]), (str(other), "0.0.9"))
            self.assertIn(f"{other} 0.0.9, expected ", run(YARS_BIN=folder).stdout)
        if (BUILD / "bin/yars").is_file():
            self.assertEqual(found["yars"]["path"], str(BUILD / "bin/yars"))
            self.assertEqual(found["yars"]["version"], as_json()["version"])

    def test_an_unknown_option_is_refused(self):
        done = run("--jsno")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr,
                         "yars: expected --json or nothing, found '--jsno'; usage: python -m yars [--json]\n")
        self.assertEqual(run("--help").returncode, 0)


if __name__ == "__main__":
    unittest.main()
