#!/usr/bin/env python3
"""Cyclone DDS's idlc takes lib/values/records.idl without a word: it is standard IDL. Its C structures have the
fields that the generator reads. Exit 77 where idlc is not installed."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
RECORDS = pathlib.Path(__file__).resolve().parents[3] / "lib/values/records.idl"
sys.path.insert(0, str(RECORDS.parent))
from generator import idl, schema  # noqa: E402


def idlc(file, folder):
    run = subprocess.run(["idlc", "-o", folder, str(file)], capture_output=True, text=True, timeout=60, check=False)
    return run.returncode, (run.stdout + run.stderr).strip()


def main():
    if shutil.which("idlc") is None:
        print("skipped: idlc is not installed; scripts/setup --test installs it (package cyclonedds-tools)")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        # In one piece: idlc writes structures only for what stands in the file itself.
        whole = pathlib.Path(folder, "records.idl")
        include = re.compile(r'^#include "([^"]+)"$', re.M)
        whole.write_text(include.sub(lambda found: (RECORDS.parent / found.group(1)).read_text(encoding="utf-8"),
                                     RECORDS.read_text(encoding="utf-8")), encoding="utf-8")
        for file in (RECORDS, whole):
            code, told = idlc(file, folder)
            if code != 0 or told:
                break
        if code != 0 or told:
            print(f"records.idl: expected that idlc takes it without a word, found exit {code}: {told}")
            return 1
        structures = pathlib.Path(folder, "records.h").read_text(encoding="utf-8")
        for one in schema.records_of(idl.read(RECORDS.parent)):
            body = re.search(rf"typedef struct yars_{one.name}\n\{{\n(.*?)\n\}} yars_{one.name};", structures, re.S)
            found = re.findall(r"(\w+)((?:\[\d+\])*);", body.group(1)) if body else []
            expected = [(field.name, re.sub(r"^\w+", "", schema.type_text(field))) for field in one.fields]
            if found != expected:
                print(f"{one.name}: expected of idlc {expected}, found {found}")
                return 1
        # That silence says something: a fault is told.
        faulty = pathlib.Path(folder, "faulty.idl")
        faulty.write_text("module yars { struct Place { @range(min=1.0, max=0.0) double latitude_deg; }; };\n",
                          encoding="utf-8")
        if idlc(faulty, folder)[0] == 0:
            print("idlc: expected a fault for a wrong range, found none")
            return 1
    print("records.idl: idlc takes it")
    return 0


sys.exit(main())
