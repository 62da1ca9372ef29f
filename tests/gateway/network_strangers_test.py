#!/usr/bin/env python3
"""Hosts that differ, and who else is on the line: a foreign DDS program, hosts with identities, a stranger without one.

usage: network_strangers_test.py BIN CMAKE BUILD CC     ends with 77 and a word where there is no lab
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import foreign_idl_test
import spread_set
from spread_set import FLIGHT, lab, runs

WITHIN_S = 60.0
ROLES = {"a": [("flight-model", FLIGHT)], "b": [("state-machine", [])], "c": [("radar-model", [])], "d": []}
SWEEPS = 200
FOREIGN = """<CycloneDDS><Domain Id="0">
 <General><Interfaces><NetworkInterface name="eth0" multicast="false"/></Interfaces>
  <AllowMulticast>false</AllowMulticast></General>
 <Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>3</MaxAutoParticipantIndex>
  <Peers>{peers}</Peers></Discovery>
 <SharedMemory><Enable>false</Enable></SharedMemory>
</Domain></CycloneDDS>
"""
# Counts the frames on eth0 for some seconds, and those that have a text.
SNIFF = """
import socket, sys, time
tap = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(3))
tap.bind(("eth0", 0))
tap.settimeout(0.1)
frames, found, until = 0, 0, time.monotonic() + float(sys.argv[1])
while time.monotonic() < until:
    try:
        frame = tap.recv(65536)
    except TimeoutError:
        continue
    frames += 1
    found += sys.argv[2].encode() in frame
print(frames, found)
"""
SNIFF_S = 3.0


def count_on_the_line(spread, host, text):
    frames, found = spread.lab.run(host, sys.executable, ["-c", SNIFF, SNIFF_S, text]).split()
    return int(frames), int(found)


def count_lines(process, text):
    return sum(text in line for line in process.text().splitlines())


def await_status(spread, host, text):
    lab.wait_until(lambda: text in spread.yars(host, "status", code=None),
                   f"`yars status` on {host} that says {text!r}", WITHIN_S, every_s=0.3)


# ---- Differences ----

def hosts_with_another_configuration_or_terrain_are_named(programs, build):
    with spread_set.SpreadSet(programs, {"a": (), "b": ()}) as spread:
        folder = spread.lab.folder
        for host, size in (("a", 10), ("b", 20)):
            (folder / f"terrain_{host}").mkdir()
            (folder / f"terrain_{host}" / "N37W123.hgt").write_bytes(bytes(size))
        for host, configuration in (("a", "apg68.guf"), ("b", "apg70.guf")):
            spread.start_gateway(host, ["--config", lab.TOP / "config" / configuration,
                                        "--terrain", folder / f"terrain_{host}"])
        for host, other in (("a", "b"), ("b", "a")):
            for what in ("configuration", "terrain"):
                spread.gateways[host].wait_for(f"host {other} has another {what}", WITHIN_S)
                await_status(spread, host, f"host {other} has another {what}")
        for host, other in (("a", "b"), ("b", "a")):
            for what in ("configuration", "terrain"):
                assert count_lines(spread.gateways[host], f"host {other} has another {what}") == 1, spread.logs()


def two_hosts_of_one_name_are_named(programs, build):
    with spread_set.SpreadSet(programs, {"a": (), "b": (), "c": ()}) as spread:
        spread.start_gateways(["a", "b"])
        spread.start_gateway("c", name="a")
        for host in ("a", "c"):
            spread.gateways[host].wait_for("another host is also called a", WITHIN_S)
            await_status(spread, host, "host a has the name of another host")
        assert count_lines(spread.gateways["b"], "also called") == 0, spread.logs()


# ---- Programs of others ----

def a_foreign_program_made_from_the_idl_files_reads_sweeps(programs, build):
    """It is alone on host d: no gateway is there. A text of the records is on the line."""
    if reason := foreign_idl_test.why_not():
        print(f"left out: {reason}")
        return
    with tempfile.TemporaryDirectory() as name, spread_set.SpreadSet(programs, ROLES) as spread:
        foreign = foreign_idl_test.build(pathlib.Path(name), *build)
        sweeping(spread)
        peers = "".join(f'<Peer Address="{spread.lab.address(host)}"/>' for host in ROLES)
        said = spread.lab.run("d", str(foreign), [spread.session, SWEEPS, int(WITHIN_S)],
                              env={"CYCLONEDDS_URI": FOREIGN.format(peers=peers)}, within_s=2 * WITHIN_S)
        lines = said.splitlines()
        assert len(lines) == SWEEPS and all(line.startswith("sweep ") and " rbm, " in line for line in lines), said
        numbers = [int(line.split()[1]) for line in lines]
        assert numbers == sorted(set(numbers)), numbers
        frames, found = count_on_the_line(spread, "c", TEXT)
        assert found > 0, (frames, spread.logs())


def memory_mb(process):
    """Memory of a program now [MB]."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def a_flood_of_rows_has_its_limit(programs, build):
    """Without it a gateway grows by 3 MB a second. The program on host d ends without a word."""
    if reason := foreign_idl_test.why_not():
        print(f"left out: {reason}")
        return
    with tempfile.TemporaryDirectory() as name, spread_set.SpreadSet(programs, ROLES) as spread:
        flood = foreign_idl_test.build(pathlib.Path(name), *build,
                                       program=pathlib.Path(__file__).with_name("flood_rows.c"))
        sweeping(spread)
        peers = "".join(f'<Peer Address="{spread.lab.address(host)}"/>' for host in ROLES)
        flooding = spread.lab.start("d", str(flood), [spread.session, int(WITHIN_S)],
                                    env={"CYCLONEDDS_URI": FOREIGN.format(peers=peers)})
        for host in "abc":
            spread.gateways[host].wait_for("topic patch_rows: expected at most", WITHIN_S)
        full = {host: memory_mb(spread.gateways[host]) for host in "abc"}
        time.sleep(FLOOD_S)
        later = {host: memory_mb(spread.gateways[host]) for host in "abc"}
        assert all(later[host] < full[host] + FLOOD_MB for host in "abc"), (full, later)
        flooding.kill()
        states = spread.states("abc")
        spread.wait_for(lambda seen: runs(seen) and all(seen[host]["sweeps"] > states[host]["sweeps"] + 50
                                                        for host in "abc"),
                        "sweeps after the flood", hosts=list("abc"), within_s=WITHIN_S)
        assert all(spread.gateways[host].poll() is None for host in "abc"), spread.logs()


FLOOD_S, FLOOD_MB = 8.0, 14.0  # without a limit the flood takes 24 MB in this time; c fills its histories too

TEXT = "GAIN 3"  # a legend of the radar state


def sweeping(spread, hosts="abc"):
    spread.start(list(hosts))
    spread.inject("a", "power opr")
    states = spread.wait_for(lambda seen: runs(seen) and all(one["sweeps"] > 50 for one in seen.values()) and
                             len({one["epoch"] for one in seen.values()}) == 1, "sweeps on all hosts, in one epoch",
                             hosts=list(hosts), within_s=WITHIN_S)
    return states


# ---- Identities ----

def a_stranger_sees_no_host_and_changes_nothing(programs, build):
    if shutil.which("openssl") is None:
        print("left out: expected openssl, found none")
        return
    with spread_set.SpreadSet(programs, {**ROLES, "e": [("state-machine", []), ("flight-model", FLIGHT)]},
                              options=':security "net/{host}"') as spread:
        subprocess.run([lab.TOP / "scripts/network_identities", spread.lab.folder / "net", *ROLES], check=True,
                       stdout=subprocess.DEVNULL, timeout=60)
        before = sweeping(spread, "abcd")
        spread.start_gateway("e", options="").wait_for("joined", WITHIN_S)  # alone
        spread.start_roles("e")
        spread.start_observer("e")
        spread.inject("e", "power stby")
        spread.yars("e", "sim", "freeze")
        spread.wait_for(lambda seen: seen["e"]["machine"] == "here" and not seen["e"]["running"],
                        "a set of its own on e", hosts=["e"])
        assert spread.ask("e", "press 7")["pushed"]
        frames, found = count_on_the_line(spread, "d", TEXT)
        assert frames > 100 and found == 0, (frames, found)
        states = spread.wait_for(lambda seen: runs({host: seen[host] for host in ROLES}) and
                                 all(seen[host]["sweeps"] > before[host]["sweeps"] + 50 for host in ROLES),
                                 "sweeps on a to d")
        for host in ROLES:
            assert set(states[host]["network"]["hosts"]) == set(ROLES) and states[host]["running"], states[host]
            assert states[host]["epoch"] == before[host]["epoch"], (before, states)
            assert spread.ask(host, "applied")["applied"] == []
            assert spread.watch(host)["power"] == "OPR"
        assert set(states["e"]["network"]["hosts"]) == {"e"} and states["e"]["model"] == "none", states["e"]


def a_member_that_may_only_read_holds_no_role_and_poses_as_nobody(programs, build):
    """It has the certificate of d (--reads) and a program of its own in place of the gateway."""
    if shutil.which("openssl") is None:
        print("left out: expected openssl, found none")
        return
    hosts = ["a", "b", "c"]
    with spread_set.SpreadSet(programs, ROLES, options=':security "net/{host}"') as spread:
        subprocess.run([lab.TOP / "scripts/network_identities", spread.lab.folder / "net", *ROLES, "--reads", "d"],
                       check=True, stdout=subprocess.DEVNULL, timeout=60)
        before = sweeping(spread)
        impostor = spread.lab.start("d", str(programs / "impostor"), [spread.session, spread.network_file("d"), "b", 5])
        spread.wait_for(lambda seen: all(present(seen[host]) == {*hosts, "d"} for host in hosts), "d, heard by all",
                        hosts=hosts)
        while impostor.poll() is None:
            states = spread.states(hosts)
            for host in hosts:
                assert (states[host]["machine"] == before[host]["machine"] and
                        states[host]["model"] == before[host]["model"]), states[host]
                assert states[host]["epoch"] == before[host]["epoch"] and states[host]["running"], states[host]
                assert states[host]["network"]["conflicts"] == before[host]["network"]["conflicts"], states[host]
                assert states[host]["network"]["hosts"]["b"]["flags"] & PRESENT, states[host]
                assert states[host]["network"]["hosts"]["d"]["roles"] & LOCK_BYTES == 0, states[host]
            time.sleep(0.05)
        assert impostor.wait(WITHIN_S) == 0, impostor.text()
        written = impostor.text().split()
        counts = dict(zip(written[::2], map(int, written[1::2])))
        assert min(counts["claims"], counts["events"], counts["answers"], counts["announcements"]) > 50, counts
        assert counts["refused"] > 50 and "requests" not in counts and "worlds" not in counts, counts
        after = spread.wait_for(lambda seen: runs(seen) and all(seen[host]["sweeps"] > before[host]["sweeps"] + 50
                                                                for host in hosts),
                                "sweeps on a to c", hosts=hosts)
        assert all(after[host]["world"] == before[host]["world"] for host in hosts), (before, after)
        assert all(abs(after["a"]["network"]["hosts"][host]["error_ns"]) < 10**9 for host in hosts), after
        assert count_lines(spread.gateways["a"],
                           "expected samples of the host that the writer's certificate names") > 0, spread.logs()
        assert count_lines(spread.gateways["a"],
                           "host d claims roles or the clock, and may not write their topics") == 1, spread.logs()
        spread.inject("a", "power stby")
        spread.wait_for(lambda seen: spread.watch("c").get("power") == "STBY", "power STBY", hosts=hosts)


PRESENT = 2                # databuffer::kHostPresent
LOCK_BYTES = (1 << 24) - 1  # databuffer::kFirstProcessBit


def present(state):
    return {name for name, other in state["network"]["hosts"].items() if other["flags"] & PRESENT}


def main():
    programs, *build = sys.argv[1:]
    programs = pathlib.Path(programs).resolve()
    if reason := spread_set.why_skipped(programs):
        print(f"skipped: {reason}")
        return 77
    spread_set.run_tests((hosts_with_another_configuration_or_terrain_are_named, two_hosts_of_one_name_are_named,
                          a_foreign_program_made_from_the_idl_files_reads_sweeps, a_flood_of_rows_has_its_limit,
                          a_stranger_sees_no_host_and_changes_nothing,
                          a_member_that_may_only_read_holds_no_role_and_poses_as_nobody),
                         programs, build)
    return 0


if __name__ == "__main__":
    sys.exit(main())
