#!/usr/bin/env python3
"""Doxygen with docs/Doxyfile: pages of a header and its source, and pages of all documents, without diagrams.
Documents and examples have the version of the build."""
import html
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILTER = ROOT / "scripts" / "doxygen_source.py"
FILES = ["model/kernel/tick_inputs.hpp", "model/kernel/tick_inputs.cpp"]


DOXYGEN = shutil.which("doxygen")
sys.path.insert(0, str(ROOT / "scripts"))
import doxygen_source  # noqa: E402  a script beside this folder


def source_files(suffix):
    """Paths of the files that scripts/docs reads, from the top."""
    for root in doxygen_source.ROOTS:
        folder = ROOT / root
        for path in sorted(folder.rglob("*" + suffix)) if folder.is_dir() else [folder]:
            if path.suffix == suffix:
                yield path.relative_to(ROOT)


def filter_of(folder):
    """A program for doxygen, which hands the name of a filter to the shell as it is: without a blank."""
    program = pathlib.Path(folder, "filter")
    program.write_text(f"#!/bin/sh\nexec {shlex.quote(sys.executable)} {shlex.quote(str(FILTER))} \"$@\"\n")
    program.chmod(0o755)
    return program


@unittest.skipUnless(DOXYGEN, "no doxygen")
class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        source = pathlib.Path(cls.folder.name) / "source"
        for file in FILES:
            (source / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / file, source / file)
        settings = (ROOT / "docs" / "Doxyfile").read_text() + "".join(line + "\n" for line in (
            "HAVE_DOT = NO", "USE_MDFILE_AS_MAINPAGE =", "IMAGE_PATH =", "DOTFILE_DIRS =",
            f"INPUT_FILTER = {filter_of(cls.folder.name)} --filter"))
        cls.run_ = subprocess.run(["doxygen", "-"], input=settings, cwd=source, capture_output=True, text=True,
                                  timeout=100)
        cls.pages = pathlib.Path(cls.folder.name) / "html"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def page(self, name):
        return (self.pages / name).read_text(encoding="utf-8")

    def lines_of(self, name):
        """The text of each line of a source's page."""
        lines = re.findall(r'<span class="lineno">(?:<[^>]*>)?\s*\d+(?:<[^>]*>)?</span>(.*?)</div>', self.page(name))
        return [html.unescape(re.sub(r"<[^>]*>", "", line)).strip() for line in lines]

    def test_nothing_is_warned_of(self):
        self.assertEqual((self.run_.returncode, self.run_.stderr), (0, ""))

    def test_pages_show_the_files_as_they_are(self):
        for file in FILES:
            name = pathlib.Path(file)
            shown = self.lines_of(f"{name.stem.replace('_', '__')}_8{name.suffix[1:]}_source.html")
            written = [line.strip() for line in (ROOT / file).read_text().splitlines()]
            self.assertEqual([line for line in shown if line], [line for line in written if line])

    def test_a_headers_page_links_to_the_line_that_declares_and_the_one_that_defines(self):
        page = self.page("tick__inputs_8hpp.html") + "".join(p.read_text()
                                                             for p in self.pages.glob("namespaceyars*.html"))
        source = (ROOT / "model/kernel/tick_inputs.cpp").read_text().splitlines()
        line = next(i for i, text in enumerate(source, 1) if "pose_of(const" in text)
        self.assertIn(f"tick__inputs_8cpp_source.html#l{line:05d}", page)

    def test_plain_comments_are_documentation(self):
        comment = "nullopt if a value of the record is not finite or out of range"
        self.assertTrue(any(comment in p.read_text() for p in self.pages.glob("namespaceyars*.html")), comment)

    def test_the_filter_keeps_the_number_of_every_line(self):
        for file in sorted((ROOT / "model").rglob("*.hpp"))[:40] + sorted((ROOT / "model").rglob("*.cpp"))[:40]:
            out = subprocess.run([sys.executable, str(FILTER), "--filter", str(file)], capture_output=True, text=True,
                                 check=True)
            before, after = file.read_text().splitlines(), out.stdout.splitlines()
            self.assertEqual(len(before), len(after), file)
            same = [i for i, line in enumerate(before) if line.startswith("#include")]
            self.assertEqual([before[i] for i in same], [after[i] for i in same], file)


class Sources(unittest.TestCase):
    """What Doxygen refuses in the whole tree. These tests need no Doxygen."""

    def setUp(self):
        os.chdir(ROOT)  # the paths of doxygen_source are relative to it

    def test_links_between_documents_lead_to_a_file_from_the_top(self):
        links = 0
        for path in source_files(".md"):
            for link in re.findall(r"\]\(([\w./-]+\.md)\)", doxygen_source.document(path)):
                links += 1
                self.assertTrue((ROOT / link).is_file(), f"{path}: expected the path of a document, found {link}")
        self.assertGreater(links, 50)

    def test_code_spans_in_comments_end_on_their_line_and_not_with_a_dot(self):
        """A dot before the closing quote ends the brief description for Doxygen, within the span."""
        for path in source_files(".hpp"):
            lines = (ROOT / path).read_text(encoding="utf-8").splitlines(keepends=True)
            for number, line in enumerate(lines, 1):
                comment = re.search(r"(?:^\s*|[;,{}] +)// ?([^\"]*)$", line)
                if not comment:
                    continue
                place = f"{path}:{number}: {line.strip()}"
                spans = comment[1].split("`")
                self.assertEqual(len(spans) % 2, 1, f"{place}: expected code spans that end on their line")
                ends = [span for span in spans[1::2] if re.search(r"[^.]\.$", span)]
                self.assertEqual(ends, [], f"{place}: expected code spans without a dot at the end")


@unittest.skipUnless(DOXYGEN, "no doxygen")
class Documents(unittest.TestCase):
    def test_links_to_headings_and_anchors_lead_there_and_one_page_is_the_first(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "source"
            subprocess.run([sys.executable, str(FILTER), str(source)], cwd=ROOT, check=True, timeout=100)
            documents = [str(path.relative_to(source)) for path in sorted(source.rglob("*.md"))]
            drawing = source / "docs" / "architecture.md"
            drawing.write_text(re.sub(r"\\dotfile \S+", "", drawing.read_text(encoding="utf-8")), encoding="utf-8")
            settings = (ROOT / "docs" / "Doxyfile").read_text() + f"HAVE_DOT = NO\nINPUT = {' '.join(documents)}\n"
            run = subprocess.run(["doxygen", "-"], input=settings, cwd=source, capture_output=True, text=True,
                                 timeout=100)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            html_folder = pathlib.Path(folder) / "html"
            rules = (html_folder / "md_docs_pilots_manual.html").read_text(encoding="utf-8")
            self.assertIn('id="docs_pilots_manual_rule-5"', rules)
            self.assertIn("an open air-to-ground radar simulation",
                          (html_folder / "index.html").read_text(encoding="utf-8"))
            choices = ((html_folder / "md_docs_decisions_0013_maps_under_the_pilots_hand.html")
                       .read_text(encoding="utf-8"))
            self.assertIn('href="md_docs_pilots_manual.html#docs_pilots_manual_rule-5"', choices)


class Versions(unittest.TestCase):
    def test_documents_have_the_version_of_the_build(self):
        version = re.search(r"project\(yars VERSION (\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
        files = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *ROOT.glob("examples/*.txt"),
                 *ROOT.glob("packaging/cmake/*")]
        found = [(path.relative_to(ROOT).as_posix(), at) for path in files for at in re.findall(
            r"find_package\(yars (\d+\.\d+)|libyars-\w+\.so\.(\d+\.\d+)", path.read_text(encoding="utf-8"))]
        self.assertGreater(len(found), 5)
        self.assertEqual([one for one in found if version not in one[1]], [])


if __name__ == "__main__":
    unittest.main()
