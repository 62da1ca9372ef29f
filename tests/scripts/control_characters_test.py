#!/usr/bin/env python3
"""Nothing from outside drives the terminal: control characters of names, headers, texts and arguments come out
escaped.

usage: control_characters_test.py BIN
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BIN = pathlib.Path(sys.argv[1])
EVIL = "\x1b]0;owned\x07\x9b31m\x7f\u202e"  # title, colour by C1, delete, writing from right to left
RAW = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202e]")
faults = []


def dted_header(text):
    """A level 0 file whose label is damaged by a text."""
    return (b"UHL1" + text.encode("latin-1", "replace")).ljust(80) + bytes(3000)


def files(folder):
    evil = pathlib.Path(folder, EVIL)
    (evil / "w123").mkdir(parents=True)
    (evil / "N37W123.hgt").write_bytes(b"short")
    (evil / "w123/n36.dt0").write_bytes(dted_header("\x1b[2J" * 10))
    (evil / "scene.flt").write_bytes(b"\x00\x01\x00\x10" + "\x1b[2J".encode() * 10)
    (evil / "a.guf").write_text(f'( Apg70 ( {EVIL} ) )')
    (evil / "b.guf").write_text(f'( Apg70 :NAME "{EVIL}" :NONSENSE 1 )')
    (evil / "a.route").write_text(f"{EVIL} 1 2\n")
    return evil


def commands(evil):
    yars = str(BIN / "yars")
    yield [yars, "terrain", "info", str(evil)]
    yield [yars, "terrain", "info", str(evil / "absent")]
    yield [yars, "scan", "--terrain", str(evil), "--lat", "37.5", "--lon", "-122.5"]
    yield [yars, "scene", "info", str(evil / "scene.flt")]
    yield [yars, "scene", "info", "--json", str(evil / "scene.flt")]
    yield [yars, "config", "check", str(evil / "a.guf")]
    yield [yars, "config", "check", str(evil / "b.guf")]
    yield [yars, "config", "print", str(evil / "b.guf")]
    yield [yars, "config", "convert", str(evil / "a.guf")]
    yield [yars, "scan", "--out", str(evil / "x") + EVIL]
    yield [yars, "--session", EVIL, "status"]
    yield [yars, EVIL]
    yield [yars, "inject", EVIL]
    yield [str(BIN / "flight-model"), "--source", f"route:{evil}/a.route", "--session", "escapes"]
    yield [str(BIN / "flight-model"), "--source", EVIL, "--session", "escapes"]
    yield [str(BIN / "input-monitor"), "--source", f"script:{evil}/a.route", "--session", "escapes"]


def check(command, folder):
    done = subprocess.run(command, capture_output=True, timeout=120, stdin=subprocess.DEVNULL, cwd=folder)
    for name, raw in (("standard output", done.stdout), ("standard error", done.stderr)):
        text = raw.decode("utf-8", "surrogateescape")
        if found := RAW.search(text):
            faults.append(f"{command}: {name} holds {found[0]!r}: {text[-300:]!r}")
    return b"\\x1b" in done.stdout + done.stderr


def check_log(folder):
    """A log line of an error has the escaped text."""
    logs = pathlib.Path(folder, "logs")
    subprocess.run([str(BIN / "flight-model"), "--session", "escapes", "--log-dir", str(logs), "--source",
                    f"route:{folder}/{EVIL}/a.route"], capture_output=True, timeout=120, stdin=subprocess.DEVNULL)
    text = (logs / "flight-model.log").read_text(errors="surrogateescape")
    if RAW.search(text) or "\\x1b" not in text:
        faults.append(f"the log: expected an escaped text, found {text!r}")


def check_session_names(folder):
    """A name that leads elsewhere is bad usage for every program, and nothing is made for it."""
    top = pathlib.Path(__file__).resolve().parents[2]
    programs = ["yars scan", "yars status", "yars watch", "yars inject freeze", "radar-model", "state-machine",
                "radar-display", "input-monitor",
                "flight-model --source fixed:1,1,1,1,1"]
    starts = [[str(BIN / words.split()[0])] + words.split()[1:] for words in programs]
    starts += [[str(top / "scripts/start")]]
    for command in starts:
        for name in ("../../x", "a/b", "a\x1b[2J", "x" * 41):
            words = command[:1] + ["--session", name] + command[1:]
            done = subprocess.run(words, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL,
                                  cwd=folder)
            if done.returncode != 2 or "1 to 40 letters" not in done.stderr or RAW.search(done.stderr):
                faults.append(f"{words}: expected exit code 2 and the names that are possible, found {done}")


def check_scripts(evil):
    """Messages of the scripts. Each of these runs ends at its arguments."""
    top = pathlib.Path(__file__).resolve().parents[2]
    recording = evil / f"{EVIL}.yars"
    recording.write_text("")
    start = str(top / "scripts/start")
    words = [[start, "--record", str(recording)], [start, "--headless", EVIL], [start, "--bin", str(evil)],
             [start, EVIL],
             [start, "--frames", EVIL, "--bin", "none"],
             [start, "--bin", str(BIN), "--session", "escapes", "--terrain", str(evil), "--config", str(evil / "a.guf"),
              "--log-dir", f"{recording}/x"],
             [start, "--bin", str(BIN), "--session", "escapes", "--terrain", str(evil), "--source", EVIL, "--frames",
              str(evil / "frames"), "--log-dir", f"{recording}/x"]]
    words += [[str(top / "scripts" / script), EVIL] for script in ("test", "setup")]
    words += [[str(top / "scripts/lint"), "-" + EVIL], [str(top / "scripts/check_fresh"), "-" + EVIL],
              [str(top / "scripts/fuzz"), EVIL]]
    for command in words:
        done = subprocess.run(command, capture_output=True, timeout=120, stdin=subprocess.DEVNULL,
                              env={**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": ""})
        text = (done.stdout + done.stderr).decode("utf-8", "surrogateescape")
        if (found := RAW.search(text)) or done.returncode == 0:
            faults.append(f"{command}: expected a failure without control characters, found {found} in {text!r}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        evil = files(folder)
        escaped = [check(command, folder) for command in commands(evil)]
        # Else the texts do not come that far, and nothing is tested.
        if sum(escaped) < len(escaped) // 2:
            faults.append(f"expected most of {len(escaped)} commands to show what is escaped, found {sum(escaped)}")
        check_log(folder)
        check_session_names(folder)
        check_scripts(evil)
    print("\n".join(faults) or f"{len(escaped)} commands print no control characters")
    return 1 if faults else 0


if __name__ == "__main__":
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
    sys.exit(main())
