#!/usr/bin/env python3
"""Builds the .debs and the wheel of a release on the system that it runs on, and lists what they depend on.

usage: build_suite.py OUT JOBS [CMAKE_OPTION...]     in the unpacked source archive, with SOURCE_DATE_EPOCH
`scripts/release` runs it, here or in a root of another suite. OUT gets the files and parts.json.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = SOURCE / "build/release"
sys.path += [str(SOURCE / "packaging/pip"), str(SOURCE / "packaging/release")]
# Program -> Debian package. dpkg-shlibdeps is quiet about what it lacks, so they are looked for first.
TOOLS = {"cmake": "cmake", "cpack": "cmake", "ninja": "ninja-build", "dpkg-shlibdeps": "dpkg-dev", "dpkg-deb": "dpkg",
         "file": "file"}


def run(*command):
    if subprocess.run([str(word) for word in command], cwd=SOURCE, check=False).returncode != 0:
        sys.exit(f"build_suite.py: {' '.join(map(str, command[:3]))} failed; its messages stand above")


def check_tools():
    missing = sorted({package for name, package in TOOLS.items() if not shutil.which(name)})
    if missing:
        sys.exit(f"build_suite.py: expected {', '.join(TOOLS)}, found not all; apt-get install {' '.join(missing)}")


def build(jobs, options):
    """All parts: a release does not depend on what happens to be installed.
    Libraries lie where Debian's packages have them."""
    triplet = subprocess.run(["dpkg-architecture", "-qDEB_HOST_MULTIARCH"], capture_output=True, text=True,
                             check=True).stdout.strip()
    run("cmake", "--preset", "release", "-DYARS_TESTS=OFF", "-DYARS_GDAL=ON", "-DYARS_GATEWAY=ON", "-DYARS_PYTHON=ON",
        f"-DCMAKE_INSTALL_LIBDIR=lib/{triplet}", *options)
    run("cmake", "--build", BUILD, "--parallel", jobs)


def main(out, jobs, *options):
    import debian_parts
    import yars_backend
    check_tools()
    build(jobs, options)
    run("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", out)
    out = pathlib.Path(out)
    shutil.rmtree(out / "_CPack_Packages", ignore_errors=True)
    wheel = yars_backend.build_wheel(out, {"build-folder": str(BUILD)})
    system = dict(line.split("=", 1) for line in pathlib.Path("/etc/os-release").read_text().splitlines()
                  if "=" in line)
    parts = {package.name: debian_parts.parts_of(package) for package in sorted(out.glob("*.deb"))}
    about = {"system": f"{system.get('ID', 'unknown')}-{system.get('VERSION_ID', 'unknown')}".replace('"', ""),
             "wheel": wheel, "packages": parts}
    (out / "parts.json").write_text(json.dumps(about, indent=1, sort_keys=True) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 3 or "SOURCE_DATE_EPOCH" not in os.environ:
        sys.exit("build_suite.py: expected OUT, JOBS and SOURCE_DATE_EPOCH; scripts/release runs it")
    main(*sys.argv[1:])
