#!/usr/bin/env python3
"""A suite of packages that YARS is not meant for is refused before anything is downloaded, by scripts/setup and
scripts/check_fresh; --any-suite goes on. Programs that download are stand-ins here, and so is /etc/os-release, in a
mount namespace.
What scripts/setup installs on Ubuntu 24.04 is in packaging/ubuntu-24.04.tsv;
where CMake states a least version, it is that or later.

usage: suites_test.py       ends with 77 and a word where it may not mount
"""
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
UBUNTU = TOP / "packaging/ubuntu-24.04.tsv"
STAND_IN = '#!/bin/sh\necho "$0 $*" >>"{log}"\n'


def run(folder, suite, *command):
    """(exit code, output, calls of programs that download) with a system of that suite."""
    log = folder / "calls"
    log.unlink(missing_ok=True)
    (folder / "os-release").write_text(f"ID=debian\nVERSION_CODENAME={suite}\n")
    for name in ("apt-get", "debootstrap", "sudo"):
        program = folder / name
        program.write_text(STAND_IN.format(log=log))
        program.chmod(0o755)
    # Nothing is installed for this computer, all for another architecture.
    (folder / "dpkg-query").write_text('#!/bin/sh\nfor word; do echo "installed $word s390x"; done\n')
    (folder / "dpkg-query").chmod(0o755)
    script = 'mount --bind "$0/os-release" /etc/os-release && PATH="$0:$PATH" exec "$@"'
    done = subprocess.run(["unshare", "--mount", "sh", "-c", script, folder, *map(str, command)], capture_output=True,
                          text=True, timeout=60, check=False)
    return done.returncode, done.stdout + done.stderr, log.read_text() if log.exists() else ""


def number(version):
    """The upstream part of a Debian version as numbers: 1:3.20-2 gives (3, 20)."""
    upstream = re.sub(r"^\d+:", "", version)
    return tuple(map(int, re.match(r"\d+(?:\.\d+)*", upstream).group().split(".")))


def check_ubuntu(installed):
    """Each package that scripts/setup installs on Ubuntu 24.04 has a row with version and source."""
    rows = [line.split("\t") for line in UBUNTU.read_text().splitlines() if not line.startswith("#")]
    assert all(len(row) == 4 and row[2] in ("main", "universe") and row[3].startswith("https://") for row in rows), rows
    versions = {name: number(version) for name, version, _, _ in rows}
    assert len(versions) == len(rows) and list(versions) == sorted(versions), "expected each name once, in order"
    differing = (versions.keys() ^ installed) - {"npm"}  # which is not installed beside a Node.js of one's own
    assert not differing, (f"expected the packages of scripts/setup in {UBUNTU.name}, "
                           f"found in one of the two alone: {differing}")
    lists = (TOP / "CMakeLists.txt").read_text()
    cmake = re.search(r"cmake_minimum_required\(VERSION ([\d.]+)\)", lists).group(1)
    boost = re.search(r"find_package\(Boost ([\d.]+)", lists).group(1)
    pybind = re.search(r"find_package\(pybind11 ([\d.]+)", (TOP / "python/CMakeLists.txt").read_text()).group(1)
    openssl = re.search(r"find_package\(OpenSSL ([\d.]+)", (TOP / "station/CMakeLists.txt").read_text()).group(1)
    for name, least in (("cmake", cmake), ("libboost-dev", boost), ("pybind11-dev", pybind), ("libssl-dev", openssl)):
        assert versions[name] >= number(least), f"{name}: expected {least} or later, found {versions[name]}"


def main():
    if subprocess.run(["unshare", "--mount", "true"], capture_output=True, check=False).returncode != 0:
        print("skipped: expected the right to mount, found none; run as root")
        return 77
    setup, fresh = TOP / "scripts/setup", TOP / "scripts/check_fresh"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for words in ((), ("--test",)):
            code, text, calls = run(folder, "bullseye", setup, *words)
            assert code == 1 and calls == "" and "found bullseye" in text, (code, text, calls)
            assert all(suite in text for suite in ("bookworm", "trixie", "noble", "--any-suite")), text
            code, text, calls = run(folder, "bullseye", setup, "--any-suite", *words)
            assert (code == 0 and "apt-get" in calls and "install" in calls and
                    "libboost-dev" in calls), (code, text, calls)
        for suite in ("bookworm", "trixie", "noble"):
            code, text, calls = run(folder, suite, setup)
            assert code == 0 and "install" in calls, (suite, code, text, calls)
        _, _, calls = run(folder, "noble", setup, "--test")
        words = next(line for line in calls.splitlines() if " install " in line).split()[2:]
        options = {word for at, word in enumerate(words) if word.startswith("-") or words[at - 1] == "-o"}
        check_ubuntu(set(words) - options)
        code, text, calls = run(folder, "bookworm", fresh, "--suite", "woody")
        assert code == 1 and calls == "" and "found woody" in text and "bookworm trixie" in text, (code, text, calls)
        code, text, calls = run(folder, "bookworm", fresh, "--memory", "much")
        assert code == 1 and calls == "" and "4G" in text, (code, text, calls)
    return 0


if __name__ == "__main__":
    sys.exit(main())
