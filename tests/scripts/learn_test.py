#!/usr/bin/env python3
"""input-monitor --learn with a FIFO as the device and a pseudo terminal as the keyboard, up to the events of the map.

usage: learn_test.py BIN
"""
import os
import pathlib
import pty
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

BIN = pathlib.Path(sys.argv.pop(1)).resolve()
EV_SYN, EV_KEY, EV_ABS = 0, 1, 3
ABS_X, ABS_HAT0X, ABS_HAT0Y = 0, 0x10, 0x11
WATCHDOG_S = 60


def record(kind, code, value):
    """One struct input_event of Linux."""
    return struct.pack("@qqHHi", 0, 0, kind, code, value)


class Fifo:
    """The writing end of a FIFO that stands for a device."""

    def __init__(self, path):
        self.path = path
        os.mkfifo(path)
        self.descriptor = -1

    def open(self):
        end = time.monotonic() + WATCHDOG_S
        while True:
            try:
                self.descriptor = os.open(self.path, os.O_WRONLY | os.O_NONBLOCK)
                return
            except OSError:
                if time.monotonic() > end:
                    raise
                time.sleep(0.01)

    def close(self):
        if self.descriptor >= 0:
            os.close(self.descriptor)
        self.descriptor = -1

    def send(self, *moves):
        for move in moves:
            os.write(self.descriptor, record(*move) + record(EV_SYN, 0, 0))

    def press(self, code):
        self.send((EV_KEY, code, 1), (EV_KEY, code, 0))


class Program:
    """A program with a pseudo terminal as its standard input and standard error."""

    def __init__(self, arguments):
        self.master, slave = pty.openpty()

        def take_terminal():
            os.setsid()
            import fcntl
            fcntl.ioctl(0, termios.TIOCSCTTY, 0)

        self.process = subprocess.Popen([str(BIN / "input-monitor"), *arguments], stdin=slave, stderr=slave,
                                        stdout=subprocess.PIPE, preexec_fn=take_terminal,
                                        env={**os.environ, "YARS_USER_CONFIG": ""})
        os.close(slave)
        self.shown = ""
        self.seen = 0

    def read(self, wait_s):
        if not select.select([self.master], [], [], wait_s)[0]:
            return True
        try:
            text = os.read(self.master, 4096).decode()
        except OSError:  # the program has ended
            return False
        self.shown += text
        return bool(text)

    def expect(self, text):
        """Waits until the program has shown this, behind what was waited for before."""
        end = time.monotonic() + WATCHDOG_S
        while text not in self.shown[self.seen:]:
            if time.monotonic() > end or not self.read(0.2):
                raise AssertionError(f"expected {text!r} in:\n{self.shown[self.seen:]}\nafter:\n"
                                     f"{self.shown[:self.seen]}")
        self.seen = self.shown.index(text, self.seen) + len(text)

    def type(self, keys):
        os.write(self.master, keys.encode())

    def echoes(self):
        return bool(termios.tcgetattr(self.master)[3] & termios.ECHO)

    def end(self):
        """Exit code and standard output."""
        end = time.monotonic() + WATCHDOG_S
        while self.process.poll() is None and time.monotonic() < end:
            self.read(0.05)
        if self.process.poll() is None:
            self.process.kill()
        while self.read(0.05) and select.select([self.master], [], [], 0)[0]:
            pass
        output = self.process.communicate()[0].decode()
        os.close(self.master)
        return self.process.returncode, output


class Learn(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="yars_learn_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.map = self.folder / "panel.guf"
        self.device = Fifo(self.folder / "panel")
        self.addCleanup(self.device.close)

    def start(self, *more):
        program = Program(["--learn", str(self.device.path), *more])
        self.addCleanup(lambda: program.process.poll() is None and program.process.kill())
        self.device.open()
        return program

    def learn_some(self, program):
        """Buttons 1 and 3, the TDC by a stick, the castle switch by a hat."""
        program.expect("button 1 of the display")
        self.device.press(0x120)
        program.expect("button 2 of the display")
        self.assertFalse(program.echoes())
        program.type("s")
        program.expect("button 3 of the display")
        self.device.press(0x120)
        program.expect("that is button 1 of the display already")
        self.device.press(0x121)
        program.expect("button 4 of the display")
        program.type("n")
        program.expect("TDC right")
        self.device.send((EV_ABS, ABS_X, 128), (EV_ABS, ABS_X, 255), (EV_ABS, ABS_X, 128))
        program.expect("TDC left")
        self.device.send((EV_ABS, ABS_X, 0), (EV_ABS, ABS_X, 128))
        program.expect("TDC up")
        program.type("n")
        program.expect("castle switch")
        self.device.send((EV_ABS, ABS_HAT0X, 1), (EV_ABS, ABS_HAT0X, 0))
        program.expect("acquisition switch forward")

    def check_map(self):
        text = self.map.read_text()
        self.assertNotIn('""', text)
        self.assertNotIn('"pb 2"', text)
        checked = subprocess.run([str(BIN / "yars"), "config", "check", str(self.map)], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("0 warnings", checked.stdout)

    def test_the_map_of_a_dialogue_sends_the_events(self):
        program = self.start("--out", os.path.relpath(self.map), "--session", "learned-here")
        self.learn_some(program)
        program.type("q")
        code, output = program.end()
        self.assertEqual((code, output), (0, ""), program.shown)
        self.assertIn("5 controls, map panel", program.shown)
        self.assertIn("is a FIFO: it waits for what another program writes into it", program.shown)
        self.assertIn("scripts/start --session learned-here --no-input", program.shown)
        self.assertIn(f"input-monitor --session learned-here --config {self.map} "
                      f"--source evdev:{self.device.path},panel", program.shown.replace("\r\n", " "))
        self.check_map()
        for jargon in ("ABS_", "BTN_", "\x1b"):
            self.assertNotIn(jargon, program.shown)
        self.device.close()

        session = f"learn-{os.getpid()}"
        heard = Program(["--session", session, "--config", str(self.map), "--source",
                         f"evdev:{self.device.path},panel", "--log-level", "debug"])
        self.addCleanup(lambda: heard.process.poll() is None and heard.process.kill())
        heard.expect("reads ")
        self.device.open()
        self.device.press(0x120)
        heard.expect("pb 1\r\n")
        self.device.press(0x121)
        heard.expect("pb 3\r\n")
        self.device.send((EV_ABS, ABS_X, 255))
        heard.expect("tdc 1 0\r\n")
        self.device.send((EV_ABS, ABS_X, 0))
        heard.expect("tdc -1 0\r\n")
        self.device.send((EV_ABS, ABS_HAT0X, 1))
        heard.expect("coolie up\r\n")
        heard.process.send_signal(signal.SIGTERM)
        self.assertEqual(heard.end()[0], 0, heard.shown)

    def test_ctrl_c_keeps_what_was_learned(self):
        program = self.start("--out", str(self.map))
        self.learn_some(program)
        program.type("\x03")
        self.assertEqual(program.end()[0], 0, program.shown)
        self.check_map()

    def test_ctrl_c_before_the_first_control_says_that_nothing_was_written(self):
        program = self.start("--out", str(self.map))
        program.expect("button 1 of the display")
        program.type("\x03")
        self.assertEqual(program.end()[0], 1)
        self.assertIn("nothing was written", program.shown)
        self.assertFalse(self.map.exists())

    def test_a_map_that_cannot_be_written_is_not_lost(self):
        program = self.start("--out", str(self.folder / "missing/panel.guf"))
        self.learn_some(program)
        program.type("q")
        code, output = program.end()
        self.assertEqual(code, 1)
        self.assertIn('"pb 3"', output)

    def test_a_program_that_writes_again_goes_on(self):
        program = self.start()
        program.expect("button 1 of the display")
        self.device.press(0x120)
        program.expect("button 2 of the display")
        self.device.close()
        self.device.open()
        self.device.press(0x121)
        program.expect("button 3 of the display")
        program.type("q")
        code, output = program.end()
        self.assertEqual(code, 0, program.shown)
        self.assertIn('"pb 2"', output)
        self.assertNotIn("unplugged", program.shown)

    def test_letters_on_lines_without_a_terminal(self):
        process = subprocess.Popen([str(BIN / "input-monitor"), "--learn", str(self.device.path)],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        self.device.open()
        self.device.press(0x120)
        line = ""
        while "button 2 of the display" not in line:
            line = process.stderr.readline()
            self.assertTrue(line, "the program has ended")
        output, said = process.communicate("skip\nq\n", timeout=WATCHDOG_S)
        self.assertEqual(process.returncode, 0, said)
        self.assertIn('"pb 1"', output)
        self.assertIn("button 3 of the display", said)

    def test_what_is_no_device_is_refused(self):
        for path, said in (("/dev/null", "/dev/input/by-id"), (str(self.folder / "none"), "/dev/input/by-id")):
            refused = subprocess.run([str(BIN / "input-monitor"), "--learn", path], capture_output=True, text=True,
                                     stdin=subprocess.DEVNULL, timeout=WATCHDOG_S)
            self.assertEqual(refused.returncode, 1)
            self.assertIn(said, refused.stderr)

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_a_device_that_may_not_be_read_names_the_group(self):
        self.device.path.chmod(0)
        refused = subprocess.run([str(BIN / "input-monitor"), "--learn", str(self.device.path)], capture_output=True,
                                 text=True, stdin=subprocess.DEVNULL, timeout=WATCHDOG_S)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("group input", refused.stderr)


if __name__ == "__main__":
    unittest.main()
