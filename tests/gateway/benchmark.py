#!/usr/bin/env python3
"""Latency, bandwidth and load of a set over several hosts, beside one host and beside ddsperf, in one run.

usage: benchmark.py BIN [--presses 200] [--seconds 20] [--line LOSS,DELAY,JITTER] [--secure]
BIN has the programs of a build with YARS_TESTS and YARS_BENCHMARKS. Needs root, Xvfb and ddsperf (cyclonedds-tools).

Latency: from the press of DCL on the display's host to the new radar state there, and to the frame (latency_benchmark).
On one host, then with flight-model, state-machine and radar-model on three others. Load: processor time of each gateway
as a percentage of a core. Bandwidth: bytes of the records that each topic sends in a second, to one receiver. ddsperf:
half of the round trip of 12 bytes between two of the hosts while the set runs. Prints one JSON object.
"""
import argparse
import json
import os
import pathlib
import re
import sys
import tempfile
import time

import spread_set

TOP = pathlib.Path(__file__).resolve().parents[2]
FLIGHT = ("flight-model", ["--source", "fixed:37.5,-123.0,15000,90,480"])
DISPLAY = ("radar-display", ["--size", "480"])
FOUR = {"a": [FLIGHT], "b": [("state-machine", [])], "c": [("radar-model", ["--samples", "1024"])], "d": []}
ONE = {"d": [FLIGHT, ("state-machine", []), ("radar-model", ["--samples", "1024"])]}
DDSPERF = """<CycloneDDS><Domain Id="any">
<General><Interfaces><NetworkInterface name="eth0" multicast="false"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>4</MaxAutoParticipantIndex><Peers>{peers}</Peers></Discovery></Domain></CycloneDDS>"""


def cpu_seconds(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def start_display(spread):
    """A window, as a pilot has: without one the display draws only what it writes."""
    server = spread.lab.start("d", "Xvfb", ["-displayfd", "1", "-screen", "0", "640x640x24", "-nolisten", "tcp"])
    spread_set.lab.wait_until(lambda: re.search(r"^\d+$", server.text(), re.M), "Xvfb")
    number = re.search(r"^(\d+)$", server.text(), re.M).group(1)
    spread.lab.start("d", str(spread.programs / "radar-display"), ["--session", spread_set.SESSION, *DISPLAY[1]],
                     env={"DISPLAY": f":{number}"})


def latency(spread, presses):
    """{"state": {"p50_ms", "p99_ms"}, "frame": ...} of presses on host d, while scanning at 160 NM."""
    spread.yars("d", "inject", "power opr", "pb 13", "pb 13")
    time.sleep(3.0)
    text = spread.lab.run("d", str(spread.programs / "latency_benchmark"), [spread_set.SESSION, presses], within_s=300)
    rows = {}
    for line in text.splitlines():
        if found := re.match(r"(.*?)\s+p50\s+([\d.]+)\s+p99\s+([\d.]+)", line):
            rows[found[1].strip()] = {"p50_ms": float(found[2]), "p99_ms": float(found[3])}
    return rows


def topics(spread, host):
    status = json.loads(spread.yars(host, "status", "--json", code=None))
    return {one["name"]: one for one in status["network"]["topics"]}


def ddsperf(spread):
    peers = "".join(f'<Peer Address="{spread.lab.address(host)}"/>' for host in "cd")
    env = {"CYCLONEDDS_URI": DDSPERF.format(peers=peers)}
    pong = spread.lab.start("c", "ddsperf", ["-i", "9", "-D", "12", "pong"], env)
    text = spread.lab.run("d", "ddsperf", ["-i", "9", "-D", "8", "ping"], env, code=None)
    pong.wait(20)
    found = re.findall(r"mean ([\d.]+)us min [\d.]+us 50% ([\d.]+)us 90% [\d.]+us 99% ([\d.]+)us", text)
    return {"p50_ms": float(found[-1][1]) / 1e3, "p99_ms": float(found[-1][2]) / 1e3} if found else text[-500:]


def over_four_hosts(options, line, secure):
    folder = tempfile.TemporaryDirectory()
    extra = ""
    if secure:
        spread_set.lab.subprocess.run([str(TOP / "scripts/network_identities"), folder.name + "/set", *FOUR],
                                      check=True, stdout=spread_set.lab.subprocess.DEVNULL)
        extra = ':security "' + folder.name + '/set/{host}"'
    with spread_set.SpreadSet(options.programs, FOUR, options=extra) as spread:
        spread.start()
        spread.lab.set_line(loss=line[0], delay=line[1], jitter=line[2])
        start_display(spread)
        result = {"latency": latency(spread, options.presses)}
        cpu = {host: cpu_seconds(process) for host, process in spread.gateways.items()}
        before, begin = {host: topics(spread, host) for host in FOUR}, time.monotonic()
        time.sleep(options.seconds)
        elapsed = time.monotonic() - begin
        after = {host: topics(spread, host) for host in FOUR}
        result["load_percent"] = {host: round(100.0 * (cpu_seconds(process) - cpu[host]) / elapsed, 2)
                                  for host, process in spread.gateways.items()}
        rates = {}
        for host in FOUR:
            for name, topic in after[host].items():
                rate = (topic["sent_bytes"] - before[host][name]["sent_bytes"]) / elapsed
                rates[name] = rates.get(name, 0.0) + rate
        result["bytes_per_s"] = {name: round(rate)
                                 for name, rate in sorted(rates.items(), key=lambda item: -item[1]) if rate >= 1}
        if not secure:
            result["ddsperf"] = ddsperf(spread)
    folder.cleanup()
    return result


def on_one_host(options):
    with spread_set.SpreadSet(options.programs, ONE) as spread:
        spread.start_roles("d")
        start_display(spread)
        return {"latency": latency(spread, options.presses)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs")
    parser.add_argument("--presses", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--line", default="0,0,0", help="loss [%%], delay [ms], jitter [ms]")
    parser.add_argument("--secure", action="store_true", help="with identities, too")
    options = parser.parse_args()
    if reason := spread_set.lab.can_run(str(pathlib.Path(options.programs) / "wire")):
        print(f"skipped: {reason}")
        return 77
    line = list(map(float, options.line.split(",")))
    report = {"one host": on_one_host(options), "four hosts": over_four_hosts(options, line, False)}
    if options.secure:
        report["four hosts, encrypted"] = over_four_hosts(options, line, True)
    print(json.dumps(report, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
