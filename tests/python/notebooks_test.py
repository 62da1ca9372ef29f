#!/usr/bin/env python3
"""The script of README and a notebook, with YARS_TEST_FULL all of examples/notebooks, run and make the pictures in
docs/pictures; what lab/notebooks finds wrong with a picture.

usage: notebooks_test.py BIN      BIN: folder of programs of a build.
    Skipped (code 77) where it has no compiled part of yars.
"""
import importlib.machinery
import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
BUILD = pathlib.Path(sys.argv.pop(1)).resolve().parent
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "lab" / "notebooks"
if not list((BUILD / "python/yars").glob("_core*.so")):
    print("no compiled part in this build: skipped")
    sys.exit(77)
try:
    import matplotlib  # noqa: F401
    import numpy
    from PIL import Image
except ImportError as problem:
    print(f"{problem}: skipped")
    sys.exit(77)

loader = importlib.machinery.SourceFileLoader("notebooks", str(SCRIPT))
notebooks = importlib.util.module_from_spec(importlib.util.spec_from_loader("notebooks", loader))
loader.exec_module(notebooks)


class Scripts(unittest.TestCase):
    def test_they_make_the_pictures_of_the_documents(self):
        for name in notebooks.MADE if "YARS_TEST_FULL" in os.environ else ("README.md", "patch_labels.py"):
            self.assertEqual(notebooks.check(name, BUILD, write=False), [])

    def test_every_notebook_is_run(self):
        files = {path.name for path in (ROOT / "examples/notebooks").glob("*.py")}
        self.assertEqual(files, set(notebooks.MADE) - {"README.md"})

    def test_notebooks_are_cells(self):
        for name in set(notebooks.MADE) - {"README.md"}:
            text = notebooks.text_of(name)
            self.assertTrue(text.startswith("# %% [markdown]\n# # "), name)
            self.assertGreater(text.count("\n# %%\n"), 4, name)

    def test_the_script_of_readme_has_at_most_ten_lines(self):
        lines = [line for line in notebooks.text_of("README.md").splitlines() if line.strip()]
        self.assertLessEqual(len(lines), 10)

    def test_every_picture_stands_in_a_document(self):
        text = (ROOT / "README.md").read_text() + (ROOT / "docs/python.md").read_text()
        for picture in sum(notebooks.MADE.values(), []):
            self.assertIn(f"pictures/{notebooks.KEPT_AS.get(picture, picture)}", text)


class Pictures(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.kept = notebooks.PICTURES / "python_scan.png"
        self.pixels = numpy.array(Image.open(self.kept).convert("RGB"))

    def fault_of(self, pixels, kept=None):
        path = pathlib.Path(self._folder.name) / "python_scan.png"
        Image.fromarray(pixels).save(path)
        return notebooks.fault(path, kept or self.kept)

    def test_the_same_picture_is_right(self):
        self.assertIsNone(self.fault_of(self.pixels))

    def test_a_blank_picture_is_a_fault(self):
        self.assertRegex(self.fault_of(numpy.full_like(self.pixels, 255)), "at least 3% of it drawn, found 0")

    def test_another_picture_is_a_fault(self):
        self.assertRegex(self.fault_of(self.pixels[:, ::-1]), "mean difference of at most 2 levels")

    def test_another_size_is_a_fault(self):
        self.assertRegex(self.fault_of(self.pixels[:-1]), "expected the size")

    def test_a_picture_that_is_not_kept_is_a_fault(self):
        self.assertRegex(self.fault_of(self.pixels, notebooks.PICTURES / "python_none.png"),
                         "found none; run lab/notebooks")


if __name__ == "__main__":
    unittest.main()
