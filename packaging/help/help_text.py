"""The command lines of the programs, read out of what they say with --help.

packaging/help/write.py and tests use it. The form of the text is that of runtime/option_text.hpp:
an entry's head, at least two blanks, and what it does; more lines of it stand under the first.

    yars = read(["build/release/bin/yars"])
    yars.below[0].words            # ["yars", "scan"]
    yars.below[0].options[0].names  # ["-h", "--help"]
"""
import dataclasses
import os
import pathlib
import re
import subprocess

PROGRAMS = ["yars", "radar-model", "state-machine", "radar-display", "input-monitor", "flight-model", "yars-station"]
START = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "start"  # yars-start before it is installed
INDENT = "  "


@dataclasses.dataclass
class Entry:
    """An option or an argument. `kind`: NUMBER, INTEGER, TEXT, FILE, DIR or another word; empty for a flag."""
    names: list      # ["-h", "--help"], or the one name of an argument
    kind: str
    count: int       # values at a time; 0 for a flag
    repeats: bool    # may be given several times
    lines: list      # what it does

    @property
    def values(self):
        """The allowed words, if the kind is a list such as {green,gray}."""
        return self.kind.strip("{}").split(",") if self.kind.startswith("{") else []

    @property
    def facts(self):
        """Facts in the parentheses at the end of the text: ["0.1 to 1000", "default 40"]."""
        found = re.search(r"\(([^()]*(?:\([^()]*\)[^()]*)*)\)$", self.lines[-1]) if self.lines else None
        return found[1].split("; ") if found else []

    @property
    def is_number(self):
        return self.kind in ("NUMBER", "INTEGER")

    @property
    def is_required(self):
        return any(fact.startswith("required") for fact in self.facts)


@dataclasses.dataclass
class Command:
    words: list      # ["yars", "terrain", "info"]
    about: str
    arguments: list  # of Entry
    options: list
    below: list      # of Command

    def walk(self):
        yield self
        for command in self.below:
            yield from command.walk()


def environment():
    """The environment without variables that change the defaults in --help."""
    return {**{name: value for name, value in os.environ.items() if name != "YARS_SESSION"}, "YARS_USER_CONFIG": ""}


def help_of(command):
    return subprocess.run([*command, "--help"], capture_output=True, text=True, check=True, timeout=60,
                          env=environment()).stdout


def entries_of(text, section):
    """[(head, [line, ...])] of one section of a help text."""
    found = re.search(rf"^{section}:\n((?: +.*\n)*)", text, re.M)
    entries = []
    for line in found[1].splitlines() if found else []:
        if line.startswith(INDENT + "  "):
            entries[-1][1].append(line.strip())
            continue
        head, _, does = line.removeprefix(INDENT).partition("  ")
        entries.append((head, [does.strip()] if does else []))
    return entries


def entry_of(head, lines):
    words = head.split(" ")
    is_argument = not words[0].startswith("-")
    repeats = words[-1] == "..."
    words = words[:-1] if repeats else words
    count = 1
    if len(words) > 2 and words[-2] == "x":
        count = int(words[-1])
        words = words[:-2]
    kind = words[1] if len(words) > 1 else words[0] if is_argument else ""
    names = [words[0]] if is_argument else words[0].split(",")
    if kind.startswith("["):  # a word that may be missing
        count = 0
    return Entry(names, kind, count if kind else 0, repeats, lines)


def read(program, words=None):
    """The command line of a program. `words`: the names of the command, else the program's name."""
    text = help_of(program)
    words = words or [pathlib.Path(program[0]).name]
    below = [read([*program, head], [*words, head]) for head, _ in entries_of(text, "Subcommands")]
    return Command(words, text.splitlines()[0], [entry_of(*entry) for entry in entries_of(text, "Positionals")],
                   [entry_of(*entry) for entry in entries_of(text, "Options")], below)


def read_all(folder):
    """The command lines of all programs in a folder, and of scripts/start as yars-start."""
    programs = [read([str(pathlib.Path(folder).resolve() / name)]) for name in PROGRAMS]
    return [*programs, read([str(START)], ["yars-start"])]
