#!/usr/bin/env python3
"""Facts about what `cmake --install` lays out: it may be moved, and works from any folder.

usage: install_test.py CMAKE BUILD CC
The programs are linked into the prefix instead of copied: with the sanitizers they are large.
"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CMAKE, BUILD, CC = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
PROGRAMS = ["yars", "radar-model", "state-machine", "radar-display", "input-monitor", "flight-model"]
faults = []


def run(*command, folder):
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, timeout=60, check=False)


def expect(what, good, found=""):
    if not good:
        faults.append(f"{what}: {found}")


def check(prefix, elsewhere):
    share = prefix / "share"
    for program in PROGRAMS:
        page = share / f"man/man1/{program}.1.gz"
        expect(f"a man page of {program}", page.is_file() and f".Nm {program}" in gzip.open(page, "rt").read())
        version = run(prefix / "bin" / program, "--version", folder=elsewhere)
        expect(f"{program} --version", re.fullmatch(r"\d+\.\d+\.\d+\n", version.stdout), version)
    expect("the licence", (share / "doc/yars/copyright").is_file())
    expect("the configurations' includes", {file.name for file in (share / "yars/config").glob("*.guf")} >= {
        "apg70.guf", "apg70nd.guf", "apg70d.guf", "apg68.guf"})
    expect("no sources among the configurations", not list((share / "yars").rglob("*.?pp")))
    other_radar = run(prefix / "bin/yars", "--config", "apg68.guf", "config", "print", folder=elsewhere)
    expect("a configuration by its bare name", '"APG-68"' in other_radar.stdout, other_radar.stderr)
    absent = run(prefix / "bin/yars", "--config", "absent.guf", "config", "print", folder=elsewhere)
    expect("an absent configuration keeps its name", absent.returncode == 1 and "yars: absent.guf:" in absent.stderr, absent)
    route = run(prefix / "bin/flight-model", "--session", f"installed-{os.getpid()}", "--source", "route:default.route",
                "--lockstep", "flight-model@3", folder=elsewhere)
    expect("a route by its bare name", route.returncode == 0, route.stderr)
    compiled = run(CC, "-I", prefix / "include", share / "doc/yars/examples/fly.c", "-o", elsewhere / "fly", "-lm",
                   folder=elsewhere)
    expect("the example in C compiles with the installed header", compiled.returncode == 0, compiled.stderr)


with tempfile.TemporaryDirectory(dir=BUILD) as folder:
    first, moved, elsewhere = (pathlib.Path(folder, name) for name in ("first", "moved", "elsewhere"))
    elsewhere.mkdir()
    installed = run(CMAKE, "--install", BUILD, "--component", "Unspecified", "--prefix", first, folder=folder)
    expect("cmake --install", installed.returncode == 0, installed.stderr)
    (first / "bin").mkdir()
    for program in PROGRAMS:
        os.link(BUILD / "bin" / program, first / "bin" / program)
    shutil.move(first, moved)
    check(moved, elsewhere)
print("\n".join(faults) or "installed: as documented")
sys.exit(1 if faults else 0)
