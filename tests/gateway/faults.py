#!/usr/bin/env python3
"""Faults in a row over four hosts: hosts killed, stopped, cut off, started again with another clock; gateways killed.

usage: faults.py BIN [--faults 1000] [--seed 1] [--line LOSS,DELAY,JITTER] [--report FILE]
BIN has the programs of a build, with wire and observer. Needs root.

Measured for each fault: the time until the last disturbance of the remaining hosts, and the same after the end of the
fault for all hosts. Checked: no event is applied twice or lost while both ends live,
no record is torn or out of range, the memory of the gateways does not grow. Prints one line for each fault, then one
JSON object; --report continues an earlier report, so that a run can be interrupted.
"""
import argparse
import json
import os
import pathlib
import random
import sys
import time

import spread_set

FAULTS = ("kill host", "stop host", "cut host", "other clock", "kill gateway")
OFFSETS_S = (0, 10, 5_000, 90_000, 250_000)
LIMIT_S = 30.0  # then a recovery has failed
CALM_S = 1.0    # without a disturbance a fault is over
WAIT_S = 0.3    # a scan turns in less; an event that takes longer waits


class Campaign:
    def __init__(self, spread, seed):
        self.spread, self.random = spread, random.Random(seed)
        self.number = 0
        self.pressed = {}      # number -> host, time
        self.applied = {}      # host, life of its segment -> {number: [[tick, lane], ...]}
        self.lives = dict.fromkeys(spread.layout, 0)
        self.done = set()      # numbers that their sender saw applied
        self.excused = set()   # numbers whose sender or receiver failed
        self.machine = None    # host of the state machine
        self.latencies_ms = []

    # ---- Events ----

    def press(self, host):
        self.number += 1
        answer = self.spread.ask(host, f"press {self.number}")
        if answer and answer.get("pushed"):
            self.pressed[self.number] = (host, time.monotonic())
            return self.number
        return None

    def collect(self, hosts):
        for host in hosts:
            answer = self.spread.ask(host, "applied")
            for number, latency_ms, *place in answer["applied"] if answer else ():
                seen = self.applied.setdefault((host, self.lives[host]), {})
                seen.setdefault(number, []).append(place)
                if self.pressed.get(number, (None,))[0] == host:
                    self.done.add(number)
                    self.latencies_ms.append(latency_ms)

    def is_applied(self, number):
        return number in self.done

    def excuse(self, host):
        """Events of a host that fails, and all under way when the state machine's host fails."""
        for number, (sender, _) in self.pressed.items():
            if not self.is_applied(number) and (sender == host or self.machine == host):
                self.excused.add(number)

    # ---- Recovery ----

    def recover(self, hosts, since):
        """Seconds from `since` until the last moment of a disturbance: a role missing or held twice, an old ownship or
        status, different epochs, sweeps that stand still, an event that waits. Ends when all has been well for
        CALM_S."""
        hosts = sorted(hosts)
        fresh, moved, last_bad, problem = {}, {}, since, "nothing yet"
        while True:
            now = time.monotonic()
            number = self.press(self.random.choice(hosts))
            if number:
                fresh[number] = now
            self.collect(hosts)
            fresh = {one: at for one, at in fresh.items() if not self.is_applied(one)}
            states = self.spread.states(hosts)
            problem = self.problem(states, fresh, moved)
            if problem:
                last_bad = time.monotonic()
            elif now - last_bad > CALM_S:
                self.machine = next(host for host in hosts if states[host]["machine"] == "here")
                return last_bad - since
            if now - since > LIMIT_S:
                raise AssertionError(f"expected a recovery within {LIMIT_S} s, found {problem}: {json.dumps(states)}; "
                                     f"logs: {self.spread.logs()}")
            time.sleep(0.01)

    @staticmethod
    def problem(states, fresh, moved):
        """What is not well; empty when all is. `moved`: host -> number of sweeps, when it last changed."""
        now = time.monotonic()
        if not all(states.values()):
            return "a host without an answer"
        if not spread_set.runs(states):
            return "a role, an epoch or an ownship"
        for host, state in states.items():
            if moved.get(host, (None,))[0] != state["sweeps"]:
                moved[host] = (state["sweeps"], now)
            elif now - moved[host][1] > WAIT_S:
                return f"no sweeps on {host}"
        waiting = [one for one, at in fresh.items() if now - at > WAIT_S]
        return f"event {waiting[0]} waits" if waiting else ""

    # ---- Faults ----

    def fault(self, kind, host):
        """Recovery times [s] of the others and, after the fault, of all."""
        spread, every = self.spread, set(self.spread.layout)
        others = every - {host}
        self.collect(every)
        begin = time.monotonic()
        if kind == "kill gateway":
            spread.gateways[host].kill()
            spread.gateways[host].wait()
            spread.start_gateway(host)
            return [self.recover(every, begin)]
        if kind == "kill host":
            spread.lab.kill_host(host)
            self.excuse(host)
            times = [self.recover(others, begin)]
            self.lives[host] += 1
            spread.start_host(host)
        elif kind == "other clock":
            spread.observers[host].end()
            spread.lab.restart(host, self.random.choice(OFFSETS_S))
            self.excuse(host)
            times = [self.recover(others, begin)]
            self.lives[host] += 1
            spread.start_host(host)
        elif kind == "stop host":
            spread.lab.stop_host(host)
            self.excuse(host)
            times = [self.recover(others, begin)]
            time.sleep(self.random.uniform(0.0, 1.5))
            spread.lab.continue_host(host)
        else:
            spread.lab.cut(host)
            times = [self.recover(others, begin)]
            time.sleep(self.random.uniform(0.0, 1.5))
            spread.lab.heal(host)
        return [*times, self.recover(every, time.monotonic())]

    def judge(self, faults):
        """Faults of all events and records."""
        deadline = time.monotonic() + 5.0
        while time.monotonic() < deadline:
            self.collect(self.spread.layout)
            lost = [n for n in self.pressed if n not in self.excused and not self.is_applied(n)]
            if not lost:
                break
            time.sleep(0.1)
        twice = [[n, host, places] for (host, _), seen in self.applied.items() for n, places in seen.items()
                 if len(places) > 1 and self.pressed[n][0] == host]
        both = [one for one in twice if self.in_two_parts(one, faults)]
        return {"pressed": len(self.pressed), "excused": len(self.excused), "lost": lost,
                "twice": [one for one in twice if one not in both], "in_both_parts": len(both)}

    def in_two_parts(self, twice, faults):
        """True if the sender was cut off from the state machine: then its own standby applied the event in the part
        that yields, and the state machine that stays applies it, too."""
        number, host, ((first, _), *_) = twice
        for fault, following in zip(faults, [*faults[1:], {"tick": 1 << 60}]):
            if fault["kind"] in ("cut host", "stop host") and fault["tick"] - 20 <= first <= following["tick"]:
                return host == fault["host"] or fault["machine"] == fault["host"]
        return False


def memory_kib(process):
    fields = pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()
    return int(fields[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)] if ordered else None


def summary(report):
    by_kind = {}
    for entry in report["faults"]:
        by_kind.setdefault(entry["kind"], []).extend(entry["times_s"])
    every = [one for times in by_kind.values() for one in times]
    figures = {kind: {"n": len(times), "p50_s": round(percentile(times, 0.5), 3),
                      "p99_s": round(percentile(times, 0.99), 3), "max_s": round(max(times), 3)}
               for kind, times in [*by_kind.items(), ("all", every)] if times}
    return {"faults": len(report["faults"]), "recovery": figures, "events": report["events"],
            "records": report["records"], "memory_kib": report["memory_kib"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs")
    parser.add_argument("--faults", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--line", default="0,0,0", help="loss [%%], delay [ms], jitter [ms]")
    parser.add_argument("--report", type=pathlib.Path)
    options = parser.parse_args()
    if reason := spread_set.lab.can_run(str(pathlib.Path(options.programs) / "wire")):
        print(f"skipped: {reason}")
        return 77
    report = {"faults": [], "events": [], "records": [], "memory_kib": []}
    if options.report and options.report.exists():
        report = json.loads(options.report.read_text())
    bad = 0
    while len(report["faults"]) < options.faults:
        seed = options.seed + len(report["faults"])
        with spread_set.SpreadSet(options.programs, seed=seed) as spread:
            bad += part(spread, seed, options, report)
        if options.report:
            options.report.write_text(json.dumps(report))
    print(json.dumps(summary(report)))
    return 1 if bad else 0


PART = 100  # faults in one life of the lab; the report is written behind each


def part(spread, seed, options, report):
    loss, delay, jitter = map(float, options.line.split(","))
    spread.start()
    spread.lab.set_line(loss=loss, delay=delay, jitter=jitter)
    spread.yars("a", "inject", "power opr")
    campaign = Campaign(spread, seed)
    campaign.recover(set(spread.layout), time.monotonic())
    first = len(report["faults"])
    records = {"torn": 0, "out_of_range": 0, "time_back": 0, "records": 0}
    for _ in range(min(PART, options.faults - len(report["faults"]))):
        kind, host = campaign.random.choice(FAULTS), campaign.random.choice(sorted(spread.layout))
        for one in spread.layout:  # a host that fails takes the observer's verdict with it
            if one == host and kind in ("kill host", "other clock"):
                add_verdict(records, spread.ask(one, "verdict"))
        tick, machine = spread.ask(host, "state").get("model_tick"), campaign.machine
        times = campaign.fault(kind, host)
        report["faults"].append({"kind": kind, "host": host, "tick": tick, "machine": machine,
                                 "times_s": [round(one, 3) for one in times]})
        print(f"{len(report['faults']):5d}  tick {tick}, {kind} {host}, machine {machine} -> {campaign.machine}: " +
              ", ".join(f"{one:.2f} s" for one in times), flush=True)
    events = campaign.judge(report["faults"][first:])
    for host in spread.layout:
        add_verdict(records, spread.ask(host, "verdict"))
    report["events"].append({**events, "latency_p50_ms": percentile(campaign.latencies_ms, 0.5),
                             "latency_p99_ms": percentile(campaign.latencies_ms, 0.99)})
    report["records"].append(records)
    report["memory_kib"].append({host: memory_kib(process) for host, process in spread.gateways.items()})
    bad = len(events["lost"]) + len(events["twice"]) + records["torn"] + records["out_of_range"]
    if bad:
        print(json.dumps({"events": events, "records": records}))
    return bad


def add_verdict(records, verdict):
    for name in ("torn", "out_of_range", "time_back", "records"):
        records[name] += verdict[name] if verdict else 0
    if verdict and verdict["first"]:
        records.setdefault("first", []).extend(verdict["first"][:5])


if __name__ == "__main__":
    sys.exit(main())
