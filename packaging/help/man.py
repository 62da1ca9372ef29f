"""Options in man pages, out of what the programs say with --help.

A page packaging/man/PROGRAM.1 has the line `MARK` where the options of the program, and of its subcommands with all
below them, belong. The rest of the page is written by hand.
"""
import re

MARK = '.\\" options\n'
UNKNOWN = ".Sh OPTIONS\n.Nm Fl Fl help\nprints the options.\n"  # of a program that cannot run here


def plain(text):
    """The text, escaped so that man reads no macro or escape in it."""
    text = text.replace("\\", "\\e").replace("--", "\\-\\-")
    return re.sub(r"^(?=[.'])", r"\\&", text)


def mark(name):
    if name.startswith("--"):
        return "Fl " + name[1:].replace("-", "Fl ", 1)
    return "Fl " + name[1:] if name.startswith("-") else "Ar " + name


def entry_text(entry):
    """An option or argument as a list item: names, value, then what it does."""
    item = ".It " + " , ".join(mark(name) for name in entry.names)
    value = "|".join(entry.values) or entry.kind.lower()
    # The name of an argument says what it is.
    if value and entry.names[0].startswith("-"):
        item += f" Ar {value}"
    item += " ..." if entry.repeats else ""
    return item + "\n" + "\n.br\n".join(plain(line) for line in entry.lines) + "\n"


def list_of(entries):
    return ".Bl -tag -width Ds\n" + "".join(map(entry_text, entries)) + ".El\n" if entries else ""


def subcommand_text(command):
    """A subsection for a subcommand, then those of the subcommands below it."""
    options = [entry for entry in command.options if "--help" not in entry.names]
    name = " ".join(command.words[1:])
    result = f".Ss yars {name}\n.Nm Cm {name}\n" + (".Op Ar options\n" if options else "")
    result += "".join(f".Ar {entry.names[0]}\n" for entry in command.arguments) + ".Pp\n" + plain(command.about) + "\n"
    return result + list_of(command.arguments + options) + "".join(map(subcommand_text, command.below))


def generated(program):
    """Sections of options and subcommands."""
    heading = ".Sh SUBCOMMANDS\n" if program.below else ""
    return (".Sh OPTIONS\n" + list_of(program.arguments + program.options) + heading
            + "".join(map(subcommand_text, program.below)))


def page_of(text, program):
    """A page with the options of its program, or of None: a program that cannot run here."""
    return text.replace(MARK, generated(program) if program else UNKNOWN)
