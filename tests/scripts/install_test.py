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
PROGRAMS = ["yars", "radar-model", "state-machine", "radar-display", "input-monitor", "flight-model", "yars-station"]
faults = []


def run(*command, folder):
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, timeout=300,
                          check=False)


def expect(what, good, found=""):
    if not good:
        faults.append(f"{what}: {found}")


def start(prefix, elsewhere):
    """The installed start script flies its own route over a plain at sea level."""
    (elsewhere / "terrain").mkdir()
    (elsewhere / "terrain/N37W123.hgt").write_bytes(bytes(2 * 1201 * 1201))
    # The search for leaks crashes now and then beside Mesa's threads.
    begun = run("env", "ASAN_OPTIONS=detect_leaks=0", prefix / "bin/yars-start", "--session", f"started-{os.getpid()}",
                "--terrain", "terrain", "--lockstep", "--headless", "3", "--frames", "frames", "--size", "240",
                "--log-dir", "logs", folder=elsewhere)
    frames = list((elsewhere / "frames").glob("*.png"))
    expect("yars-start flies and draws", begun.returncode == 0 and len(frames) >= 3, begun)
    expect("yars-start keeps logs", (elsewhere / "logs/radar-model.log").is_file(), begun)
    unknown = run(prefix / "bin/yars-start", "--nonsense", folder=elsewhere)
    expect("yars-start says its own name", unknown.returncode == 2 and unknown.stderr.startswith("yars-start: "),
           unknown)
    for unit in ("yars.service", "yars@.service"):
        text = (prefix / "lib/systemd/user" / unit).read_text()
        expect(f"{unit} starts what is installed", "exec yars-start --session" in text and "YARS_HOME" not in text,
               text)


def check(prefix, elsewhere):
    share = prefix / "share"
    for program in PROGRAMS + ["yars-start"]:
        page = share / f"man/man1/{program}.1.gz"
        expect(f"a man page of {program}", page.is_file() and f".Nm {program}" in gzip.open(page, "rt").read())
        if program == "yars-start":
            continue
        version = run(prefix / "bin" / program, "--version", folder=elsewhere)
        expect(f"{program} --version", re.fullmatch(r"\d+\.\d+\.\d+\n", version.stdout), version)
    for program in PROGRAMS + ["yars-start"]:
        expect(f"completion of {program}", (share / f"bash-completion/completions/{program}").is_file()
               and (share / f"fish/vendor_completions.d/{program}.fish").is_file()
               and program in (share / "zsh/vendor-completions/_yars").read_text().splitlines()[0].split())
    expect("the tables of the records", "## Ownship: " in (share / "doc/yars/docs/records.md").read_text())
    expect("the licence", (share / "doc/yars/copyright").is_file())
    expect("the configurations' includes", {file.name for file in (share / "yars/config").glob("*.guf")} >= {
        "apg70.guf", "apg70nd.guf", "apg70d.guf", "apg68.guf"})
    expect("what yars-start makes and plays", (share / "yars/config/coast.scenes").is_file() and
           {file.name for file in (share / "yars/config/tours").glob("*.tour")} >= {"radar.tour", "second_radar.tour"})
    expect("no sources among the configurations", not list((share / "yars").rglob("*.?pp")))
    other_radar = run(prefix / "bin/yars", "--config", "apg68.guf", "config", "print", folder=elsewhere)
    expect("a configuration by its bare name", '"APG-68"' in other_radar.stdout, other_radar.stderr)
    network = run(prefix / "bin/yars", "config", "print", "network.guf", folder=elsewhere)
    expect("config print has the network of a file",
           "( Network\n" in network.stdout and '"10.77.0.2"' in network.stdout, network)
    expect("a file without the form has no network", "( Network\n" not in other_radar.stdout)
    checked = run(prefix / "bin/yars", "config", "check", "apg68.guf", folder=elsewhere)
    expect("config check finds what --config finds", checked.returncode == 0 and "valid" in checked.stdout, checked)
    absent = run(prefix / "bin/yars", "--config", "absent.guf", "config", "print", folder=elsewhere)
    expect("an absent configuration keeps its name", absent.returncode == 1 and "yars: absent.guf:" in absent.stderr,
           absent)
    route = run(prefix / "bin/flight-model", "--session", f"installed-{os.getpid()}", "--source", "route:default.route",
                "--lockstep", "flight-model@3", folder=elsewhere)
    expect("a route by its bare name", route.returncode == 0, route.stderr)
    start(prefix, elsewhere)
    compiled = run(CC, "-I", prefix / "include", share / "doc/yars/examples/fly.c", "-o", elsewhere / "fly", "-lm",
                   folder=elsewhere)
    expect("the example in C compiles with the installed header", compiled.returncode == 0, compiled.stderr)


def install_without_a_build(folder):
    """Documents and man pages need no target of their own: scripts/start builds the programs alone."""
    build, prefix = pathlib.Path(folder, "bare"), pathlib.Path(folder, "bare_prefix")
    configured = run(CMAKE, "-S", pathlib.Path(__file__).resolve().parents[2], "-B", build, "-DYARS_TESTS=OFF",
                     "-G", "Ninja", folder=folder)
    installed = run(CMAKE, "--install", build, "--component", "Unspecified", "--prefix", prefix, folder=folder)
    expect("cmake --install before anything is built", configured.returncode == 0 and installed.returncode == 0,
           configured.stderr + installed.stderr)
    expect("its man pages", len(list((prefix / "share/man").rglob("*.gz"))) >= 8)


with tempfile.TemporaryDirectory(dir=BUILD) as folder:
    install_without_a_build(folder)
    first, moved, elsewhere = (pathlib.Path(folder, name) for name in ("first", "moved", "elsewhere"))
    elsewhere.mkdir()
    for component in ("Unspecified", "headers"):
        installed = run(CMAKE, "--install", BUILD, "--component", component, "--prefix", first, folder=folder)
        expect(f"cmake --install --component {component}", installed.returncode == 0, installed.stderr)
    (first / "bin").mkdir(exist_ok=True)
    for program in PROGRAMS:
        os.link(BUILD / "bin" / program, first / "bin" / program)
    shutil.move(first, moved)
    check(moved, elsewhere)
print("\n".join(faults) or "installed: as documented")
sys.exit(1 if faults else 0)
