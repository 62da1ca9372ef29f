"""The session of a set, as its files in /dev/shm and `yars` show it: who has it, who takes part, who still lives."""
import contextlib
import fcntl
import json
import os
import struct

from starting.command import run
from starting.roles import ROLES

EVERY_BYTE = 1 + max(kind.once for kind in ROLES.values())


def segment_path(session):
    return f"/dev/shm/yars.{os.geteuid()}.{session}"


def is_named(path, file):
    """Whether the name of an open file is still its own."""
    with contextlib.suppress(FileNotFoundError):
        return os.path.samestat(os.stat(path, follow_symlinks=False), os.fstat(file))
    return False


def lock(file, kind, length, start):
    fcntl.lockf(file, kind | fcntl.LOCK_NB, length, start)


class SetLock:
    """The right to run a set in a session: locks on bytes of /dev/shm/yars-set.UID.SESSION, which the kernel releases
    when this process ends. A byte for each role that a session has once, behind byte 0: a set in lockstep begins only
    where no other set is. The last set removes the file."""

    def __init__(self, session, names, lockstep):
        self.path = f"/dev/shm/yars-set.{os.geteuid()}.{session}"
        self.bytes = sorted({ROLES[name].once for name in names if name in ROLES} - {0})
        self.lockstep = lockstep
        self.file = -1

    def take(self):
        """False: another set has a role of this one, or is in the session where this one is in lockstep. OSError: no file."""
        while True:
            # No link is followed, no pipe waited for; a file of another user is refused.
            self.file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK, 0o600)
            try:
                # Byte 0 first: of a set in lockstep and another one that start at once, one goes on.
                lock(self.file, fcntl.LOCK_EX if self.lockstep else fcntl.LOCK_SH, 1, 0)
                for byte in self.bytes:
                    lock(self.file, fcntl.LOCK_EX, 1, byte)
                lock(self.file, fcntl.LOCK_SH, 1, 0)
            except (BlockingIOError, PermissionError):
                os.close(self.file)
                return False
            if is_named(self.path, self.file):
                return True
            os.close(self.file)  # a set that ended meanwhile removed the name

    def give_back(self):
        with contextlib.suppress(OSError):  # others are in the session
            lock(self.file, fcntl.LOCK_EX, EVERY_BYTE, 0)
            os.unlink(self.path)
        os.close(self.file)


def remove_leftover(session):
    """Removes the segment of roles that were killed. A segment in use has a read lock on byte 0 by each participant
    (shm/segment.hpp)."""
    path = segment_path(session)
    with contextlib.suppress(OSError):
        file = os.open(path, os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
        try:
            lock(file, fcntl.LOCK_EX, 1, 0)
            if is_named(path, file):
                os.unlink(path)
        finally:
            os.close(file)


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
    """Times of the last heartbeats in the session's table of processes, [ns] of CLOCK_MONOTONIC, by pid. Where the table
    is `yars status --layout` says, which `layout` keeps."""
    layout |= layout or read_json(of, "status", "--layout")
    try:
        table, at = layout["containers"]["processes"], layout["offsets"]["processes"]
        with open(segment_path(of.session), "rb", buffering=0) as segment:
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
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
            return file.read().rpartition(") ")[2][:1] in ("T", "t")
    except OSError:
        return True
