#!/usr/bin/env python3
"""The data set maker with a made-up radar: equal files from any number of workers and shards; ends and faults that
leave a folder which the same command completes.
usage: dataset_run_test.py BIN [unittest options]   (BIN: folder of `yars`)"""
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import unittest

HERE = pathlib.Path(__file__).resolve().parent
FAKE_MAKER = HERE / "dataset_fake_maker.py"
sys.path.append(str(HERE.parents[1] / "python"))
sys.path.append(str(HERE))
if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
    os.environ["YARS_BIN"] = os.path.abspath(sys.argv.pop(1))

from yars.dataset import Dataset, maker, run  # noqa: E402

SPEC = """count: {count}
seed: 3
chip: {{size: 16, window_nm: 0.67, arrays: [video, object, shadow]}}
scenes: [{{file: town.flt, at: [37.5, -122.3]}}]
targets:
  - {{area: [37, -123, 38, -122], on: land}}
  - {{objects: house}}
geometry: {{range_nm: {{uniform: [5, 18]}}, altitude_ft: {{uniform: [5000, 20000]}}, squint_deg: {{uniform: [5, 70]}}}}
movers: [{{count: {{uniform: [0, 3]}}}}]
weather: {{sea_state: {{uniform: [0, 5]}}}}
output: {{block: {block}{output}}}
"""


def tree(folder):
    """{path: hash} of all files."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def descendants(pid):
    """Processes below a process."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                parents[int(entry)] = int(pathlib.Path(f"/proc/{entry}/stat").read_text().rpartition(")")[2].split()[1])
            except (OSError, ValueError):
                pass
    below = {pid}
    while True:
        more = {child for child, parent in parents.items() if parent in below} - below
        if not more:
            return below - {pid}
        below |= more


def alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False


def call_in_child(function, environment, prepare=None):
    """Calls a function, which returns an exit code, in a child of fork(): the child need not import what this process
    has imported. prepare: called in the child first. Returns what subprocess.run does."""
    pipes = [os.pipe(), os.pipe()]
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            signal.alarm(300)
            for number, (read, write) in enumerate(pipes, 1):
                os.dup2(write, number)
                os.close(read)
                os.close(write)
            os.environ.update(environment)
            if prepare:
                prepare()
            code = function()
        except SystemExit as end:
            code = end.code
        except BaseException:  # pylint: disable=broad-except
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    texts = ["", ""]

    def read_all(number):
        with open(pipes[number][0], encoding="utf-8") as file:
            texts[number] = file.read()
    for _, write in pipes:
        os.close(write)
    reader = threading.Thread(target=read_all, args=(1,))
    reader.start()
    read_all(0)
    reader.join()
    return subprocess.CompletedProcess(None, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), *texts)


maker.hasher()  # imported here for all children


class Case(unittest.TestCase):
    count, block, output = 200, 8, ""
    _kept = tempfile.TemporaryDirectory(prefix="yars-dataset-kept-")
    _references = {}  # (folder in _kept, its tree) by specification and scene: many tests have the same

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="yars-dataset-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        (self.folder / "town.flt").write_bytes(b"a scene that the made-up radar does not read")
        self.plan = self.write_spec()
        self.out = self.folder / "out"

    def write_spec(self, name="specification.yaml", **changes):
        values = {"count": self.count, "block": self.block, "output": self.output, **changes}
        path = self.folder / name
        path.write_text(SPEC.format(**values))
        return path

    def command(self, *arguments, out=None, plan=None):
        return [sys.executable, str(FAKE_MAKER), str(plan or self.plan), "--out", str(out or self.out),
                *map(str, arguments)]

    def start(self, *arguments, environment=None, **options):
        return subprocess.Popen(self.command(*arguments), env={**os.environ, **(environment or {})},
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)

    def run_it(self, *arguments, code=0, out=None, plan=None, environment=None, prepare=None):
        command = self.command(*arguments, out=out, plan=plan)
        if command[1] == str(FAKE_MAKER) and "--dask" not in command and threading.active_count() == 1:
            done = call_in_child(lambda: run.main(command[2:], maker="dataset_fake_maker:open_maker"),
                                 environment or {}, prepare)
        else:
            done = subprocess.run(command, env={**os.environ, **(environment or {})}, capture_output=True, text=True,
                                  check=False, timeout=300, preexec_fn=prepare)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def _reference(self):
        key = (self.plan.read_text(), (self.folder / "town.flt").read_bytes())
        if key not in self._references:
            out = pathlib.Path(self._kept.name) / str(len(self._references))
            self.run_it("--workers", 1, out=out)
            self._references[key] = out, tree(out)
        return self._references[key]

    def reference(self):
        """The files that one worker makes by this test's specification, as tree() gives them."""
        return self._reference()[1]

    def have_whole(self):
        """Fills the folder `out` with the files of reference() and returns them."""
        folder, whole = self._reference()
        shutil.copytree(folder, self.out)
        return whole

    def blocks_there(self):
        return len(list(self.out.glob("parts/*/*.jsonl")))


class EqualFiles(Case):
    count, block = 800, 16

    def test_workers_and_shards(self):
        whole = self.reference()
        two = self.folder / "two"
        self.run_it("--workers", 2, out=two)
        self.assertEqual(tree(two), whole)
        seven = self.folder / "seven"
        for shard in (3, 0, 6, 1, 5, 2, 4):
            self.assertNotIn("manifest.jsonl", tree(seven))
            self.run_it("--workers", 1, "--shard", f"{shard}/7", out=seven)
        self.assertEqual(tree(seven), whole)

    def test_shards_at_once(self):
        running = [self.start("--workers", 1, "--shard", f"{shard}/3") for shard in range(3)]
        for process in running:
            _, errors = process.communicate(timeout=300)
            self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(tree(self.out), self.reference())

    def test_items_do_not_depend_on_the_block(self):
        self.run_it("--workers", 1, out=self.folder / "reference")
        self.run_it(plan=self.write_spec("other.yaml", block=37))
        first, second = Dataset(self.folder / "reference"), Dataset(self.out)
        for item in (0, 36, 37, 799):
            for name in ("video", "object", "boxes"):
                self.assertEqual(first[item][name].tobytes(), second[item][name].tobytes())
            self.assertEqual(first[item]["parameters"], second[item]["parameters"])


class Ends(Case):
    """The maker takes 50 ms a block, so that signals find it at work."""
    count, block = 400, 4
    slow = {"FAKE_MAKER_S": "0.05"}

    def begun(self, *arguments, **options):
        process = self.start("--workers", 2, *arguments, environment=self.slow, **options)
        self.addCleanup(process.kill)
        self.assertTrue(wait_for(lambda: self.blocks_there() > 3))
        return process

    def check_end(self, process, code):
        below = descendants(process.pid)
        self.assertGreaterEqual(len(below), 3)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, code, errors)
        self.assertTrue(wait_for(lambda: not any(map(alive, below))), "a child is left")
        self.assertLess(self.blocks_there(), 100)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())
        return errors

    def test_interrupt_and_terminate(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(number):
                process = self.begun()
                below = descendants(process.pid)
                process.send_signal(number)
                _, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, code, errors)
                self.assertIn("run the same command again", errors)
                self.assertNotIn("Traceback", errors)
                self.assertTrue(wait_for(lambda: not any(map(alive, below))), "a child is left")
                self.assertLess(self.blocks_there(), 100)
                self.run_it()
                self.assertEqual(tree(self.out), self.reference())
                shutil.rmtree(self.out)

    def test_kill_of_the_coordinator_leaves_no_child(self):
        process = self.begun()
        below = descendants(process.pid)
        self.assertGreaterEqual(len(below), 3)
        process.kill()
        process.communicate()
        self.assertTrue(wait_for(lambda: not any(map(alive, below))), "a child is left")
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_killed_workers_and_host_are_replaced(self):
        process = self.begun()
        for _ in range(6):
            below = sorted(descendants(process.pid))
            if below:
                os.kill(below[-1], signal.SIGKILL)
            time.sleep(0.2)
        if process.poll() is None:
            below = sorted(descendants(process.pid))
            os.kill(below[0], signal.SIGKILL)  # the host process
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(tree(self.out), self.reference())

    def test_a_block_that_kills_its_workers_is_an_error(self):
        done = self.run_it("--workers", 2, environment={"FAKE_MAKER_DEADLY_MAP": "30"}, code=1)
        self.assertIn("block 7: expected its files, found its worker ended each time by SIGKILL", done.stderr)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())


class Arguments(Case):
    def test_wrong_ones(self):
        for arguments, word in ((("--workers", "0"), "1 to 4096"), (("--shard", "7/7"), "0 to N - 1"),
                                (("--shard", "x"), "i/N")):
            self.assertIn(word, self.run_it(*arguments, code=2).stderr)

    def test_no_specification(self):
        done = self.run_it(plan=self.folder / "none.yaml", code=1)
        self.assertIn("none.yaml: expected a specification, found none", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_absent_scene(self):
        (self.folder / "town.flt").unlink()
        self.assertIn("specification.yaml:4: expected an OpenFlight file, found none", self.run_it(code=1).stderr)

    def test_unknown_class(self):
        text = self.plan.read_text().replace("objects: house", "objects: hause")
        self.plan.write_text(text)
        self.assertIn("specification.yaml:7: expected a class of the scenes' objects (car, house)",
                      self.run_it(code=1).stderr)

    def test_no_boxes_is_a_warning(self):
        self.plan.write_text(self.plan.read_text().replace("[video, object, shadow]", "[video]"))
        self.assertRegex(self.run_it().stderr,
                         "^yars dataset: warning: .*specification.yaml:3: without object there are no boxes")

    def test_check(self):
        self.assertIn("good; 200 items in 25 blocks", self.run_it("--check").stdout)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
