#!/usr/bin/env python3
"""Rules of all command lines: defaults in --help, words that are misspelled, values that are wrong,
help of each command.

usage: commands_test.py BIN
Walks the programs, their commands and options by --help (packaging/help/help_text.py). Each wrong command line ends
with exit code 2 and one line in the form "PROGRAM COMMAND: OPTION: expected ..., found ...; see PROGRAM COMMAND
--help". YARS_TEST_FULL: each option is misspelled, without a value, and before --help; without, every eighth.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOP / "packaging/help"))
import help_text  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
# Texts of CLI11 and of argparse, which are not in the form of the house.
FOREIGN = re.compile(r"is required|not convert|not in range|were not expected|was not expected|requires|excludes"
                     r"|At Most|Excludes|REQUIRED|At Least|not in \{|missing$|A subcommand|override"
                     r"|should not see|error:|usage:")
# Commands that print facts; docs/commands.md#json has their fields.
WITH_JSON = ["scan", "patch", "trade", "trade maps", "terrain generate", "terrain info", "terrain profile",
             "terrain reduce", "terrain convert", "terrain pack", "terrain cover", "scene generate", "scene info",
             "config check", "config user", "sim state", "sim freeze", "sim run", "sim rate", "sim step", "sim reset",
             "sim reposition", "world", "inject", "status", "watch", "record", "recordings",
             "replay"]  # and all of `yars world`
ALL = "YARS_TEST_FULL" in os.environ
SESSION = f"commands-{os.getpid()}"
faults = []


def run(words):
    start = [str(BIN / words[0])] if words[0] != "yars-start" else [str(TOP / "scripts/start")]
    environment = {**help_text.environment(), "YARS_SESSION": SESSION, "YARS_BIN_DIR": str(BIN)}
    return subprocess.run(start + words[1:], capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL,
                          env=environment)


def refusal(words, *parts, command=None):
    """The fault of a command line that has to be refused with these parts in its message; None: there is none."""
    done = run(words)
    path = " ".join(command or words[:1])
    path = path.replace("yars-start", "scripts/start")
    lines = done.stderr.splitlines()
    if done.returncode != 2 or len(lines) != 1 or done.stdout:
        return f"{words}: expected exit code 2 and one line, found {done.returncode}, {done.stdout!r}, {done.stderr!r}"
    if not lines[0].startswith(f"{path}: ") or not re.search(rf"(see|See) {re.escape(path)} --help$", lines[0]):
        return f"{words}: expected '{path}: ...; see {path} --help', found {lines[0]}"
    absent = [part for part in ("expected ", "found ", *parts) if part not in lines[0]]
    if absent or FOREIGN.search(lines[0]) or "\x1b" in done.stderr:
        return f"{words}: expected {absent}, found {lines[0]}"
    return None


def misspelled(word):
    """Two characters in its middle are in the wrong order."""
    for at in range(len(word) // 2, len(word) - 1):
        if word[at] != word[at + 1] and "-" not in word[at:at + 2]:
            return word[:at] + word[at + 1] + word[at] + word[at + 2:]
    return word[:-1]


def limits(entry):
    for fact in entry.facts:
        if found := re.fullmatch(r"(-?[\d.e+]+) to (-?[\d.e+]+)", fact):
            return [float(number) for number in found.groups()]
    return None


def cases_of_values(command, entry, number):
    """Wrong values of an option or an argument: (words, parts of the message). `number`: of those of the command."""
    name = entry.names[-1]
    is_option = name.startswith("-")

    def with_value(value):
        if is_option:
            return [*command.words, name, *[value] * entry.count]
        before = command.arguments.index(entry)
        return [*command.words, *["1"] * before, value]
    start = command.words[0] == "yars-start"
    some = ALL or number % 8 == 0
    if is_option and some:
        yield [*command.words, name], [f"{name}: expected ", "found nothing" if entry.count == 1 else "found 0"]
    if entry.is_number:
        if ALL or number == 0:
            yield with_value("forty"), [f"{name}: expected a ", "number", "forty"]
        yield with_value("2x"), [f"{name}: expected a ", "number", "2x"]
    if found := limits(entry):
        for value in (found[0] - 1, found[1] + 1):
            text = str(int(value)) if value == int(value) else str(value)
            yield with_value(text), [f"{name}: expected a ", "number from ", text]
    if entry.values:
        yield with_value("nonsense"), [f"{name}: expected ", *entry.values, "'nonsense'"]
        if len(entry.values[0]) >= 4:
            yield with_value(misspelled(entry.values[0])), [f"did you mean '{entry.values[0]}'?"]
    if is_option and some and not entry.is_number and not entry.values and entry.count == 1 and not start:
        yield [*command.words, name, "--help"], [f"{name}: expected ", "found the option '--help'"]


def cases_of(program, command):
    inherited = [entry for entry in program.options if command is not program and "--session" in entry.names]
    for number, entry in enumerate(command.options + inherited):
        name = entry.names[-1]
        if entry.count:
            yield from cases_of_values(command, entry, number)
        elif "--help" not in entry.names and "--version" not in entry.names and command.words[0] != "yars-start":
            yield [*command.words, f"{name}=maybe"], [f"{name}: expected no value", "'maybe'"]
        if name.startswith("--") and (ALL or number % 8 == 0):
            yield [*command.words, misspelled(name)], ["expected an option", misspelled(name), "did you mean '--"]
    for entry in command.arguments:
        if command.words[-1] != "help":
            yield from cases_of_values(command, entry, 0)
    yield [*command.words, "--xyzzyx"], ["expected an option", "--xyzzyx"]
    if command.words[0] == "yars-start":
        return
    if any(entry.is_required for entry in command.arguments + command.options):
        required = next(entry for entry in command.arguments + command.options if entry.is_required)
        yield command.words, [required.names[-1].lstrip("-"), "found none"]
    if command.below:
        for below in command.below:
            if len(below.words[-1]) >= 4:
                yield ([*command.words, misspelled(below.words[-1])],
                       ["expected a command", f"did you mean '{below.words[-1]}'?"])
        yield [*command.words, "xyzzyx"], ["expected a command: ", command.below[-1].words[-1], "'xyzzyx'"]
    elif not any(entry.repeats for entry in command.arguments):
        words = ["1"] * len(command.arguments)
        yield [*command.words, *words, "xyzzyx"], ["expected no further argument", "'xyzzyx'"]


def check_defaults(command):
    """Each value has a default, or what holds without it, or is required."""
    for entry in command.options + command.arguments:
        if entry.count and not any(re.match("default |else |required", fact) for fact in entry.facts):
            faults.append(f"{' '.join(command.words)} {entry.names[-1]}: expected a default in --help, "
                          f"found {entry.lines}")
        if not entry.lines:
            faults.append(f"{' '.join(command.words)} {entry.names[-1]}: expected what it is, found nothing")
        if entry.is_required and any(fact.startswith("default") for fact in entry.facts):
            faults.append(f"{' '.join(command.words)} {entry.names[-1]}: expected no default where a value is required")


def check_help(command):
    """`yars help X Y` prints what `yars X Y --help` prints."""
    one, other = run([*command.words, "--help"]), run(["yars", "help", *command.words[1:]])
    if one.returncode != 0 or other.returncode != 0 or one.stdout != other.stdout or "\x1b" in one.stdout:
        faults.append(f"help {command.words[1:]}: expected the text of --help, found {other}")


def check_help_without_words():
    """`yars` alone prints its help. Other programs do what they do by default."""
    alone, asked = run(["yars"]), run(["yars", "--help"])
    if alone.returncode != 0 or alone.stdout != asked.stdout or alone.stderr:
        faults.append(f"yars: expected the text of --help and exit code 0, found {alone}")


def check_fidelities(programs):
    """The presets of the start script are those of the programs."""
    found = {" ".join(command.words): entry.values for program in programs for command in program.walk()
             for entry in command.options if "--fidelity" in entry.names}
    if (len({tuple(values) for values in found.values()}) != 1 or
            not {"yars-start", "radar-model", "yars scan"} <= set(found)):
        faults.append(f"--fidelity: expected the same presets everywhere, found {found}")


def check_json(yars):
    found = [" ".join(command.words[1:]) for command in yars.walk()
             if any("--json" in entry.names for entry in command.options) and command.words[1:2] != ["world"]
             or command.words[1:] == ["world"]]
    actions = [command for command in yars.walk() if command.words[1:2] == ["world"] and
               (len(command.words) == 4 or command.words[2:] in (["sea"], ["wind"], ["reset"]))]
    faults.extend(f"{' '.join(command.words)}: expected --json, found none" for command in actions
                  if not any("--json" in entry.names for entry in command.options))
    if found != WITH_JSON:
        faults.append(f"--json: expected {WITH_JSON}, found {found}")


def check_wrong_help():
    for words, parts, command in (
            (["yars", "help", "stauts"], ["did you mean 'status'?"], None),
            (["yars", "stauts", "--help"], ["did you mean 'status'?"], None),
            (["yars", "help", "terrain", "inof"], ["did you mean 'info'?"], ["yars", "terrain"]),
            (["yars", "help", "scan", "more"], ["no further argument"], ["yars", "scan"]),
            (["yars", "scan", "--lat", "1", "--lat", "2"], ["--lat: expected the option once", "2 times"],
             ["yars", "scan"]),
            (["yars", "scan", "--rang-nm=40"], ["did you mean '--range-nm'?"], ["yars", "scan"]),
            (["yars", "--log-level", "off"], ["expected a command: ", "found none"], ["yars"]),
            (["yars", "scene", "image", "a", "--out", "a.png", "--window", "1", "2"], ["3 values", "found 2"],
             ["yars", "scene", "image"]),
            (["yars", "replay", "a", "--rate", "1", "--events"], ["expected no --", "found both"], ["yars", "replay"]),
            (["radar-display", "--keep", "3"], ["--keep: expected --headless with it"], None)):
        if fault := refusal(words, *parts, command=command):
            faults.append(fault)


def check_events():
    """Words of `yars inject`; these fail before a session is looked for."""
    for words, part in ((["freze"], "did you mean 'freeze'?"), (["power oper"], "did you mean 'power opr'?"),
                        (["powr opr"], "did you mean 'power opr'?"), (["xyzzyx"], "which begins with one of pb, tdc"),
                        (["pb 21"], "pb 1..20"),
                        (["pb13"], "did you mean 'pb 13'? See"), (["pb 21"], "did you mean 'pb 20'?"),
                        (["power", "on"], "did you mean 'power opr'?"),
                        (["rage", "inc"], "the range is on buttons of the display: 'pb 13'"),
                        (["pb", "thirteen"],
                         "yars inject: expected pb 1..20, found \"pb thirteen\"; see yars inject --help")):
        done = run(["yars", "inject", *words])
        if done.returncode != 2 or part not in done.stderr or len(done.stderr.splitlines()) != 1:
            faults.append(f"inject {words}: expected {part}, found {done}")


def main():
    programs = help_text.read_all(BIN)
    commands = [(program, command) for program in programs for command in program.walk()]
    cases = [(words, parts, command.words) for program, command in commands
             for words, parts in cases_of(program, command)]
    if len(cases) < 700:
        faults.append(f"expected at least 700 wrong command lines, found {len(cases)}: "
                      "are the help texts read rightly?")
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        faults.extend(filter(None, pool.map(lambda case: refusal(case[0], *case[1], command=case[2]), cases)))
    for program, command in commands:
        check_defaults(command)
        if program.words[0] == "yars":
            check_help(command)
    check_help_without_words()
    check_fidelities(programs)
    check_json(programs[0])
    check_wrong_help()
    check_events()
    print("\n".join(faults) or f"{len(commands)} commands, {len(cases)} wrong command lines: as the rules want")
    return 1 if faults else 0


if __name__ == "__main__":
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
    sys.exit(main())
