#!/usr/bin/env python3
"""A supervised set with roles that hang or are stopped, and with standard streams that are closed or full.

usage: supervise_test.py BIN (folder of the programs)
"""
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time

HOME = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(sys.argv[1]).resolve()
WATCHDOG_S = 120
# Takes part, sends some heartbeats and then none.
HANGING = """
import os, signal, sys, time
sys.path.insert(0, sys.argv[1])
from yars import session
while True:
    try:
        joined = session.Session(sys.argv[2], "hanging")
        break
    except session.YarsError:
        time.sleep(0.1)
for _ in range(160):  # long enough for the supervisor to see more than one
    joined.heartbeat()
    time.sleep(0.05)
while True:
    time.sleep(1)
"""


class Set:
    """A supervised set, whose standard error is a file."""

    def __init__(self, folder, *roles, redirection=""):
        self.session = f"supervise-{os.getpid()}"
        self.log = pathlib.Path(folder, "log")
        program = [f"import sys; sys.path.insert(0, {str(HOME / 'scripts')!r})",
                   "from starting import roles as r, supervisor",
                   "roles = [r.Role(name, command) "
                   f"for name, *command in {[[str(word) for word in role] for role in roles]}]",
                   f"sys.exit(supervisor.run_sets([r.Set({str(BIN)!r}, {self.session!r}, roles)]))"]
        words = [sys.executable, "-B", "-c", "\n".join(program)]
        self.process = subprocess.Popen(
            ["bash", "-c", f"exec {shlex.join(map(str, words))} {redirection or f'2>{self.log}'}"],
            stdin=subprocess.DEVNULL, cwd=folder, env={**os.environ, "YARS_USER_CONFIG": ""})

    def await_line(self, pattern):
        deadline = time.monotonic() + WATCHDOG_S
        while not (found := re.search(pattern, self.log.read_text() if self.log.exists() else "")):
            assert self.process.poll() is None and time.monotonic() < deadline, (
                f"{pattern} not found in\n{self.log.read_text()}")
            time.sleep(0.1)
        return found

    def present(self):
        done = subprocess.run([BIN / "yars", "--session", self.session, "watch", "--once", "--json"],
                              capture_output=True, text=True, check=False)
        return {name: int(pid) for name, pid in re.findall(r'"([\w -]+)":\s*\{[^{}]*"pid":\s*(\d+)', done.stdout)}

    def await_present(self, name):
        deadline = time.monotonic() + WATCHDOG_S
        while name not in (present := self.present()):
            assert time.monotonic() < deadline, f"{name} not among {present}"
            time.sleep(0.1)
        return present[name]

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(WATCHDOG_S)


def role(name, session, *more):
    return (name, BIN / name, "--session", session, "--log-level", "warning", *more)


def a_role_that_hangs_is_started_again(folder):
    session = f"supervise-{os.getpid()}"
    program = pathlib.Path(folder, "hanging.py")
    program.write_text(HANGING)
    flight = "fixed:37.5,-122.9,15000,90,480"
    tested = Set(folder, role("state-machine", session), role("flight-model", session, "--source", flight),
                 ("hanging", sys.executable, program, HOME / "python", session))
    stopped = tested.await_present("flight-model")
    os.kill(stopped, signal.SIGSTOP)
    tested.await_line(r"hanging has sent no heartbeat for \d+ s; it is killed")
    tested.await_line(r"hanging was killed by SIGKILL; starting it again \(1 of 5")
    tested.await_present("hanging")
    # Who is stopped on purpose, as in a debugger, stays.
    assert tested.present()["flight-model"] == stopped and "flight-model has sent" not in tested.log.read_text(), (
        tested.log.read_text())
    os.kill(stopped, signal.SIGCONT)
    tested.end()


def a_set_needs_no_standard_streams(folder):
    session = f"supervise-{os.getpid()}"
    for redirection in ("<&- >&- 2>&-", ">/dev/full 2>/dev/full", "</dev/full >&-"):
        recording = pathlib.Path(folder, "recording")
        recording.unlink(missing_ok=True)
        tested = Set(folder, role("state-machine", session),
                     ("recorder", BIN / "yars", "--session", session, "record", recording), redirection=redirection)
        tested.await_present("recorder")
        tested.await_present("state-machine")
        code = tested.end()
        assert code == 0, (redirection, code)
        listed = subprocess.run([BIN / "yars", "recordings", recording], capture_output=True, text=True, check=False)
        assert listed.returncode == 0 and "cut short" not in listed.stdout, listed


JOINED = """
import sys, time
sys.path.insert(0, sys.argv[1])
from yars import session
joined = session.Session(sys.argv[2], "other")
print("joined", flush=True)
time.sleep(1000)
"""


def what_roles_leave_that_had_to_be_killed_is_removed(folder):
    session = f"supervise-{os.getpid()}"
    segment = pathlib.Path(f"/dev/shm/yars.{os.geteuid()}.{session}")
    for somebody_stays in (True, False):
        tested = Set(folder, role("state-machine", session))
        machine = tested.await_present("state-machine")
        other = (subprocess.Popen([sys.executable, "-c", JOINED, HOME / "python", session], stdout=subprocess.PIPE)
                 if somebody_stays else None)
        if other:
            assert other.stdout.readline() == b"joined\n"
        os.kill(machine, signal.SIGSTOP)
        code = tested.end()
        assert code == 1 and "state-machine was killed by SIGKILL when the set ended" in tested.log.read_text(), (
            tested.log.read_text())
        assert segment.exists() == somebody_stays
        if other:
            other.kill()
            other.wait()


def main():
    for test in (a_role_that_hangs_is_started_again, a_set_needs_no_standard_streams,
                 what_roles_leave_that_had_to_be_killed_is_removed):
        with tempfile.TemporaryDirectory() as folder:
            test(folder)
        print(f"{test.__name__}: ok", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
