#!/usr/bin/env python3
"""A suite of packages that YARS is not meant for is refused before anything is downloaded, by scripts/setup and scripts/check_fresh;
--any-suite goes on. Programs that download are stand-ins here, and so is /etc/os-release, in a mount namespace.

usage: suites_test.py       ends with 77 and a word where it may not mount
"""
import pathlib
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
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
    (folder / "dpkg-query").write_text("#!/bin/sh\n")  # nothing is installed
    (folder / "dpkg-query").chmod(0o755)
    script = 'mount --bind "$0/os-release" /etc/os-release && PATH="$0:$PATH" exec "$@"'
    done = subprocess.run(["unshare", "--mount", "sh", "-c", script, folder, *map(str, command)], capture_output=True, text=True, timeout=60,
                          check=False)
    return done.returncode, done.stdout + done.stderr, log.read_text() if log.exists() else ""


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
            assert code == 0 and "apt-get" in calls and "install" in calls and "libboost-dev" in calls, (code, text, calls)
        for suite in ("bookworm", "trixie", "noble"):
            code, text, calls = run(folder, suite, setup)
            assert code == 0 and "install" in calls, (suite, code, text, calls)
        code, text, calls = run(folder, "bookworm", fresh, "--suite", "woody")
        assert code == 1 and calls == "" and "found woody" in text and "bookworm trixie" in text, (code, text, calls)
        code, text, calls = run(folder, "bookworm", fresh, "--memory", "much")
        assert code == 1 and calls == "" and "4G" in text, (code, text, calls)
    return 0


if __name__ == "__main__":
    sys.exit(main())
