#!/usr/bin/env python3
"""`--web` of the start script: it lasts until it is interrupted, counts the pictures of its own run, and hands its
options to yars-station, whose addresses stand on lines of their own.

usage: web_start_test.py
The command runs as it is installed, with programs that stand in for the real ones.
"""
import contextlib
import pathlib
import signal
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import tour_start_test  # noqa: E402

WATCHDOG_S = tour_start_test.WATCHDOG_S
ADDRESSES = ["http://radar.example:8096/display.html?token=0", "http://radar.example:8096/instructor.html?token=1"]


def first(commands):
    """A role that does something before it says that it runs."""
    return tour_start_test.ROLE.replace("#!/bin/bash", "#!/bin/bash\n" + commands, 1)


DISPLAY = first("""
for word in "$@"; do
  [ "${before:-}" = --frames ] && echo picture | tee "$word/frame_000001.png" >"$word/frame_000002.png"
  before=$word
done
""")
STATION = first(f"printf '%s\\n' '{ADDRESSES[0]}' '{ADDRESSES[1]}'\n")


class Place(tour_start_test.Place):
    def __init__(self, folder):
        super().__init__(folder)
        self.write("bin/yars-station", STATION)
        self.write("bin/radar-display", DISPLAY)
        self.write("bin/input-monitor", tour_start_test.ROLE.replace("  input-monitor*)", "  nothing*)"))
        (self.folder / "terrain").mkdir()
        self.frames = self.folder / "frames"
        self.options = ["--session", self.session, "--log-dir", "", "--terrain", self.folder / "terrain"]
        self.environment["XDG_STATE_HOME"] = str(self.folder / "state")
        self.tokens = f"--tokens={self.folder}/state/yars/web-tokens"

    def of_station(self):
        """Options that yars-station got and others did not."""
        return {word for word in self.lines("yars-station")[0].split()
                if "=" in word or word.startswith("--without-") or word == "--behind-proxy"}

    @contextlib.contextmanager
    def running(self, *arguments):
        """The set's process and the arguments of radar-display; afterwards `text` is what it printed. Without options
        of the station's own, with --web."""
        is_said = any(str(word).startswith("--web-") for word in arguments)
        process = self.start(*([] if is_said else ["--web"]), *arguments)
        try:
            deadline = time.monotonic() + WATCHDOG_S
            while not self.lines("yars-station") or not self.lines("radar-display"):
                assert time.monotonic() < deadline and process.poll() is None, "expected the set to start"
                time.sleep(0.05)
            yield process, self.lines("radar-display")[0].split()
        finally:
            process.send_signal(signal.SIGTERM)
            self.text = process.communicate(timeout=WATCHDOG_S)[0]
        assert process.returncode == 0, self.text


def without_a_screen_it_lasts_until_it_is_interrupted(place):
    # Without power-on, from which the time would run.
    with place.running("--script", "/dev/null") as (process, display):
        time.sleep(1)
        assert process.poll() is None, process.communicate()[0]
        assert "--headless" in display and "--publish" in display and "--frames" not in display, display
    assert "headless until Ctrl-C" in place.text, place.text


def pictures_are_written_where_a_folder_is_named(place):
    with place.running("--frames", place.frames) as (_, display):
        assert f"--frames {place.frames} --every" in " ".join(display), display


def seconds_that_are_given_hold(place):
    with place.running("--headless", "1", "--no-frames", "--script", "/dev/null") as (process, _):
        process.wait(WATCHDOG_S)
    assert "Ctrl-C" not in place.text, place.text


def pictures_of_earlier_runs_are_not_counted(place):
    place.frames.mkdir()
    for number in (2, 3, 4):
        (place.frames / f"frame_00000{number}.png").write_text("earlier")
    with place.running("--frames", place.frames):
        pass
    assert f"; 2 pictures of this run are in {place.frames}" in place.text, place.text


def options_of_the_station_are_handed_to_it(place):
    with place.running("--web-port", "8100"):
        assert place.of_station() == {"--port=8100", place.tokens}, place.lines("yars-station")
    with place.running("--web-listen", "0.0.0.0", "--web-names", "radar.example,radar",
                       "--web-tokens", place.folder / "tokens",
                       "--web-certificate", "/a/certificate.pem", "--web-key", "/a/key.pem", "--web-port", "1",
                       "--web-port", "0"):
        assert place.of_station() == {"--listen=0.0.0.0", "--names=radar.example,radar",
                                      f"--tokens={place.folder}/tokens",
                                      "--certificate=/a/certificate.pem", "--key=/a/key.pem",
                                      "--port=0"}, place.lines("yars-station")
    with contextlib.chdir(place.folder), place.running("--web-without-tls", "--web-tokens", "tokens"):
        assert place.of_station() == {"--without-tls", f"--tokens={place.folder}/tokens"}, place.lines("yars-station")
    with place.running():
        assert place.of_station() == {place.tokens}, place.lines("yars-station")
    assert (place.folder / "state/yars").stat().st_mode & 0o077 == 0
    with place.running("--web-without-tokens", "--web-behind-proxy"):
        assert place.of_station() == {"--without-tokens", "--behind-proxy"}, place.lines("yars-station")


def addresses_stand_on_lines_of_their_own(place):
    with place.running():
        pass
    lines = place.text.splitlines()
    assert [line for line in lines if "://" in line] == ADDRESSES, place.text


def values_that_are_missing_are_refused_at_once(place):
    for option, expected in (("--web-listen", "a value"), ("--web-names", "a value"), ("--web-tokens", "a value"),
                             ("--web-certificate", "a value"), ("--web-key", "a value"), ("--web-port", "a value")):
        code, text = place.run(option)
        message = f"yars-start: {option}: expected {expected}, found nothing; see yars-start --help\n"
        assert code == 2 and text == message, (code, text)
    code, text = place.run("--web-tokens", "")
    assert code == 2 and "--web-tokens: expected a path, found an empty text" in text, (code, text)
    code, text = place.run("--web-listen", "0.0.0.0", "--lockstep", "--headless", "1")
    assert code == 2 and "--web: expected no --lockstep with it" in text, (code, text)


if __name__ == "__main__":
    tour_start_test.run_each(Place, without_a_screen_it_lasts_until_it_is_interrupted,
                             pictures_are_written_where_a_folder_is_named, seconds_that_are_given_hold,
                             pictures_of_earlier_runs_are_not_counted, options_of_the_station_are_handed_to_it,
                             addresses_stand_on_lines_of_their_own, values_that_are_missing_are_refused_at_once)
