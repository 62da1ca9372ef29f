#!/usr/bin/env python3
"""Holds the layers of the design: who includes whom, who sees the world, how files are named.

usage: check_layers.py [--root DIR]
Prints one line a finding, `file:line: rule: what was found, what is allowed`; exit 1 when there is one.
Long files are only warned of. The rules are the tables below; a new folder or a new third-party header gets a row.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

GEO = ["lib/failure", "lib/geo"]
RADAR = GEO + ["lib/radar"]
RECORDS = RADAR + ["databuffer/records"]
ROLE = RECORDS + ["lib/file", "lib/imageio", "config"]
MODEL = ROLE + ["lib/lanes", "lib/memory", "model/terrain", "model/antenna", "model/reflectivity", "model/scene", "model/rbm", "model/hrm", "model/kernel"]
SEGMENT = ROLE + ["shm", "databuffer", "databuffer/flight", "databuffer/bridges"]

# Folder -> folders whose headers it may include besides its own. model, statemachine, inputmonitor and display
# never see each other; tools and tests drive everything.
LAYERS = {
    "lib/failure": [],
    "lib/lanes": [],
    "lib/memory": [],
    "lib/file": ["lib/failure"],
    "lib/geo": GEO,
    "lib/radar": RADAR,
    "lib/imageio": ["lib/failure", "lib/file"],
    "shm": ["lib/failure", "lib/file"],
    "config": RECORDS,
    "databuffer/records": RECORDS,
    "databuffer/flight": RECORDS,
    "databuffer/bridges": RECORDS + ["databuffer/flight"],
    "databuffer": SEGMENT,
    "model/terrain/gdal": ["lib/failure", "lib/file"],
    "model/terrain": RADAR + ["lib/lanes", "lib/memory", "lib/file", "lib/imageio", "model/terrain/gdal"],
    "model/antenna": RADAR,
    "model/reflectivity": RADAR + ["model/terrain"],
    "model/scene": RADAR + ["model/terrain", "lib/file", "lib/imageio"],
    "model/rbm": RADAR + ["lib/lanes", "lib/memory", "model/terrain", "model/antenna", "model/reflectivity", "model/scene"],
    "model/hrm": RADAR + ["lib/lanes", "lib/memory", "model/terrain", "model/reflectivity", "model/rbm", "model/scene"],
    "model/kernel": MODEL,
    "model": MODEL,
    "statemachine": ROLE,
    "inputmonitor": ROLE,
    "display": ROLE,
    "display/gl": ROLE + ["display"],
    "display/host": SEGMENT + ["display", "display/gl"],
    "tools/recording": MODEL,
    "tools/trade": MODEL + ["display"],
    "tools": SEGMENT + ["tools/recording", "tools/trade", "model/terrain/gdal"] + MODEL + ["statemachine", "display"],
    "examples": ["databuffer", "display", "display/host", "lib/failure", "lib/file", "lib/imageio"],
    "tests": None,  # None: everything
}

# Shells (*_main.cpp, *_shell.*) of the roles see the segment, the log and clocks; nobody else of a role does.
SHELL = re.compile(r"_(main|shell)\.[ch]pp$")
SHELL_LAYERS = {"model": SEGMENT, "statemachine": SEGMENT, "inputmonitor": SEGMENT, "display": SEGMENT + ["display/gl", "display/host"]}
SHELL_FOLDERS = ["databuffer", "tools", "tests", "examples"]  # whole folders that may do what shells do

# Third-party and system headers: prefix -> who may include it: folders, single files or "shells".
SYSTEM_HEADERS = {
    "GeographicLib/": ["lib/geo", "tests"],
    "tl/": ["lib/failure"],
    "png.h": ["lib/imageio"],
    "openjpeg.h": ["model/terrain"],
    "zip.h": ["model/terrain", "tests"],
    "zlib.h": ["model/terrain", "tools/recording", "tests"],
    "zstd.h": ["tools/recording"],
    "arpa/": ["databuffer", "tests"],
    "netinet/": ["databuffer", "tests"],
    "sys/mman.h": ["lib/memory", "shells", "shm", "databuffer", "tools", "tests"],
    "gdal.h": ["model/terrain/gdal", "tests"],
    "gdal_utils.h": ["tests"],
    "proj.h": ["model/terrain/gdal", "tests"],
    "ext/": ["databuffer"],
    "cpl_vsi.h": ["model/terrain/gdal"],
    "cpl_conv.h": ["model/terrain/gdal", "tests"],
    "cpl_error.h": ["model/terrain/gdal", "tests"],
    "ogr_srs_api.h": ["model/terrain/gdal", "tests"],
    "boost/": ["shm", "tests"],
    "epoxy/": ["display/gl", "examples", "tests"],
    "dlfcn.h": ["display/gl/context.cpp"],
    "EGL/": ["display/gl"],
    "glm/": ["display/gl"],
    "xxhash.h": ["model/kernel"],
    "hwy/": ["lib/lanes", "model/terrain", "model/rbm", "model/hrm", "tests"],
    "embree3/": ["tests"],
    "GLFW/": ["display/gl", "inputmonitor/keyboard_source.cpp"],
    "spdlog/": ["shells"],
    "CLI/": ["shells"],
    "nlohmann/": ["tools", "tests", "databuffer"],
    "gtest/": ["tests"],
    "gmock/": ["tests"],
    "benchmark/": ["tests"],
    "chrono": ["shells"],
    "csignal": ["shells"],
    "linux/input-event-codes.h": ["config", "inputmonitor", "tests"],
    "iostream": ["shells"],
}
# POSIX and Linux headers (with .h): the ways out of the process.
POSIX_FOLDERS = ["lib/file", "shm", "databuffer", "inputmonitor", "tools", "tests", "examples", "shells"]

CLOCKS = re.compile(r"\b(std::chrono::\w+_clock|clock_gettime|gettimeofday|clock_nanosleep|nanosleep|usleep|sleep_for"
                    r"|sleep_until|std::time\s*\(|monotonic_ns\s*\()")
CLOCK_FOLDERS = ["databuffer", "tools", "tests", "examples", "shm", "shells"]

# Only readers (and what writes a picture or a terminal) open files.
OPENING = re.compile(r"\bstd::[io]?fstream\b|\bfopen\b|(?<![\w>])::(open|openat|mmap)\b"
                     r"|\bstd::filesystem::(recursive_)?directory_iterator\b")
READERS = [re.compile(pattern) for pattern in (
    r"_(reader|reading|index|writer)\.cpp$", r"_(main|shell)\.[ch]pp$", r"^config/read_tree\.cpp$", r"^databuffer/\w+\.cpp$",
    r"^(lib/file|shm|tools|tests|examples)/",
)]

# Only lib/file makes files and folders: what others have planted in a folder is met there once.
WRITING = re.compile(r'\bstd::ofstream\b|\bfopen\([^;]*"[wa]|\bO_CREAT\b|\bmkstemp\b|\bmkdir(at)?\s*\(|\brename(at)?\s*\('
                     r"|\bstd::filesystem::(create_director\w+|rename|copy\w*)\b|\b\w+_file_sink\w*\b")
WRITERS = ("lib/file/", "shm/segment_file.cpp", "tests/", "examples/", "config/schema/load.cpp")

HEAVY_IN_HEADERS = ("iostream", "boost/", "spdlog/")
HEAVY_HEADERS = {"shm/segment_file.hpp"}  # seen by shm/segment.cpp alone
# by flex and bison, in the build folder
GENERATED_HEADERS = {"guf_lexer.hpp", "guf_parser.hpp", "message_lexer.hpp", "message_parser.hpp"}

FORBIDDEN_FOLDERS = {"common", "utils", "util", "misc", "helpers"}
SOURCES = {".cpp", ".hpp", ".c", ".h", ".l", ".y", ".ll", ".yy"}
LONG_FILE = 400  # [lines]
# Assembled, so that this file passes its own rule.
MACHINE_PATHS = re.compile("(?<![\\w.}])/(" + "|".join(["work", "home", "root", "Users"]) + r")/\w")
REGISTRIES = re.compile(r"\b(" + "|".join(
    [r"deb\.debian", r"security\.debian", r"archive\.ubuntu", r"snapshot\.debian"]) + r")\.(org|com)|\b("
    + "|".join([r"pypi", r"files\.pythonhosted", r"crates", r"registry\.npmjs", r"proxy\.golang"]) + r")\.(org|io)\b")


def tracked_files(root):
    """Every file of the project: what git knows or would add; without git, all but build/."""
    try:
        names = subprocess.run(["git", "-C", str(root), "ls-files", "-co", "--exclude-standard"], capture_output=True,
                               text=True, check=True).stdout.splitlines()
    except (FileNotFoundError, subprocess.CalledProcessError):
        names = []
        for folder, folders, files in os.walk(root):
            folders[:] = [name for name in folders if name not in ("build", ".git", "__pycache__")]
            names += [str(pathlib.Path(folder, name).relative_to(root)) for name in files]
    return sorted(name for name in names if (root / name).is_file())


def folder_of(name):
    """The layer that a file belongs to: the longest row of LAYERS that its path begins with."""
    rows = [row for row in LAYERS if name.startswith(row + "/")]
    return max(rows, key=len) if rows else None


def is_among(name, places):
    if "shells" in places and (SHELL.search(name) or any(name.startswith(folder + "/") for folder in SHELL_FOLDERS)):
        # The records, the flight models and the bridges are pure, though they live below databuffer/.
        if not name.startswith(("databuffer/records/", "databuffer/flight/", "databuffer/bridges/")):
            return True
    return any(name == place or folder_of(name) == place for place in places)


def allowed_folders(name, folder):
    allowed = LAYERS[folder]
    if allowed is not None and SHELL.search(name):
        allowed = allowed + SHELL_LAYERS.get(folder.split("/")[0], [])
    return allowed


def without_comments(text):
    """Comments blanked, line numbers kept. Quoted strings stay: a path in a message counts too."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    return re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)


def check_project_include(root, name, folder, header):
    if header in GENERATED_HEADERS and folder == "config":
        return
    if not (root / header).is_file():
        yield "include", f'"{header}" is not a file from the top of the tree; name headers from there'
        return
    target = folder_of(header)
    allowed = allowed_folders(name, folder)
    if allowed is None or target == folder or target in allowed:
        return
    yield "layer", f'{folder} includes "{header}" of {target}; allowed: {", ".join(sorted(set(allowed)))}'


def check_system_include(name, header):
    rows = [row for row in SYSTEM_HEADERS if header == row or (row.endswith("/") and header.startswith(row))]
    if rows:
        places = SYSTEM_HEADERS[rows[0]]
        if not is_among(name, places):
            yield "layer", f"<{header}> is included; allowed in: {', '.join(places)}"
    elif header.endswith(".h") and not is_among(name, POSIX_FOLDERS):
        yield "layer", f"<{header}> is a system header; allowed in: {', '.join(POSIX_FOLDERS)}"
    elif "/" in header and not header.startswith(("sys/", "linux/")):
        yield "layer", f"<{header}> has no row in SYSTEM_HEADERS of check_layers.py"


def check_source(root, name, text):
    folder = folder_of(name)
    if folder is None:
        yield 1, "layer", f"no row in LAYERS of check_layers.py fits {name}"
        return
    is_header = name.endswith((".hpp", ".h"))
    # Highway includes an -inl.hpp once for each set of instructions: a toggle guards it.
    if is_header and not name.endswith("-inl.hpp") and "#pragma once" not in text and not name.endswith(".h"):
        yield 1, "header", "expected #pragma once"
    for number, line in enumerate(without_comments(text).splitlines(), 1):
        include = re.match(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', line)
        if include and include.group(1):
            yield from ((number, *finding) for finding in check_project_include(root, name, folder, include.group(1)))
        elif include:
            header = include.group(2)
            yield from ((number, *finding) for finding in check_system_include(name, header))
            if is_header and header.startswith(HEAVY_IN_HEADERS) and name not in HEAVY_HEADERS:
                yield number, "header", f"<{header}> is heavy; include it in the source"
        clock = CLOCKS.search(line)
        if clock and not is_among(name, CLOCK_FOLDERS):
            yield number, "clock", f"{clock.group()} outside of a shell (*_main.cpp, *_shell.*)"
        opening = OPENING.search(line)
        if opening and not any(reader.search(name) for reader in READERS):
            yield number, "reader", f"{opening.group()} opens files; only READERS of check_layers.py do"
        writing = WRITING.search(line)
        if writing and not name.startswith(WRITERS):
            yield number, "writer", f"{writing.group()} makes files; lib/file/output_file.hpp does that for all"


def check_names(root, name):
    path = pathlib.PurePath(name)
    for part in path.parts[:-1]:
        if part in FORBIDDEN_FOLDERS:
            yield 1, "name", f"a folder '{part}' says nothing of its contents"
    if path.suffix not in SOURCES:
        return
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*(-inl)?", path.stem):
        yield 1, "name", f"expected lower_snake, found '{path.name}'"
    # The commands' functions are declared together, in tools/*command*.hpp.
    unpaired = name.startswith(("tests/", "tools/", "examples/")) or name.endswith(("_main.cpp", "_shell.cpp"))
    if path.suffix == ".cpp" and not unpaired and not has_header(root, path):
        yield 1, "pair", f"no header {path.stem}.hpp beside it"


def has_header(root, source):
    """A header of the source's name, or one whose sources are a family: forms.hpp has forms_antenna.cpp and others."""
    words = source.stem.split("_")
    stems = ["_".join(words[:count]) for count in range(len(words), 0, -1)]
    return any((root / source.with_name(stem + ".hpp")).is_file() for stem in stems)


def check_text(text):
    for number, line in enumerate(text.splitlines(), 1):
        if MACHINE_PATHS.search(line):
            yield number, "path", "a path of one machine: " + line.strip()[:80]
        if REGISTRIES.search(line):
            yield number, "registry", "a package registry's host name: " + line.strip()[:80]


def findings_of(root):
    for name in tracked_files(root):
        yield from ((name, *finding) for finding in check_names(root, name))
        try:
            text = (root / name).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue  # a picture
        yield from ((name, *finding) for finding in check_text(text))
        if pathlib.PurePath(name).suffix in {".cpp", ".hpp", ".c", ".h"}:
            yield from ((name, *finding) for finding in check_source(root, name, text))
            if text.count("\n") > LONG_FILE:
                print(f"{name}: warning: {text.count(chr(10))} lines; aim at 300")


def run(checker, purpose, findings, clean):
    """The program of a checker: its findings over the tree of --root, a line each; 1 when there is one."""
    parser = argparse.ArgumentParser(description=purpose)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    root = parser.parse_args().root
    count = 0
    for name, line, rule, message in findings(root):
        print(f"{name}:{line}: {rule}: {message}")
        count += 1
    print(f"{checker}: {count} findings" if count else f"{checker}: {clean}")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(run("check_layers", "Checks layers, names and paths of the YARS tree.", findings_of, "the layers hold"))
