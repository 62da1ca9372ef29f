#!/usr/bin/env python3
"""`--roles` and `--network` of the start script: which programs start, in which order, with which arguments,
and how they end.

usage: network_start_test.py
The command runs as it is installed, with programs that stand in for the real ones: each writes down
its arguments when it starts and its name when it ends.
`yars status` says that the gateway has joined, of a degraded set, when a file is there.
"""
import pathlib
import re
import signal
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import tour_start_test  # noqa: E402

# It writes down that it starts when it is ready for the signal that ends it.
ROLE = """#!/bin/bash
case "$(basename "$0") $*" in gateway*) ;; *--lockstep*) echo "$(basename "$0") $@" >>"$YARS_TEST_LOG"; exit 0 ;; esac
trap 'kill $waiting; echo "ended $(basename "$0")" >>"$YARS_TEST_LOG"; exit 0' TERM INT
sleep 60 & waiting=$!
echo "$(basename "$0") $@" >>"$YARS_TEST_LOG"
wait $waiting
"""
YARS = """#!/bin/bash
while [ "${1#--}" != "$1" ]; do shift 2; done
case "$1 $2" in
  "config user"|"config check") ;;
  "config print") cat "$3" ;;
  "status --json")
    [ -e "$YARS_TEST_LOG.joined" ] && grep -q ^gateway "$YARS_TEST_LOG" &&
      { echo '{"network": {"joined": true}}'; exit 3; } ;;
  *) exit 1 ;;
esac
"""
WATCHDOG_S = tour_start_test.WATCHDOG_S
ROLES = ["flight-model", "input-monitor", "state-machine", "radar-model", "radar-display"]


class Place(tour_start_test.Place):
    def __init__(self, folder):
        super().__init__(folder)
        for name in [*ROLES, "gateway"]:
            self.write(f"bin/{name}", ROLE)
        self.write("bin/yars", YARS)
        (self.folder / "network.guf").write_text("( Network )\n")
        (self.folder / "terrain").mkdir()
        self.options = ["--log-dir", "", "--terrain", self.folder / "terrain"]
        self.join()

    def join(self, joined=True):
        file = pathlib.Path(f"{self.log}.joined")
        file.touch() if joined else file.unlink()

    def begun(self):
        text = self.log.read_text() if self.log.exists() else ""
        return [line.split()[0] for line in text.splitlines() if not line.startswith("ended ")]

    def ended(self):
        return [line.split()[1] for line in self.log.read_text().splitlines() if line.startswith("ended ")]

    def run_until(self, number, *arguments, network=True):
        """Text of a set that is ended when a number of programs have started."""
        more = ["--network", str(self.folder / "network.guf")] if network else []
        process = self.start(*more, *arguments)
        deadline = time.monotonic() + WATCHDOG_S
        while len(self.begun()) < number:
            assert time.monotonic() < deadline and process.poll() is None, (self.begun(), process.poll())
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        text = process.communicate(timeout=WATCHDOG_S)[0]
        assert process.returncode == 0, text
        return text


def the_gateway_is_first_and_last(place):
    text = place.run_until(3, "--roles", "radar-model,state-machine")
    assert (place.begun()[0] == "gateway" and
            sorted(place.begun()) == ["gateway", "radar-model", "state-machine"]), place.begun()
    assert place.ended()[-1] == "gateway" and len(place.ended()) == 3, place.ended()
    gateway = place.lines("gateway")[0]
    assert (f"--network {place.folder}/network.guf" in gateway and
            f"--terrain {place.folder}/terrain" in gateway), gateway
    for role in ("radar-model", "state-machine"):
        assert "--standby" in place.lines(role)[0], place.lines(role)
    assert "no frames; they run until they are interrupted" in text and "Frames go to" not in text, text


def roles_without_a_network(place):
    place.run_until(1, "--roles", "flight-model", network=False)
    assert place.begun() == ["flight-model"], place.begun()
    place.run_until(2, "--roles", "radar-model,flight-model", "--no-flight")
    assert place.begun() == ["gateway", "radar-model"], place.begun()
    place.run_until(4, "--no-input", "--headless", "100", "--frames", str(place.folder / "frames"), network=False)
    assert sorted(place.begun()) == ["flight-model", "radar-display", "radar-model", "state-machine"], place.begun()
    assert "--standby" not in place.log.read_text()


def a_form_in_the_configuration_is_a_network(place):
    config = place.folder / "network_in_config.guf"
    config.write_text('( Apg70 )\n( Network\n  :interfaces `( "lo" ) )\n')
    text = place.run_until(2, "--roles", "radar-model", "--config", str(config), network=False)
    assert place.begun() == ["gateway", "radar-model"], place.begun()
    assert f"--config {config} --network {config}" in place.lines("gateway")[0], place.lines("gateway")
    assert "The configuration has a form Network" in text, text
    place.log.unlink()
    config.write_text("( Apg70 )\n")
    place.run_until(1, "--roles", "radar-model", "--config", str(config), network=False)
    assert place.begun() == ["radar-model"], place.begun()


def a_limit_without_a_display(place):
    code, text = place.run("--roles", "flight-model", "--headless", "0.5")
    assert code == 0 and "they run for 0.5 s\n" in text, text


def a_display_alone(place):
    text = place.run_until(2, "--roles", "radar-display", "--headless", "100", "--frames", str(place.folder / "frames"))
    assert place.begun() == ["gateway", "radar-display"] and "Frames go to" in text, text


def a_gateway_that_does_not_join_is_not_waited_for_for_ever(place):
    place.join(False)
    text = place.run_until(2, "--roles", "flight-model")
    assert place.begun() == ["gateway", "flight-model"], place.begun()
    assert "expected it to join the network within 5 s, found it has not" in text, text


def a_gateway_that_refuses_its_file_ends_the_set(place):
    place.join(False)
    place.write("bin/gateway", "#!/bin/sh\necho gateway >>\"$YARS_TEST_LOG\"\nexit 2\n")
    code, text = place.run("--network", str(place.folder / "network.guf"), "--roles", "flight-model")
    assert code == 1 and "gateway refused its arguments" in text and place.begun() == ["gateway"], text


def lockstep_names_the_roles_of_all_computers(place):
    network = ["--network", str(place.folder / "network.guf"), "--headless", "2", "--lockstep"]
    for roles in ("radar-model", "state-machine,flight-model"):
        code, text = place.run(*network, "--roles", roles)
        assert code == 0 and place.ended() == ["gateway"], text
        plan = re.search(r"--lockstep (\S+)", place.lines(roles.split(",", maxsplit=1)[0])[0])[1]
        assert plan == ",".join(ROLES) + "@400", plan
    place.run(*network, "--roles", "radar-model", "--no-flight")
    assert "--lockstep " + ",".join(ROLES[1:]) + "@400" in place.lines("radar-model")[0], place.lines("radar-model")
    place.run("--headless", "2", "--lockstep", "--roles", "state-machine,radar-model")
    assert "--lockstep state-machine,radar-model@400" in place.lines("radar-model")[0], place.lines("radar-model")


def what_is_refused(place):
    for words, part in ((["--roles", "radar"], "--roles: expected some of flight-model, "),
                        (["--roles", ""], "found ''"),
                        (["--roles", "radar-model,"], "found radar-model,"),
                        (["--roles", "radar-model", "--frames", "x"], "--frames: expected radar-display among --roles"),
                        (["--network", "absent"], "--network: expected a file that can be read"),
                        (["--roles", "input-monitor"], "expected --input SOURCE or a terminal")):
        code, text = place.run(*words)
        assert code == 2 and part in text, (words, text)


def a_build_without_a_gateway(place):
    (place.folder / "bin/gateway").unlink()
    code, text = place.run("--network", str(place.folder / "network.guf"))
    assert code == 1 and "expected the program gateway beside yars, found none" in text, text


if __name__ == "__main__":
    tour_start_test.run_each(Place, the_gateway_is_first_and_last, roles_without_a_network,
                             a_form_in_the_configuration_is_a_network, a_limit_without_a_display, a_display_alone,
                             a_gateway_that_does_not_join_is_not_waited_for_for_ever,
                             a_gateway_that_refuses_its_file_ends_the_set, lockstep_names_the_roles_of_all_computers,
                             what_is_refused, a_build_without_a_gateway)
