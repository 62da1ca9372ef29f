#!/usr/bin/env python3
"""A set over four hosts in real time: memory and load of the gateways, events, recordings on two hosts.

usage: endurance.py BIN [--minutes 60] [--line LOSS,DELAY,JITTER] [--out FOLDER]
BIN has the programs of a build, with wire and observer. Needs root.

An event is pressed each second on the hosts in turn. Each 10 s the resident memory of the gateways is read. At the end
both recordings are replayed: their sweeps have to be equal to those computed from their ticks. Prints one JSON object.
"""
import argparse
import json
import pathlib
import sys
import time

import faults
import spread_set


def replayed(spread, host, recording):
    counts = spread.replayed(host, recording)
    return {name: counts[name] for name in ("ticks", "sweeps", "equal", "different", "ticks_lost", "run_hash")}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs")
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--line", default="0,0,0", help="loss [%%], delay [ms], jitter [ms]")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    options = parser.parse_args()
    if reason := spread_set.lab.can_run(str(pathlib.Path(options.programs) / "wire")):
        print(f"skipped: {reason}")
        return 77
    loss, delay, jitter = map(float, options.line.split(","))
    out = options.out.resolve()
    with spread_set.SpreadSet(options.programs) as spread:
        spread.start()
        spread.lab.set_line(loss=loss, delay=delay, jitter=jitter)
        recorders = [spread.lab.start(host, str(spread.programs / "yars"),
                                      ["record", "--session", spread_set.SESSION, "--overwrite",
                                       str(out / f"endurance_{host}.yars")])
                     for host in "cd"]
        spread.yars("a", "inject", "power opr")
        campaign = faults.Campaign(spread, 1)
        campaign.recover(set(spread.layout), time.monotonic())
        memory = {host: [] for host in spread.layout}
        begin, second = time.monotonic(), 0
        while time.monotonic() - begin < 60.0 * options.minutes:
            second += 1
            campaign.press("abcd"[second % 4])
            campaign.collect(spread.layout)
            if second % 10 == 0:
                for host, process in spread.gateways.items():
                    memory[host].append(faults.memory_kib(process))
            if second % 60 == 0:
                print(f"{second // 60:4d} min: " + ", ".join(f"{host} {kib[-1]} KiB" for host, kib in memory.items()),
                      flush=True)
            time.sleep(max(0.0, begin + second - time.monotonic()))
        events = campaign.judge([])
        states = spread.states()
        for recorder in recorders:
            recorder.terminate()
            recorder.wait()
        report = {"minutes": options.minutes, "events": events,
                  "memory_kib": {host: {"first": kib[0], "middle": kib[len(kib) // 2], "last": kib[-1], "max": max(kib)}
                                 for host, kib in memory.items() if kib},
                  "load": {host: round(state["network"]["load"], 4) for host, state in states.items()},
                  "lost": {host: sum(one["lost"] for one in state["network"]["hosts"].values())
                           for host, state in states.items()},
                  "records": {host: spread.ask(host, "verdict") for host in spread.layout},
                  "replay": {host: replayed(spread, host, str(out / f"endurance_{host}.yars")) for host in "cd"}}
    print(json.dumps(report))
    return 1 if events["lost"] or events["twice"] or any(one["different"] for one in report["replay"].values()) else 0


if __name__ == "__main__":
    sys.exit(main())
