"""Of a checkout: installs what the set needs and builds its programs. One at a time, whoever starts."""
import contextlib
import fcntl
import os
import subprocess
import sys
import time

from starting.command import HOME, INSTALLED, NAME, catch_signals, end, leave, put, quoted
from starting.roles import ROLES

BIN = "build/release/bin"
LOG = "build/start.log"
PROGRAMS = sorted({kind.program for name, kind in ROLES.items() if name != "gateway"})
# Processor time and disk of a step of the build: means of a whole one, see HACKING.md, "What a build takes".
STEP_CPU_MS, STEP_DISK_KB = 2300, 2600


@contextlib.contextmanager
def one_at_a_time(what, path):
    """A lock that ends with whoever holds it: this process and those that get the descriptor."""
    with open(path, "ab") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            put(1, f"Another start is at work on the {what}; waiting for it ...")
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield lock.fileno()


def expected_cost(steps):
    """Minutes and megabytes of so many steps on the cores of this machine."""
    cores = len(os.sched_getaffinity(0))
    minutes = int(steps * STEP_CPU_MS / cores / 60000 + 0.5)
    return (f"{f'about {minutes} min' if minutes else 'under a minute'} on {cores} {'core' if cores == 1 else 'cores'}, "
            f"{int(steps * STEP_DISK_KB / 1000 + 0.5)} MB of disk")


def show_progress(lines):
    """Of lines of ninja: on a terminal one line that is redrawn, else a line for every tenth."""
    redraw = os.isatty(1) and os.environ.get("TERM", "dumb") != "dumb"
    began, next_percent = time.monotonic(), 0
    for line in lines:
        word, number, total, rest = [*line.decode(errors="replace").split(maxsplit=3), "", "", "", ""][:4]
        if word != "step" or rest.startswith(("Re-checking", "Re-running")):
            continue
        number, total = int(number), int(total)
        if not next_percent:
            put(1, f"Building {total} steps: {expected_cost(total)}; the log is {LOG}")
            next_percent = 10
        percent, left_s = 100 * number // total, (time.monotonic() - began) * (total - number) / max(number, 1)
        left = f", {int(left_s / 60) + 1} min left" if percent >= 10 and number < total else ""
        if redraw:
            sys.stdout.write(f"\r{percent:3d} %, step {number} of {total}{left:<16}")
            sys.stdout.flush()
        elif percent >= next_percent:
            put(1, f"{percent} %, step {number} of {total}{left}")
            next_percent = percent // 10 * 10 + 10
    if redraw and next_percent:
        put(1, "")


def build(targets, lock):
    """What the set runs, and no more. False: it failed."""
    commands = (("--preset", "release", "-DYARS_TESTS=OFF"), ("--build", "--preset", "release", "--target", *targets))
    with open(LOG, "wb") as log:
        def logged(lines):
            for line in lines:
                log.write(line)
                yield line

        for words in commands:
            with subprocess.Popen(["cmake", *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  env={**os.environ, "NINJA_STATUS": "step %f %t "}, pass_fds=[lock]) as process:
                show_progress(logged(process.stdout))
            if process.returncode != 0:
                return False
    return True


def set_up_and_build(network, lock):
    stopped = []
    catch_signals(lambda *_: stopped.append(True))  # the build, which they reach too, ends by itself

    def stop_if_asked(doing):
        if stopped:
            end(130, f"stopped while {doing}; the next start goes on from there")

    is_set_up = all(subprocess.run(["scripts/setup", *words], check=False, pass_fds=[lock]).returncode == 0
                    for words in ([], ["--network"])[:1 + bool(network)])
    stop_if_asked("setting up")
    if not is_set_up:
        end(1, "set-up failed")
    put(1, "Preparing the build ...")
    is_built = build([*PROGRAMS, "yars_help", *["gateway"] * bool(network)], lock)
    stop_if_asked("building")
    if not is_built:
        with open(LOG, "rb") as log:
            os.write(2, b"".join(log.readlines()[-30:]))
        end(1, f"the build failed; the whole log is {LOG}")
    catch_signals(leave)


def folder_of_programs(options):
    """Built before, where --bin does not name it. A live set is to go on at once: what is built already is not built again."""
    if options.bin:
        if not os.access(f"{options.bin}/yars", os.X_OK):
            end(2, f"--bin: expected a folder with yars and the other programs, found {quoted(options.bin)}")
        return options.bin
    if INSTALLED:
        return str(HOME / "bin")
    if not options.fly_out or not all(os.access(f"{BIN}/{program}", os.X_OK) for program in PROGRAMS):
        os.makedirs("build", exist_ok=True)
        with one_at_a_time("build", "build/start.lock") as lock:  # two builds in one folder spoil each other
            set_up_and_build(options.network, lock)
    return BIN
