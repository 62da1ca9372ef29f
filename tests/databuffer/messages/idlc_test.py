#!/usr/bin/env python3
"""Cyclone DDS's idlc takes databuffer/messages/records.idl without a word: it is standard IDL. Exit 77 where idlc is not."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

RECORDS = pathlib.Path(__file__).resolve().parents[3] / "databuffer/messages/records.idl"


def idlc(file, folder):
    run = subprocess.run(["idlc", "-o", folder, str(file)], capture_output=True, text=True, timeout=60, check=False)
    return run.returncode, (run.stdout + run.stderr).strip()


def main():
    if shutil.which("idlc") is None:
        print("skipped: idlc is not installed; scripts/setup --test installs it (package cyclonedds-tools)")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        code, told = idlc(RECORDS, folder)
        if code != 0 or told:
            print(f"records.idl: expected that idlc takes it without a word, found exit {code}: {told}")
            return 1
        structures = pathlib.Path(folder, "records.h").read_text(encoding="utf-8")
        missing = [name for name in ("yars_Ownship", "yars_RadarState", "yars_ModelStatus", "yars_Note") if f"}} {name};" not in structures]
        # That silence says something: a fault is told.
        faulty = pathlib.Path(folder, "faulty.idl")
        faulty.write_text("module yars { struct Place { @range(min=1.0, max=0.0) double latitude_deg; }; };\n", encoding="utf-8")
        if missing or idlc(faulty, folder)[0] == 0:
            print(f"idlc: expected structures for all records and a fault for a wrong range, found {missing or 'none'}")
            return 1
    print("records.idl: idlc takes it")
    return 0


sys.exit(main())
