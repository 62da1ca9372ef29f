#!/usr/bin/env python3
"""One session over four hosts in real time: a bad line, a partition, hosts that die, the clock, maps, ships,
the world.

usage: network_test.py BIN [TEST...]       BIN: folder of the programs; ends with 77 and a word where there is no lab
The tests are functions with one set after another; each leaves the set whole. No time is asserted but the limits of
waiting.
"""
import json
import signal
import sys
import threading
import time

sys.dont_write_bytecode = True
import faults
import spread_set
from spread_set import FLIGHT, lab, runs

# Each role that may stand by does so on b and c. a has an ownship, and so has each part of a network that falls apart.
LAYOUT = {"a": [("flight-model", FLIGHT)],
          "b": [("state-machine", ["--standby"]), ("radar-model", ["--standby"]), ("flight-model", FLIGHT)],
          "c": [("radar-model", ["--standby"]), ("state-machine", ["--standby"]), ("flight-model", FLIGHT)],
          "d": []}
WITHIN_S = 60.0
# What a new machine takes over.
PILOTS = ("power", "mode", "range_nm", "scan", "gain", "brightness", "declutter", "master")


class Flight:
    """The set, and the events that the test presses on it."""

    def __init__(self, spread):
        self.spread = spread
        self.campaign = faults.Campaign(spread, 1)

    def await_whole(self):
        """One machine, one model and one clock, seen alike by all."""
        states = self.spread.wait_for(lambda seen: runs(seen) and is_one_clock(seen, self.spread),
                                      "one machine, one model and one clock", within_s=WITHIN_S)
        self.campaign.machine = self.host_of("machine", states)
        return states

    @staticmethod
    def host_of(role, states):
        return next(host for host, state in states.items() if state[role] == "here")

    def await_watch(self, host, condition, what):
        deadline = time.monotonic() + WITHIN_S
        while not condition(seen := self.spread.watch(host)):
            assert time.monotonic() < deadline, (what, seen, self.spread.logs())
            time.sleep(0.05)
        return seen

    def await_one_state(self, holder):
        """Until each host shows all events that the state machine of a host has applied by now."""
        applied = self.spread.watch(holder)["events_applied"]
        for host in LAYOUT:
            self.await_watch(host, lambda seen: seen["events_applied"] == applied, f"{applied} events applied")

    def await_applied(self, numbers, hosts):
        deadline = time.monotonic() + WITHIN_S
        while waiting := [one for one in numbers if not self.campaign.is_applied(one)]:
            assert time.monotonic() < deadline, (waiting, self.spread.logs())
            self.campaign.collect(hosts)
            time.sleep(0.05)

    def press_on(self, hosts, count):
        """Numbers of events that have entered lanes; count on each host."""
        numbers = []
        for _ in range(count):
            for host in hosts:
                number = self.campaign.press(host)
                assert number, (host, self.spread.logs())
                numbers.append(number)
            time.sleep(0.05)
        return numbers

    def assert_once(self):
        events = self.campaign.judge(faults=[])
        assert not events["lost"] and not events["twice"], (events, self.spread.logs())


def lost(states):
    return {host: {name: other["lost"] for name, other in state["network"]["hosts"].items()}
            for host, state in states.items()}


ASIDE_DEG = 20.0  # of the nose; the blind zone is 8 degrees either side


def a_map_that_is_commanded_appears_on_all_hosts(flight):
    spread = flight.spread
    for event in ("power opr", "pb 14", "tdc 1 0"):
        spread.inject("d", event)
    # An epoch begins without an ownship.
    flight.await_watch("d", lambda seen: seen["ownship"] and seen["cursor"] and
                       seen["cursor"]["bearing_deg"] - seen["ownship"]["heading_deg"] > ASIDE_DEG,
                       "a cursor right of the blind zone ahead of the aircraft")
    for event in ("tdc 0 0", "tdc release"):
        spread.inject("d", event)
    deadline = time.monotonic() + WITHIN_S
    while True:
        maps = {host: spread.ask(host, "maps") for host in LAYOUT}
        if all(maps.values()) and all(one == maps["a"] for one in maps.values()):
            break
        assert time.monotonic() < deadline, (maps, spread.watch("d"), spread.logs())
        time.sleep(0.1)
    for stated, computed in maps["d"].values():
        assert stated == computed != 0, maps
    flight.await_watch("d", lambda seen: seen.get("mode") == "PATCH", "the map on the display's host")
    spread.inject("a", "pb 6")
    flight.await_watch("d", lambda seen: seen.get("mode") != "PATCH", "a mode that sweeps")


def ships_of_one_host_are_latched_by_the_model_of_another(flight):
    spread = flight.spread
    before = flight.await_whole()
    assert spread.ask("d", "ships 3") == {"ships": 3}
    model = flight.host_of("model", before)
    spread.wait_for(lambda states: states[model].get("ships") == 3 and
                    all(states[host]["ships_latched"] > before[host]["ships_latched"] for host in LAYOUT),
                    "ships on all hosts")


BAD_LINE_ROUNDS = 100  # events from each host


def a_bad_line_loses_no_sweep_and_no_event(flight):
    spread = flight.spread
    spread.lab.set_line(loss=1, delay=20, jitter=5, duplicate=1, reorder=5)
    recorder, recording = record(spread, "d", "line.yars")
    before = flight.await_whole()
    numbers = []
    for _ in range(BAD_LINE_ROUNDS):
        numbers += flight.press_on(LAYOUT, 1)
        flight.campaign.collect(LAYOUT)
    flight.await_applied(numbers, LAYOUT)
    spread.wait_for(lambda seen: all(seen[host]["sweeps"] > before[host]["sweeps"] + 200 for host in LAYOUT),
                    "sweeps over the bad line")
    after = flight.await_whole()
    recorder.signal(signal.SIGINT)
    assert recorder.wait(WITHIN_S) == 0, recorder.text()
    flight.assert_once()
    assert lost(after) == lost(before), (lost(before), lost(after))
    frames = spread.lab.statistics()
    assert min(frames["lost"], frames["duplicated"], frames["reordered"]) > 0, frames
    spread.lab.set_line()
    replayed = spread.replayed("d", recording)
    assert replayed["different"] == 0 and replayed["ticks_lost"] == 0 and replayed["equal"] > 100, replayed


def an_instructor_of_any_host_changes_the_world(flight):
    """Recorded on two hosts, which both replay to the same sweeps."""
    spread = flight.spread
    model = flight.host_of("model", flight.await_whole())
    recorders = {host: record(spread, host, f"world_{host}.yars") for host in ("d", model)}
    rain = len(spread.ask("d", "state")["world"]["rain"])
    add_rain(spread, "d", 1)
    in_effect_everywhere(flight, rain + 1)
    several = [threading.Thread(target=add_rain, args=(spread, host, 4)) for host in ("a", "d", model)]
    for one in several:
        one.start()
    for one in several:
        one.join()
    in_effect_everywhere(flight, rain + 13)  # none is lost, though each host has edited the same list
    spread.yars("a", "sim", "freeze")
    spread.wait_for(lambda seen: all(not one["running"] and one["model_tick"] >= one["sim_ns"] // TICK_NS
                                     for one in seen.values()), "a frozen clock, and all of its ticks")
    for count, host in ((14, "a"), (15, "d")):
        add_rain(spread, host, 1)
        spread.wait_for(lambda seen: all(len(one["world_newest"]["rain"]) == rain + count for one in seen.values()),
                        "the newest world")
    assert all(len(one["world"]["rain"]) == rain + 13 for one in spread.states().values()), spread.states()
    spread.yars("a", "sim", "run")
    in_effect_everywhere(flight, rain + 15)
    sweeps = spread.states()
    spread.wait_for(lambda seen: all(seen[host]["sweeps"] > sweeps[host]["sweeps"] + 50 for host in LAYOUT),
                    "sweeps in the new world")
    for host, (recorder, recording) in recorders.items():
        recorder.signal(signal.SIGINT)
        assert recorder.wait(WITHIN_S) == 0, recorder.text()
        replayed = spread.replayed(host, recording)
        assert replayed["different"] == 0 and replayed["ticks_lost"] == 0 and replayed["equal"] > 100, (host, replayed)
        items = spread.lab.run(host, str(spread.programs / "yars"), ["replay", "--print", recording], within_s=1800)
        worlds = [json.loads(line)["world"]["edit"] for line in items.splitlines()
                  if '"world": {' in line or '"world":{' in line]
        assert len(worlds) >= 4 and worlds == sorted(set(worlds)), (host, worlds)


def the_world_outlasts_hosts_and_is_seen_by_those_that_join(flight):
    spread = flight.spread
    states = flight.await_whole()
    model = flight.host_of("model", states)
    add_rain(spread, "d", 1)
    world = in_effect_everywhere(flight, len(states["d"]["world"]["rain"]) + 1)["d"]["world"]
    joins = next(host for host in ("d", "a") if states[host]["machine"] != "here" and states[host]["model"] != "here")
    for killed in (joins, model):
        flight.campaign.excuse(killed)
        spread.lab.kill_host(killed)
        others = [host for host in LAYOUT if host != killed]
        spread.wait_for(lambda seen: runs(seen) and all(one["world"] == world == one["world_newest"]
                                                        for one in seen.values()), "the same world", hosts=others)
        flight.campaign.lives[killed] += 1
        spread.start_host(killed)
        states = spread.wait_for(lambda seen: runs(seen) and all(one.get("world") == world == one["world_newest"]
                                                                 for one in seen.values()),
                                 "the same world on the host that has joined")
        flight.campaign.machine = flight.host_of("machine", states)
    spread.yars(joins, "world", "reset")
    spread.wait_for(lambda seen: all(one["world"]["configured"] and one["world"]["edit"] == world["edit"] + 1
                                     for one in seen.values()), "the configuration's world")


def add_rain(spread, host, count):
    for number in range(count):
        added = json.loads(spread.yars(host, "world", "rain", "add", str(37.4 + 0.02 * number), "-122.8",
                                       "--rate", "40", "--json"))
        assert added["rain"], added


def in_effect_everywhere(flight, rain):
    return flight.spread.wait_for(lambda seen: all(len(one["world"]["rain"]) == rain and
                                                   one["world"] == one["world_newest"] and
                                                   one["world"] == seen["d"]["world"] for one in seen.values()),
                                  f"{rain} showers")


def record(spread, host, name):
    """A recorder that writes, and its file."""
    recording = spread.lab.folder / name
    recorder = spread.lab.start(host, str(spread.programs / "yars"), ["record", "--session", spread.session, recording])
    recorder.wait_for(" ", WITHIN_S)  # its first line
    return recorder, recording


def the_clock_obeys_any_host(flight):
    spread = flight.spread
    flight.await_whole()
    states = spread.wait_for(lambda seen: any(owns_clock(state, host) for host, state in seen.items()),
                             "an owner of the clock")
    owner = next(host for host in LAYOUT if owns_clock(states[host], host))
    first, second, third = (host for host in LAYOUT if host != owner)
    spread.yars(first, "sim", "freeze")
    stands = spread.wait_for(lambda seen: not any(one["running"] for one in seen.values()) and
                             len({one["sim_ns"] for one in seen.values()}) == 1, "one frozen sim time")
    stepped_ns = (stands["a"]["sim_ns"] // TICK_NS + 10) * TICK_NS
    spread.yars(second, "sim", "step", "10")
    spread.wait_for(lambda seen: {one["sim_ns"] for one in seen.values()} == {stepped_ns}, "ten ticks more on all")
    spread.yars(third, "sim", "rate", "2")
    spread.yars(third, "sim", "run")
    spread.wait_for(lambda seen: all(one["running"] and one["rate"] == 2.0 for one in seen.values()) and
                    is_one_clock(seen, spread), "rate 2 and one clock")
    epoch = states["a"]["epoch"]
    spread.yars(first, "sim", "reset", "1000")
    spread.wait_for(lambda seen: all(one["epoch"] > epoch and one["sim_ns"] >= 1000 * 10**9 for one in seen.values()),
                    "a new epoch from 1,000 s")
    spread.yars(second, "sim", "rate", "1")
    spread.wait_for(lambda seen: all(one["rate"] == 1.0 for one in seen.values()), "rate 1 on all")
    flight.await_whole()


PRESENT, OWNS_CLOCK = 2, 4  # databuffer::kHostPresent, kHostOwnsClock
TICK_NS = 5_000_000


def owns_clock(state, host):
    return state["network"]["hosts"][host]["flags"] & OWNS_CLOCK != 0


def is_one_clock(states, spread):
    """True if all hosts show one owner, epoch and rate, and sim times that differ by less than 50 ms at one moment,
    which their monotonic clocks give."""
    owners = {tuple(name for name in state["network"]["hosts"] if owns_clock(state, name)) for state in states.values()}
    kinds = {(one["epoch"], one["running"], one["rate"]) for one in states.values()}
    if len(owners) != 1 or len(next(iter(owners))) != 1 or len(kinds) != 1:
        return False
    _, running, rate = next(iter(kinds))
    rate = rate if running else 0.0
    behind = [state["sim_ns"] - rate * (state["monotonic_ns"] - spread.lab.hosts[host].offset_s * 10**9)
              for host, state in states.items()]
    return max(behind) - min(behind) < 50e6


def a_host_without_roles_is_cut_off_and_nobody_notices(flight):
    spread = flight.spread
    before = flight.await_whole()
    alone = next(host for host in ("d", "a") if before[host]["machine"] != "here" and before[host]["model"] != "here")
    rest = [host for host in LAYOUT if host != alone]
    spread.lab.cut(alone)
    spread.wait_for(lambda seen: owns_clock(seen[alone], alone) and set(present(seen[alone])) == {alone},
                    "a clock of its own", [alone])
    spread.lab.heal(alone)
    states = spread.wait_for(lambda seen: runs(seen) and
                             all(set(present(one)) == set(LAYOUT) for one in seen.values()) and
                             is_one_clock(seen, spread), "all hosts, and one clock")
    assert all(states[host]["epoch"] == before[host]["epoch"] for host in rest), (before, states)
    # Requests of a host are applied in their order: one for a new epoch would be applied before the freeze.
    for word, running in (("freeze", 0), ("run", 1)):
        spread.yars(alone, "sim", word)
        states = spread.wait_for(lambda seen: all(one["running"] == running for one in seen.values()),
                                 f"{word} on all hosts")
    assert all(one["epoch"] == before["a"]["epoch"] for one in states.values()), (before, states, spread.logs())


PARTED_ROUNDS = 50  # events from each host of the larger part


def both_parts_of_a_partition_go_on_and_the_larger_one_stays(flight):
    """The host that is cut off precedes by its name, so that only the size of its part decides."""
    spread, rest = flight.spread, ["a", "c", "d"]
    spread.lab.kill_host("c")  # then b has both roles
    spread.wait_for(lambda seen: seen["b"]["machine"] == seen["b"]["model"] == "here", "b with both roles",
                    hosts=["a", "b", "d"])
    spread.start_host("c")
    flight.campaign.lives["c"] += 1
    before = flight.await_whole()
    conflicts = {host: before[host]["network"]["conflicts"] for host in LAYOUT}
    spread.lab.cut("b")
    alone = spread.wait_for(lambda seen: set(present(seen["b"])) == {"b"} and
                            seen["b"]["machine"] == seen["b"]["model"] == "here",
                            "b alone with its roles", hosts=["b"])
    kept = spread.wait_for(lambda seen: runs(seen) and all(set(present(one)) == set(rest) for one in seen.values()),
                           "c with both roles", hosts=rest)
    flight.campaign.machine = "c"
    numbers = []
    for _ in range(PARTED_ROUNDS):
        numbers += flight.press_on(rest, 1)
        flight.campaign.collect(rest)
    flight.await_applied(numbers, rest)
    later = spread.wait_for(lambda seen: all(seen[host]["sweeps"] > (alone if host == "b" else kept)[host]["sweeps"]
                                             for host in LAYOUT), "sweeps in both parts")
    spread.lab.heal("b")
    highest = max(one["epoch"] for one in later.values())
    healed = spread.wait_for(lambda seen: runs(seen) and seen["c"]["machine"] == seen["c"]["model"] == "here" and
                             all(set(present(one)) == set(LAYOUT) and one["epoch"] > highest for one in seen.values()),
                             f"c with both roles in an epoch above {highest}, seen by all")
    # Others may hear of b only after it has given way.
    spread.wait_for(lambda seen: any(seen[host]["network"]["conflicts"] > conflicts[host] for host in LAYOUT),
                    f"conflicts after {healed}")
    flight.campaign.collect(LAYOUT)
    flight.assert_once()
    restart_what_ended(flight, "b")


def separate(spread, part, whole):
    """Hosts of the part and the others do not reach each other: each has a wrong link address of those beyond."""
    for host in LAYOUT:
        for other in LAYOUT:
            if (host in part) == (other in part):
                continue
            address = spread.lab.address(other)
            words = (["del", address] if whole else
                     ["replace", address, "lladdr", "02:00:00:00:00:99", "nud", "permanent"])
            spread.lab.run(host, "ip", ["neigh", *words, "dev", "eth0"])


def of_two_equal_parts_the_first_name_stays(flight):
    """Two hosts against two: a and b, with a state machine and a radar model on b; c and d, with both on c."""
    spread, parts = flight.spread, (["a", "b"], ["c", "d"])
    flight.await_whole()
    separate(spread, "ab", whole=False)
    for part, holder in zip(parts, "bc"):
        spread.wait_for(lambda seen: all(set(present(one)) == set(part) for one in seen.values()) and runs(seen) and
                        seen[holder]["machine"] == seen[holder]["model"] == "here",
                        f"{holder} with both roles", hosts=part)
    time.sleep(1.5)  # the size of a part is the number of hosts that it heard 1 s ago
    apart = spread.states()
    separate(spread, "ab", whole=True)
    highest = max(one["epoch"] for one in apart.values())
    met = spread.wait_for(lambda seen: runs(seen) and seen["b"]["machine"] == seen["b"]["model"] == "here" and
                          all(set(present(one)) == set(LAYOUT) and one["epoch"] > highest for one in seen.values()),
                          f"b with both roles in an epoch above {highest}, seen by all")
    assert met["c"]["machine"] == met["c"]["model"] == "remote", met
    restart_what_ended(flight, "c")
    flight.await_whole()


def present(state):
    """Hosts that a host hears."""
    return [name for name, other in state["network"]["hosts"].items() if other["flags"] & PRESENT]


def restart_what_ended(flight, host):
    """As scripts/start does: roles that gave way start again and stand by."""
    running = {process.name for process in flight.spread.lab.hosts[host].processes if process.poll() is None}
    for role, arguments in LAYOUT[host]:
        if role not in running:
            flight.spread.lab.start(host, str(flight.spread.programs / role),
                                    ["--session", flight.spread.session, *arguments])


def a_standby_goes_on_where_the_killed_host_ended(flight):
    spread = flight.spread
    for role in ("model", "machine"):
        states = flight.await_whole()
        for event in ("power opr", "pb 9", "pb 3", "pb 14", "pb 2"):
            spread.inject("a", event)
        flight.await_one_state(flight.host_of("machine", states))
        pilot, holder = spread.watch("d"), flight.host_of(role, states)
        status = spread.ask("d", "state")
        flight.campaign.excuse(holder)
        spread.lab.kill_host(holder)
        others = [host for host in LAYOUT if host != holder]
        states = spread.wait_for(lambda seen: runs(seen) and all(one["model_sweeps"] > status["model_sweeps"] + 50
                                                                 for one in seen.values()),
                                 "a standby that goes on", hosts=others)
        after = spread.watch("d")
        assert {name: after[name] for name in PILOTS} == {name: pilot[name] for name in PILOTS}, (pilot, after)
        assert after["events_applied"] == pilot["events_applied"], (pilot, after)
        resumed = states["d"]
        assert resumed["scan"] >= status["scan"] > 0 and resumed["model_tick"] > status["model_tick"], (status, resumed)
        spread.inject("a", "pb 9")
        flight.await_watch("d", lambda seen: seen["scan"] != pilot["scan"], "the scan width of the event")
        flight.campaign.lives[holder] += 1
        spread.start_host(holder)


def nothing_is_torn_or_out_of_range(flight):
    for host in LAYOUT:
        # An observer that has just started has read nothing yet.
        verdict = lab.wait_until(lambda: (said := flight.spread.ask(host, "verdict"))["records"] and said, "records",
                                 WITHIN_S)
        assert verdict["torn"] == verdict["out_of_range"] == 0, (host, verdict)


TESTS = (a_map_that_is_commanded_appears_on_all_hosts, ships_of_one_host_are_latched_by_the_model_of_another,
         a_bad_line_loses_no_sweep_and_no_event, an_instructor_of_any_host_changes_the_world,
         the_world_outlasts_hosts_and_is_seen_by_those_that_join, the_clock_obeys_any_host,
         nothing_is_torn_or_out_of_range, a_host_without_roles_is_cut_off_and_nobody_notices,
         both_parts_of_a_partition_go_on_and_the_larger_one_stays, of_two_equal_parts_the_first_name_stays,
         a_standby_goes_on_where_the_killed_host_ended, nothing_is_torn_or_out_of_range)


def main():
    programs, *names = sys.argv[1:]
    if reason := spread_set.why_skipped(programs):
        print(f"skipped: {reason}")
        return 77
    with spread_set.SpreadSet(programs, LAYOUT) as spread:
        spread.start()
        spread.inject("a", "power opr")
        flight = Flight(spread)
        flight.await_whole()
        spread_set.run_tests([test for test in TESTS if not names or test.__name__ in names], flight)
    return 0


if __name__ == "__main__":
    sys.exit(main())
