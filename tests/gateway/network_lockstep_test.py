#!/usr/bin/env python3
"""Lockstep over four hosts: the whole interface test of tests/endtoend, and sweeps that equal those of one host.

usage: network_lockstep_test.py BIN            BIN: folder of the programs; ends with 77 and a word where there is no
                                               lab
       network_lockstep_test.py --on FOLDER PROGRAM ARGUMENTS    starts a role on its host, for YARS_TEST_HOSTS

The C++ test starts its roles by the second form, which asks the first for gateways of a new session by a file in
FOLDER.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import spread_set
import lab  # noqa: E402, found by spread_set

HOSTS = ("a", "b", "c", "d")
HOST_OF = {"flight-model": "a", "input-monitor": "a", "state-machine": "b", "radar-model": "c", "radar-display": "d",
           "yars": "d"}  # yars: the recorder
INTERFACE_TESTS = ("Lockstep.EveryRealBeamMapEventHasItsEffectAndTheRunRepeatsBitForBit:"
                   "Lockstep.TheVtrStopsAndStartsTheRecordingInOneFile")
SESSIONS = 3  # that they run: two, and one
SCRIPT = "0.2 power opr\n0.6 pb 14\n1.0 pb 9\n1.5 pb 3\n"
TICKS = 600
ENDS = {"a": 400000, "b": 300000}  # [ticks] of the hosts of a run that no host finishes
WITHIN_S = 240.0  # of a run, on a busy machine


# ---- Roles of the C++ test on hosts ----

def enter(folder, words):
    """Does not return: becomes the program on its host, once the gateways of its session have joined."""
    session = words[words.index("--session") + 1]
    (folder / f"{session}.wanted").touch()
    ready = folder / f"{session}.ready"
    deadline = time.monotonic() + WITHIN_S
    while not ready.exists():
        if time.monotonic() > deadline:
            sys.exit(f"expected gateways of session {session}, found none")
        time.sleep(0.01)
    entry = json.loads((folder / "entries.json").read_text())[pathlib.Path(words[0]).name]
    os.execvp(entry[0], [*entry, *words])


def write_entries(spread, folder):
    """The words that start a program on its host, by program."""
    entries = {}
    for program, name in HOST_OF.items():
        host = spread.lab.hosts[name]
        kept = ("HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME", "XDG_CONFIG_HOME", "XDG_RUNTIME_DIR")
        home = [f"{key}={value}" for key, value in host.environment(None).items() if key in kept]
        entries[program] = host.inside("env", *home)
    (folder / "entries.json").write_text(json.dumps(entries))


def serve(spread, folder, test):
    """Gateways for each session that the test begins; those of its earlier sessions end. Result: number of sessions."""
    known = set()
    while test.poll() is None:
        for wanted in folder.glob("*.wanted"):
            if wanted.stem in known:
                continue
            known.add(wanted.stem)
            for gateway in spread.gateways.values():
                gateway.terminate()
                gateway.wait(WITHIN_S)
            spread.session = wanted.stem
            spread.start_gateways()
            wanted.with_suffix(".ready").touch()
        time.sleep(0.01)
    return len(known)


def the_interface_test_holds_over_four_hosts(programs):
    """Its expectations are those of one host."""
    if not (programs / "test_endtoend").exists():
        print("left out: this build has no test_endtoend; -DYARS_LONG_TESTS=ON builds it")
        return
    with tempfile.TemporaryDirectory() as name, spread_set.SpreadSet(programs, dict.fromkeys(HOSTS, ())) as spread:
        folder = pathlib.Path(name)
        write_entries(spread, folder)
        command = [sys.executable, __file__, "--on", name]
        output = folder / "output"
        with output.open("w") as to:
            test = subprocess.Popen([programs / "test_endtoend", f"--gtest_filter={INTERFACE_TESTS}"], stdout=to,
                                    stderr=subprocess.STDOUT, env={**os.environ, "YARS_TEST_HOSTS": " ".join(command)})
        try:
            sessions = serve(spread, folder, test)
        finally:
            test.kill()
            test.wait()
        said = output.read_text()
        assert (test.returncode == 0 and "[  PASSED  ] 2 tests" in said and
                sessions == SESSIONS), f"{said}\n{spread.logs()}"


# ---- Hashes ----

def fly(spread, host_of, recording):
    """A run in lockstep to its end; `host_of(role)` is where a role runs. Result: what the replay counts."""
    script = spread.lab.folder / "script"
    script.write_text(SCRIPT)
    plan = f"flight-model,input-monitor,state-machine,radar-model,recorder@{TICKS}"
    common = ["--session", spread.session, "--lockstep", plan]
    roles = (("yars", ["record", *common, "--patches", recording]), ("flight-model", [*common, *spread_set.FLIGHT]),
             ("input-monitor", [*common, "--source", f"script:{script}"]), ("state-machine", common),
             ("radar-model", common))
    processes = [spread.lab.start(host_of(role), str(spread.programs / role), arguments) for role, arguments in roles]
    for process in processes:
        assert process.wait(WITHIN_S) == 0, (process.text(), spread.logs())
    return spread.replayed(host_of("yars"), recording)


def sweeps_equal_those_of_one_host(programs):
    with spread_set.SpreadSet(programs, {"o": ()}) as one:
        alone = fly(one, lambda role: "o", one.lab.folder / "one.yars")
    with spread_set.SpreadSet(programs, dict.fromkeys(HOSTS, ())) as four:
        four.lab.set_line(loss=1, delay=2, jitter=1)
        four.start_gateways()
        spread = fly(four, HOST_OF.__getitem__, four.lab.folder / "four.yars")
        assert four.lab.statistics()["lost"] > 0, four.lab.statistics()
    assert alone["run_hash"] == spread["run_hash"] and alone == spread, (alone, spread)
    assert spread["different"] == spread["ticks_lost"] == 0 and spread["equal"] > 100, spread


# ---- Hosts that leave ----

def a_run_ends_when_a_host_is_gone(programs):
    """A host that is cut off for a short time continues. After the death of one the other ends with one line."""
    layout = {"a": (), "b": ()}
    with spread_set.SpreadSet(programs, layout) as spread:
        spread.start_gateways()
        roles = {"a": ("flight-model", spread_set.FLIGHT), "b": ("state-machine", [])}
        processes = {host: spread.lab.start(host, str(programs / role), [
            "--session", spread.session, "--lockstep", f"flight-model,state-machine@{ENDS[host]}", *arguments])
            for host, (role, arguments) in roles.items()}

        def done():
            return json.loads(spread.yars("a", "sim", "state", "--json"))["sim_time"]

        def goes_on():
            return lambda before=done(): done() > before

        def stands():
            before = done()
            time.sleep(0.2)
            return done() == before

        lab.wait_until(goes_on(), "ticks of both hosts")
        for host, other in (("a", "b"), ("b", "a")):
            spread.gateways[host].wait_for(f"lockstep to tick {ENDS[other]} on host {other}, to tick {ENDS[host]} here")
        spread.lab.cut("b")
        lab.wait_until(stands, "a shown sim time that is the one of the last tick")
        spread.lab.heal("b")
        lab.wait_until(goes_on(), "ticks after the cut")
        spread.lab.kill_host("b")
        assert processes["a"].wait(60.0) == 1, (processes["a"].text(), spread.logs())
        assert "expected state-machine of host b to do tick" in processes["a"].text(), processes["a"].text()


def main():
    if sys.argv[1] == "--on":
        enter(pathlib.Path(sys.argv[2]), sys.argv[3:])
    programs = pathlib.Path(sys.argv[1]).resolve()
    if reason := spread_set.why_skipped(programs):
        print(f"skipped: {reason}")
        return 77
    spread_set.run_tests((a_run_ends_when_a_host_is_gone, sweeps_equal_those_of_one_host,
                          the_interface_test_holds_over_four_hosts), programs)
    return 0


if __name__ == "__main__":
    sys.exit(main())
