#!/usr/bin/env python3
"""The user's file of defaults: which options follow it, what is stronger, and how a bad line is refused.

usage: user_file_test.py BIN
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from tour_start_test import install_start

BIN = pathlib.Path(sys.argv[1]).resolve()
SUPERVISOR = """
import os
def run_sets(sets):
    print(f"file:{os.environ['YARS_USER_CONFIG']}:", "--log-dir", sets[0].log_dir, sep="\\n")
    for role in sets[0].roles:
        print(*role.command, sep="\\n")
"""
faults = []


class Home:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.file = self.folder / "config/yars/yars.conf"
        self.file.parent.mkdir(parents=True)

    def run(self, *words, text=None, **environment):
        """Runs a program with this text as the user's file; the path of a script stands for itself."""
        if text is not None:
            self.file.write_text(text)
        program = words[0] if "/" in words[0] else str(BIN / words[0])
        base = {name: value for name, value in os.environ.items() if not name.startswith(("YARS_", "XDG_"))}
        base.update(HOME=str(self.folder), XDG_CONFIG_HOME=str(self.folder / "config"), ASAN_OPTIONS="detect_leaks=0")
        return subprocess.run([program, *words[1:]], capture_output=True, text=True, timeout=120,
                              stdin=subprocess.DEVNULL, env={**base, **environment}, cwd=self.folder)


def expect(what, good, found=""):
    if not good:
        faults.append(f"{what}: {found}")


def values_are_defaults(home):
    text = "session = mine\nconfig = ~/my.guf\nterrain = ~/cells\nlog-level = error\nlog-dir = ~/logs\nsize = 300\n"
    (home.folder / "my.guf").write_text("( Apg70 :NAME \"MINE\" )\n")
    helped = home.run("yars", "scan", "--help", text=text)
    expect("a default in --help", f"default {home.folder}/cells)" in helped.stdout, helped)
    expect("the configuration", '"MINE"' in home.run("yars", "config", "print").stdout)
    absent = home.run("yars", "watch")
    expect("the session", absent.returncode == 1 and "mine" in absent.stderr, absent)
    stronger = home.run("yars", "watch", YARS_SESSION="environment")
    expect("YARS_SESSION is stronger", "environment" in stronger.stderr, stronger)
    stronger = home.run("yars", "--session", "given", "watch", YARS_SESSION="environment")
    expect("an option is stronger", "given" in stronger.stderr, stronger)
    terrain = home.run("yars", "terrain", "info")
    expect("terrain that is required", terrain.returncode == 1 and f"{home.folder}/cells" in terrain.stderr, terrain)
    ignored = home.run("yars", "terrain", "info", YARS_USER_CONFIG="")
    expect("an empty YARS_USER_CONFIG ignores it", ignored.returncode == 2 and "found none" in ignored.stderr, ignored)
    shown = json.loads(home.run("yars", "config", "user", "--json").stdout)
    expect("config user", shown["exists"] and shown["file"] == str(home.file) and shown["values"]["size"] == "300",
           shown)
    for program, option in (("radar-display", "default 300"), ("radar-model", f"default {home.folder}/cells"),
                            ("state-machine", f"default {home.folder}/logs"), ("flight-model", "default error")):
        helped = home.run(program, "--help")
        expect(f"{program} follows it", option in helped.stdout, helped.stdout)
    # A recording is played over its own terrain, and --size of other commands is another size.
    for words in (["replay"], ["patch"]):
        helped = home.run("yars", *words, "--help").stdout
        expect(f"{words} has its own",
               (f"{home.folder}/cells" in helped) == (words == ["patch"]) and "default 300" not in helped, helped)


def bad_lines_are_refused(home):
    for text, message in (("sesion = a\n",
                           ":1: expected one of session, config, terrain, log-dir, log-level, size, found "
                                           "'sesion'; did you mean 'session'?"),
                          ("\nsize = big\n", ":2: --size: expected a whole number from 120 to 4096, found 'big'"),
                          ("log-level = loud\n",
                           ":1: --log-level: expected trace, debug, info, warning, error or off")):
        program = "radar-display" if "size" in text else "yars"
        words = [program] + (["config", "print"] if program == "yars" else [])
        done = home.run(*words, text=text)
        expect(f"{text!r}",
               done.returncode == 1 and done.stderr.count("\n") == 1 and f"{home.file}{message}" in done.stderr, done)
        expect(f"help with {text!r}", home.run(program, "--help").returncode == 0)
    done = home.run("yars", "watch", text="session = a/b\n")
    expect("a name that is no session", done.returncode == 2 and "1 to 40 letters" in done.stderr, done)
    named = home.run("yars", "config", "print", YARS_USER_CONFIG="/nowhere.conf")
    expect("a file that is named and absent", named.returncode == 1 and "/nowhere.conf" in named.stderr, named)


def start_follows_it(home):
    """The start script ends where it looks for the terrain's coast: a stand-in prints what the set would get."""
    bin_folder = home.folder / "bin"
    install_start(home.folder, SUPERVISOR)
    (bin_folder / "yars").symlink_to(BIN / "yars")
    text = "session = mine\nterrain = ~/cells\nlog-level = debug\nlog-dir = ~/logs\nsize = 300\nconfig = apg68.guf\n"
    (home.folder / "apg68.guf").write_text("( Apg70 :name \"MINE\" )\n")  # yars-start checks it
    words = [str(bin_folder / "yars-start"), "--headless", "1"]
    done = home.run(*words, text=text)
    for part in ("--session\nmine\n", f"--terrain\n{home.folder}/cells\n", "--log-level\ndebug\n",
                 f"--log-dir\n{home.folder}/logs\n", "--size\n300\n", "--config\napg68.guf\n", "file::\n"):
        expect(f"yars-start: {part!r}", part in done.stdout, done)
    done = home.run(*words, "--session", "given", "--log-dir", "", "--size", "400")
    for part in ("--session\ngiven\n", "--log-dir\n\n", "--size\n400\n"):
        expect(f"yars-start with options: {part!r}", part in done.stdout, done)
    done = home.run(*words, text="sesion = a\n")
    expect("yars-start with a bad line", done.returncode == 1 and "did you mean 'session'?" in done.stderr, done)


def main():
    with tempfile.TemporaryDirectory() as folder:
        home = Home(folder)
        values_are_defaults(home)
        bad_lines_are_refused(home)
        start_follows_it(home)
    print("\n".join(faults) or "the user's file: as documented")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
