#!/usr/bin/env python3
"""Sets of one session that start at once: one lives, the others end with code 1 and start nothing.

usage: one_set_test.py
With the stand-ins for the programs of tour_start_test.py, which take part in no session: nothing but the set's lock
keeps one from the other.
"""
import os
import pathlib
import signal
import time

from tour_start_test import WATCHDOG_S, Place, run_each

CALLERS = 4
ALL = "flight-model,state-machine,radar-model,radar-display"


def lock_file(place):
    return pathlib.Path(f"/dev/shm/yars-set.{os.geteuid()}.{place.session}")


def await_lines(place, role, count):
    deadline = time.monotonic() + WATCHDOG_S
    while len(place.lines(role)) < count:
        assert time.monotonic() < deadline, f"{role} did not start {count} times"
        time.sleep(0.02)


def ended(process):
    process.send_signal(signal.SIGTERM)
    return process.communicate(timeout=WATCHDOG_S)[0]


def start(place, roles, *more):
    of_display = place.options if "radar-display" in roles else place.options[:4]  # with --frames
    return place.start("--roles", roles, *more, options=of_display, keep_log=True)


def refused(process):
    text = process.communicate(timeout=WATCHDOG_S)[0]
    return process.returncode == 1 and "is there already" in text and "choose --session NAME" in text


def of_four_at_once_one_lives(place):
    for _ in range(5):
        place.log.unlink(missing_ok=True)
        callers = [start(place, ALL, "--headless", "600") for _ in range(CALLERS)]
        await_lines(place, "radar-display", 1)
        deadline = time.monotonic() + WATCHDOG_S
        while sum(caller.poll() is None for caller in callers) > 1:
            assert time.monotonic() < deadline, "more than one set lives"
            time.sleep(0.02)
        living = [caller for caller in callers if caller.poll() is None]
        assert len(living) == 1, [caller.communicate()[0] for caller in callers]
        assert all(refused(caller) for caller in callers if caller is not living[0])
        text = ended(living[0])
        assert living[0].returncode == 0, text
        assert len(place.lines("state-machine")) == 1, place.lines("state-machine")
        assert not lock_file(place).exists()


def parts_of_a_set_start_beside_each_other(place):
    first = start(place, "state-machine,flight-model")
    await_lines(place, "flight-model", 1)
    assert refused(start(place, "state-machine"))
    second = start(place, "radar-model")
    await_lines(place, "radar-model", 1)
    displays = [start(place, "radar-display", "--headless", "600") for _ in range(2)]
    await_lines(place, "radar-display", 2)
    assert refused(start(place, "flight-model", "--headless", "5", "--lockstep"))
    for process in (first, second, *displays):
        assert lock_file(place).exists()
        text = ended(process)
        assert process.returncode == 0, text
    assert not lock_file(place).exists()


def a_killed_set_leaves_no_lock(place):
    first = start(place, "state-machine")
    await_lines(place, "state-machine", 1)
    os.killpg(first.pid, signal.SIGKILL)
    first.communicate(timeout=WATCHDOG_S)
    assert lock_file(place).exists()
    second = start(place, "state-machine")
    await_lines(place, "state-machine", 2)
    assert second.poll() is None
    ended(second)
    assert second.returncode == 0 and not lock_file(place).exists()


def a_lock_that_is_no_file_is_refused(place):
    lock_file(place).symlink_to(place.folder / "elsewhere")
    try:
        code, text = place.run("--roles", ALL, "--headless", "5")
        assert code == 1 and str(lock_file(place)) in text and "expected a file" in text, text
        assert not (place.folder / "elsewhere").exists() and not place.lines("state-machine")
    finally:
        lock_file(place).unlink()


if __name__ == "__main__":
    run_each(Place, of_four_at_once_one_lives, parts_of_a_set_start_beside_each_other, a_killed_set_leaves_no_lock,
             a_lock_that_is_no_file_is_refused)
