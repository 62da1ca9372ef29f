"""The session of a set, as its files in /dev/shm and `yars` show it: who has it, who takes part, who still lives."""
import contextlib
import fcntl
import json
import os
import struct

from starting.command import run
from starting.roles import ROLES

ALONE, SHARED = fcntl.LOCK_EX | fcntl.LOCK_NB, fcntl.LOCK_SH | fcntl.LOCK_NB
FOR_BOTH = os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK  # no link is followed, no pipe waited for


def path_of(kind, session):
    """`kind`: yars, the segment; yars-set, the lock of its sets."""
    return f"/dev/shm/{kind}.{os.geteuid()}.{session}"


def is_named(path, file):
    """Whether the name of an open file is still its own."""
    with contextlib.suppress(FileNotFoundError):
        return os.path.samestat(os.stat(path, follow_symlinks=False), os.fstat(file))
    return False


def take_set_lock(path, names, lockstep):
    """The right to run a set in a session: locks on bytes of a file, which the kernel releases when this process ends.
    Byte 0 is of the set: one in lockstep begins only where no other is. Others are of roles that a session has once.
    None: another set has a role of this one, or is there beside a set in lockstep. OSError: no file of this user."""
    while True:
        file = os.open(path, FOR_BOTH | os.O_CREAT, 0o600)
        try:
            # Byte 0 first: of a set in lockstep and another one that start at once, one goes on.
            fcntl.lockf(file, ALONE if lockstep else SHARED, 1, 0)
            for byte in sorted({ROLES[name].once for name in names if name in ROLES} - {0}):
                fcntl.lockf(file, ALONE, 1, byte)
            fcntl.lockf(file, SHARED, 1, 0)
        except (BlockingIOError, PermissionError):
            os.close(file)
            return None
        if is_named(path, file):
            return file
        os.close(file)  # a set that ended meanwhile removed the name


def give_set_lock_back(path, file):
    """The last set of a session removes the file."""
    with contextlib.suppress(OSError):  # others are in the session
        fcntl.lockf(file, ALONE, 1 + max(kind.once for kind in ROLES.values()), 0)
        os.unlink(path)
    os.close(file)


def remove_leftover(session):
    """Removes the segment of roles that were killed. A segment in use has a read lock on byte 0 by each participant
    (shm/segment.hpp)."""
    path = path_of("yars", session)
    with contextlib.suppress(OSError), open(os.open(path, FOR_BOTH), "r+b", buffering=0) as file:
        fcntl.lockf(file, ALONE, 1, 0)
        if is_named(path, file.fileno()):
            os.unlink(path)


def run_yars(of, *arguments, codes=(0,)):
    """Standard output of a command in the session of a set; None when it failed: ended with another code."""
    done = run(f"{of.bin}/yars", "--session", of.session, *arguments, capture_output=True, timeout=10.0)
    return done.stdout if done.returncode in codes else None


def read_json(of, *arguments, codes=(0,)):
    """What a command prints; empty when it fails, or was killed while it printed."""
    with contextlib.suppress(json.JSONDecodeError):
        return json.loads(run_yars(of, *arguments, codes=codes) or "{}")
    return {}


def watch(of):
    return read_json(of, "watch", "--json", "--once")


def heartbeats(of, layout):
    """Times of the last heartbeats in the session's table of processes, [ns] of CLOCK_MONOTONIC, by pid. `layout` keeps
    what `yars status --layout` says of the place of the table."""
    layout |= layout or read_json(of, "status", "--layout")
    try:
        table, at = layout["containers"]["processes"], layout["offsets"]["processes"]
        with open(path_of("yars", of.session), "rb", buffering=0) as segment:
            content = os.pread(segment.fileno(), table["count"] * table["stride"], at)
    except (OSError, KeyError):
        return {}
    return {struct.unpack_from("<i", content, entry + table["pid"])[0]:
            struct.unpack_from("<q", content, entry + table["heartbeat_ns"])[0]
            for entry in range(0, len(content) - table["stride"] + 1, table["stride"])}


def is_there_already(of):
    """Whether processes that no set holds have a role of this set. In lockstep all begin together: any process counts.
    A program of the user's own may wait in a session for its set, and a hand-over looks by itself."""
    if any(role.name == "hand-over" for role in of.roles):
        return False
    present = watch(of)
    once = {role.name for role in of.roles if role.kind.once}
    return bool(present if of.lockstep else once & present.get("processes", {}).keys())


def is_stopped(pid):
    """Whether a signal or a debugger has stopped the process."""
    with contextlib.suppress(OSError), open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
        return file.read().rpartition(") ")[2][:1] in ("T", "t")
    return True
