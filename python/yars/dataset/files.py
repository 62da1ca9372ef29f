"""Files of a data set: written under a temporary name and renamed, so that a name stands for a whole file."""
import errno
import os
import pathlib
import re
import shutil
import signal
import socket
import time

from . import DatasetError

_HOST = re.sub(r"[^A-Za-z0-9]", "-", socket.gethostname())[:32]
_TEMPORARY = re.compile(r"\.writing-(.*)-(\d+)-")
_OLD_S = 3600.0  # no writer takes so long for a file
_ACTIONS = {errno.ENOSPC: "free some space, then run the same command again: what is written stays",
            errno.EDQUOT: "raise the quota or free some space, then run the same command again: what is written stays",
            errno.EFBIG: "raise the limit (ulimit -f), then run the same command again: what is written stays",
            errno.EACCES: "give write permission for the folder, or choose another --out",
            errno.EEXIST: "it, or a folder above it, is a file: choose another --out",
            errno.ENOTDIR: "it, or a folder above it, is a file: choose another --out",
            errno.EROFS: "choose an --out on a file system that can be written"}


_SIGNALS = {signal.SIGXFSZ: "raise the limit of a file's size (ulimit -f)",
            signal.SIGKILL: "is memory short? Try fewer --workers, or a smaller output.block",
            signal.SIGXCPU: "raise the limit of processor time (ulimit -t)",
            signal.SIGBUS: "is the disk full, or was a file cut off?"}


def end_of(code):
    """How a process ended, with what to do. `code`: returncode of subprocess, negative for a signal."""
    if code >= 0:
        return f"exit code {code}"
    try:
        name = signal.Signals(-code).name
    except ValueError:
        name = f"signal {-code}"
    action = _SIGNALS.get(-code)
    return f"{name} ({signal.strsignal(-code)})" + (f"; {action}" if action else "")


def failure(path, error, expected="to write"):
    """DatasetError of an OSError, with what the user can do."""
    action = _ACTIONS.get(error.errno, "check the disk, then run the same command again: what is written stays")
    room = ""
    if error.errno == errno.ENOSPC:
        try:
            room = f" ({shutil.disk_usage(pathlib.Path(path).parent).free // 1000000} MB are free)"
        except OSError:
            pass
    return DatasetError(f"{path}: expected {expected}, found: {error.strerror or error}{room}; {action}")


def temporary_name(path):
    """Name beside a file under which this process writes it."""
    folder, name = os.path.split(path)
    return os.path.join(folder, f".writing-{_HOST}-{os.getpid()}-{name}")


def write(path, *parts):
    """Writes a file as a whole: a new name, then a rename. Raises DatasetError; then no part of it stays."""
    temporary = temporary_name(path)
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC
    try:
        try:
            file = os.open(temporary, flags, 0o666)
        except FileNotFoundError:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            file = os.open(temporary, flags, 0o666)
        try:
            for part in parts:
                view = memoryview(part).cast("B")
                while len(view):
                    view = view[os.write(file, view):]
        finally:
            os.close(file)
        os.rename(temporary, path)
    except OSError as error:
        try:
            os.unlink(temporary)
        except OSError:
            pass
        raise failure(path, error) from None


def write_stream(path, parts, good):
    """Writes bytes objects to a file under a temporary name; renames it if good() holds at the end."""
    temporary = temporary_name(path)
    try:
        with open(temporary, "wb") as file:
            for part in parts:
                file.write(part)
        if good():
            os.rename(temporary, path)
            return
    except OSError as error:
        raise failure(path, error) from None
    finally:
        try:
            os.unlink(temporary)
        except OSError:
            pass


def remove(path):
    """Removes a file or a folder with all that is in it. It may be absent."""
    try:
        if os.path.isdir(path) and not os.path.islink(path):
            shutil.rmtree(path)
        else:
            pathlib.Path(path).unlink(missing_ok=True)
    except OSError as error:
        raise failure(path, error, "to remove it") from None


def below(folder):
    """Names of all files below a folder, relative to it, sorted. Temporary ones are left out."""
    names = []
    for place, folders, inside in os.walk(folder):
        folders[:] = [name for name in folders if not _TEMPORARY.match(name)]
        names += [os.path.relpath(os.path.join(place, name), folder) for name in inside if not _TEMPORARY.match(name)]
    return sorted(names)


def _runs(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def remove_leftovers(folder):
    """Removes temporary files and folders of writers that no longer run: those of this host by their process, those of
    others by their age. Returns their number."""
    count = 0
    for place, folders, names in os.walk(folder):
        for name in names + folders:
            match = _TEMPORARY.match(name)
            path = os.path.join(place, name)
            try:
                if match and (not _runs(match.group(2)) if match.group(1) == _HOST
                              else time.time() - os.stat(path).st_mtime > _OLD_S):
                    shutil.rmtree(path) if name in folders else os.unlink(path)
                    count += 1
            except OSError:
                pass
        folders[:] = [name for name in folders if not _TEMPORARY.match(name)]
    return count


def read(path):
    """Content of a file; None if it is absent."""
    try:
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise failure(path, error, "to read") from None
