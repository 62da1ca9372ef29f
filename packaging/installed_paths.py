#!/usr/bin/env python3
"""Rewrites installed documents, examples and configurations in place, so that they name what is installed.

usage: installed_paths.py PREFIX_WITH_DESTDIR DOCUMENTS SHARE [VERSION]
DOCUMENTS, SHARE: folders below the prefix: share/doc/yars, share/yars.
`cmake --install` runs it. scripts/start becomes yars-start, build/release/bin/yars becomes yars, config/apg68.guf
becomes apg68.guf, which the programs find. A path of the sources that is not installed gets SOURCES/ before it, and a
link to it becomes such a path; the README says what SOURCES is. To do it twice changes nothing.
"""
import os
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[1]
FOLDERS = ("build|config|databuffer|display|docs|examples|gateway|inputmonitor|lib|model|packaging|python|scripts|shm"
           "|statemachine|station|tests|tools|worldgen")
PATH = re.compile(rf"(?<![\w./<~$=-])(?:\./)?((?:{FOLDERS})/(?:[\w*@-]|[./](?=[\w*@-]))*/?)")
LINK = re.compile(r"(!?)\[([^\]\n]*)\]\(([^)\s#]+)(#[^)\s]*)?\)")
# Text for a checkout, and the text that replaces it in an installation. In the sources the comment hides the second.
SOURCES_ONLY = re.compile(r"<!-- sources -->\n.*?<!-- installed\n(.*?)-->\n", re.S)
# Before the paths: parts of commands.
WORDS = [('"databuffer/client/yars.h"', "<yars/yars.h>"), ('"databuffer/client/yars_client.h"', "<yars/yars_client.h>"),
         ("PYTHONPATH=python ", ""), ("cc -I. ", "cc "),
         ("-I. examples/", "")]
PLACES = {
    "scripts/start": "yars-start", "scripts/plot_trade": "yars-plot-trade",
    "scripts/network_identities": "yars-network-identities", "build/release/bin": "bin",
    "scripts/starting": "libexec/yars/starting",
    "build/terrain/default": "~/.cache/yars/terrain", "build/start.log": "yars-start's log",
    "build/release/install/doc/records.md": "share/doc/yars/docs/records.md",
    "build/release/install/doc/dataset_keys.md": "share/doc/yars/docs/dataset_keys.md",
    "build/release/systemd": "lib/systemd/user", "python/yars/session.py": "yars/session.py",
    "databuffer/client/yars.h": "yars/yars.h", "databuffer/client/yars_client.h": "yars/yars_client.h",
    "databuffer/client/yars_records.h": "yars/yars_records.h",
    "databuffer/client/yars_segment.h": "yars/yars_segment.h",
    "display/library/yars_display.h": "yars/yars_display.h",
    "gateway/yars_network.idl": "share/yars/idl/yars_network.idl",
}
SAYS = ("This is the installed copy: the programs are on your path, `examples/` lies beside this README. `SOURCES/` "
        "stands for the sources of YARS{}, which hold the rest.")


def installed_place(path, prefix, documents, share):
    """Path or text in an installation for a path of the sources."""
    if path in PLACES:
        return PLACES[path]
    program = re.fullmatch(r"build/(?:release|dev)/bin/([\w-]+)", path)
    if program and not program[1].startswith("test_"):
        return program[1]
    if path.startswith("config/") and (prefix / share / path).is_file():
        return pathlib.PurePath(path).name
    is_installed = path != "lib/" and any((prefix / root / path).exists() for root in (".", documents))
    is_source = path.startswith("build/") or any(SOURCE.glob(path))
    return "SOURCES/" + path if is_source and not is_installed else path


def rewritten(text, file, prefix, documents, share):
    """The text of the installed `file`, a path below the prefix."""
    text = SOURCES_ONLY.sub(r"\1", text)
    for word, other in WORDS:
        text = text.replace(word, other)
    kept = []  # links, which are no paths from the top of the sources

    def place(match):
        return installed_place(match[1], prefix, documents, share)

    def link(match):
        picture, words, target, anchor = match[1], match[2], match[3], match[4] or ""
        path = pathlib.Path(os.path.normpath(file.parent / target))
        changelog = path.with_name("changelog.gz")
        words = PATH.sub(place, words)
        if picture or "://" in target or target.startswith("mailto:") or (prefix / path).exists():
            kept.append(f"{picture}[{words}]({target}{anchor})")
        elif path.name == "CHANGELOG.md" and (prefix / changelog).exists():
            kept.append(f"[{words}]({os.path.relpath(changelog, file.parent)}{anchor})")
        else:
            source = os.path.relpath(path, documents)
            kept.append(f"{words} (`SOURCES/{source}`)" if source not in words else f"`SOURCES/{source}`")
        return f"\0{len(kept) - 1}\0"

    if file.suffix == ".md":
        text = LINK.sub(link, text)
    text = PATH.sub(place, text)
    return re.sub(r"\0(\d+)\0", lambda match: kept[int(match[1])], text)


def with_preface(text, version):
    says = SAYS.format(f" {version}" if version else "")
    title, _, rest = text.partition("\n\n")
    return text if says in text else f"{title}\n\n{says}\n\n{rest}"


def main(prefix, documents, share, version=""):
    prefix, documents, share = pathlib.Path(prefix), pathlib.Path(documents), pathlib.Path(share)
    for path in sorted(path for root in (documents, share) for path in (prefix / root).rglob("*") if path.is_file()):
        if path.suffix not in (".md", ".c", ".cpp", ".py", ".txt", ".idl", ".guf", ".route", ".script", ".scenes",
                               ".tour"):
            continue
        before = path.read_text(encoding="utf-8")
        after = rewritten(before, path.relative_to(prefix), prefix, documents, share)
        if path in (prefix / documents / "README.md", prefix / documents / "docs/README.md"):
            after = with_preface(after, version)
        if after != before:
            path.write_text(after, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
