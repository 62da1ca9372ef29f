#!/usr/bin/env python3
"""A foreign program is made of the installed .idl files alone: idlc takes both without a word, and foreign_sweeps.c
compiles as C11 without a warning and links with Cyclone DDS.

usage: foreign_idl_test.py CMAKE BUILD CC     exit 77 where idlc or Cyclone DDS is not installed
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(__file__).resolve().with_name("foreign_sweeps.c")


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120, check=False)
    return done.returncode, (done.stdout + done.stderr).strip()


def must(what, *command):
    code, told = run(*command)
    if code != 0 or told:
        sys.exit(f"{what}: expected success without a word, found exit {code}: {told}")


def why_not():
    """Why the program cannot be built here; empty where it can."""
    if (shutil.which("idlc") is None or shutil.which("pkg-config") is None or
            run("pkg-config", "--exists", "CycloneDDS")[0] != 0):
        return "idlc or Cyclone DDS is not installed; scripts/setup --network installs both"
    return ""


def build(folder, cmake, tree, compiler, program=PROGRAM):
    """The program, made in a folder. tree: a build of YARS."""
    flags = run("pkg-config", "--cflags", "--libs", "CycloneDDS")[1].split()
    code, told = run(cmake, "--install", tree, "--component", "idl", "--prefix", folder / "prefix")
    if code != 0:
        sys.exit(f"cmake --install: expected success, found exit {code}: {told}")
    installed = folder / "prefix/share/yars/idl"
    names = sorted(file.name for file in installed.iterdir())
    if names != ["yars_network.idl", "yars_records.idl"]:
        sys.exit(f"share/yars/idl: expected yars_network.idl and yars_records.idl, found {names}")
    for name in names:
        must(name, "idlc", "-o", folder, installed / name)
    sources = [program, *sorted(folder.glob("*.c"))]
    must(program.name, compiler, "-std=c11", "-Wall", "-Wextra", "-Werror", "-I", folder, *sources, *flags, "-o",
         folder / "foreign")
    return folder / "foreign"


def main():
    if reason := why_not():
        print(f"skipped: {reason}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        foreign = build(pathlib.Path(folder), *sys.argv[1:4])
        code, told = run(foreign)  # without arguments it opens no network
        if code != 2 or "usage" not in told:
            sys.exit(f"foreign_sweeps: expected its usage and exit 2, found exit {code}: {told}")
    print("a foreign program of the .idl files compiles and links")
    return 0


if __name__ == "__main__":
    sys.exit(main())
