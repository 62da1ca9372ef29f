"""State of a set's session, from its files in /dev/shm and from `yars`: lock, participants, heartbeats."""
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
    """Path of a file of the session. `kind`: yars for the segment, yars-set for the lock of its sets."""
    return f"/dev/shm/{kind}.{os.geteuid()}.{session}"


def is_named(path, file):
    """Whether the path still leads to this open file."""
    with contextlib.suppress(FileNotFoundError):
        return os.path.samestat(os.stat(path, follow_symlinks=False), os.fstat(file))
    return False


def take_set_lock(path, names, lockstep):
    """Takes the locks, on bytes of a file, of a set in a session. The kernel frees them when this process ends.
    Byte 0: shared by sets; a set in lockstep needs it alone. Other bytes: roles of which a session has one (Kind.once).
    Returns None if another set has one of these locks. OSError: the file belongs to another user."""
    while True:
        file = os.open(path, FOR_BOTH | os.O_CREAT, 0o600)
        try:
            # Byte 0 first, so that of two sets that start at the same time, one in lockstep, exactly one continues.
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
    """Frees the locks. The last set of a session removes the file."""
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
    """Standard output of `yars` in the session of a set; None if it ended with a code that is not in `codes`."""
    done = run(f"{of.bin}/yars", "--session", of.session, *arguments, capture_output=True, timeout=10.0)
    return done.stdout if done.returncode in codes else None


def read_json(of, *arguments, codes=(0,)):
    """JSON that `yars` prints; empty if it fails, or is killed while it prints."""
    with contextlib.suppress(json.JSONDecodeError):
        return json.loads(run_yars(of, *arguments, codes=codes) or "{}")
    return {}


def watch(of):
    return read_json(of, "watch", "--json", "--once")


def heartbeats(of, layout):
    """Times of the last heartbeats in the session's table of processes, [ns] of CLOCK_MONOTONIC, by pid. `layout` is
    a cache of `yars status --layout`, which has the position of the table."""
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
    """Whether a process outside this set has a role of it that a session has once. For a set in lockstep any process
    counts, because all begin together; else other programs may wait in the session. A hand-over tests this itself."""
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
