"""Completion for fish: a line for each option and command; a function finds the command before the cursor."""
from shapes import FILES, FOLDERS, MADE, SESSIONS, about, identifier, options_of, shape

PATH = '''# The command before the cursor, as in "terrain info".
function __{0}_path
    set -l path
    set -l left 0
    for word in (commandline -opc)[2..-1]
        if test $left -gt 0
            set left (math $left - 1)
            continue
        end
        switch $word
{1}            case '-*'
            case '*'
                set -l longer (string join ' ' $path $word)
                contains -- $longer {2}; and set -a path $word
        end
    end
    string join ' ' $path
end

function __{0}_at
    set -l path (__{0}_path)
    test "$path" = "$argv[1]"
end
'''
SESSIONS_FUNCTION = '''
function __yars_sessions
    string replace -f -r '^/dev/shm/yars\\.'(id -u)'\\.' '' /dev/shm/yars.*
end
'''
SOURCE_FUNCTION = '''
# Words; what follows route: and the like is a file.
function __yars_source
    set -l word (commandline -ct)
    if string match -q '*:*' -- $word
        set -l parts (string split -m 1 : -- $word)
        string replace -r '^' $parts[1]: (__fish_complete_path $parts[2])
    else
        printf '%s\\n' $argv
    end
end
'''


def quoted(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def value(what):
    """Flags of `complete` for a value."""
    if what == FILES:
        return " -r -F"
    if what == FOLDERS:
        return " -x -a '(__fish_complete_directories)'"
    if what == SESSIONS:
        return " -x -a '(__yars_sessions)'"
    if isinstance(what, list) and any(word.endswith(":") for word in what):
        return " -x -a " + quoted(f"(__yars_source {' '.join(what)})")
    return " -x -a " + quoted(" ".join(what)) if isinstance(what, list) else " -x"


def option(start, entry):
    names = "".join(f" -l {name[2:]}" if name.startswith("--") else f" -s {name[1:]}" for name in entry.names)
    return f"{start}{names}{value(shape(entry)) if entry.count else ''} -d {quoted(about(entry))}\n"


def path_function(program):
    """The function that finds the command before the cursor. An option has as many values in every command."""
    names_of = {}
    for command in program.walk():
        for entry in command.options:
            for name in entry.names if entry.count else []:
                names_of.setdefault(entry.count, set()).add(name)
    cases = "".join(f"            case {' '.join(sorted(names))}\n                set left {count}\n"
                    for count, names in sorted(names_of.items()))
    paths = " ".join(quoted(" ".join(command.words[1:])) for command in program.walk() if command is not program)
    return PATH.format(identifier(program.words), cases, paths)


def files_of(programs):
    for program in programs:
        name = program.words[0]
        text = f"# fish completion of {name}. {MADE}\n\n"
        if program.below:
            text += path_function(program)
        text += SESSIONS_FUNCTION + SOURCE_FUNCTION + f"\ncomplete -c {name} -f\n"
        for command in program.walk():
            path = " ".join(command.words[1:])
            start = f"complete -c {name}" + (f" -n \"__{identifier([name])}_at '{path}'\"" if program.below else "")
            for below in command.below:
                text += f"{start} -a {below.words[-1]} -d {quoted(below.about)}\n"
            if path == "help":
                text += f"{start} -a {quoted(' '.join(below.words[-1] for below in program.below))}\n"
            for entry in command.arguments if path != "help" else []:
                text += start + value(shape(entry)).replace(" -r", "").replace(" -x", "") + "\n"
            text += "".join(option(start, entry) for entry in options_of(program, command))
        yield f"fish/{name}.fish", text
