#!/usr/bin/env python3
"""Every number that a program takes refuses NaN and infinity; every text refuses an empty one.

usage: numbers_test.py BIN
Walks all programs and commands by their --help and gives each option and argument of a number `nan` and one of `inf`,
`-inf`, `1e999` and `-nan` in turn: exit code 2 and one line that names the option and the value. Then the texts that
have numbers in them. Each option and argument of a text gets an empty one: exit code 2 and a message that names the
option. YARS_TEST_FULL: all values for each of them.
"""
import concurrent.futures
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "packaging/help"))
import help_text  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
VALUES = ["nan", "inf", "-inf", "1e999", "-nan"]
# Texts with numbers in them; N is where the value goes.
TEXTS = [
    ["yars", "scan", "--scene", "a.flt@N,2,3"], ["yars", "scan", "--scene", "a.flt@1,N,3"],
    ["yars", "scan", "--scene", "a.flt@1,2,N"],
    ["yars", "patch", "--target-lat", "1", "--target-lon", "1", "--scene", "a.flt@1,2,N"],
    ["yars", "scene", "generate", "--out", "a.flt", "--origin", "N,1"],
    ["yars", "scene", "generate", "--out", "a.flt", "--origin", "1,N"],
    ["yars", "trade", "--knob", "postsPerSample=N"], ["yars", "trade", "--knob", "samples=N"],
    ["yars", "trade", "--scene", "N,1,15000,0,40"], ["yars", "trade", "--scene", "1,1,15000,0,N"],
    ["yars", "trade", "maps", "--view", "1,1,15000,1,N,0.67"],
    ["yars", "inject", "tdc N 0"], ["yars", "inject", "tdc 0 N"], ["yars", "inject", "elevation N"],
    ["yars", "inject", "pb N"], ["yars", "inject", "nav error mn N 0"], ["yars", "inject", "nav drift ins 0 N"],
    ["flight-model", "--source", "fixed:N,1,1,1,1"], ["flight-model", "--source", "fixed:1,N,1,1,1"],
    ["flight-model", "--source", "fixed:1,1,N,1,1"], ["flight-model", "--source", "fixed:1,1,1,N,1"],
    ["flight-model", "--source", "fixed:1,1,1,1,N"], ["flight-model", "--source", "flightgear:N"],
    ["state-machine", "--cpus", "N"], ["state-machine", "--lockstep", "state-machine@N"],
]
# Files with numbers in them: text, and the command that reads it (F: the file). Exit code other than 0.
FILES = [
    ("radar.guf", "( Apg70 ( :SEED N ) )", ["yars", "config", "check", "F"]),
    ("radar.guf", "( Apg70 ( Radar :FREQUENCY-GHZ N ) )", ["yars", "config", "check", "F"]),
    ("a.route", "lat 1\nlon N\n", ["flight-model", "--source", "route:F"]),
    ("a.csv", "time_s,latitude_deg,longitude_deg,altitude_msl_m,heading_deg,speed_mps\n0,1,N,1,1,1\n1,1,1,1,1,1\n",
     ["flight-model", "--source", "csv:F"]),
    ("a.script", "N freeze\n", ["input-monitor", "--source", "script:F"]),
    ("a.script", "0 tdc N 0\n", ["input-monitor", "--source", "script:F"]),
]
COUNT = itertools.count()


def values_of(number):
    """Values for the option or text with this number. All are read by one function, so each gets two of them."""
    return VALUES if "YARS_TEST_FULL" in os.environ else [VALUES[0], VALUES[1 + number % (len(VALUES) - 1)]]


def run(arguments):
    """Runs a program in a session of its own: programs run at the same time, and a session has one state-machine."""
    command = [str(BIN / arguments[0]), "--session", f"numbers-{os.getpid()}-{next(COUNT)}"] + arguments[1:]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL)


def entries_of(command, is_wanted):
    """(command, option, how many values) for each option of a kind; the arguments of a command are one entry without an
    option; then those of the commands below."""
    for entry in command.options:
        if entry.count and is_wanted(entry):
            yield command.words, entry.names[-1], entry.count
    arguments = sum(entry.count for entry in command.arguments if is_wanted(entry))
    if arguments and command.words[-1] != "help":
        yield command.words, None, arguments
    for below in command.below:
        yield from entries_of(below, is_wanted)


def is_text(entry):
    return not entry.is_number


def problem_of(done, named, value):
    if done.returncode != 2:
        return f"expected exit code 2, found {done.returncode}: {done.stderr.strip()[-300:]}"
    if (not value.startswith("-") and value not in done.stderr) or (named and named.lstrip("-") not in done.stderr):
        return f"expected a message that names {named} and {value}, found {done.stderr.strip()[-300:]}"
    return None


def try_option(case):
    (command, option, count), value = case
    # A second value with a sign would pass for an option; it is bad usage, too.
    words = ([option] if option and not value.startswith("-") else []) + [value] * count
    if option and value.startswith("-"):
        words = [f"{option}={value}"] + words[1:]
    return " ".join(command + words), problem_of(run(command + words), option, value)


def try_empty_text(case):
    command, option, count = case
    words = ([option] if option else []) + [""] * count
    done = run(command + words)
    fine = done.returncode == 2 and "found an empty one" in done.stderr and (option or "") in done.stderr
    return " ".join(command + words), None if fine else f"found {done.returncode}: {done.stderr.strip()[-300:]}"


def try_text(case):
    text, value = case
    # What is in the middle of a text is no option: any place where there is an N of its own.
    words = [re.sub(r"\bN\b", value, word) for word in text]
    return " ".join(words), problem_of(run(words), None, value)


def try_file(case):
    (name, text, command), value = case
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, name)
        path.write_text(re.sub(r"\bN\b", value, text))
        words = [word.replace("F", str(path)) if word in ("F", "csv:F", "route:F", "script:F") else word
                 for word in command]
        done = run(words)
    fine = done.returncode in (1, 2) and "runtime error" not in done.stderr and "Sanitizer" not in done.stderr
    return f"{name} {text!r} with {value}", None if fine else f"found {done.returncode}: {done.stderr.strip()[-300:]}"


def main():
    programs = [help_text.read([str(BIN / name)]) for name in help_text.PROGRAMS]
    entries = [entry for program in programs for entry in entries_of(program, lambda entry: entry.is_number)]
    texts = [entry for program in programs for entry in entries_of(program, is_text)]
    print(f"{len(entries)} options and arguments of numbers, {len(texts)} of texts, {len(TEXTS)} texts of numbers, "
          f"{len(FILES)} files")
    if len(entries) < 60 or len(texts) < 60:
        print("expected at least 60 of them: are the help texts read rightly?")
        return 1
    tries = [(try_option, (entry, value)) for at, entry in enumerate(entries) for value in values_of(at)]
    tries += [(try_text, (text, value)) for at, text in enumerate(TEXTS) for value in values_of(at)]
    tries += [(try_empty_text, entry) for entry in texts]
    tries += [(try_file, (file, value)) for file in FILES for value in VALUES]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        problems = [(what, problem) for what, problem in pool.map(lambda one: one[0](one[1]), tries) if problem]
    for what, problem in problems:
        print(f"{what}: {problem}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
