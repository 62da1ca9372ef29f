#!/usr/bin/env python3
"""`--tour` of the start script: two sets one after the other, which end with the tour; what goes with it and what not.

usage: tour_start_test.py
The command runs as it is installed, with programs that stand in for the real ones: each writes its
arguments down; input-monitor comes to its end at once, the others wait for a signal.
"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time

HOME = pathlib.Path(__file__).resolve().parents[2]
# Those that wait write down that they start when they are ready for the signal that ends them.
ROLE = """#!/bin/bash
says() { echo "$(basename "$0") $@" >>"$YARS_TEST_LOG"; }
case "$(basename "$0") $*" in
  *--lockstep*) says "$@"; exit 0 ;;
  input-monitor*) says "$@"; sleep 0.3; exit "${YARS_TEST_CODE:-0}" ;;
esac
trap 'kill $waiting; exit 0' TERM INT
sleep 60 & waiting=$!
says "$@"
wait $waiting
"""
YARS = """#!/bin/bash
case "$1 $2" in
  "config user"|"config check") ;;
  "terrain generate") mkdir -p "$4/w122" && echo cell >"$4/w122/n37.dt1" ;;
  "scene generate") echo scene >"${@: -1}" ;;
  *) exit 1 ;;
esac
"""
WATCHDOG_S = 60


def install_start(prefix, supervisor=None):
    """yars-start, as in an installation. `supervisor`: text of a module in place of that which runs the sets."""
    (prefix / "bin").mkdir(exist_ok=True)
    shutil.copy(HOME / "scripts/start", prefix / "bin/yars-start")
    shutil.copytree(HOME / "scripts/starting", prefix / "libexec/yars/starting")
    if supervisor:
        (prefix / "libexec/yars/starting/supervisor.py").write_text(supervisor)


class Place:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.log = self.folder / "log"
        self.environment = {"XDG_CACHE_HOME": str(self.folder / "cache"), "YARS_TEST_LOG": str(self.log)}
        self.session = f"tour-start-{os.getpid()}"
        self.options = ["--session", self.session, "--log-dir", "", "--frames", self.folder / "frames"]
        for name in ("state-machine", "radar-model", "flight-model", "input-monitor", "radar-display"):
            self.write(f"bin/{name}", ROLE)
        self.write("bin/yars", YARS)
        install_start(self.folder)
        shutil.copytree(HOME / "config", self.folder / "share/yars/config")

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def start(self, *arguments, code="0", options=None, keep_log=False):
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment.update(self.environment, YARS_TEST_CODE=code)
        if not keep_log:
            self.log.unlink(missing_ok=True)
        return subprocess.Popen([self.folder / "bin/yars-start", *(options or self.options), *arguments],
                                env=environment, text=True, start_new_session=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def run(self, *arguments, code="0"):
        process = self.start(*arguments, code=code)
        text = process.communicate(timeout=WATCHDOG_S)[0]
        return process.returncode, text

    def lines(self, role):
        return ([line for line in self.log.read_text().splitlines() if line.startswith(role + " ")]
                if self.log.exists() else [])


def tour_seconds(file):
    return float(re.findall(r"^(\S+) end$", (HOME / "config/tours" / file).read_text(), re.M)[0])


def two_radars_one_after_the_other(place):
    code, text = place.run("--tour")
    assert code == 0 and "running headless until the tour ends" in text, text
    tours = place.lines("input-monitor")
    assert len(tours) == 2, tours
    assert tours[0].endswith("config/tours/radar.tour") and "config/default.guf" in tours[0], tours
    assert tours[1].endswith("config/tours/second_radar.tour") and "config/default_apg68.guf" in tours[1], tours
    flights = place.lines("flight-model")
    assert all("routes/default.route" in flight for flight in flights) and len(flights) == 2, flights
    displays = place.lines("radar-display")
    assert "--frames {}/frames --every".format(place.folder) in displays[0], displays
    assert "--frames {}/frames/apg68 --every".format(place.folder) in displays[1], displays


def for_the_pilot(place):
    code, text = place.run("--tour", "pilot", "--headless", "100")
    assert code == 0, text
    assert all(line.endswith(".tour,pilot") for line in place.lines("input-monitor")), place.lines("input-monitor")


def in_lockstep_each_part_is_as_long_as_its_tour(place):
    code, text = place.run("--tour", "--headless", "9999", "--lockstep")
    assert code == 0, text
    ends = [int(re.search(r"@(\d+)", line)[1]) for line in place.lines("state-machine")]
    assert ends == [200 * (tour_seconds(file) + 1) for file in ("radar.tour", "second_radar.tour")], ends
    code, text = place.run("--tour", "--headless", "10", "--lockstep")
    ends = [int(re.search(r"@(\d+)", line)[1]) for line in place.lines("state-machine")]
    assert code == 0 and ends == [2000, 2000], (ends, text)


def a_signal_ends_it_all(place):
    place.write("bin/input-monitor", ROLE.replace("  input-monitor*)", "  nothing*)"))
    process = place.start("--tour")
    deadline = time.monotonic() + WATCHDOG_S
    while len(place.lines("radar-display")) == 0 or not place.lines("input-monitor"):
        assert time.monotonic() < deadline, "nothing happened"
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=WATCHDOG_S)  # what starts the next part has ended
    assert len(place.lines("radar-display")) == 1, place.lines("radar-display")
    place.write("bin/input-monitor", ROLE)


def a_tour_that_fails_is_not_followed_by_the_next(place):
    code, text = place.run("--tour", code="2")
    assert code == 1 and "input-monitor" in text, text
    assert len(place.lines("radar-display")) == 1, place.lines("radar-display")


def it_goes_with_its_own_world_only(place):
    for more in (["--terrain", "x"], ["--config", "x.guf"], ["--source", "fixed:1,1,1,1,1"], ["--script", "x"],
                 ["--record", "x"], ["--no-flight"], ["--no-input"]):
        code, text = place.run("--tour", *more)
        assert code == 2 and "--tour: expected none of" in text, (more, text)
    code, text = place.run("--tour", "autopilot")
    assert code == 2 and "autopilot" in text, text


def a_fidelity_reaches_the_radar_model_alone(place):
    code, text = place.run("--tour", "--fidelity", "draft")
    models = place.lines("radar-model")
    assert code == 0 and len(models) == 2 and all(line.endswith("--fidelity draft") for line in models), (text, models)
    assert not any("--fidelity" in line for role in ("state-machine", "radar-display") for line in place.lines(role))
    place.run("--tour")
    assert "--fidelity" not in place.lines("radar-model")[0], place.lines("radar-model")


def a_wrong_fidelity_is_refused_with_the_list(place):
    place.options = ["--log-dir", ""]  # --frames belongs to the display
    for words, expected in ((["--fidelity", "drat"],
                             "expected one of 1996, draft, standard, fine, reference, found 'drat'; "
                             "did you mean 'draft'?"),
                            (["--fidelity", ""], "found an empty text"),
                            (["--fidelity"], "expected a value, found nothing"),
                            (["--fidelity", "fine", "--roles", "flight-model"], "expected radar-model among --roles")):
        code, text = place.run(*words)
        assert (code == 2 and "yars-start: --fidelity: " in text and expected in text and
                text.count("\n") == 1), (words, text)
        assert not place.log.exists(), words


def run_each(place, *tests):
    """Runs tests, each in a folder of its own."""
    for test in tests:
        with tempfile.TemporaryDirectory() as folder:
            test(place(folder))
        print(f"{test.__name__}: ok", flush=True)


if __name__ == "__main__":
    run_each(Place, two_radars_one_after_the_other, for_the_pilot, in_lockstep_each_part_is_as_long_as_its_tour,
             a_fidelity_reaches_the_radar_model_alone, a_wrong_fidelity_is_refused_with_the_list,
             a_signal_ends_it_all, a_tour_that_fails_is_not_followed_by_the_next, it_goes_with_its_own_world_only)
