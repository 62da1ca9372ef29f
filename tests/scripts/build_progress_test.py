#!/usr/bin/env python3
"""scripts/start while it builds: minutes and disk first, then the part that is done; Ctrl-C ends it in one line.

A checkout of scripts/start alone, with a set-up and a cmake that only print what the real ones do.
"""
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

HOME = pathlib.Path(__file__).resolve().parents[2]
WATCHDOG_S = 60
# Prints as ninja does, as far as the file `steps` says; `hang` makes it wait behind the last step.
CMAKE = '''#!/bin/bash
case $1 in --preset) echo "-- Configuring done"; exit 0 ;; esac
printf '%s' "$*" >"$HOME/targets"
status() { local text=${NINJA_STATUS//%f/$1}; printf '%s' "${text//%t/$2}"; }
status 0 2; echo "Re-checking globbed directories..."
total=$(cat "$HOME/total")
for ((step = 1; step <= $(cat "$HOME/steps"); step++)); do
  status "$step" "$total"; echo "Building CXX object $step.o"
done
if [ -e "$HOME/hang" ]; then
  echo $$ >"$HOME/builder"
  trap 'kill $!; echo "ninja: build stopped: interrupted by user."; exit 130' INT
  sleep 600 & wait
fi
[ "$step" -gt "$total" ] || { echo "error: no such thing"; exit 1; }
'''


class BuildProgress(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="yars_progress_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        for name in ("scripts", "tools", "build/release/bin"):
            (self.folder / name).mkdir(parents=True)
        shutil.copy(HOME / "scripts/start", self.folder / "scripts/start")
        shutil.copytree(HOME / "scripts/starting", self.folder / "scripts/starting")
        (self.folder / "CMakeLists.txt").touch()
        self.program("scripts/setup", "#!/bin/sh\n")
        self.program("tools/cmake", CMAKE)
        # Ends the start behind the build: the user's file cannot be read.
        self.program("build/release/bin/yars", "#!/bin/sh\necho built >&2\nexit 1\n")
        self.environment = {**os.environ, "HOME": str(self.folder), "PATH": f"{self.folder}/tools:{os.environ['PATH']}",
                            "TERM": "xterm"}

    def program(self, name, text):
        path = self.folder / name
        path.write_text(text)
        path.chmod(0o755)

    def prepare(self, steps, total, hang=False):
        (self.folder / "steps").write_text(str(steps))
        (self.folder / "total").write_text(str(total))
        if hang:
            (self.folder / "hang").touch()

    def command(self):
        return [str(self.folder / "scripts/start"), "--headless", "1"]

    def run_plainly(self):
        return subprocess.run(self.command(), env=self.environment, capture_output=True, stdin=subprocess.DEVNULL,
                              timeout=WATCHDOG_S)

    def run_on_a_terminal(self, key_when=None):
        """Exit code and what was shown; Ctrl-C is typed once the file `key_when` is there."""
        child, master = pty.fork()
        if child == 0:
            os.chdir(self.folder)
            os.execve(self.command()[0], self.command(), self.environment)
        shown = b""
        end = time.monotonic() + WATCHDOG_S
        while time.monotonic() < end:
            if key_when and key_when.exists() and key_when.stat().st_size:
                os.write(master, b"\x03")
                key_when = None
            try:
                os.set_blocking(master, False)
                more = os.read(master, 4096)
            except BlockingIOError:
                time.sleep(0.02)
                continue
            except OSError:
                break
            if not more:
                break
            shown += more
        else:
            os.kill(child, signal.SIGKILL)
        os.close(master)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), shown.decode()

    def test_without_a_terminal_lines_are_plain(self):
        self.prepare(200, 200)
        ended = self.run_plainly()
        text = ended.stdout.decode()
        self.assertIn(b"built", ended.stderr)
        self.assertRegex(text, r"Building 200 steps: (about \d+ min|under a minute) on \d+ cores?, "
                               r"\d+ MB of disk; the log")
        self.assertEqual(len(re.findall(r"^\d+ %, step \d+ of 200(, \d+ min left)?$", text, re.MULTILINE)), 10, text)
        self.assertTrue(all(character == "\n" or character.isprintable() for character in text), repr(text))

    def test_on_a_terminal_one_line_is_redrawn(self):
        self.prepare(200, 200)
        code, text = self.run_on_a_terminal()
        self.assertEqual(code, 1)
        self.assertIn("Building 200 steps", text)
        self.assertIn("\r 50 %, step 100 of 200, 1 min left", text)
        self.assertRegex(text, r"\r100 %, step 200 of 200 *\r\n")

    def test_nothing_to_build_says_nothing_of_minutes(self):
        self.prepare(0, 0)
        self.assertNotIn(b"steps", self.run_plainly().stdout)

    def test_a_failure_shows_the_end_of_the_log(self):
        self.prepare(3, 9)
        ended = self.run_plainly()
        self.assertEqual(ended.returncode, 1)
        self.assertIn(b"error: no such thing", ended.stderr)
        self.assertIn(b"the whole log is build/start.log", ended.stderr)

    def test_ctrl_c_ends_the_build_in_one_line(self):
        self.prepare(3, 9, hang=True)
        code, text = self.run_on_a_terminal(key_when=self.folder / "builder")
        self.assertEqual(code, 130, text)
        self.assertIn("stopped while building; the next start goes on", text)
        self.assertNotIn("failed", text)
        builder = int((self.folder / "builder").read_text())
        self.assertFalse(pathlib.Path(f"/proc/{builder}").exists())

    def test_only_the_programs_of_a_set_are_built(self):
        self.prepare(1, 1)
        self.run_plainly()
        targets = (self.folder / "targets").read_text().split("--target ")[1].split()
        self.assertEqual(sorted(targets),
                         ["flight-model", "input-monitor", "radar-display", "radar-model", "state-machine", "yars",
                          "yars-station", "yars_client_library", "yars_help"])


if __name__ == "__main__":
    unittest.main()
