"""Completion for zsh: a function for each command, with the specifications of _arguments."""
import re

from shapes import FILES, FOLDERS, MADE, NOTHING, SESSIONS, about, identifier, options_of, shape

LOOK_UP = {FILES: "_files", FOLDERS: "_files -/", SESSIONS: "_yars_sessions", NOTHING: " "}
SESSIONS_FUNCTION = '''_yars_sessions() {
  local -a names=(/dev/shm/yars.$UID.*(N:t))
  compadd -- ${names#yars.$UID.}
}

# What follows route: and the like is a file.
_yars_source() {
  if compset -P '*:'; then _files; else compadd -S '' -- ${@:#^*:}; compadd -- ${@:#*:}; fi
}
'''


def plain(text):
    """The text, escaped for single quotes, brackets and colons of a specification."""
    return re.sub(r"([][:\\])", r"\\\1", text).replace("'", "'\\''")


def action(what):
    if not isinstance(what, list):
        return LOOK_UP[what]
    if any(word.endswith(":") for word in what):
        return "_yars_source " + " ".join(word.replace(":", "\\:") for word in what)
    return "(" + " ".join(what) + ")"


def option(entry):
    value = f":{plain('value' if entry.values else entry.kind.lower())}:{action(shape(entry))}" * entry.count
    for name in entry.names:
        sign = "=" if entry.count and name.startswith("--") else ""
        yield f"'{'*' if entry.repeats else ''}{name}{sign}[{plain(about(entry))}]{value}'"


def argument(number, entry):
    return f"'{'*' if entry.repeats else number}:{plain(entry.names[0].lower())}:{action(shape(entry))}'"


def function_name(command):
    return "_yars_" + identifier(command.words)


def function_of(program, command):
    specifications = [line for entry in options_of(program, command) for line in option(entry)]
    is_help = command.words[1:] == ["help"]
    if command.below:
        specifications += ["'1: :->command'", "'*:: :->rest'"]
    elif is_help:
        specifications += [f"'1:command:({' '.join(below.words[-1] for below in program.below)})'"]
    else:
        specifications += [argument(*numbered) for numbered in enumerate(command.arguments, 1)]
    text = f"{function_name(command)}() {{\n"
    if command.below:
        text += "  local context state state_descr line\n  typeset -A opt_args\n"
    text += f"  _arguments -S{' -C' if command.below else ''} \\\n    " + " \\\n    ".join(specifications) + "\n"
    if command.below:
        text += "  case $state in\n    command)\n      local -a commands=(\n"
        text += "".join(f"        '{below.words[-1]}:{plain(below.about)}'\n" for below in command.below)
        text += "      )\n      _describe -t commands command commands ;;\n    rest)\n      case $line[1] in\n"
        text += "".join(f"        {below.words[-1]}) {function_name(below)} ;;\n" for below in command.below)
        text += "      esac ;;\n  esac\n"
    return text + "}\n"


def files_of(programs):
    text = f"#compdef {' '.join(program.words[0] for program in programs)}\n# zsh completion of YARS. {MADE}\n\n"
    text += SESSIONS_FUNCTION
    for program in programs:
        text += "".join("\n" + function_of(program, command) for command in program.walk())
    text += "\ncase $service in\n"
    text += "".join(f"  {program.words[0]}) {function_name(program)} ;;\n" for program in programs)
    yield "zsh/_yars", text + "esac\n"
