"""Words and files that may complete an argument of a command line, for all shells.

Inputs: commands and entries of help_text.py. Outputs: a list of words, or what the shell looks up.
"""
import re

FILES, FOLDERS, SESSIONS, NOTHING = "files", "folders", "sessions", "nothing"
MADE = "Made from --help when YARS was built."


def shape(entry):
    """Words for the value of an option or an argument. A word that ends in a colon is followed by a file name."""
    text = "\n".join(entry.lines)
    if entry.values:
        return entry.values
    if entry.kind == "EVENT":  # lines like "acq fwd | acq aft" between the first and the last
        return sorted(set(re.findall(r"(?<![\w.])[a-z]{2,}(?![\w.])",
                                     re.sub(r"\(.*?\)", "", "\n".join(entry.lines[1:])))))
    if entry.kind == "SOURCE":  # "route:FILE  a route", "window, terminal, script:FILE or auto"
        return sorted(set(re.findall(r"(?<!\S)[a-z]+:(?=[A-Z[])", text)) |
                      set(re.findall(r"\b(?:window|terminal|auto)\b", text)))
    return {"FILE": FILES, "DIR": FOLDERS, "SESSION": SESSIONS}.get(entry.kind, NOTHING)


def about(entry):
    """The first line of what an entry does, without the facts in parentheses."""
    line = entry.lines[0] if entry.lines else ""
    facts = f" ({'; '.join(entry.facts)})"
    return line.removesuffix(facts) if len(entry.lines) == 1 else line.rstrip(":")


def options_of(program, command):
    """Options of a command, and those of the program that may follow it."""
    if command is program:
        return program.options
    own = {name for entry in command.options for name in entry.names}
    return command.options + [entry for entry in program.options if not own & {*entry.names, "--version"}
                              and "--version" not in entry.names]


def identifier(words):
    return "_".join(re.sub(r"\W", "_", word) for word in words)
