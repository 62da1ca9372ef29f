#!/usr/bin/env python3
"""Facts about the package yars without its compiled part: what loads when, what is said of what is missing, the names
in the stubs, and the package in the build folder.

usage: python_module_test.py [BUILD]     BUILD: a build folder, whose python/yars is compared with the sources
"""
import ast
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = SOURCE / "python"
BUILD = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
# Modules of others that are not found, however this Python is equipped.
WITHOUT = """import sys
class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ABSENT or name == "yars._core" and "core" in ABSENT:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
ABSENT = %r
sys.meta_path.insert(0, Absent())
"""


def run(program, absent=(), folder=PACKAGE):
    """What a program prints that finds the package in `folder`."""
    done = subprocess.run([sys.executable, "-B", "-I", "-c", WITHOUT % (absent,) + "sys.path.insert(0, "
                           f"{str(folder)!r})\n" + program], capture_output=True, text=True, timeout=120)
    return done.stdout + done.stderr


def said(expression, absent=(), folder=PACKAGE):
    """The message of the MissingPart that an expression raises."""
    return run(f"import yars\ntry:\n    {expression}\nexcept yars.Error as error:\n"
               "    print(isinstance(error, ImportError), error)\n", absent, folder)


class Names(unittest.TestCase):
    def test_importing_needs_python_alone(self):
        program = ("import yars; print(sorted(name for name in sys.modules if name.partition('.')[0] in ('numpy', "
                   "'matplotlib', 'yars')))")
        self.assertEqual(run(program), "['yars']\n")

    def test_the_session_client_needs_python_alone(self):
        for program in ("from yars.session import Session, YarsError",
                        "import yars; Session, YarsError = yars.Session, yars.YarsError",
                        "from yars import Session, YarsError, patch_map",
                        "import yars; Session = yars.session.Session; YarsError = yars.YarsError"):
            program += ("\ntry:\n    Session('absent-session')\nexcept YarsError as error:\n    print(error)\n"
                        "print('numpy' in sys.modules)")
            printed = run(program, ("numpy", "matplotlib", "core"))
            self.assertIn("no such session runs", printed)
            self.assertTrue(printed.endswith("\nFalse\n"), printed)

    def test_an_error_of_the_session_is_an_error_of_the_package(self):
        self.assertEqual(run("import yars; print(issubclass(yars.YarsError, yars.Error), issubclass(yars.Error, "
                             "RuntimeError))"), "True True\n")

    def test_an_unknown_name_is_an_attribute_error(self):
        self.assertIn("AttributeError: module 'yars' has no attribute 'Rader'", run("import yars; yars.Rader"))
        self.assertEqual(run("import yars; print(hasattr(yars, 'nothing'))"), "False\n")

    def test_dir_lists_what_can_be_loaded(self):
        printed = run("import yars; print(*dir(yars))", ("numpy", "core")).split()
        self.assertTrue({"Session", "session", "Error"} <= set(printed))
        self.assertFalse({"Radar", "plot", "dataset"} & set(printed))
        self.assertEqual(run("from yars import *; print(Session.__name__)", ("numpy", "core")), "Session\n")
        self.assertIn("patch_map", run("import yars; help(yars)", ("numpy", "core")))

    def test_stubs_have_the_names_of_the_package(self):
        stub = ast.parse((PACKAGE / "yars/__init__.pyi").read_text())
        stubbed = {name.asname for one in stub.body if isinstance(one, ast.ImportFrom) for name in one.names
                   if name.asname}
        stubbed |= {one.name for one in stub.body if isinstance(one, ast.ClassDef)}
        names = set(run("import yars; print(*yars._MODULES, *yars._MODULE_OF)").split()) | {"Error", "MissingPart"}
        self.assertEqual(stubbed, names)

    def test_the_session_has_the_names_of_the_package(self):
        self.assertEqual(run("import yars; print([n for n, m in yars._MODULE_OF.items() if m == 'session' and "
                             "getattr(yars, n, 0) is not getattr(yars.session, n)])"), "[]\n")


class Missing(unittest.TestCase):
    def test_numpy(self):
        self.assertEqual(said("yars.Radar", ("numpy",)),
                         "True yars.Radar: expected the Python module numpy, found none; install the Debian "
                         "package python3-numpy\n")

    def test_matplotlib(self):
        if run("import numpy"):
            self.skipTest("python3-numpy is not installed")
        self.assertEqual(said("yars.plot.ppi", ("matplotlib",)),
                         "True yars.plot: expected the Python module matplotlib, found none; install "
                         "the Debian package python3-matplotlib\n")

    def test_a_module_that_fails_says_why(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "numpy.py").write_text("import no_such_library\n")
            program = (f"sys.path.insert(0, {folder!r})\nimport yars\ntry:\n    yars.Scene\n"
                       "except yars.Error as error:\n    print(error)\n")
            self.assertIn("found one that fails: No module named 'no_such_library'", run(program))

    def compiled(self, *files, absent=()):
        """What is said of the compiled part where the package has these files beside it."""
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder, "yars")
            package.mkdir()
            (package / "__init__.py").write_text((PACKAGE / "yars/__init__.py").read_text())
            pathlib.Path(folder, "numpy.py").write_text("")
            for file in files:
                (package / file).write_text("no library")
            return said("yars.Terrain", absent, folder)

    def test_the_compiled_part(self):
        printed = self.compiled()
        self.assertRegex(printed, r"^True yars.Terrain: expected _core\.cpython-\S+\.so in \S+/yars, found none; "
                                  r"install the Debian package "
                         r"python3-yars; ")
        self.assertEqual(printed.count("\n"), 1)

    def test_a_compiled_part_for_another_python(self):
        printed = self.compiled("_core.cpython-302-x86_64-linux-gnu.so")
        self.assertIn("found _core.cpython-302-x86_64-linux-gnu.so in", printed)
        self.assertIn("it is for another Python than this one", printed)

    def test_a_compiled_part_that_does_not_load(self):
        import importlib.machinery
        printed = self.compiled("_core" + importlib.machinery.EXTENSION_SUFFIXES[0])
        self.assertIn("to load, found: ", printed)
        self.assertIn("install or build it again", printed)


    def of_session(self, *files):
        """What is said of libyars-client where the package, with these files beside it, is far from any build."""
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder, "yars")
            shutil.copytree(PACKAGE / "yars", package, ignore=shutil.ignore_patterns("dataset", "__pycache__"))
            for file in files:
                (package / file).write_text("no library")
            return said("yars.Session('absent-session')", folder=folder)

    def test_the_library_of_sessions(self):
        name = run("import yars; print('libyars-client.so.' + yars.__version__.rpartition('.')[0])").strip()
        if subprocess.run([sys.executable, "-c", f"import ctypes; ctypes.CDLL({name!r})"],
                          capture_output=True).returncode == 0:
            self.skipTest(f"{name} is installed")
        for files in ((), (name,)):
            printed = self.of_session(*files)
            self.assertRegex(printed, rf"^True yars.session: expected the library {name}, found: .*{name}.*; "
                                      r"install the Debian package yars; ")
            self.assertEqual(printed.count("\n"), 1)
        self.assertIn("file too short; ", printed)
        self.assertEqual(run("import yars; print(yars.Event.TDC, yars.patch_map.__name__)"), "2 patch_map\n")


class Examples(unittest.TestCase):
    def test_fly_py_runs_from_the_sources(self):
        done = subprocess.run([sys.executable, "-B", "-I", str(SOURCE / "examples/fly.py"), "absent-session"],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no such session runs", done.stderr)


class Documents(unittest.TestCase):
    def test_what_python_md_shows_compiles(self):
        text = (SOURCE / "docs/python.md").read_text()
        blocks = [textwrap.dedent(block).strip() for block in re.findall(r"(?:^(?:    .*|)\n)+", text, re.M)
                  if block.strip()]
        programs = [block for block in blocks if re.match(r"import|from", block)]
        self.assertGreaterEqual(len(programs), 2)
        for program in programs:
            compile(program, "docs/python.md", "exec")

    def test_functions_of_plot_in_python_md_are_there(self):
        named = set(re.findall(r"^\| `(\w+)\(", (SOURCE / "docs/python.md").read_text(), re.M))
        defined = {one.name for one in ast.parse((PACKAGE / "yars/plot.py").read_text()).body
                   if isinstance(one, ast.FunctionDef)}
        self.assertTrue({"ppi", "patch", "map", "trade_front"} <= named <= defined, named - defined)


@unittest.skipUnless(BUILD, "no build folder is given")
class Built(unittest.TestCase):
    def test_the_build_folder_has_the_files_of_the_sources(self):
        def files(folder, patterns=("*.py", "*.pyi", "py.typed")):
            return {path.relative_to(folder): path.read_bytes() for pattern in patterns
                    for path in folder.rglob(pattern)}

        self.assertEqual(files(BUILD / "python/yars"), files(PACKAGE / "yars"))

    def test_the_session_calls_the_library_beside_it(self):
        printed = run("import yars.session; print(yars.session._library()._name)", ("numpy",), folder=BUILD / "python")
        self.assertRegex(printed, rf"^{BUILD}/python/yars/libyars-client\.so\.\d+\.\d+\n$")

    def test_it_is_found_there(self):
        self.assertEqual(run("import yars; print(yars.__file__)", folder=BUILD / "python"),
                         f"{BUILD / 'python/yars/__init__.py'}\n")


if __name__ == "__main__":
    unittest.main()
