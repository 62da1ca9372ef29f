#!/usr/bin/env python3
"""Nothing that is installed points to a file that is not: links, paths, headers, man pages in documents, examples,
headers, configurations, completions, units. A path after SOURCES/ is one of the sources, and is there.

usage: installed_paths_test.py CMAKE BUILD      without the programs, which may be large
"""
import gzip
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "packaging"))
sys.dont_write_bytecode = True
import installed_paths  # noqa: E402  a script of another folder

DOCUMENTS, SHARE = pathlib.PurePath("share/doc/yars"), pathlib.PurePath("share/yars")
LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)\s]*)?\)")
# Who made a file is a fact about the sources.
PROVENANCE = re.compile(r"[Gg]enerated by|Made by|^\s*(?:#|\.\\\"|;|//) ?(?:begin|end): ", re.M)
OF_SOURCES = re.compile(r"SOURCES/((?:[\w*@-]|[./](?=[\w*@-]))*)")
BELOW_PREFIX = re.compile(
    r"(?<![\w./<~$=-])(?:/usr/(?=[\w./-]*yars))?((?:share|libexec|include|lib/(?:systemd|cmake|pkgconfig|python3))"
                          r"/(?:[\w@-]|[./](?=[\w@-]))*)")
HEADER = re.compile(r"(?<![\w/])<?yars/(yars\w*\.h)\b")
PAGE = re.compile(r"^\.Xr ([\w.-]+) (\d)", re.M)


def texts(prefix):
    """(path below the prefix, text) of all that is no program, picture or library."""
    for path in sorted(path for path in prefix.rglob("*") if path.is_file()):
        place = path.relative_to(prefix)
        if (place.parts[0] in ("bin", "libexec") or path.suffix in (".png", ".webp", ".ico", ".a") or
                ".so." in path.name or path.suffix == ".so"):
            continue
        opened = gzip.open(path, "rt", encoding="utf-8") if path.suffix == ".gz" else open(path, encoding="utf-8")
        with opened as file:
            yield place, file.read()


def missing_links(prefix, place, text):
    for target in LINK.findall(text) if place.suffix == ".md" else ():
        path = os.path.normpath(place.parent / target)
        in_sources = (SOURCE / os.path.relpath(path, DOCUMENTS)).exists()  # else scripts/check_citations.py says so
        if "://" not in target and in_sources and not (prefix / path).exists():
            yield f"link to {target}"


def missing_paths(prefix, place, line):
    if place.is_relative_to(DOCUMENTS / "docs/decisions"):  # a decision names what there was
        return
    for source in OF_SOURCES.findall(line):
        if source and not source.startswith("build/") and not any(SOURCE.glob(source)):
            yield f"SOURCES/{source}, which the sources do not have"
    for path in installed_paths.PATH.findall(line):
        if not any((prefix / root / path).exists() for root in (".", DOCUMENTS, SHARE)):
            yield path
    for path in BELOW_PREFIX.findall(line):
        if not (prefix / path).exists() and "/usr/" + path not in line.replace("/usr/" + path + "/", ""):
            yield path
    for header in HEADER.findall(line):
        if not (prefix / "include/yars" / header).is_file():
            yield f"yars/{header}"


def missing(prefix):
    """One line for each path that leads nowhere."""
    for place, text in texts(prefix):
        if place.name == "changelog.gz":  # what was, also of files that are no more
            continue
        for what in missing_links(prefix, place, text):
            yield f"{place}: {what}"
        for number, line in enumerate(text.splitlines(), 1):
            if not PROVENANCE.search(line):
                for what in missing_paths(prefix, place, LINK.sub("]()", line)):
                    yield f"{place}:{number}: {what}"
        for page, section in PAGE.findall(text):
            if not (prefix / f"share/man/man{section}/{page}.{section}.gz").is_file():
                yield f"{place}: man page {page}({section})"


def main(cmake, build):
    with tempfile.TemporaryDirectory(dir=build) as folder:
        prefix = pathlib.Path(folder, "prefix")
        for component in ("idl", "python", "Unspecified", "headers", "client", "display", "radar", "development"):
            subprocess.run([cmake, "--install", build, "--component", component, "--prefix", prefix], check=True,
                           stdout=subprocess.DEVNULL, timeout=120)
        faults = list(missing(prefix))
        # The check itself: what it finds in a document that points to nothing.
        (prefix / DOCUMENTS / "wrong.md").write_text("[a](HACKING.md) `scripts/start` `share/yars/absent` "
                                                     "<yars/yars_no.h> `SOURCES/model/absent` `docs/absent`\n")
        found = len(list(missing(prefix))) - len(faults)
        if found != 6:
            faults.append(f"expected 6 faults in wrong.md, found {found}")
    print("\n".join(faults) or "nothing installed points to what is not")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
