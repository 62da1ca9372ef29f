"""Debian packages that a .deb depends on, with the versions of this system
and the licences that their copyright files name."""
import pathlib
import re
import subprocess

# Short names of licences in Debian's machine-readable copyright files -> SPDX identifiers, where the two differ.
SPDX_OF_DEBIAN = {
    "Expat": "MIT", "BSD-2-clause": "BSD-2-Clause", "BSD-3-clause": "BSD-3-Clause", "GPL-2": "GPL-2.0-only",
    "GPL-2+": "GPL-2.0-or-later", "GPL-3": "GPL-3.0-only", "GPL-3+": "GPL-3.0-or-later", "LGPL-2": "LGPL-2.0-only",
    "LGPL-2+": "LGPL-2.0-or-later", "LGPL-2.1": "LGPL-2.1-only", "LGPL-2.1+": "LGPL-2.1-or-later",
    "LGPL-3": "LGPL-3.0-only",
    "LGPL-3+": "LGPL-3.0-or-later", "Apache-2.0": "Apache-2.0", "MIT": "MIT", "ISC": "ISC", "BSL-1.0": "BSL-1.0",
    "Zlib": "Zlib",
    "zlib": "Zlib", "EPL-2.0": "EPL-2.0", "BSD-3-Clause": "BSD-3-Clause", "BSD-2-Clause": "BSD-2-Clause",
    "MPL-2.0": "MPL-2.0",
}
STRENGTHS = ("Depends", "Recommends", "Suggests")


def field(package, name):
    return subprocess.run(["dpkg-deb", "--field", package, name], capture_output=True, text=True,
                          check=True).stdout.strip()


def query(name):
    """(version, source package, its version) of an installed package; None: it is not installed."""
    form = "${db:Status-Status}\t${Version}\t${source:Package}\t${source:Version}\n"
    done = subprocess.run(["dpkg-query", "--show", f"--showformat={form}", name], capture_output=True, text=True,
                          check=False)
    for line in done.stdout.splitlines():
        status, *rest = line.split("\t")
        if status == "installed":
            return rest
    return None


def licences(text):
    """Sorted short names of the licences in a machine-readable copyright file, but for Debian's own files;
    [] for another file."""
    names = set()
    if "copyright-format/1.0" not in text:
        return []
    for paragraph in re.split(r"\n\s*\n", text):
        files = re.search(r"^Files:\s*(.*(?:\n[ \t].*)*)", paragraph, re.M)
        licence = re.search(r"^License:[ \t]*(\S.*)$", paragraph, re.M)
        if files and licence and not files[1].strip().startswith("debian/"):
            names.add(licence[1].strip())
    return sorted(names)


def part(name):
    """Name, version, source and licences of one Debian package."""
    known = query(name)
    copyright_file = pathlib.Path("/usr/share/doc", name, "copyright")
    text = copyright_file.read_text(encoding="utf-8", errors="replace") if copyright_file.is_file() else ""
    version, source, source_version = known or ("", "", "")
    return {"name": name, "version": version, "source": source, "source_version": source_version,
            "licences": licences(text)}


def alternatives(dependency):
    """Names of the packages that one entry of Depends accepts, in order."""
    return [re.match(r"[a-z0-9.+-]+", choice.strip())[0] for choice in dependency.split("|")]


def names_of(package, strength):
    """Packages that a .deb names: of alternatives the first that is installed, else the first."""
    names = []
    for dependency in filter(None, (text.strip() for text in field(package, strength).split(","))):
        choices = alternatives(dependency)
        names.append(next((name for name in choices if query(name)), choices[0]))
    return sorted(set(names))


def parts_of(package):
    """The packages of a .deb by strength: {"Depends": [part, ...], ...}, those of this project left out."""
    return {strength: [part(name) for name in names_of(package, strength)
                       if name not in ("yars", "libyars-dev", "python3-yars")]
            for strength in STRENGTHS}
