#!/usr/bin/env python3
"""The data set maker on Dask distributed: a scheduler and three workers, of which two die after 15 and 30 of 50 blocks,
make the same files as one process. usage: dataset_dask_test.py BIN [unittest options]   (BIN: folder of `yars`)"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE))
from dataset_run_test import Case, alive, tree, wait_for  # noqa: E402  takes BIN from the arguments

try:
    import distributed  # noqa: F401
except ImportError:
    print("distributed is not installed: skipped")
    sys.exit(77)


def hosts_of(folder):
    """Host processes and workers of a data set's folder."""
    found = []
    for entry in os.listdir("/proc"):
        try:
            words = pathlib.Path(f"/proc/{entry}/cmdline").read_bytes().split(b"\0") if entry.isdigit() else []
        except OSError:
            continue
        if b"yars.dataset.host" in words and str(folder).encode() in words and alive(int(entry)):
            found.append(int(entry))
    return found


class Cluster:
    """A scheduler and workers with one thread each, as processes of this computer."""

    def __init__(self, folder, workers, environment):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address, self._folder, self.kills = f"tcp://127.0.0.1:{port}", folder, 0
        paths = os.pathsep.join([path for path in sys.path if path])
        self._environment = {**os.environ, "PYTHONPATH": paths, **environment}
        self.scheduler = self._start("dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        self._count, self.workers = 0, []
        for _ in range(workers):
            self.add()
        self._stop = threading.Event()
        self._killer = None

    def _start(self, program, *arguments):
        log = open(self._folder / f"{program}.log", "ab")
        with log:
            return subprocess.Popen([sys.executable, "-m", f"distributed.cli.{program}", *arguments],
                                    env=self._environment, stdout=log, stderr=log, cwd=self._folder)

    def add(self):
        self._count += 1
        self.workers.append(self._start("dask_worker", self.address, "--nthreads", "1",
                                        "--no-dashboard", "--no-nanny", "--memory-limit", "0",
                                        "--local-directory", str(self._folder / f"worker{self._count}")))

    def kill_when(self, due):
        """Kills the oldest worker, and starts another, each time that due(kills up to now) is true."""
        def loop():
            while not self._stop.wait(0.02):
                if not due(self.kills):
                    continue
                oldest = self.workers.pop(0)
                oldest.kill()
                oldest.wait()
                self.kills += 1
                self.add()
        self._killer = threading.Thread(target=loop, daemon=True)
        self._killer.start()

    def close(self):
        self._stop.set()
        if self._killer:
            self._killer.join()
        for process in self.workers + [self.scheduler]:
            process.kill()
            process.wait()


class Dask(Case):
    count, block = 800, 16

    def cluster(self, workers=3, **environment):
        folder = self.folder / "cluster"
        folder.mkdir(exist_ok=True)
        cluster = Cluster(folder, workers, environment)
        self.addCleanup(cluster.close)
        return cluster

    def test_deaths_and_an_interrupt(self):
        """On one cluster, which takes as long to start as a data set."""
        cluster = self.cluster(FAKE_MAKER_S="0.2")
        cluster.kill_when(lambda kills: kills < 2 and self.blocks_there() >= 15 * (kills + 1))
        done = self.run_it("--dask", cluster.address)
        self.assertIn("800 items made", done.stdout)
        self.assertEqual(cluster.kills, 2)
        self.assertEqual(tree(self.out), self.reference())
        self.assertTrue(wait_for(lambda: not hosts_of(self.out)), "a host process is left")
        for check in (self.check_interrupt, self.check_death_of_the_scheduler):
            shutil.rmtree(self.out)
            with self.subTest(check.__name__):
                check(cluster)

    def check_interrupt(self, cluster):
        process = self.start("--dask", cluster.address)
        self.assertTrue(wait_for(lambda: self.blocks_there() > 3))
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 143, errors)
        self.assertTrue(wait_for(lambda: not hosts_of(self.out)), "a host process is left")
        there = self.blocks_there()
        time.sleep(1.0)
        self.assertEqual(self.blocks_there(), there)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def check_death_of_the_scheduler(self, cluster):
        """One error, and no host that is left."""
        process = self.start("--dask", cluster.address)
        self.assertTrue(wait_for(lambda: self.blocks_there() > 3))
        cluster.scheduler.kill()
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, errors)
        self.assertEqual(len(errors.strip().splitlines()), 1, errors)
        self.assertIn("yars dataset: --dask: expected the scheduler", errors)
        self.assertTrue(wait_for(lambda: not hosts_of(self.out)), "a host process is left")
        there = self.blocks_there()
        self.assertIn(f"{16 * there:,} were there", self.run_it().stdout)
        self.assertEqual(tree(self.out), self.reference())

    @unittest.skipUnless("YARS_TEST_FULL" in os.environ, "scripts/test --full runs it: a cluster of its own")
    def test_full_disk_is_one_error(self):
        cluster = self.cluster(workers=2, FAKE_MAKER_FULL="20")
        done = self.run_it("--dask", cluster.address, code=1)
        self.assertEqual(done.stderr.count("No space left on device"), 1, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        self.run_it()
        self.assertEqual(tree(self.out), self.reference())

    def test_no_scheduler(self):
        shutil.rmtree(self.out, ignore_errors=True)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        done = self.run_it("--dask", f"tcp://127.0.0.1:{port}", code=1,
                           environment={"DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "1s"})
        self.assertIn("expected a scheduler", done.stderr)
        self.assertFalse(self.out.exists())
        self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
