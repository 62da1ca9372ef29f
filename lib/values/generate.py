#!/usr/bin/env python3
"""Generates code and tables from the IDL of the records (records.idl in this folder).

usage: generate.py --build FOLDER   the C++ headers and sources, and the IDL for DDS, into FOLDER; the build calls it
       generate.py --fields FOLDER  what people give: <yars/requests.hpp>, tables of fields, defaults, presets, into
                                    FOLDER
       generate.py --tables FILE    the page of all records, fields and values, in Markdown; needs no build
       generate.py --write YARS     layout.tsv in this folder, databuffer/client/yars_records.h,
                                    station/web/src/values.ts; the marked parts of docs/commands.md and, in
                                    python/yars/, session.py, results.pyi and dataset/keys.py; the table of writers in
                                    docs/shared_memory.md; the lists of presets in the files that generator/presets.py
                                    names
       generate.py --check YARS     checks that these files equal what --write would write; exit 1 if not
YARS is the command `yars` built from the same records, such as build/dev/bin/yars. It prints the offsets of the
segment's containers (`yars status --layout`). A fault in the IDL is reported in one line: file:line, what was expected,
what was found, what to do. The exit code is then 1.
"""
import json
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from generator import clients, cpp, dds, fields, idl, presets, schema, segment, stability, tables  # noqa: E402

ROOT = HERE.parents[1]
HEADER = "databuffer/client/yars_records.h"
PYTHON = "python/yars/session.py"
STUBS = {"python/yars/results.pyi": ("ScanRequest", "PatchRequest", "ScanTradeRequest", "MapTradeRequest"),
         "python/yars/places.pyi": ("TerrainGeneration", "SceneGeneration")}
KEYS = "python/yars/dataset/keys.py"
PAGES = "station/web/src/values.ts"
COMMANDS = "docs/commands.md"
LAYOUT = "lib/values/layout.tsv"
BEGIN, END = "# begin: lib/values/generate.py\n", "# end: lib/values/generate.py\n"  # the part of PYTHON


class StaleError(Exception):
    pass


def write_if_changed(path, text):
    """Writes a changed file. An unchanged one keeps its time stamp, so that the build compiles nothing again."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def described_segment():
    return idl.read(HERE, "segment.idl")[-1].declarations[-1]


def build(folder, chapters):
    made = {**cpp.files(chapters), **segment.files(described_segment())}
    made["databuffer/client/yars_records_check.hpp"] = clients.c_asserts(chapters)
    made[fields.LISTS] = fields.lists_header(chapters)
    made["gateway/yars_records.idl"] = dds.idl(chapters)
    made["gateway/dds/yars_records_check.cpp"] = dds.asserts(chapters)
    write_all(folder, made)


def write_all(folder, made):
    for name, text in made.items():
        write_if_changed(folder / name, text)


def layout_of(program, chapters):
    """The layout that the program prints. Raises StaleError if its records differ from those of the IDL."""
    try:
        printed = subprocess.run([program, "status", "--layout"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as problem:
        raise StaleError(f"{program}: expected `{program} status --layout` to print the layout, found: {problem}; "
                         "build it: cmake --build build/dev --target yars") from None
    layout = json.loads(printed)
    for one in schema.records_of(chapters):
        expected = {field.name: [field.offset, field.size] for field in one.fields if not field.reserved}
        if layout["records"].get(one.name, {}).get("fields") != expected:
            raise StaleError(f"{program}: expected the {one.name} of {HERE.name}/records.idl, found another; "
                             "build it anew: cmake --build build/dev --target yars")
    return layout


def with_part(name, text, part, begin=BEGIN, end=END):
    """Text of the file with `part` between its marks. StaleError if a mark is absent."""
    before, found, rest = text.partition(begin)
    _, closed, after = rest.partition(end)
    if not found or not closed:
        raise StaleError(f"{name}: expected the lines '{begin.strip()}' and '{end.strip()}', found not both; "
                         "put them back")
    return before + begin + part + end + after


def text_of(path):
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def preset_kinds():
    return next(one for one in idl.read(HERE, "presets.idl")[-1].declarations if one.name == "Preset")


def tree_files(chapters, layout, root):
    """{path of a generated file: (its present text, its generated text)}"""
    made = {LAYOUT: stability.text(chapters, layout), HEADER: clients.c_header(chapters, layout)}
    python = text_of(root / PYTHON)
    made[PYTHON] = with_part(PYTHON, python, clients.python_records(chapters))
    requests = idl.read(HERE, "requests.idl")
    stubs = fields.stubs(requests[-1])
    for file, names in STUBS.items():
        made[file] = text_of(root / file)
        for name in names:
            made[file] = with_part(file, made[file], stubs[name], f"        # begin: lib/values/generate.py, {name}\n",
                                   f"        # end: {name}\n")
    keys = with_part(KEYS, text_of(root / KEYS), "")
    made[KEYS] = with_part(KEYS, keys, fields.python_values(chapters, requests, keys))
    made[COMMANDS] = with_part(COMMANDS, text_of(root / COMMANDS), fields.lists_table(chapters),
                               f"<!-- {BEGIN[2:-1]} -->\n", f"<!-- {END[2:-1]} -->\n")
    kinds = preset_kinds()
    try:
        made[PAGES] = fields.typescript(chapters, requests) + presets.typescript(kinds, text_of(root / presets.PAGE))
    except KeyError as name:
        raise StaleError(f"{presets.PAGE}: expected a row of the preset {name} in the first table of `Speed against "
                         "accuracy`, found none; measure it with `yars trade`") from None
    made[segment.PAGE] = with_part(segment.PAGE, text_of(root / segment.PAGE), segment.writers(described_segment()),
                                   segment.TABLE, segment.END)
    known = presets.names(kinds)
    for name in presets.LISTS:
        text = made[name] if name in made else text_of(root / name)
        if not presets.has_list(text, known):
            raise StaleError(f"{name}: expected a list of the presets {', '.join(known)}, found none; write one, or "
                             "take the file out of LISTS in generator/presets.py")
        made[name] = presets.listed(text, known)
    return {name: (text_of(root / name), text) for name, text in made.items()}


def main(arguments):
    if len(arguments) != 2 or arguments[0] not in ("--build", "--fields", "--tables", "--write", "--check"):
        sys.exit(__doc__)
    what, where = arguments
    if what == "--fields":
        made = fields.files(idl.read(HERE), idl.read(HERE, "requests.idl"))
        return write_all(pathlib.Path(where), {**made, presets.HEADER: presets.header(preset_kinds())})
    chapters = idl.read(HERE)
    if what == "--build":
        return build(pathlib.Path(where), chapters)
    if what == "--tables":
        return write_if_changed(pathlib.Path(where),
                                tables.document(chapters, (ROOT / LAYOUT).read_text(encoding="utf-8")))
    layout = layout_of(where, chapters)
    files = tree_files(chapters, layout, ROOT)
    stability.check(*files[LAYOUT])
    stale = [name for name, (found, expected) in files.items() if found != expected]
    if what == "--write":
        for name in stale:
            (ROOT / name).write_text(files[name][1], encoding="utf-8")
            print(f"{name}: written")
    elif stale:
        raise StaleError(f"{', '.join(stale)}: expected what the IDL says, found otherwise; "
                         f"run lib/values/generate.py --write {where}")
    return None


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (schema.IdlError, StaleError, stability.MovedError) as fault:
        sys.exit(f"generate.py: {fault}")
