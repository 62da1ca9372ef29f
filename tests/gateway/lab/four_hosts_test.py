#!/usr/bin/env python3
"""scripts/start --network on four hosts over a bad line, as docs/network.md sets them up, with identities.
YARS_TEST_FULL: also without, and after a silence.

usage: four_hosts_test.py BIN       BIN: folder of the programs; ends with 77 and a word where there is no lab or no
                                    gateway
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import lab  # noqa: E402

START = lab.TOP / "scripts/start"
ROLES = {"a": "flight-model", "b": "state-machine", "c": "radar-model", "d": "radar-display,input-monitor"}
SESSION = "lab"
CELL_BYTES = 1201 * 1201 * 2  # of zeros: a plain at sea level
FLIGHT = "fixed:37.5,-122.5,15000,90,480"
OF_READER = "hosts probes clock clock_requests input_events lockstep"
WITHIN_S = 60.0  # watchdog
BAD_LINE_S = 6.0
SUPERVISOR_LOOKS_S = 1.0  # between two tries of power-on


class Set:
    """One session over the hosts of a lab."""

    def __init__(self, hosts, programs, folder, identities):
        self.hosts, self.programs, self.folder, self.identities = hosts, pathlib.Path(programs), folder, identities
        self.begun = {}
        (folder / "terrain").mkdir()
        with (folder / "terrain/N37W123.hgt").open("wb") as cell:
            cell.truncate(CELL_BYTES)
        (folder / "empty.script").write_text("")
        if identities:
            subprocess.run([lab.TOP / "scripts/network_identities", folder / "net", *ROLES, "--reads", "d"], check=True,
                           stdout=subprocess.DEVNULL)

    def form(self, host):
        peers = " ".join(f'"{self.hosts.address(name)}"' for name in ROLES)
        more = ""
        if self.identities:
            more = f' :security "net/{host}"' + (f" :topicsOut `( {OF_READER} )" if host == "d" else "")
        file = self.folder / f"{host}.guf"
        file.write_text(f'( Network :interfaces `( "eth0" ) :peers `( {peers} ){more} )\n')
        return file

    def start(self, host, roles):
        words = ["--bin", self.programs, "--session", SESSION, "--terrain", self.folder / "terrain", "--config",
                 lab.TOP / "config/default.guf", "--network", self.form(host), "--roles", roles]
        if "flight-model" in roles:
            words += ["--source", FLIGHT]
        if "radar-display" in roles:
            words += ["--headless", "1000", "--size", "120", "--script", self.folder / "empty.script"]
        self.begun[host] = self.hosts.start(host, str(START), words)

    def watch(self, host):
        text = self.hosts.run(host, str(self.programs / "yars"), ["--session", SESSION, "watch", "--json", "--once"],
                              code=None)
        try:
            return json.loads(text)
        except json.JSONDecodeError:  # nothing runs there yet
            return {}

    def await_on(self, hosts, condition, what):
        try:
            lab.wait_until(lambda: all(condition(self.watch(host)) for host in hosts), what, WITHIN_S, every_s=0.3)
        except lab.LabError as problem:
            said = "\n".join(f"{host}: {process.text()}" for host, process in self.begun.items())
            raise AssertionError(f"{problem}; {[self.watch(host) for host in hosts]}\n{said}") from None

    def end(self):
        for process in self.begun.values():
            process.terminate()
        for host, process in self.begun.items():
            assert process.wait(WITHIN_S) == 0, (host, process.text())


def fly(hosts, programs, folder, identities):
    one = Set(hosts, programs, folder, identities)
    for host, roles in ROLES.items():
        one.start(host, roles)
    one.await_on(ROLES, lambda seen: seen.get("power") == "OPR" and seen.get("sweeps", 0) > 100,
                 "a radar that sweeps, on all hosts")
    applied = one.watch("b")["events_applied"]
    hosts.run("d", str(one.programs / "yars"), ["--session", SESSION, "inject", "elevation -5"])
    one.await_on(["b", "d"], lambda seen: seen.get("events_applied", 0) > applied, "the event of host d applied")
    hosts.kill_host("c")
    one.start("c", "radar-model")
    one.begun["c"].wait_for("radar-model info: runs in session", WITHIN_S)
    seen_sweeps = {one.watch("d")["sweeps"]}

    def goes_on(seen):
        seen_sweeps.add(seen.get("sweeps"))
        return len(seen_sweeps) > 4
    one.await_on(["d"], goes_on, "sweeps of the radar model that was started again")
    one.end()


def joins_over_a_line_that_was_bad(hosts, programs, folder):
    """Handshakes of DDS Security that the line loses are made again when it is better."""
    hosts.set_line(loss=30, delay=5, jitter=2, duplicate=1, reorder=2)
    one = Set(hosts, programs, folder, True)
    for host, roles in ROLES.items():
        one.start(host, roles)
    time.sleep(BAD_LINE_S)
    hosts.set_line(loss=1, delay=5)
    one.await_on(ROLES, lambda seen: seen.get("power") == "OPR" and seen.get("sweeps", 0) > 100,
                 "a radar that sweeps, on all hosts")
    one.end()


def joins_again_after_a_silence(hosts, programs, folder):
    """A gateway whose participant is there, and of which no sample comes, gets another handshake."""
    one = Set(hosts, programs, folder, True)
    for host, roles in ROLES.items():
        one.start(host, roles)
    one.await_on(ROLES, lambda seen: seen.get("power") == "OPR" and seen.get("sweeps", 0) > 100,
                 "a radar that sweeps, on all hosts")
    hosts.mute("c")
    lab.wait_until(lambda: any("was lost, as on a bad line: joins again" in process.text()
                               for process in one.begun.values()), "a gateway that joins again", WITHIN_S)
    hosts.heal("c")
    before = {host: one.watch(host).get("sweeps", 0) for host in ROLES}
    for host in ROLES:
        one.await_on([host], lambda seen, host=host: seen.get("sweeps", 0) > before[host] + 50,
                     "sweeps after the silence")
    one.end()


def power_stays_as_the_pilot_set_it(hosts, programs, folder):
    """A state-machine that stands by sends no power-on: neither while it waits nor when it takes over."""
    one = Set(hosts, programs, folder, False)
    for host, roles in (("a", "flight-model"), ("b", "state-machine"), ("c", "radar-model")):
        one.start(host, roles)
    one.await_on("abc", lambda seen: seen.get("power") == "OPR", "a radar that is on")
    hosts.run("b", str(one.programs / "yars"), ["--session", SESSION, "inject", "power stby"])
    one.await_on("abc", lambda seen: seen.get("power") == "STBY", "a radar in standby")
    one.start("d", "state-machine")
    one.await_on("d", lambda seen: "state-machine standby" in seen.get("processes", {}) and seen.get("power") == "STBY",
                 "a second state-machine that waits")
    applied = one.watch("d")["events_applied"]
    time.sleep(2 * SUPERVISOR_LOOKS_S)
    hosts.kill_host("b")
    one.begun.pop("b")
    one.begun["d"].wait_for("state-machine info: runs in session", WITHIN_S)
    time.sleep(2 * SUPERVISOR_LOOKS_S)
    seen = one.watch("d")
    assert seen["power"] == "STBY" and seen["events_applied"] == applied, seen
    one.end()


def main():
    programs = pathlib.Path(sys.argv[1]).resolve()
    why_not = lab.can_run(str(programs / "wire"))
    if not why_not and not os.access(programs / "gateway", os.X_OK):
        why_not = "expected the program gateway, found none; this build is without Cyclone DDS"
    if not why_not and shutil.which("openssl") is None:
        why_not = "expected openssl, found none"
    if why_not:
        print(f"skipped: {why_not}")
        return 77
    full = "YARS_TEST_FULL" in os.environ
    for identities in (False, True) if full else (True,):
        with tempfile.TemporaryDirectory() as folder, lab.Lab(ROLES, wire=str(programs / "wire")) as hosts:
            hosts.set_line(loss=1, delay=5, jitter=2, duplicate=1, reorder=2)
            fly(hosts, programs, pathlib.Path(folder), identities)
        print(f"four hosts{' with identities' if identities else ''}: ok", flush=True)
    for check in (joins_over_a_line_that_was_bad, joins_again_after_a_silence)[:2 if full else 1]:
        with tempfile.TemporaryDirectory() as folder, lab.Lab(ROLES, wire=str(programs / "wire")) as hosts:
            check(hosts, programs, pathlib.Path(folder))
        print(f"{check.__name__}: ok", flush=True)
    with tempfile.TemporaryDirectory() as folder, lab.Lab(ROLES, wire=str(programs / "wire")) as hosts:
        power_stays_as_the_pilot_set_it(hosts, programs, pathlib.Path(folder))
    print("power stays as the pilot set it: ok")
    return 0


if __name__ == "__main__":
    sys.exit(main())
