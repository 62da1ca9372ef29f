#!/usr/bin/env python3
"""Pages of the station in Debian's Chromium, by Playwright: a script against a running set.
usage: pages_test.py BIN SCRIPT    (BIN: folder of the programs; SCRIPT: pages.mjs or instructor.mjs).
Exit code 77: no npm, no Chromium, or no packages of npm.

With pages.mjs it also checks that station/web/dist is what the sources give,
and that no page loads more than 500 KB."""
import filecmp
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
WEB = TOP / "station/web"


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def install(folder):
    """Node packages and sources of the pages, in a folder of the build."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json", "tsconfig.json", "build.mjs"):
        shutil.copy(WEB / name, folder)
    shutil.copytree(WEB / "src", folder / "src", dirs_exist_ok=True)
    mark = folder / "installed"
    lock = (WEB / "package-lock.json").read_text()
    if not mark.exists() or mark.read_text() != lock:
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=folder, check=False,
                              capture_output=True, text=True)
        if done.returncode:
            skip(f"npm ci: {done.stderr.strip().splitlines()[:1]}")
        mark.write_text(lock)


def check_build(folder):
    """The pages in the tree are those of the sources."""
    subprocess.run(["npx", "tsc", "--noEmit"], cwd=folder, check=True)
    shutil.rmtree(folder / "fresh", ignore_errors=True)
    subprocess.run(["node", "build.mjs", "fresh"], cwd=folder, check=True)
    names = sorted(path.name for path in (folder / "fresh").iterdir())
    assert names == sorted(path.name for path in (WEB / "dist").iterdir()), names
    _, different, errors = filecmp.cmpfiles(folder / "fresh", WEB / "dist", names, shallow=False)
    assert not different and not errors, f"{different + errors}: expected station/web/dist as `npm run build` makes it"
    size = sum(path.stat().st_size for path in (WEB / "dist").iterdir())
    assert size < 500_000, size


def address(log, process):
    for _ in range(600):
        found = re.search(r"^(http://127\.0\.0\.1:\d+)/", log.read_text(), re.M)
        if found:
            return found.group(1)
        assert process.poll() is None, log.read_text()
        time.sleep(0.1)
    raise AssertionError(log.read_text())


def main():
    binaries = pathlib.Path(sys.argv[1]).resolve()
    if not shutil.which("npm"):
        skip("expected npm, found none")
    if not shutil.which("chromium-headless-shell"):
        skip("expected chromium-headless-shell, found none")
    script = sys.argv[2]
    folder = binaries.parent / f"station_web_{pathlib.Path(script).stem}"  # tests may run beside each other
    install(folder)
    if script == "pages.mjs":
        check_build(folder)
    for name in ("browser.mjs", script):
        shutil.copy(TOP / "tests/station" / name, folder)
    session = f"pages{os.getpid()}"
    with socket.socket() as free:  # a fixed port, at which a restarted station is found again
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with tempfile.TemporaryDirectory() as name:
        log = pathlib.Path(name) / "log"
        with log.open("w") as out:
            terrain = pathlib.Path(name) / "terrain"
            subprocess.run([binaries / "yars", "terrain", "generate", "--out", terrain, "--south=36", "--west=-123",
                            "--level=0"], check=True, stdout=subprocess.DEVNULL)
            process = subprocess.Popen([TOP / "scripts/start", "--bin", binaries, "--session", session,
                                        "--terrain", terrain, "--headless", "600",
                                        # The browser draws 40 pictures a second, which takes as long as their pixels.
                                        "--no-frames", "--size", "240", "--no-input", "--log-dir", "", "--web",
                                        "--web-port", str(port), "--web-without-tokens"],
                                       stdout=out, stderr=subprocess.STDOUT, cwd=name)
        try:
            done = subprocess.run(["node", script, address(log, process), binaries / "yars", session], cwd=folder,
                                  check=False, timeout=480)
        finally:
            process.terminate()
            code = process.wait()
        if done.returncode or code:
            print(log.read_text())
        assert code == 0, f"expected the set to end without a fault, found code {code}"
        sys.exit(done.returncode)


if __name__ == "__main__":
    main()
