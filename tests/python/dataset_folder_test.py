#!/usr/bin/env python3
"""The folder of a data set: what is damaged, lost or of another specification is found; a full disk is one error.
usage: dataset_folder_test.py BIN [unittest options]   (BIN: folder of `yars`)"""
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE))
from dataset_run_test import Case, tree, wait_for  # noqa: E402  takes BIN from the arguments


class Resume(Case):
    def test_what_is_whole_is_not_made_again(self):
        self.run_it()
        done = self.run_it()
        self.assertIn("0 items made, 200 were there", done.stdout)

    def test_damaged_files_are_made_again(self):
        whole = self.have_whole()
        (self.out / "chips.zarr/video/2.0.0").unlink()
        with open(self.out / "chips.zarr/object/5.0.0", "r+b") as file:
            file.truncate(10)
        (self.out / "parts/0000/0000007.jsonl").unlink()
        part = self.out / "parts/0000/0000009.jsonl"
        part.write_bytes(part.read_bytes()[:-40])
        part = self.out / "parts/0000/0000011.jsonl"
        part.write_bytes(part.read_bytes().replace(b'"item":90', b'"item":80'))
        (self.out / "boxes/0000/0000013.npy").write_bytes(b"")
        done = self.run_it()
        self.assertIn("48 items made", done.stdout)
        self.assertIn("block 2 is made again: chips.zarr/video/2.0.0 is absent", done.stderr)
        self.assertEqual(tree(self.out), whole)

    def test_verify_finds_changed_bytes(self):
        whole = self.have_whole()
        path = self.out / "chips.zarr/video/3.0.0"
        data = bytearray(path.read_bytes())
        data[-3] ^= 1
        path.write_bytes(data)
        self.assertIn("0 items made", self.run_it().stdout)
        done = self.run_it("--verify")
        self.assertIn("8 items made", done.stdout)
        self.assertIn("another content", done.stderr)
        self.assertEqual(tree(self.out), whole)

    def test_another_specification_is_refused(self):
        self.have_whole()
        before = tree(self.out)
        for changes in ({"count": 201}, {"block": 9}, {"output": ", compression: zstd"}):
            done = self.run_it(plan=self.write_spec("other.yaml", **changes), code=1)
            self.assertIn("another specification", done.stderr)
        (self.folder / "town.flt").write_bytes(b"another scene")
        self.assertIn("different: contents of scenes[0].file", self.run_it(code=1).stderr)
        self.assertEqual(tree(self.out), before)

    def test_comments_may_change(self):
        self.have_whole()
        self.plan.write_text("# a comment\n" + self.plan.read_text())
        self.run_it()

    def test_a_folder_with_other_files_is_refused(self):
        self.out.mkdir()
        (self.out / "thesis.tex").write_text("x")
        self.assertIn("other files", self.run_it(code=1).stderr)
        self.assertEqual(list(tree(self.out)), ["thesis.tex"])

    def test_leftovers_of_dead_writers_go(self):
        self.have_whole()
        from yars.dataset import files
        (self.out / f".writing-{files._HOST}-999999999-x").write_text("x")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_merge_alone(self):
        self.run_it("--shard", "0/2")
        done = self.run_it("--merge", code=1)
        self.assertIn("run the other shards first", done.stderr)
        self.run_it("--shard", "1/2")
        (self.out / "manifest.jsonl").unlink()
        self.run_it("--merge")
        self.assertEqual(tree(self.out), self.reference())


class Made(Case):
    """Scenes and terrain that the specification makes."""
    count, block = 40, 8

    def write_spec(self, name="specification.yaml", **changes):
        path = super().write_spec(name, **changes)
        path.write_text(path.read_text().replace("{file: town.flt,", "{generate: town, triangles: 200,") +
                        "terrain: {generate: {south: 37, west: -123, level: 0, edge: cut}}\n")
        return path

    def damage(self):
        scene = self.out / "scenes/0_town.flt"
        data = bytearray(scene.read_bytes())
        data[len(data) // 2] ^= 1
        scene.write_bytes(data)
        cell = next((self.out / "terrain").rglob("*.dt0"))
        cell.write_bytes(cell.read_bytes()[:-2] + b"xx")
        (self.out / "terrain/w001").mkdir()
        (self.out / "terrain/w001/n01.dt0").write_text("another cell")

    def test_they_are_read_before_a_block_is_made_and_by_verify(self):
        whole = self.have_whole()
        self.damage()
        damaged = tree(self.out)
        self.assertEqual(self.run_it().stderr, "")  # nothing is made
        self.assertEqual(tree(self.out), damaged)
        done = self.run_it("--verify")
        self.assertIn("warning: " + str(self.out / "scenes/0_town.flt") + " is made again", done.stderr)
        self.assertIn("0 items made", done.stdout)
        self.assertEqual(tree(self.out), whole)
        self.damage()
        (self.out / "parts/0000/0000003.jsonl").unlink()
        self.assertIn("8 items made", self.run_it().stdout)
        self.assertEqual(tree(self.out), whole)

    def test_a_scene_that_was_not_noted_is_made_again(self):
        whole = self.have_whole()
        (self.out / "checks/0_town.flt.json").unlink()
        (self.out / "scenes/0_town.flt").write_text("half")
        self.run_it()
        self.assertEqual(tree(self.out), whole)

    def test_another_scene_than_the_items_were_made_with_is_an_error(self):
        self.have_whole()
        check = self.out / "checks/0_town.flt.json"
        text = check.read_text()
        check.write_text(text.replace(text[-9:-6], "000" if text[-9:-6] != "000" else "111"))
        before = tree(self.out)
        self.assertIn("use the version that dataset.json names", self.run_it("--verify", code=1).stderr)
        self.assertEqual(tree(self.out), before)

    def test_a_limit_of_a_file_s_size_is_named(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        self.assertRegex(self.run_it(prepare=limit, code=1).stderr, "(SIGXFSZ|File too large).*ulimit -f")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_faults_name_keys(self):
        self.plan.write_text(self.plan.read_text().replace("at: [37.5,", "at: [95.5,"))
        self.assertIn("specification.yaml:4: expected", self.run_it(code=1).stderr)


class General(Case):
    """Files that belong to no block."""
    count, block, output = 40, 8, ", png: true, coco: true"
    names = ("objects.json", "manifest.jsonl", "annotations.json", "chips.zarr/.zmetadata", "chips.zarr/video/.zarray")

    def test_they_are_made_again(self):
        whole = self.have_whole()
        for change in (lambda path: path.unlink(), lambda path: path.write_bytes(path.read_bytes()[:-3])):
            for name in self.names:
                with self.subTest(name):
                    change(self.out / name)
                    self.assertIn("0 items made, 40 were there", self.run_it().stdout)
                    self.assertEqual(tree(self.out), whole)
        for name in self.names:
            change(self.out / name)
        self.run_it("--merge")
        self.assertEqual(tree(self.out), whole)

    def test_verify_finds_changed_bytes(self):
        whole = self.have_whole()
        for name in self.names:
            path = self.out / name
            path.write_bytes(path.read_bytes()[:-4] + b"####")
        self.run_it("--verify")
        self.assertEqual(tree(self.out), whole)

    def test_checks_are_written_again(self):
        whole = self.have_whole()
        for path in (self.out / "checks").iterdir():
            path.write_text("{")
        self.run_it()
        self.assertEqual(tree(self.out), whole)


class Specification(Case):
    """Which specification a folder takes."""
    count, block = 40, 8

    def test_the_message_names_the_keys(self):
        self.have_whole()
        self.plan.write_text(
            self.plan.read_text().replace("count: 40", "count: 41").replace("uniform: [5, 18]", "uniform: [6, 18]"))
        self.assertIn("different: count, geometry.range_nm.uniform)", self.run_it(code=1).stderr)
        self.plan.write_text(self.plan.read_text().replace("on: land", "on: sea"))
        self.assertIn("targets[0].on", self.run_it(code=1).stderr)

    def test_a_folder_without_a_block_takes_another(self):
        self.run_it(environment={"FAKE_MAKER_FULL": "1"}, code=1)
        self.assertFalse(list(self.out.glob("parts/*/*")))
        (self.out / "chips.zarr/power").mkdir(parents=True)
        (self.out / "chips.zarr/power/0.0.0").write_text("of the first specification")
        self.write_spec(count=24)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())
        self.assertIn("count: 24", (self.out / "specification.yaml").read_text())

    def test_a_damaged_copy_of_the_specification_is_made_again(self):
        whole = self.have_whole()
        copy = self.out / "specification.yaml"
        for damaged in (copy.read_bytes()[:40], b"", copy.read_bytes()[:-2] + b"x\n"):
            copy.write_bytes(damaged)
            done = self.run_it("--verify")
            self.assertIn(f"warning: {copy} is made again: specification.yaml has another", done.stderr)
            self.assertEqual(tree(self.out), whole)
        self.assertEqual(self.run_it("--verify").stderr, "")

    def test_a_lost_or_damaged_description_is_made_again(self):
        whole = self.have_whole()
        about = self.out / "dataset.json"
        other = about.read_text().replace('"size": 16', '"size": 17')
        for change in (about.unlink, lambda: about.write_text("{"), lambda: about.write_bytes(b""),
                       lambda: about.write_text(other)):
            change()
            done = self.run_it()
            self.assertIn("dataset.json is made again", done.stderr)
            self.assertIn("40 were there", done.stdout)
            self.assertEqual(tree(self.out), whole)
        about.unlink()
        error = self.run_it(plan=self.write_spec("other.yaml", count=41), code=1).stderr
        self.assertIn("specification that they were made by", error)
        self.assertIn("no item is lost", error)
        self.run_it()
        self.assertEqual(tree(self.out), whole)

    def test_another_version_is_a_warning(self):
        self.have_whole()
        about = self.out / "dataset.json"
        text = about.read_text()
        self.assertIn('"yars": "', text)
        about.write_text(text.replace('"yars": "', '"yars": "old-'))
        self.assertEqual(self.run_it().stderr.count("warning: "), 1)

    def test_no_folder_without_need(self):
        self.assertIn("found none", self.run_it("--merge", code=1).stderr)
        self.plan.write_text("count: 1\n")
        self.run_it(code=1)
        self.assertFalse(self.out.exists())

    def test_a_file_in_place_of_the_folder(self):
        self.out.write_text("x")
        for out in (self.out, self.out / "below"):
            self.assertIn("is a file: choose another --out", self.run_it(out=out, code=1).stderr)


class Huge(Case):
    def test_a_billion_blocks_begin_at_once(self):
        self.write_spec(count=10**9, block=1)
        process = self.start("--workers", 1)
        self.addCleanup(process.kill)
        self.assertTrue(wait_for(lambda: self.blocks_there() > 20))
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        self.assertLess(int(re.search(r"VmHWM:\s+(\d+) kB", status).group(1)), 150000)
        process.terminate()
        process.communicate(timeout=60)
        there = self.blocks_there()
        process = self.start("--workers", 1, "--shard", "0/2")
        self.addCleanup(process.kill)
        self.assertTrue(wait_for(lambda: self.blocks_there() > there + 20))
        process.terminate()
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 143)

    def test_blocks_that_are_absent(self):
        from yars.dataset.store import absent_blocks
        there = bytearray(1 << 18)
        for block in (0, 5, 7, 1 << 20):
            there[block // 8] |= 1 << block % 8
        self.assertEqual(list(absent_blocks(there, 0, 1, 9)), [1, 2, 3, 4, 6, 8])
        self.assertEqual(list(absent_blocks(there, 1, 2, 9)), [1, 3])
        self.assertEqual(sum(1 for _ in absent_blocks(there, 0, 1, (1 << 20) + 5)), (1 << 20) + 5 - 4)


class FullDisk(Case):
    def one_error(self, done, *words):
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_no_space(self):
        done = self.run_it("--workers", 2, environment={"FAKE_MAKER_FULL": "20"}, code=1)
        self.one_error(done, "No space left on device", "run the same command again")
        self.assertFalse([name for name in tree(self.out) if ".writing" in name])
        there = self.blocks_there()
        self.assertGreater(there, 1)
        done = self.run_it()
        self.assertIn(f"{8 * there} were there", done.stdout)
        self.assertEqual(tree(self.out), self.reference())

    def test_limit_of_a_file_s_size(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1500, 1500))
        self.one_error(self.run_it(prepare=limit, code=1), "File too large", "ulimit -f")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_a_small_file_system(self):
        small = self.folder / "small"
        small.mkdir()
        if os.geteuid() or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "none", str(small)],
                                          capture_output=True, check=False).returncode:
            self.skipTest("needs the right to mount")
        self.addCleanup(subprocess.run, ["umount", "-l", str(small)], check=False)
        self.one_error(self.run_it(out=small / "out", code=1), "No space left on device")
        there = len(list((small / "out").glob("parts/*/*.jsonl")))
        self.assertGreater(there, 0)
        subprocess.run(["mount", "-o", "remount,size=20m", str(small)], check=True)
        self.run_it(out=small / "out")
        self.assertEqual(tree(small / "out"), self.reference())

    def test_no_permission(self):
        if os.geteuid() == 0:
            self.out.mkdir()
            if not shutil.which("chattr") or subprocess.run(["chattr", "+i", str(self.out)], capture_output=True,
                                                            check=False).returncode != 0:
                self.skipTest("root may write everywhere")
            self.addCleanup(subprocess.run, ["chattr", "-i", str(self.out)], check=False)
        else:
            self.out.mkdir(mode=0o500)
        self.one_error(self.run_it(code=1), "expected")


if __name__ == "__main__":
    unittest.main()
