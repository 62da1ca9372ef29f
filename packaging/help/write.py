#!/usr/bin/env python3
"""Writes man pages and completions of the programs, with the options that --help of this build prints.

usage: write.py BIN OUT
BIN: folder of the programs, such as build/release/bin. OUT: becomes share/ of an installation
Files: man/man?/NAME.?.gz; bash-completion/completions/PROGRAM, zsh/vendor-completions/_yars and
fish/vendor_completions.d/PROGRAM.fish with commands, options, fixed values, files, folders, names of sessions, words of
events. In a cross build BIN is - : no program runs here, so the pages have no options and there are no completions.
"""
import gzip
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True
import bash  # noqa: E402
import fish  # noqa: E402
import help_text  # noqa: E402
import man  # noqa: E402
import zsh  # noqa: E402

PAGES = pathlib.Path(__file__).resolve().parents[1] / "man"
FOLDERS = {"bash": "bash-completion/completions", "zsh": "zsh/vendor-completions", "fish": "fish/vendor_completions.d"}


def pages(programs):
    """(path below OUT, bytes) of each man page. A program that was not built has no page."""
    by_name = {program.words[0]: program for program in programs}
    for path in sorted(PAGES.glob("*.[15]")):
        text, section = path.read_text(), path.suffix[1:]
        if programs and man.MARK in text and path.stem not in by_name:
            continue
        packed = gzip.compress(man.page_of(text, by_name.get(path.stem)).encode(), 9, mtime=0)
        yield f"man/man{section}/{path.name}.gz", packed


def completions(programs):
    """(path below OUT, bytes) of each file of a shell."""
    for shell in (bash, zsh, fish):
        for name, text in shell.files_of(programs):
            kind, _, file = name.partition("/")
            yield f"{FOLDERS[kind]}/{file}", text.encode()


def main(folder, out):
    programs = [] if folder == "-" else help_text.read_all(folder)
    if (gateway := pathlib.Path(folder, "gateway")).is_file():  # in builds with Cyclone DDS
        programs.append(help_text.read([str(gateway.resolve())]))
    shutil.rmtree(out, ignore_errors=True)
    files = dict(pages(programs))
    if programs:
        files |= dict(completions(programs))
    for name, data in files.items():
        path = pathlib.Path(out, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
