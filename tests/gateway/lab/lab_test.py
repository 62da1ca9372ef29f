#!/usr/bin/env python3
"""What the lab promises: a line with delay, loss and cuts; hosts apart; nothing left behind, however it ends.

usage: lab_test.py WIRE       ends with 77 and a word where there are no namespaces
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import lab  # noqa: E402

WATCHDOG_S = 60
HOLDER = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background it may be ignored
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import lab
with lab.Lab(["a", "b"], wire=sys.argv[2]) as two:
    sleeper = two.start("a", "sleep", [1000])
    print(two.folder, *[host.first for host in two.hosts.values()], sleeper.pid, two.wire.pid, flush=True)
    time.sleep(1000)
"""


def ping(hosts, source, target, count=5, more=()):
    """Numbers of what was sent and received, and the least round trip [ms]; no answer at all is 0 received."""
    text = hosts.run(source, "ping", ["-n", "-q", "-c", count, "-i", "0.01", "-W", "1", *more, hosts.address(target)],
                     code=None)
    sent, received = map(int, re.search(r"(\d+) packets transmitted, (\d+) received", text).groups())
    least = re.search(r"rtt min/avg/max/mdev = ([0-9.]+)/", text)
    return sent, received, float(least[1]) if least else None


def is_reached(hosts, source, target):
    """True if an answer comes. On a busy machine some of several come too late."""
    return ping(hosts, source, target)[1] > 0


def the_line_delays(hosts):
    assert is_reached(hosts, "a", "b")
    hosts.set_line(delay=30)
    _, received, least = ping(hosts, "a", "b")
    assert received > 0 and least >= 60.0, (received, least)
    hosts.set_line()


def lost_and_doubled_frames_are_counted(hosts):
    before = hosts.statistics()
    hosts.set_line(loss=20, duplicate=20, reorder=20)
    received = ping(hosts, "a", "b", count=100)[1]
    hosts.set_line()
    after = hosts.statistics()
    change = {name: after[name] - before[name] for name in after}
    assert (40 <= received < 100 and
            min(change["lost"], change["duplicated"], change["reordered"]) > 0), (received, change)


def bandwidth_is_a_limit(hosts):
    hosts.set_line(bandwidth=1000)
    least = ping(hosts, "a", "b", more=["-s", "1000"])[2]
    hosts.set_line()
    assert least >= 2 * 1000 * 8 / 1000, least


def a_host_is_cut_off_and_comes_back(hosts):
    hosts.cut("b")
    assert ping(hosts, "a", "b", count=2)[1] == 0 and is_reached(hosts, "a", "c")
    hosts.heal("b")
    assert is_reached(hosts, "a", "b")


def hosts_are_apart(hosts):
    hosts.run("a", "sh", ["-c", "echo mine >/dev/shm/file"])
    assert hosts.run("a", "ls", ["/dev/shm"]) == "file\n" and hosts.run("b", "ls", ["/dev/shm"]) == ""
    assert not os.path.exists("/dev/shm/file")
    assert hosts.run("b", "uname", ["-n"]) == "b\n"
    script = "import time; print(time.monotonic())"
    clocks = [float(hosts.run(host, sys.executable, ["-c", script])) for host in ("a", "b", "c")]
    assert 1_000 <= clocks[1] - clocks[0] < 1_100 and 50_000 <= clocks[2] - clocks[0] < 50_100, clocks
    hosts.restart("b", offset_s=20_000)
    clock = float(hosts.run("b", sys.executable, ["-c", script]))
    assert 20_000 <= clock - clocks[0] < 20_100, (clock, clocks)
    assert is_reached(hosts, "a", "b")


def state(pid):
    return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]


def hosts_are_killed_stopped_and_continued(hosts):
    sleeper, other = hosts.start("a", "sleep", [1000]), hosts.start("b", "sleep", [1000])
    hosts.start("a", "sh", ["-c", "sleep 1000 & sleep 1000 & wait"])
    lab.wait_until(lambda: len(hosts.pids("a")) == 4, "four processes")
    hosts.stop_host("a")
    lab.wait_until(lambda: all(state(pid) == "T" for pid in hosts.pids("a")), "that all are stopped")
    assert state(other.pid) == "S", state(other.pid)
    hosts.continue_host("a")
    lab.wait_until(lambda: all(state(pid) == "S" for pid in hosts.pids("a")), "that none is stopped")
    assert sleeper.poll() is None
    hosts.stop_host("a")
    hosts.kill_host("a")
    assert sleeper.poll() == -signal.SIGKILL and hosts.pids("a") == [] and other.poll() is None
    other.terminate()
    assert other.wait() == -signal.SIGTERM


def a_program_says_how_it_ended(hosts):
    process = hosts.start("c", "sh", ["-c", "echo $GREETING; echo there >&2; exit 3"], env={"GREETING": "hello"})
    assert process.wait() == 3 and process.text() == "hello\nthere\n", process.text()
    hosts.run("c", "sh", ["-c", "(sleep 0.01 &) "])
    lab.wait_until(lambda: hosts.pids("c") == [], "an orphan that leaves no zombie")
    try:
        hosts.run("c", "false")
    except lab.LabError as problem:
        assert "expected code 0, found 1" in str(problem), problem
    else:
        raise AssertionError("false was taken for true")


def exists(pid):
    try:
        return state(pid) != "Z"
    except OSError:  # it is gone, or goes between the opening and the reading
        return False


def nothing_stays_behind(wire):
    """After SIGINT also no folder; after SIGKILL nobody is left who could remove it."""
    for number in (signal.SIGINT, signal.SIGKILL):
        with subprocess.Popen([sys.executable, "-c", HOLDER, str(pathlib.Path(lab.__file__).parent), wire],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as holder:
            try:
                folder, *pids = holder.stdout.readline().split()
                assert len(pids) == 4 and all(map(exists, pids)), pids
                holder.send_signal(number)
                holder.wait(WATCHDOG_S)
            finally:
                holder.kill()
        lab.wait_until(lambda: not any(map(exists, pids)), "the end of what the lab started")
        if number == signal.SIGKILL:
            subprocess.run(["rm", "-r", folder], check=True)
        assert not os.path.exists(folder), folder
        assert folder not in pathlib.Path("/proc/mounts").read_text()


def main():
    wire = sys.argv[1]
    why_not = lab.can_run(wire)
    if why_not:
        print(f"skipped: {why_not}")
        return 77
    began = time.monotonic()
    with lab.Lab(["a", "b", "c"], wire=wire) as hosts, lab.Lab(["a"], wire=wire) as beside:
        for test in (the_line_delays, lost_and_doubled_frames_are_counted, bandwidth_is_a_limit,
                     a_host_is_cut_off_and_comes_back, hosts_are_apart, hosts_are_killed_stopped_and_continued,
                     a_program_says_how_it_ended):
            test(hosts)
            print(f"{test.__name__}: ok", flush=True)
        assert beside.run("a", "ls", ["/dev/shm"]) == ""
    nothing_stays_behind(wire)
    print(f"nothing_stays_behind: ok; {time.monotonic() - began:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
