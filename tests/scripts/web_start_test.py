#!/usr/bin/env python3
"""`--web` of the start script without a screen: it lasts until it is interrupted, and fills no folder with pictures.

usage: web_start_test.py
The script and its supervisor run as they are installed, with programs that stand in for the real ones.
"""
import contextlib
import pathlib
import signal
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import tour_start_test  # noqa: E402

WATCHDOG_S = tour_start_test.WATCHDOG_S


class Place(tour_start_test.Place):
    def __init__(self, folder):
        super().__init__(folder)
        self.write("bin/yars-station", tour_start_test.ROLE)
        self.write("bin/input-monitor", tour_start_test.ROLE.replace("  input-monitor*)", "  nothing*)"))
        (self.folder / "terrain").mkdir()
        self.frames = self.folder / "frames"
        self.options = ["--log-dir", "", "--terrain", self.folder / "terrain"]

    @contextlib.contextmanager
    def running(self, *arguments):
        """The arguments of its supervisor and of radar-display; afterwards `text` is what it printed."""
        process = self.start("--web", *arguments)
        try:
            deadline = time.monotonic() + WATCHDOG_S
            while not self.lines("yars-station") or not self.lines("radar-display"):
                assert time.monotonic() < deadline and process.poll() is None, "expected the set to start"
                time.sleep(0.05)
            words = pathlib.Path(f"/proc/{process.pid}/cmdline").read_bytes().decode().split("\0")
            yield words[:words.index("--role")], self.lines("radar-display")[0].split()
        finally:
            process.send_signal(signal.SIGTERM)
            self.text = process.communicate(timeout=WATCHDOG_S)[0]
        assert process.returncode == 0, self.text


def without_a_screen_it_lasts_until_it_is_interrupted(place):
    with place.running() as (supervisor, display):
        assert "--seconds" not in supervisor, supervisor
        assert "--headless" in display and "--publish" in display and "--frames" not in display, display
    assert "headless until Ctrl-C" in place.text, place.text


def pictures_are_written_where_a_folder_is_named(place):
    with place.running("--frames", place.frames) as (supervisor, display):
        assert "--seconds" not in supervisor, supervisor
        assert f"--frames {place.frames} --every" in " ".join(display), display


def seconds_that_are_given_hold(place):
    with place.running("--headless", "77", "--no-frames") as (supervisor, _):
        assert supervisor[supervisor.index("--seconds") + 1] == "77", supervisor
    assert "Ctrl-C" not in place.text, place.text


def main():
    for test in (without_a_screen_it_lasts_until_it_is_interrupted, pictures_are_written_where_a_folder_is_named,
                 seconds_that_are_given_hold):
        with tempfile.TemporaryDirectory() as folder:
            test(Place(folder))
        print(f"{test.__name__}: ok", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
