#!/usr/bin/env python3
"""Facts about pip with the build backend of the tree: without a network, `pip install .` and `-e .` in an environment
of the system's packages give the module of the build, and `pip wheel .` gives equal wheels with a right RECORD.

usage: pip_test.py BUILD/bin     The compiled part is that of BUILD. YARS_TEST_FULL: the wheel is made twice.
    Skipped (code 77) without one, or without python3-venv.
"""
import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import zipfile

sys.dont_write_bytecode = True
BUILD = pathlib.Path(sys.argv.pop(1)).resolve().parent
SOURCE = pathlib.Path(__file__).resolve().parents[2]
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")
if not (BUILD / f"python/yars/_core{SUFFIX}").is_file():
    print(f"no _core{SUFFIX} in this build: skipped")
    sys.exit(77)
try:
    import ensurepip  # noqa: F401  what python3-venv brings
except ImportError:
    print("python3-venv is not installed: skipped")
    sys.exit(77)
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "YARS_BUILD_FOLDER": str(BUILD),
               "SOURCE_DATE_EPOCH": "1700000000", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_NO_CACHE_DIR": "1",
               "LC_ALL": "C.UTF-8"}
SCAN = """import yars
scan = yars.Radar("draft").scan(yars.Terrain(), latitude_deg=37.8, longitude_deg=-122.5, altitude_ft=15000,
                                heading_deg=30, range_nm=10, seed=7)
print(scan.hash, yars.Radar(config="apg68.guf").name, yars.__file__, sep="\\n")
"""


def run(*command, folder, **environment):
    return subprocess.run([str(word) for word in command], cwd=folder, env={**ENVIRONMENT, **environment},
                          capture_output=True, text=True, timeout=600, check=False)


def cut_off():
    """Words before a command that take its network away; [] where the system does not allow it:
    pip then has no index."""
    words = ["unshare", "--net"] if os.geteuid() == 0 else ["unshare", "--map-root-user", "--net"]
    return words if run(*words, "true", folder="/").returncode == 0 else []


class Pip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name).resolve()
        cls.python = cls.folder / "v/bin/python3"
        cls.without_network = cut_off()
        made = run("/usr/bin/python3", "-m", "venv", "--system-site-packages", cls.folder / "v", folder=cls.folder)
        assert made.returncode == 0, made

    def pip(self, *words, **environment):
        if not self.without_network:
            environment["PIP_NO_INDEX"] = "1"
        return run(*self.without_network, self.python, "-m", "pip", *words, folder=SOURCE, **environment)

    def installed(self, *words):
        """(hash, name of a configuration, file of the module) after `pip install`, in another folder."""
        done = self.pip("install", *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        scan = run(self.python, "-c", SCAN, folder=self.folder)
        self.assertEqual(scan.returncode, 0, scan.stderr)
        return scan.stdout.splitlines()

    def test_an_installation_makes_the_scan_of_the_build(self):
        of_build = run("/usr/bin/python3", "-B", "-c", SCAN, folder=self.folder,
                       PYTHONPATH=str(BUILD / "python")).stdout.splitlines()
        self.assertEqual(of_build[2], str(BUILD / "python/yars/__init__.py"))
        package = self.folder / f"v/lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages/yars"
        self.assertEqual(self.installed("."), [*of_build[:2], str(package / "__init__.py")])
        self.assertTrue((package / "share/yars/config/apg68.guf").is_file())
        self.assertEqual(run(self.folder / "v/bin/yars-plot-trade", "--help", folder=self.folder).returncode, 0)
        library = run(self.python, "-c", "import yars.session; print(yars.session._library()._name)",
                      folder=self.folder)
        self.assertRegex(library.stdout, rf"^{package}/libyars-client\.so\.\d+\.\d+\n$", library.stderr)
        about = run(self.python, "-m", "yars", folder=self.folder)
        self.assertIn(f"compiled part: {package / f'_core{SUFFIX}'}\n", about.stdout)
        self.assertEqual(self.installed("-e", "."), of_build)

    def test_a_wheel_has_a_right_record_and_is_made_again_with_equal_bytes(self):
        made = []
        for name in ("one", "two") if "YARS_TEST_FULL" in os.environ else ("one",):
            done = self.pip("wheel", ".", "--wheel-dir", self.folder / name)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            made += (self.folder / name).iterdir()
        python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
        self.assertRegex(made[0].name, rf"^yars-\d+\.\d+\.\d+-{python}-{python}-linux_x86_64\.whl$")
        self.assertEqual(made[0].read_bytes(), made[-1].read_bytes())
        with zipfile.ZipFile(made[0]) as wheel:
            names = wheel.namelist()
            record = next(name for name in names if name.endswith(".dist-info/RECORD"))
            rows = [line.rsplit(",", 2) for line in wheel.read(record).decode().splitlines()]
            self.assertEqual([row[0] for row in rows], names)
            for name, digest, size in rows[:-1]:
                content = wheel.read(name)
                expected = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
                self.assertEqual((digest, size), (f"sha256={expected}", str(len(content))), name)
            self.assertFalse([name for name in names if "__pycache__" in name])

    def test_what_is_missing_is_said_in_one_message(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for name in ("git", "unshare", "cmake"):
            (tools / name).symlink_to(f"/usr/bin/{name}")
        for words, expected in (({"YARS_BUILD_FOLDER": str(self.folder)},
                                 "build-folder: expected a build folder of cmake, found none at "),
                                ({"PATH": str(tools)}, "expected the program ninja, found none; run "),
                                ({"PATH": "/nonexistent"}, "expected the program cmake, found none; run ")):
            done = run(self.python, "-m", "pip", "wheel", ".", "--no-deps", "--no-index",
                       "--wheel-dir", self.folder / "none", folder=SOURCE, **words)
            printed = done.stdout + done.stderr
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"yars: {expected}", printed)
            self.assertNotIn("Traceback", printed)


if __name__ == "__main__":
    unittest.main()
