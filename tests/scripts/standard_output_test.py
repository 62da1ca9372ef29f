#!/usr/bin/env python3
"""A program whose standard output cannot be written says so in one line and has exit code 1. A closed pipe stays quiet.

usage: standard_output_test.py BIN
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

BIN = pathlib.Path(sys.argv[1]).resolve()
ROLES = ["flight-model", "input-monitor", "state-machine", "radar-model", "radar-display"]
EXPECTED = re.compile(r"^[\w-]+: standard output: expected .*, found No space left on device; .*$", re.M)
AREA = "--terrain cells --south 36 --west -124".split()
faults = []


def run(words, output):
    return subprocess.run([str(BIN / words[0])] + words[1:], stdout=output, stderr=subprocess.PIPE, text=True,
                          timeout=120, stdin=subprocess.DEVNULL)


def helps(words):
    """--help of a command and of all its subcommands, as its own help lists them."""
    yield words + ["--help"]
    text = run(words + ["--help"], subprocess.PIPE).stdout
    subcommands = text.partition("Subcommands:\n")[2]
    for name in re.findall(r"^  (\w+) ", subcommands, re.M):
        yield from helps(words + [name])


def commands():
    for program in ROLES + ["yars"]:
        yield [program, "--version"]
    for role in ROLES:
        yield [role, "--help"]
    yield from helps(["yars"])
    yield "yars scan --out sweep.f32".split()
    yield ["yars", "terrain", "info", "cells"]
    yield ["yars", "terrain", "dump"] + AREA
    yield "yars terrain profile --from 36.1 -123.9 --to 36.9 -123.1 --step 1000".split()
    yield "yars terrain reduce --in cells --out reduced --reduction 1".split()
    yield "yars terrain pack --in cells --out packed".split()
    yield "yars scene info scene.flt".split()
    yield "yars scene info --json scene.flt".split()
    yield "yars config print".split()
    yield "yars config print --defaults".split()
    yield ["yars", "config", "check", "plain.guf"]
    yield ["yars", "config", "convert", "plain.guf"]
    yield "yars status --layout".split()


def prepare():
    for words in ("yars terrain generate --out cells --south 36 --west -124 --cells-lat 1 --cells-lon 1 --level 0",
                  "yars scene generate --kind bridge --triangles 200 --origin 36.5,-123.5 --out scene.flt"):
        done = run(words.split(), subprocess.PIPE)
        if done.returncode != 0:
            sys.exit(f"{words}: expected exit code 0, found {done}")
    pathlib.Path("plain.guf").write_text("( Apg70 )\n")


def check_full(words):
    with open("/dev/full", "w") as full:
        done = run(words, full)
    if done.returncode != 1 or len(EXPECTED.findall(done.stderr)) != 1:
        faults.append(f"{words}: expected exit code 1 and one line on standard output, found {done}")


def check_closed_pipe(words, sigpipe):
    """The reader has gone before the first write."""
    reader, writer = os.pipe()
    os.close(reader)
    previous = signal.signal(signal.SIGPIPE, sigpipe)
    done = subprocess.run([str(BIN / words[0])] + words[1:], stdout=writer, stderr=subprocess.PIPE, text=True,
                          timeout=120, stdin=subprocess.DEVNULL, restore_signals=False)
    signal.signal(signal.SIGPIPE, previous)
    os.close(writer)
    if done.returncode not in (0, -signal.SIGPIPE) or "standard output" in done.stderr:
        faults.append(f"{words}: expected nothing of a closed pipe, found {done}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        prepare()
        walked = list(commands())
        for words in walked:
            check_full(words)
        for sigpipe in (signal.SIG_DFL, signal.SIG_IGN):
            check_closed_pipe(["yars", "terrain", "dump"] + AREA, sigpipe)
            check_closed_pipe(["radar-model", "--help"], sigpipe)
    print("\n".join(faults) or f"{len(walked)} commands name a standard output that is full")
    return 1 if faults else 0


if __name__ == "__main__":
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
    sys.exit(main())
