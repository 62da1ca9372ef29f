#!/usr/bin/env python3
"""Checks the layers of the design: which folder includes which; which folders use clocks, files and system headers; how
files are named.

usage: check_layers.py [--root DIR] [--draw]
Prints one line per finding, `file:line: rule: what was found, what is allowed`. The exit code is 1 if there is any.
--draw first writes the diagram of the folders, docs/layers.dot, and its picture. A long file gives a warning, which is
no finding. The tables below are the rules. A new folder or a new third-party header needs a row in them.
"""
import argparse
import collections
import os
import pathlib
import re
import subprocess
import sys

BASE = ["lib/text", "lib/error"]
RADAR = BASE + ["lib/values", "lib/geo", "lib/radar"]
RECORDS = RADAR + ["databuffer/messages"]
TERRAIN = RADAR + ["lib/simd", "lib/memory", "lib/random", "lib/file", "lib/imageio", "model/terrain/formats",
                   "model/terrain/sampling"]
SCENE = TERRAIN + ["model/scene/openflight", "model/scene/placement"]
PHYSICS = SCENE + ["lib/parallel", "model/physics"]
KERNEL = PHYSICS + ["databuffer/messages", "model/antenna", "model/rbm", "model/hrm", "model/kernel"]
WORLD = ["model/terrain/gdal", "model/terrain/store", "model/scene/index"]
LIBRARY = KERNEL + WORLD + ["lib/values", "radar/recording", "radar"]
# What the program of every role, and most tools, may include: records, files, log, configuration and the session.
SHELL = RECORDS + ["lib/file", "lib/imageio", "lib/log", "config/schema", "databuffer/session", "runtime"]

# Folder -> folders whose headers the folder may include in addition to its own. Lower layers stand first: a row names
# only rows above itself, so that no cycle of folders can be allowed. model, statemachine, inputmonitor and display
# never include each other; tools include model and statemachine, and tests all four.
LAYERS = {
    "lib/text": [],
    "lib/values": [],
    "lib/error": ["lib/text"],
    "lib/simd": [],
    "lib/memory": [],
    "lib/parallel": [],
    "lib/file": BASE,
    "lib/log": BASE + ["lib/file"],
    "lib/geo": BASE,
    "lib/random": ["lib/geo"],
    "lib/radar": BASE + ["lib/values", "lib/geo"],
    "lib/imageio": BASE + ["lib/file"],
    "shm": BASE + ["lib/file"],
    "databuffer/messages": RADAR,
    "config/guf": BASE,
    "config/schema": RECORDS + ["lib/file", "lib/log", "config/guf"],
    "databuffer/session": RECORDS + ["lib/file", "lib/log", "shm"],
    "databuffer/client": RECORDS + ["shm", "databuffer/session"],
    "databuffer/json": RECORDS + ["databuffer/session"],
    "world": RECORDS,
    "runtime": RECORDS + ["lib/file", "lib/log", "databuffer/session"],
    "flightmodel": RECORDS + ["lib/file"],
    "flightmodel/bridges": RECORDS + ["lib/memory", "flightmodel"],
    "flightmodel/app": SHELL + ["flightmodel", "flightmodel/bridges"],
    "model/terrain/gdal": BASE + ["lib/file"],
    "model/terrain/formats": RADAR + ["lib/memory", "lib/file", "lib/imageio"],
    "model/terrain/sampling": RADAR + ["lib/simd", "lib/memory", "model/terrain/formats"],
    "model/terrain/picture": TERRAIN,
    "model/terrain/store": TERRAIN + ["model/terrain/gdal"],
    "model/scene/openflight": RADAR + ["lib/file", "lib/memory", "model/terrain/formats"],
    "model/scene/placement": TERRAIN + ["model/scene/openflight"],
    "model/scene/index": SCENE + ["model/terrain/store"],
    "model/antenna": RADAR,
    "model/physics": SCENE,
    "model/rbm": PHYSICS,
    "model/hrm": PHYSICS,
    "model/kernel": KERNEL,
    "radar/recording": KERNEL + WORLD + ["world"],
    "radar": KERNEL + WORLD + ["config/schema", "lib/values", "radar/recording"],
    "model/app": SHELL + KERNEL + WORLD + ["world", "radar"],
    "worldgen/scene": SCENE,
    "worldgen/terrain": TERRAIN + ["model/physics", "lib/parallel"],
    "statemachine": RECORDS + ["lib/random"],
    "statemachine/app": SHELL + ["world", "statemachine"],
    "inputmonitor": RECORDS + ["lib/file", "config/schema"],
    "inputmonitor/app": SHELL + ["inputmonitor"],
    "display/symbology": RECORDS + ["lib/imageio"],
    "display/gl": RECORDS + ["lib/imageio", "display/symbology"],
    "display/host": SHELL + ["display/symbology", "display/gl"],
    "display/library": BASE + ["display/symbology", "display/host"],
    "display/app": SHELL + ["display/symbology", "display/gl", "display/host"],
    "gateway": RECORDS,
    "gateway/checks": RADAR + ["lib/file"],
    "gateway/dds": RECORDS + ["lib/file", "gateway"],
    "gateway/exchange": RECORDS + ["lib/log", "databuffer/session", "runtime", "gateway", "gateway/dds"],
    "gateway/app": SHELL + ["gateway", "gateway/checks", "gateway/dds", "gateway/exchange"],
    "station": TERRAIN + ["databuffer/messages", "world", "model/terrain/picture"],
    "station/app": SHELL + TERRAIN + ["model/terrain/picture", "flightmodel", "databuffer/json", "world",
                                      "display/symbology", "station", "radar"] + SCENE + WORLD,
    "tools/command": SHELL + LIBRARY,
    "tools/trade": SHELL + LIBRARY + ["tools/command"],
    "tools/scan": SHELL + LIBRARY + ["tools/command"],
    "tools/patch": SHELL + LIBRARY + ["tools/command"],
    "tools/terrain": SHELL + LIBRARY + ["model/terrain/picture", "worldgen/terrain", "tools/command"],
    "tools/scene": SHELL + LIBRARY + ["worldgen/scene", "tools/command"],
    "tools/dataset": SHELL + ["tools/command"],
    "tools/session": SHELL + LIBRARY + ["databuffer/json", "world", "statemachine", "tools/command"],
    "tools": SHELL + ["gateway/checks", "tools/command", "radar"],
    "python/core": SHELL + LIBRARY + ["tools/command", "tools/trade", "tools/scene", "tools/terrain"],
    "examples": ["databuffer/client"],
    "tests": None,  # None: everything
}

# Shells: folders that may use the segment, the log and clocks. They have the programs, and code that programs share.
SHELLS = ["lib/log", "databuffer/session", "runtime", "flightmodel/app", "databuffer/client", "model/app",
          "statemachine/app", "inputmonitor/app", "display/host", "display/library", "display/app",
          "gateway/exchange", "gateway/app", "station/app", "databuffer/json", "tools", "python/core", "tests",
          "examples"]

# Third-party and system headers: a header, or a folder of headers with "/" at the end -> who may include it: folders,
# single files, or "shells" for SHELLS.
SYSTEM_HEADERS = {
    "GeographicLib/": ["lib/geo", "tests"],
    "tl/": ["lib/error"],
    "png.h": ["lib/imageio", "tests"],
    "openjpeg.h": ["model/terrain/formats"],
    "zip.h": ["model/terrain/formats", "tests"],
    "zlib.h": ["model/terrain/formats", "radar/recording", "tests"],
    "zstd.h": ["radar/recording"],
    "arpa/": ["flightmodel/app", "gateway/checks", "gateway/dds", "tests"],
    "netinet/": ["flightmodel/app", "gateway/checks", "gateway/dds", "tests"],
    "openssl/": ["gateway/checks", "gateway/dds"],
    "net/": ["flightmodel/app", "gateway/checks"],
    "sys/mman.h": ["lib/memory", "shells", "shm"],
    "gdal.h": ["model/terrain/gdal", "tests"],
    "gdal_utils.h": ["tests"],
    "proj.h": ["model/terrain/gdal", "tests"],
    "ext/": ["runtime"],
    "dds/": ["gateway/dds", "tests"],
    "cpl_vsi.h": ["model/terrain/gdal"],
    "cpl_conv.h": ["model/terrain/gdal", "tests"],
    "cpl_error.h": ["model/terrain/gdal", "tests"],
    "ogr_srs_api.h": ["model/terrain/gdal", "tests"],
    "boost/": ["shm", "station/app", "tests"],
    "epoxy/": ["display/gl", "examples", "tests"],
    "dlfcn.h": ["display/gl/context.cpp", "lib/file/text_file.cpp", "model/terrain/gdal/gdal_library.cpp"],
    "EGL/": ["display/gl"],
    "glm/": ["lib/geo", "lib/radar", "model/scene/openflight"],
    "xxhash.h": ["model/kernel", "databuffer/messages", "radar", "python/core"],
    "yars/": ["examples", "tests"],  # headers for programs of others, as they are installed
    "hwy/": ["lib/simd", "lib/random", "model/terrain/sampling", "model/physics", "model/rbm", "model/hrm", "tests"],
    "embree3/": ["tests"],
    "GLFW/": ["display/gl", "inputmonitor/keyboard_source.cpp", "databuffer/messages/key_map.cpp"],
    "spdlog/": ["shells"],
    "CLI/": ["runtime"],
    "nlohmann/": ["databuffer/json", "world", "station", "tools", "tests"],
    "pybind11/": ["python/core"],
    "gtest/": ["tests"],
    "gmock/": ["tests"],
    "benchmark/": ["tests"],
    "chrono": ["shells", "lib/parallel/thread_pool.cpp"],
    "csignal": ["shells"],
    "linux/input-event-codes.h": ["config/schema", "inputmonitor", "tests"],
    "iostream": ["shells"],
}
# Folders that may include all other POSIX and Linux headers (with .h), by which code reaches outside of its process.
POSIX_FOLDERS = ["lib/file", "shm", "inputmonitor", "gateway/checks", "gateway/dds", "radar/recording", "shells"]

CLOCKS = re.compile(r"\b(std::chrono::\w+_clock|clock_gettime|gettimeofday|clock_nanosleep|nanosleep|usleep|sleep_for"
                    r"|sleep_until|std::time\s*\(|monotonic_ns\s*\()")
# The pool times its threads to leave them alone on a busy machine; what they compute does not depend on it.
CLOCK_FOLDERS = ["shm", "shells", "lib/parallel/thread_pool.cpp"]

# Text that opens a file or lists a folder: allowed only in sources whose path matches one of READERS.
OPENING = re.compile(r"\bstd::[io]?fstream\b|\bfopen\b|(?<![\w>])::(open|openat|mmap)\b"
                     r"|\bstd::filesystem::(recursive_)?directory_iterator\b")
READERS = [re.compile(pattern) for pattern in (
    r"_(main|shell)\.[ch]pp$",
    r"^(config/schema/load|runtime/processor_load|databuffer/session/participant|inputmonitor/device_source"
    r"|lib/imageio/png|model/terrain/formats/cell_reading|model/terrain/store/cell_files|shm/segment_file)\.cpp$",
    r"^(lib/file|radar/recording|tools|tests|examples)/",
)]

# Text that makes files or folders: allowed only in WRITERS. Product code makes them in lib/file and segment_file.cpp.
# Protection against links planted by others is needed only there. load.cpp has a function rename() of its own.
WRITING = re.compile(r'\bstd::ofstream\b|\bfopen\([^;]*"[wa]|\bO_CREAT\b|\bmkstemp\b|\bmkdir(at)?\s*\('
                     r"|\brename(at)?\s*\(|\bstd::filesystem::(create_director\w+|rename|copy\w*)\b"
                     r"|\b\w+_file_sink\w*\b")
WRITERS = ("lib/file/", "shm/segment_file.cpp", "tests/", "examples/", "config/schema/load.cpp")

HEAVY_IN_HEADERS = ("iostream", "boost/", "spdlog/")
# May include them. Only shm/segment.cpp and its test include the first. The others are of the server over connections,
# whose types are those of Boost.Beast.
HEAVY_HEADERS = {"shm/segment_file.hpp", "station/app/connection_shell.hpp", "station/app/page_shell.hpp"}
# made by flex and bison in the build folder
GENERATED_HEADERS = {"guf_lexer.hpp", "guf_parser.hpp", "message_lexer.hpp", "message_parser.hpp"}

# made by lib/values/generate.py in the build folder, beside one header for each IDL file of the records
MADE_HEADERS = {"databuffer/messages/record_checks.hpp", "databuffer/messages/shown_fields.hpp",
                "databuffer/messages/world_lists.hpp", "databuffer/session/session_containers.hpp",
                "databuffer/client/yars_records_check.hpp"}
# made by idlc in the build folder
MADE_HEADERS |= {"gateway/dds/yars_network.h", "gateway/dds/yars_records.h", "lib/values/fields.hpp",
                 "lib/values/defaults.hpp", "lib/values/presets.hpp"}
# Folders with a subfolder yars/ of headers that are installed as <yars/...>, and such a header that the build makes.
PUBLIC_FOLDERS = ["lib/error", "radar"]
MADE_PUBLIC = {"yars/requests.hpp": "lib/values/fields.hpp"}
GENERATED = "Generated by lib/values/generate.py"  # in the head of each generated file that is in the tree
CLIENT = "databuffer/client"  # its headers include one another without a path, because users copy them anywhere

# Sources without a header of their own, by the beginning of their path; after each, where their functions are declared.
FAMILIES = ("config/schema/forms_",  # schema.hpp
            "worldgen/scene/",  # scene_builder.hpp
            "model/terrain/gdal/gdal_absent.cpp",  # raster.hpp and map_writer.hpp
            "tools/")  # commands: tools/command/command.hpp and those of their folders
DIAGRAM = "docs/layers.dot"

FORBIDDEN_FOLDERS = {"common", "utils", "util", "misc", "helpers"}
SOURCES = {".cpp", ".hpp", ".c", ".h", ".l", ".y", ".ll", ".yy"}
LONG_FILE = 400  # [lines]
# Assembled, so that this file passes its own rule.
MACHINE_PATHS = re.compile("(?<![\\w.}])/(" + "|".join(["work", "home", "root", "Users"]) + r")/\w")
REGISTRIES = re.compile(r"\b(" + "|".join(
    [r"deb\.debian", r"security\.debian", r"archive\.ubuntu", r"snapshot\.debian"]) + r")\.(org|com)|\b("
    + "|".join([r"pypi", r"files\.pythonhosted", r"crates", r"registry\.npmjs", r"proxy\.golang"]) + r")\.(org|io)\b")


def tracked_files(root):
    """All files of the project: those that git tracks or would add. Without git: all files outside of build/."""
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
    """The layer of a file: the longest row of LAYERS with which its path begins; None if there is no such row."""
    rows = [row for row in LAYERS if name.startswith(row + "/")]
    return max(rows, key=len) if rows else None


def is_among(name, places):
    """True if a file lies in one of the folders, is one of the files, or is in SHELLS and `places` has "shells"."""
    wanted = [place for place in places if place != "shells"] + (SHELLS if "shells" in places else [])
    return any(name == place or name.startswith(place + "/") for place in wanted)


def description_of(root, header):
    """The IDL file from which the build makes this header, or None."""
    name = f"lib/values/{pathlib.PurePath(header).stem}.idl"
    return name if header.startswith("databuffer/messages/") and (root / name).is_file() else None


def file_of(root, header):
    """The file from the top of the tree that an include names: "yars/scan.hpp" is radar/yars/scan.hpp."""
    if header in MADE_PUBLIC:
        return MADE_PUBLIC[header]
    found = [f"{folder}/{header}" for folder in PUBLIC_FOLDERS
             if header.startswith("yars/") and (root / folder / header).is_file()]
    return found[0] if found else header


def without_comments(text):
    """The text with blanks in place of comments, and of what looks like one in a string. Line numbers do not change."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    return re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)


def check_project_include(root, name, folder, header):
    if header in GENERATED_HEADERS and folder in ("config/guf", "config/schema"):
        return
    if folder == CLIENT and (root / CLIENT / header).is_file():
        return
    header = file_of(root, header)
    if not (root / header).is_file() and header not in MADE_HEADERS and not description_of(root, header):
        yield "include", f'"{header}" is not a file from the top of the tree; name headers from there'
        return
    target = folder_of(header)
    allowed = LAYERS[folder]
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
    # Highway (SIMD library) includes an -inl.hpp once for each instruction set, so #pragma once would be wrong there.
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
            yield number, "clock", f"{clock.group()} outside of the folders that may read a clock (CLOCK_FOLDERS)"
        opening = OPENING.search(line)
        if opening and not any(reader.search(name) for reader in READERS):
            yield number, "reader", f"{opening.group()} opens files; only READERS of check_layers.py do"
        writing = WRITING.search(line)
        if writing and not name.startswith(WRITERS):
            yield number, "writer", f"{writing.group()} makes files; lib/file/output_file.hpp does that for all"


def product_sources(root):
    return [name for name in tracked_files(root) if name.endswith((".cpp", ".hpp", ".c", ".h", ".l", ".y"))
            and not name.startswith(("tests/", "examples/"))]


def check_names(root, name):
    path = pathlib.PurePath(name)
    for part in path.parts[:-1]:
        if part in FORBIDDEN_FOLDERS:
            yield 1, "name", f"a folder '{part}' says nothing of its contents"
    if path.suffix not in SOURCES:
        return
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*(-inl)?", path.stem):
        yield 1, "name", f"expected lower_snake, found '{path.name}'"
    unpaired = name.startswith(("tests/", "examples/", *FAMILIES)) or name.endswith(("_main.cpp", "_shell.cpp"))
    headers = [path.with_suffix(".hpp"), path.parent / "yars" / f"{path.stem}.hpp"]
    if path.suffix == ".cpp" and not unpaired and not any((root / header).is_file() for header in headers):
        yield 1, "pair", f"no header {path.stem}.hpp beside it"


def includes(root, names):
    """{file: list of the project files that it includes}"""
    known = set(names)
    pattern = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
    text = {name: (root / name).read_text(errors="replace") for name in names}
    described = {header: description_of(root, header) for headers in text for header in pattern.findall(text[headers])}
    found = {name: [header if header in known else described[header] for header in pattern.findall(text[name])
                    if header in known or described[header]] for name in names}
    return {**found, **{idl: [] for idl in described.values() if idl}}


def owners_of(graph):
    """{-inl header: the unit that it belongs to}: the unit of the same name, else the only unit that includes it."""
    users = collections.defaultdict(set)
    for name, headers in graph.items():
        for header in headers:
            if header.endswith("-inl.hpp"):
                users[header].add(name)
    owners = {}
    for _ in range(len(users)):  # an -inl may include another
        for header, names in users.items():
            named = header.removesuffix("-inl.hpp")
            found = {named} if named + ".hpp" in graph else {unit_of(name, owners) for name in names}
            if len(found) == 1:
                owners[header] = found.pop()
    return owners


def unit_of(name, owners):
    """Name of a file's unit: a header and its source, with the -inl headers that only they include."""
    return owners.get(name) or str(pathlib.PurePath(name).with_suffix(""))


def groups(graph):
    """Groups of two or more nodes that reach one another: strongly connected components by Tarjan's algorithm."""
    index, low, stack, on_stack, found = {}, {}, [], set(), []
    for root in graph:
        if root in index:
            continue
        work = [(root, iter(graph[root]))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, following = work[-1]
            for target in following:
                if target not in index:
                    index[target] = low[target] = len(index)
                    stack.append(target)
                    on_stack.add(target)
                    work.append((target, iter(graph[target])))
                    break
                if target in on_stack:
                    low[node] = min(low[node], index[target])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    group = []
                    while True:
                        member = stack.pop()
                        on_stack.discard(member)
                        group.append(member)
                        if member == node:
                            break
                    if len(group) > 1:
                        found.append(sorted(group))
    return sorted(found, key=len, reverse=True)


def joined(graph, name_of):
    """The graph in which all nodes with the same `name_of` are one node. Arrows within a node are left out."""
    result = collections.defaultdict(set)
    for node, targets in graph.items():
        result[name_of(node)].update(name_of(target) for target in targets)
    return {node: targets - {node} for node, targets in result.items()}


def check_cycles(root, names):
    graph = includes(root, names)
    owners = owners_of(graph)
    for kind, name_of in (("folders", lambda name: str(pathlib.PurePath(name).parent)),
                          ("units", lambda name: unit_of(name, owners))):
        for group in groups(joined(graph, name_of)):
            yield group[0], 1, "cycle", f"{kind} that include one another: {', '.join(group)}"
    rows = list(LAYERS)
    for place, (row, allowed) in enumerate(LAYERS.items()):
        for other in allowed or []:
            if other not in rows[:place] and other != row:
                yield "scripts/check_layers.py", 1, "table", f"{row} may include {other}, which stands below it"


def diagram(root, names):
    """The folders and their includes in Graphviz' language. An arrow that follows from other arrows is left out."""
    graph = joined({name: headers for name, headers in includes(root, names).items()
                    if LAYERS[folder_of(name)] is not None}, folder_of)
    below = {folder: graph.get(folder, set()) for folder in LAYERS if folder in graph}
    reached = {}
    for folder in below:  # lower ones first
        reached[folder] = set(below[folder]).union(*(reached.get(other, set()) for other in below[folder]))
    lines = ["// Made by scripts/check_layers.py --draw: who includes whom. "
             "An arrow that follows from others is left out.",
             "digraph layers {",
             '  graph [rankdir=TB, nodesep=0.2, ranksep=0.5, fontname="Helvetica", fontsize=11]',
             '  node [shape=box, style="rounded,filled", fillcolor="#e8f2ea", color="#4a7a55", '
             'fontname="Helvetica", fontsize=10]',
             '  edge [color="#777777", arrowsize=0.6]']
    tops = collections.defaultdict(list)
    for folder in below:
        tops[folder.split("/")[0]].append(folder)
    for top, folders in tops.items():
        lines.append(f'  subgraph "cluster_{top}" {{ label="{top}"; style="rounded"; color="#aaaaaa"')
        lines += [f'    "{folder}" [label="{folder.removeprefix(top + "/")}"]' for folder in folders]
        lines.append("  }")
    for folder, others in below.items():
        direct = [other for other in others if not any(other in reached.get(third, ()) for third in others)]
        lines += [f'  "{folder}" -> "{other}"' for other in sorted(direct)]
    return "\n".join(lines + ["}", ""])


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
            continue  # no text, such as a picture
        yield from ((name, *finding) for finding in check_text(text))
        if pathlib.PurePath(name).suffix in {".cpp", ".hpp", ".c", ".h"}:
            yield from ((name, *finding) for finding in check_source(root, name, text))
            if text.count("\n") > LONG_FILE and GENERATED not in text[:500]:
                print(f"{name}: warning: {text.count(chr(10))} lines; aim at 300")
    names = product_sources(root)
    yield from check_cycles(root, names)
    drawing = root / DIAGRAM
    if drawing.is_file() and drawing.read_text() != diagram(root, names):
        yield DIAGRAM, 1, "diagram", "expected the folders of today; run scripts/check_layers.py --draw"


def draw(root):
    """Writes the diagram and its picture. Without Graphviz the program ends with an error after the diagram."""
    (root / DIAGRAM).write_text(diagram(root, product_sources(root)))
    picture = (root / DIAGRAM).parent / "pictures" / "layers.png"
    try:
        subprocess.run(["dot", "-Tpng", "-Gdpi=110", "-o", str(picture), str(root / DIAGRAM)], check=True)
    except FileNotFoundError:
        sys.exit("check_layers: expected dot of Graphviz for the picture, found none; run scripts/setup --full")


def run(checker, purpose, findings, clean, draw=None):
    """Main program of a checker: prints the findings in the tree of --root, one per line. Returns 1 if there is any.

    `draw`: called first if the command line has --draw.
    """
    parser = argparse.ArgumentParser(description=purpose)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    if draw:
        parser.add_argument("--draw", action="store_true", help=f"rewrite {DIAGRAM} and its picture")
    options = parser.parse_args()
    root = options.root
    if draw and options.draw:
        draw(root)
    count = 0
    for name, line, rule, message in findings(root):
        print(f"{name}:{line}: {rule}: {message}")
        count += 1
    print(f"{checker}: {count} finding{'' if count == 1 else 's'}" if count else f"{checker}: {clean}")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(run("check_layers", "Checks layers, names and paths of the YARS tree.", findings_of, "the layers hold",
                 draw))
