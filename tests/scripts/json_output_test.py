#!/usr/bin/env python3
"""--json prints one JSON object with the fields of docs/commands.md#json; progress and escapes are for terminals.

usage: json_output_test.py BIN
"""
import json
import os
import re
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time

BIN = pathlib.Path(sys.argv[1]).resolve()
SOURCE = "docs/commands.md#json"
DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / SOURCE.partition("#")[0]
SESSION = f"json-{os.getpid()}"
faults = []


def expect(what, good, found=""):
    if not good:
        faults.append(f"{what}: {found}")


def run(*words, code=0):
    done = subprocess.run([str(BIN / "yars"), "--session", SESSION, *words], capture_output=True, text=True,
                          timeout=300, stdin=subprocess.DEVNULL)
    expect(words, done.returncode == code, done)
    return done


def object_of(*words, code=0):
    """The object that a command prints, whose fields the document has."""
    done = run(*words, code=code)
    try:
        found = json.loads(done.stdout)
    except json.JSONDecodeError:
        expect(words, False, f"expected one JSON object, found {done}")
        return {}
    if not isinstance(found, dict):
        expect(words, False, f"expected one JSON object, found {done.stdout[:200]}")
        return {}
    text = DOCUMENT.read_text()
    for field in found:
        expect(words, f"`{field}`" in text, f"expected {field} in {SOURCE}")
    expect(words, code != 0 or not done.stderr, f"expected nothing on standard error, found {done.stderr}")
    return found


def offline():
    made = object_of("terrain", "generate", "--out", "cells", "--south", "36", "--west", "-124", "--cells-lat", "1",
                     "--cells-lon", "1", "--level", "0", "--json")
    expect("terrain generate", made.get("files") == 1, made)
    by_option, by_argument = (object_of("terrain", "info", *words, "--json")
                              for words in (["--terrain", "cells"], ["cells"]))
    expect("terrain info", by_option == by_argument and by_option.get("total", {}).get("cells") == 1, by_option)
    expect("terrain info", by_option["cells"][0]["file"].startswith("cells/"), by_option)
    packed = object_of("terrain", "pack", "--in", "cells", "--out", "packed", "--json")
    expect("terrain pack", packed.get("files") == ["packed/w124/n36.jp2"], packed)
    for words in (["reduce", "--reduction", "2"], ["convert", "--to", "hgt", "--level", "1"]):
        converted = object_of("terrain", words[0], "--in", "cells", "--out", words[0], *words[1:], "--json")
        expect(words, converted.get("cells") == 1 and not converted["problems"], converted)
    scene = object_of("scene", "generate", "--kind", "bridge", "--triangles", "200", "--origin", "36.5,-123.5", "--out",
                      "a.flt", "--json")
    expect("scene generate", scene.get("kind") == "bridge" and scene["bytes"] == os.path.getsize("a.flt"), scene)
    forms = [object_of("scene", "info", *words, "--json")
             for words in (["a.flt"], ["--scene", "a.flt"], ["--scene", "a.flt@36.5,-123.5,10"])]
    expect("scene info", forms[0] == forms[1] == forms[2] and len(forms[0].get("files", [])) == 1, forms)
    pathlib.Path("plain.guf").write_text("( Apg70 )\n")
    expect("config check", object_of("config", "check", "plain.guf", "--json") == {
        "file": "plain.guf", "valid": True, "warnings": [], "notes": []})
    object_of("config", "user", "--json")
    place = ["--terrain", "cells", "--lat", "36.5", "--lon", "-123.5"]
    scan = object_of("scan", *place, "--samples", "32", "--json")
    expect("scan", scan.get("samples") == 32, scan)
    patch = ["patch", *place, "--target-lat", "36.6", "--target-lon", "-123.3", "--heading", "30", "--size", "32",
             "--force"]
    expect("patch", object_of(*patch, "--json").get("cpu_ms", 0) > 0)
    before = sorted(os.listdir("."))
    nothing = object_of("scan", *place, "--samples", "32", "--out", "none", "--shadow", "none", "--json")
    expect("scan --out none", nothing["hash"] == scan["hash"] and nothing["cpu_ms"] > 0, nothing)
    object_of(*patch, "--out", "none", "--json")
    expect("--out none", sorted(os.listdir(".")) == before, os.listdir("."))
    for words, begin, facts in ((["scan", *place, "--samples", "32"], "scan    ", scan),
                                (patch, "map     ", object_of(*patch, "--json"))):
        shown = run(*words).stdout
        expect(words[:1], shown.startswith(begin) and f"hash    {facts['hash']}\n" in shown and " % " in shown, shown)
    object_of("trade", *place[:2], "--presets", "draft", "--repeat", "1", "--ruler-samples", "16", "--json")


def refusals():
    """Errors are text on standard error; exit codes are those without --json."""
    damaged = pathlib.Path("damaged/w124")
    damaged.mkdir(parents=True)
    (damaged / "n36.dt0").write_bytes(b"short")
    found = object_of("terrain", "info", "damaged", "--json", code=1)
    expect("a damaged cell", found.get("problems") and found["total"]["cells"] == 0, found)
    for words in (["status", "--json"], ["watch", "--json"], ["sim", "state", "--json"], ["inject", "freeze", "--json"],
                  ["world", "--json"], ["world", "sea", "3", "--json"]):
        done = run(*words, code=1)
        expect(words, not done.stdout and done.stderr.count("\n") == 1, done)


def progress():
    """A line for each cell on a terminal; none in a pipe."""
    command = [str(BIN / "yars"), "terrain", "convert", "--in", "cells", "--out", "shown"]
    piped = subprocess.run(command, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL)
    expect("a pipe", "1/1" not in piped.stdout + piped.stderr and "\x1b" not in piped.stdout + piped.stderr, piped)
    shown = subprocess.run(["script", "-qec", shlex.join(command), "/dev/null"], capture_output=True, text=True,
                           timeout=120, stdin=subprocess.DEVNULL)
    expect("a terminal", "1/1  shown/w124/n36.dt0" in shown.stdout, shown)
    info = shlex.join([str(BIN / "yars"), "terrain", "info", "cells", "--json"])
    for terminal, escapes in (("xterm", True), ("dumb", False)):
        shown = subprocess.run(["script", "-qec", f"{info} >/dev/null", "/dev/null"], capture_output=True, text=True,
                               timeout=120, stdin=subprocess.DEVNULL, env={**os.environ, "TERM": terminal})
        expect(f"TERM={terminal}", ("\x1b" in shown.stdout) == escapes, shown)


def world():
    """Changes of the world, beside the state machine of session()."""
    model = subprocess.Popen([str(BIN / "radar-model"), "--session", SESSION], stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and subprocess.run(
                [str(BIN / "yars"), "--session", SESSION, "world"], capture_output=True, check=False).returncode:
            time.sleep(0.05)
        configured = object_of("world", "--json")
        expect("world", configured["configured"] and configured["sea_state"] is None, configured)
        lists = re.findall(r"^\| `(\w+)` \| `yars world (\w+)` \|", DOCUMENT.read_text(), re.M)
        for kind, command in lists:
            changed = object_of("world", command, "add", "37", "-122", "--json")
            expect("world", all(f"`{field}`" in DOCUMENT.read_text() for field in changed[kind][-1]), changed)
            entry = str(changed[kind][-1]["id"])
            changed = object_of("world", command, "change", entry, "--json")
            expect("world", str(changed[kind][-1]["id"]) == entry, changed)
        expect("world", {kind for kind, of_kind in changed.items() if isinstance(of_kind, list)} ==
               {kind for kind, _ in lists}, changed)
        mover = str(changed["movers"][0]["id"])
        for words in (["sea", "3"], ["wind", "20", "90"], ["mover", "steer", mover, "5", "90"]):
            changed = object_of("world", *words, "--json")
        expect("world", (changed["edit"], changed["sea_state"], changed["wind_kt"], changed["movers"][0]["speed_kt"])
               == (2 * len(lists) + 3, 3, 20, 5), changed)
        expect("world reset", object_of("world", "reset", "--json")["rain"] == [])
    finally:
        model.terminate()
        model.communicate(timeout=60)


def session():
    """Commands of a session, with the state machine alone."""
    pathlib.Path("route.guf").write_text('( Apg70 )\n'
                                         '( Route :points `( ( Point "1" 37 -122 0 ) ( Point "3.01" 38 -122 0 ) ) )\n')
    machine = subprocess.Popen([str(BIN / "state-machine"), "--session", SESSION, "--config", "route.guf"],
                               stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and subprocess.run(
                [str(BIN / "yars"), "--session", SESSION, "sim", "state"], capture_output=True, check=False).returncode:
            time.sleep(0.05)
        frozen = object_of("sim", "freeze", "--json")
        expect("sim freeze", frozen.get("running") is False and frozen["epoch"] == 0, frozen)
        expect("sim step", object_of("sim", "step", "3", "--json")["sim_time"] > frozen["sim_time"])
        expect("sim rate", object_of("sim", "rate", "2", "--json")["rate"] == 2)
        expect("sim reset", object_of("sim", "reset", "--json")["epoch"] == 1)
        expect("sim reposition", object_of("sim", "reposition", "36", "-122", "10000", "0", "--json")["epoch"] == 2)
        expect("sim run", object_of("sim", "run", "--json")["running"] is True)
        expect("sim state", object_of("sim", "state", "--json")["rate"] == 2)
        run("world", "sea", "3", "--json", code=1)  # no radar-model
        world()
        done = object_of("inject", "power opr", "nav mn", "--json")
        expect("inject", done["done"] == 1 and done["without_effect"] == 1, done)
        expect("inject", [event["effect"] for event in done["events"]] == ["done", "without effect"], done)
        refused = object_of("inject", "sp 99", "--json", code=1)
        expect("inject", refused["refused"] == 1 and refused["events"][0]["reason"] == "NO POINT 99", refused)
        expect("an unknown point", "points on the display: 1\n" in run("inject", "sp 99", code=1).stderr)
        run("inject", "sp 3.01")
        misspelled = run("inject", "sp 3.02", code=1)
        expect("a point that is near", "NO POINT 3.02; did you mean 'sp 3.01'?\n" in misspelled.stderr, misspelled)
        object_of("watch", "--once", "--json")
        status = json.loads(run("status", "--json", code=3).stdout)
        expect("status", status["health"]["state"] == "DEGRADED", status["health"])
    finally:
        machine.terminate()
        machine.communicate(timeout=60)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        offline()
        refusals()
        progress()
        session()
        os.chdir("/")
    print("\n".join(faults) or "JSON objects as documented")
    return 1 if faults else 0


if __name__ == "__main__":
    os.environ.update(ASAN_OPTIONS="detect_leaks=0", YARS_USER_CONFIG="")
    sys.exit(main())
