"""A wheel: a zip file with sorted entries, one date for all of them, and their hashes in RECORD. The same files and the
same date give the same bytes. Format: the PyPA specification "Binary distribution format", version 1.0."""
import base64
import hashlib
import pathlib
import stat
import time
import zipfile

# A zip file has no date before it.
EARLIEST = 315532800  # 1980-01-01, seconds of POSIX
GENERATOR = "yars_backend"


def record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


class WheelFile:
    """Collects files as (name, content, executable) and writes them at once.
    `tag`: such as cp311-cp311-linux_x86_64."""

    def __init__(self, name, version, tag):
        self.tag = tag
        self.file_name = f"{name}-{version}-{tag}.whl"
        self.information = f"{name}-{version}.dist-info"
        self.scripts = f"{name}-{version}.data/scripts"
        self._files = {}

    def add(self, name, content, executable=False):
        if isinstance(content, str):
            content = content.encode()
        self._files[name] = (content, executable)

    def add_folder(self, folder, below, suffixes):
        """Files of `folder` and its subfolders with one of the suffixes, also behind links, as `below`/PATH."""
        folder = pathlib.Path(folder)
        for path in folder.rglob("*"):
            if path.is_file() and path.name.endswith(suffixes):
                self.add(f"{below}/{path.relative_to(folder).as_posix()}", path.read_bytes())

    def write(self, folder, seconds):
        """Writes the wheel into the folder and returns its name. `seconds`: date of all entries, seconds of POSIX."""
        self.add(f"{self.information}/WHEEL",
                 f"Wheel-Version: 1.0\nGenerator: {GENERATOR}\nRoot-Is-Purelib: false\nTag: {self.tag}\n")
        # The specification asks for the information last: a reader then finds it at the end of a large file.
        names = sorted(self._files, key=lambda name: (name.startswith(self.information), name))
        record = f"{self.information}/RECORD"
        lines = [record_line(name, self._files[name][0]) for name in names] + [f"{record},,\n"]
        self.add(record, "".join(lines))
        date = time.gmtime(max(seconds, EARLIEST))[:6]
        with zipfile.ZipFile(pathlib.Path(folder, self.file_name), "w") as archive:
            for name in [*names, record]:
                content, executable = self._files[name]
                entry = zipfile.ZipInfo(name, date)
                entry.compress_type = zipfile.ZIP_DEFLATED
                entry.external_attr = (stat.S_IFREG | (0o755 if executable else 0o644)) << 16
                archive.writestr(entry, content, compresslevel=9)
        return self.file_name
