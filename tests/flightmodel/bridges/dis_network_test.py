#!/usr/bin/env python3
"""DIS over the network as laboratories use it: multicast, IPv6, bundles, another exercise on the same port.

usage: dis_network_test.py BIN (folder of the programs)
"""
import contextlib
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest

BIN = pathlib.Path(sys.argv.pop(1)).resolve()
PACKETS = pathlib.Path(__file__).resolve().parent / "packets/dis"
WATCHDOG_S = 60


def reports(name, exercise=1):
    """An Entity State PDU, again and again with later time stamps."""
    pdu = bytearray((PACKETS / name).read_bytes())
    pdu[1] = exercise
    stamp = struct.unpack_from(">I", pdu, 4)[0]
    while True:
        struct.pack_into(">I", pdu, 4, stamp & 0xFFFFFFFE)
        yield bytes(pdu)
        stamp += 1 << 16


class Flown(unittest.TestCase):
    def flight_model(self, source):
        """Starts it, and reads its log in the background."""
        process = subprocess.Popen([BIN / "flight-model", "--session", f"dis{os.getpid()}", "--source", source],
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        self.log = ""

        def read():
            with contextlib.suppress(ValueError):
                for line in process.stderr:
                    self.log += line

        threading.Thread(target=read, daemon=True).start()
        return process

    def await_line(self, pattern, process, send=lambda: None):
        deadline = time.monotonic() + WATCHDOG_S
        while not (found := re.search(pattern, self.log)):
            self.assertTrue(process.poll() is None and time.monotonic() < deadline,
                            f"{pattern} not found in\n{self.log}")
            send()
            time.sleep(0.05)
        return found

    def flies(self, source, family, address, *, option=None, datagrams=None):
        """The aircraft of datagrams that are sent to an address is the ownship."""
        process = self.flight_model(source)
        port = int(self.await_line(r"listens for dis on \S+:(\d+)", process)[1])
        with socket.socket(family, socket.SOCK_DGRAM) as sender:
            if option:
                sender.setsockopt(*option)
            several = datagrams or reports("air.bin")
            self.await_line("the aircraft is flown by dis", process,
                            lambda: sender.sendto(next(several), (address, port)))

    def test_loopback(self):
        self.flies("dis:0", socket.AF_INET, "127.0.0.1")
        self.assertRegex(self.log, "no grid of a geoid is installed|above mean sea level by the geoid")
        self.assertIn("exercise 1, the first one heard", self.log)

    def test_ipv6(self):
        if not socket.has_ipv6 or not pathlib.Path("/proc/net/if_inet6").exists():
            self.skipTest("expected IPv6, found none")
        self.flies("dis:[::1]:0", socket.AF_INET6, "::1")

    def test_a_multicast_group_is_joined(self):
        group = "239.255.77.23"
        loopback = (socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
        self.flies(f"dis:{group}%lo:0", socket.AF_INET, group, option=loopback)

    def test_several_programs_of_a_computer_hear_a_group(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            taken.bind(("239.255.77.24", 0))
            process = self.flight_model(f"dis:239.255.77.24%lo:{taken.getsockname()[1]}")
            self.await_line("listens for dis on", process)

    def test_an_interface_that_is_none_is_named(self):
        process = self.flight_model("dis:239.255.77.25%nowhere0:0")
        self.assertEqual(process.wait(WATCHDOG_S), 1)
        deadline = time.monotonic() + WATCHDOG_S
        while "name the network's interface" not in self.log:
            self.assertLess(time.monotonic(), deadline, self.log)
            time.sleep(0.05)

    def test_bundles(self):
        bundles = map(b"".join, zip(reports("ship.bin"), reports("air.bin"), reports("truck.bin")))
        self.flies("dis:0", socket.AF_INET, "127.0.0.1", datagrams=bundles)
        self.assertNotIn("refused", self.log)

    def test_another_exercise_is_left_out(self):
        process = self.flight_model("dis:0,exercise=2")
        port = int(self.await_line(r"listens for dis on \S+:(\d+)", process)[1])
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            first, second = reports("air.bin"), reports("air.bin", exercise=2)
            self.await_line("exercise 1 is heard too and left out", process,
                            lambda: sender.sendto(next(first), ("127.0.0.1", port)))
            self.assertNotIn("the aircraft is flown", self.log)
            self.await_line("the aircraft is flown by dis", process,
                            lambda: sender.sendto(next(second), ("127.0.0.1", port)))


if __name__ == "__main__":
    unittest.main()
