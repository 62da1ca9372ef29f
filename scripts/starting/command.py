"""The command itself: its name, its folders, what it says, and how it ends."""
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
    """A line for people. Its reader may be gone and a disk may be full: neither is a fault of the set."""
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
    """Bad usage: what was expected and what was found; `meant`: "did you mean 'WORD'? " or nothing."""
    end(2, f"{text}; {meant}{'See' if meant else 'see'} {NAME} --help")


def catch_signals(handler=lambda *_: sys.exit(130)):
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup
            signal.signal(number, handler)


def run(*command, **more):
    """The command's end, with what it wrote as text. A command that cannot be started, or is too slow, has failed."""
    try:
        return subprocess.run(command, errors="surrogateescape", stdin=subprocess.DEVNULL, check=False, **more)
    except (subprocess.TimeoutExpired, OSError) as problem:
        return subprocess.CompletedProcess(command, 127, "", str(problem))


def put_as_own(said):
    """A message of `yars COMMAND` as one of this command."""
    put(2, f"{NAME}: " + re.sub(r"\Ayars.*?: ", "", said.rstrip("\n"), flags=re.S))


def user_folder(variable, below_home):
    """Of the XDG base directories; empty without a home."""
    home = os.environ.get("HOME")
    return os.environ.get(variable) or (f"{home}/{below_home}" if home else "")


def private_folder(path):
    """Made for the user alone."""
    before = os.umask(0o077)
    try:
        os.makedirs(path, exist_ok=True)
    finally:
        os.umask(before)
    return path
