"""Sets up a checkout and builds the programs of a set. A lock keeps other starts waiting meanwhile."""
import contextlib
import fcntl
import os
import subprocess
import time

from starting.command import HOME, INSTALLED, catch_signals, end, put, quoted
from starting.roles import ROLES

BIN, LOG = "build/release/bin", "build/start.log"
BUILD = ("cmake --preset release -DYARS_TESTS=OFF && NINJA_STATUS='step %f %t ' "
         "cmake --build --preset release --target")
PROGRAMS = sorted({kind.program for name, kind in ROLES.items() if name != "gateway"})
# Processor time and disk space of one step: averages over a whole build (HACKING.md, "What a build takes").
STEP_CPU_MS, STEP_DISK_KB = 2300, 2600


@contextlib.contextmanager
def one_at_a_time(what, path):
    """Takes a lock. The kernel frees it when this process and all that inherited the descriptor have closed it."""
    with open(path, "ab") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            put(1, f"Another start is at work on the {what}; waiting for it ...")
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield lock.fileno()


def show_progress(lines, log):
    """Shows the progress of ninja: on a terminal as one line that is redrawn, else as a line for every 10 %."""
    redraw = os.isatty(1) and os.environ.get("TERM", "dumb") != "dumb"
    began, next_percent, cores = time.monotonic(), 0, len(os.sched_getaffinity(0))
    for line in lines:
        log.write(line)
        word, number, total, rest = [*line.decode(errors="replace").split(maxsplit=3), "", "", "", ""][:4]
        if word != "step" or rest.startswith(("Re-checking", "Re-running")):
            continue
        number, total = int(number), int(total)
        if not next_percent:
            minutes, megabytes = int(total * STEP_CPU_MS / cores / 60000 + 0.5), int(total * STEP_DISK_KB / 1000 + 0.5)
            put(1, f"Building {total} steps: {f'about {minutes} min' if minutes else 'under a minute'} on {cores} "
                   f"{'core' if cores == 1 else 'cores'}, {megabytes} MB of disk; the log is {LOG}")
            next_percent = 10
        percent = 100 * number // total
        left_min = int((time.monotonic() - began) * (total - number) / max(number, 1) / 60) + 1
        left = f", {left_min} min left" if percent >= 10 and number < total else ""
        if redraw:
            print(f"\r{percent:3d} %, step {number} of {total}{left:<16}", end="", flush=True)
        elif percent >= next_percent:
            put(1, f"{percent} %, step {number} of {total}{left}")
            next_percent = percent // 10 * 10 + 10
    if redraw and next_percent:
        put(1, "")


def set_up_and_build(network, lock):
    stopped = []
    catch_signals(lambda *_: stopped.append(True))  # the signals reach the build, too, and end it

    def expect(is_done, doing, fault):
        if stopped:
            end(130, f"stopped while {doing}; the next start goes on from there")
        if not is_done:
            end(1, fault)

    options = [[], ["--network"]] if network else [[]]
    is_set_up = all(subprocess.call(["scripts/setup", *words], pass_fds=[lock]) == 0 for words in options)
    expect(is_set_up, "setting up", "set-up failed")
    put(1, "Preparing the build ...")
    # What the set runs, and no more.
    targets = [*PROGRAMS, "yars_client_library", "yars_help", *["gateway"] * bool(network)]
    with open(LOG, "wb") as log:
        process = subprocess.Popen(["sh", "-c", f"{BUILD} {' '.join(targets)}"], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=[lock])
        show_progress(process.stdout, log)
    is_built = process.wait() == 0
    if not is_built and not stopped:
        with open(LOG, "rb") as log:
            os.write(2, b"".join(log.readlines()[-30:]))
    expect(is_built, "building", f"the build failed; the whole log is {LOG}")
    catch_signals()


def folder_of_programs(given, fly_out, network):
    """Folder of the programs: --bin, or that of the build, which is brought up to date first. --fly-out uses programs
    that are there without a build, because its live set takes over at once."""
    if given:
        return given if os.access(f"{given}/yars", os.X_OK) else end(
            2, f"--bin: expected a folder with yars and the other programs, found {quoted(given)}")
    if INSTALLED:
        return str(HOME / "bin")
    if not fly_out or not all(os.access(f"{BIN}/{program}", os.X_OK) for program in PROGRAMS):
        os.makedirs("build", exist_ok=True)
        with one_at_a_time("build", "build/start.lock") as lock:  # two builds in one folder damage each other's files
            set_up_and_build(network, lock)
    return BIN
