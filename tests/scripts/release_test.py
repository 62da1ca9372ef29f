#!/usr/bin/env python3
"""Facts about scripts/release without its build: what it refuses, the source archive, the list of parts, the notes; and
about texts that name the version.

usage: release_test.py
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(SOURCE / "packaging/release"))
import changelog  # noqa: E402  modules of another folder
import debian_parts  # noqa: E402
import spdx  # noqa: E402

VERSION = re.search(r"^project\(yars VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"),
                    re.M)[1]
PART = {"name": "libpng16-16", "version": "1.6.39-2", "source": "libpng1.6", "source_version": "1.6.39-2",
        "licences": ["Expat", "libpng"]}


class Refusals(unittest.TestCase):
    """In a small checkout of its own: whether this one is clean does not matter."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.tree = pathlib.Path(temporary.name, "tree")
        for name in ("scripts/release", "CMakeLists.txt", "station/web/LICENCES.md", "station/web/package-lock.json"):
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / name, self.tree / name)
        shutil.copytree(SOURCE / "packaging/release", self.tree / "packaging/release",
                        ignore=shutil.ignore_patterns("__pycache__"))
        self.edit("CHANGELOG.md", lambda text: f"# Changelog\n\n## [{VERSION}] - 2026-01-02\n\n- A fact.\n")
        self.git("init", "--quiet")
        self.commit()

    def git(self, *words):
        return subprocess.run(["git", "-C", self.tree, "-c", "user.name=t", "-c", "user.email=t@localhost", *words],
                              check=True, capture_output=True)

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "test")

    def edit(self, name, change):
        path = self.tree / name
        path.write_text(change(path.read_text(encoding="utf-8") if path.exists() else ""), encoding="utf-8")

    def refused(self, expected, *words, code=1):
        done = subprocess.run([sys.executable, self.tree / "scripts/release", *words], capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (code, "", 1), done.stderr)
        self.assertIn(expected, done.stderr)

    def test_a_tree_with_changes(self):
        self.edit("new.txt", lambda text: "new")
        self.refused("expected a clean tree, found 1 changed or new files, the first: new.txt", VERSION)

    def test_another_version(self):
        self.refused(f"expected the version of CMakeLists.txt, {VERSION}, found 9.9.9", "9.9.9")

    def test_a_changelog_without_a_dated_heading(self):
        for change, found in ((lambda text: text.replace("2026-01-02", "unreleased"), "found unreleased"),
                              (lambda text: "# Changelog\n", "found none")):
            self.edit("CHANGELOG.md", change)
            self.commit()
            self.refused(f"expected a heading '## [{VERSION}] - YYYY-MM-DD', {found}", VERSION)

    def test_an_npm_package_without_a_licence_in_the_table(self):
        self.edit("station/web/LICENCES.md", lambda text: re.sub(r"(?m)^\| typescript .*\n", "", text))
        self.commit()
        self.refused("station/web/LICENCES.md: typescript: expected ", VERSION)

    def test_a_folder_with_files_and_unknown_options(self):
        self.refused("expected an empty folder or none, found files", VERSION, "--out", self.tree)
        self.refused("unrecognized arguments: --nonsense; see --help", VERSION, "--nonsense", code=2)

    def test_a_root_that_is_none_leaves_no_folder(self):
        self.refused("--root /nonexistent: expected the root of a Debian system" if os.geteuid() == 0
                         else "expected root for --root", VERSION, "--root", "/nonexistent")
        self.assertFalse((self.tree / "build").exists())


class Parts(unittest.TestCase):
    def made(self):
        parts = spdx.PartsList("1.2.3")
        file_id = parts.add_file("yars_1.2.3-1~deb12u1_amd64.deb", b"content", "1.2.3")
        unknown = {"name": "libc6", "version": "", "source": "", "source_version": "", "licences": []}
        parts.add_debian(file_id, {"Depends": [PART, unknown],
                                   "Recommends": [dict(PART, name="libgdal32", licences=["Expat"])],
                                   "Suggests": []}, "debian-12")
        parts.add_npm(json.loads((SOURCE / "station/web/package-lock.json").read_text(encoding="utf-8")))
        return parts.text("1.2.3", "abc", 1700000000)

    def test_every_relation_is_between_parts_of_the_list(self):
        document = json.loads(self.made())
        names = [one["SPDXID"] for one in document["packages"]]
        self.assertEqual(len(names), len(set(names)))
        known = {*names, "SPDXRef-DOCUMENT"}
        for one in document["relationships"]:
            self.assertTrue({one["spdxElementId"], one["relatedSpdxElement"]} <= known, one)
        self.assertFalse([name for name in names if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", name)])
        self.assertEqual(document["creationInfo"]["created"], "2023-11-14T22:13:20Z")
        self.assertEqual(self.made(), self.made())

    def test_a_debian_part_has_version_licence_and_address(self):
        parts = {one["name"]: one for one in json.loads(self.made())["packages"]}
        self.assertEqual((parts["libgdal32"]["licenseDeclared"], parts["libpng16-16"]["licenseDeclared"]),
                         ("MIT", "NOASSERTION"))
        self.assertIn("Expat; libpng", parts["libpng16-16"]["licenseComments"])
        self.assertEqual(parts["libpng16-16"]["externalRefs"][0]["referenceLocator"],
                         "pkg:deb/debian/libpng16-16@1.6.39-2?distro=debian-12")
        self.assertNotIn("versionInfo", parts["libc6"])

    def test_the_npm_packages_of_the_station_are_in_it(self):
        found = {reference["referenceLocator"] for one in json.loads(self.made())["packages"]
                 for reference in one.get("externalRefs", [])}
        lock = json.loads((SOURCE / "station/web/package-lock.json").read_text(encoding="utf-8"))
        for name in ("typescript", "@esbuild/linux-x64"):
            self.assertIn(f"pkg:npm/{name.replace('@', '%40')}@{lock['packages']['node_modules/' + name]['version']}",
                          found)

    def test_licences_of_a_copyright_file(self):
        text = ("Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\nFiles: *\n .\n"
                "License: Expat\n\n"
                "Files: debian/*\nLicense: GPL-3+\n\nLicense: Expat\n The text.\n")
        self.assertEqual(debian_parts.licences(text), ["Expat"])
        self.assertEqual(debian_parts.licences("Anything else. License: Expat"), [])


class Texts(unittest.TestCase):
    def test_the_section_of_a_version(self):
        text = "# C\n\n## [0.2.0] - unreleased\n\n- b\n\n## [0.1.0] - 2026-01-02\n\n- a\n"
        self.assertEqual(changelog.section(text, "0.2.0"), ("unreleased", "- b"))
        self.assertEqual(changelog.section(text, "0.1.0"), ("2026-01-02", "- a"))
        self.assertIsNone(changelog.section(text, "0.1"))

    def test_texts_name_the_version_of_the_programs(self):
        self.assertIn(f'__version__ = "{VERSION}"', (SOURCE / "python/yars/__init__.py").read_text(encoding="utf-8"))
        self.assertIn(f"\nversion: {VERSION}\n", (SOURCE / "CITATION.cff").read_text(encoding="utf-8"))
        self.assertIsNotNone(changelog.section((SOURCE / "CHANGELOG.md").read_text(encoding="utf-8"), VERSION))
        for path in [SOURCE / "README.md", SOURCE / "Containerfile", *(SOURCE / "docs").glob("*.md")]:
            for named in re.findall(r"(?:yars_|release-)(\d+\.\d+\.\d+)", path.read_text(encoding="utf-8")):
                self.assertEqual(named, VERSION, path)


if __name__ == "__main__":
    unittest.main()
