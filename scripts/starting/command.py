"""Name, folders, messages and exit of the start command."""
import contextlib
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys

HERE = os.getcwd()  # of the user
TOP = pathlib.Path(__file__).resolve().parents[2]
INSTALLED = not (TOP / "CMakeLists.txt").is_file()  # TOP is PREFIX/libexec, else the checkout
NAME = "yars-start" if INSTALLED else "scripts/start"
HOME = TOP.parent if INSTALLED else TOP
SHARE = HOME / "share/yars" if INSTALLED else HOME


def put(descriptor, text):
    """Prints a line. A closed pipe or a full disk must not end the set, so errors of writing are ignored."""
    with contextlib.suppress(OSError):
        os.write(descriptor, f"{text}\n".encode(errors="replace"))


def shown(text):
    """The text with control characters escaped, for messages."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def quoted(text):
    """A value of the user as a word of a command line, for messages."""
    return shown(shlex.quote(str(text)))


def end(code, text):
    put(2, f"{NAME}: {text}")
    sys.exit(code)


def refuse(text, meant=""):
    """Ends with code 2 for bad usage. `text`: what was expected and found. `meant`: empty, or "did you mean X? "."""
    end(2, f"{text}; {meant}{'See' if meant else 'see'} {NAME} --help")


def catch_signals(handler=lambda *_: sys.exit(130)):
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup
            signal.signal(number, handler)


def run(*command, **more):
    """Runs a command and returns its exit code and output. Code 127: it could not be started, or took too long."""
    try:
        return subprocess.run(command, errors="surrogateescape", stdin=subprocess.DEVNULL, check=False, **more)
    except (subprocess.TimeoutExpired, OSError) as problem:
        return subprocess.CompletedProcess(command, 127, "", str(problem))


def put_as_own(said):
    """Prints a message of `yars COMMAND` with the name of this command in its place."""
    put(2, f"{NAME}: " + re.sub(r"\Ayars.*?: ", "", said.rstrip("\n"), flags=re.S))


def user_folder(variable, below_home):
    """A folder of the XDG Base Directory Specification; empty if neither `variable` nor HOME is set."""
    home = os.environ.get("HOME")
    return os.environ.get(variable) or (f"{home}/{below_home}" if home else "")


def private_folder(path):
    """Makes a folder with mode 0700 if it does not exist."""
    before = os.umask(0o077)
    try:
        os.makedirs(path, exist_ok=True)
    finally:
        os.umask(before)
    return path
