#!/usr/bin/env python3
"""Records what JSBSim itself sends with this aircraft: the packets that the tests read.

usage: record_jsbsim.py JSBSIM FOLDER
JSBSIM is the program (Debian has it in the package flightgear); FOLDER gets jsbsim/flight.txt (the labels and the
lines of 20 s, one a datagram) and flightgear/jsbsim_turn.bin with jsbsim/turn.txt, both of the same moment.
"""
import pathlib
import socket
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
TURN = 380  # the packet of the moment that both files show


def listen():
    port = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    port.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
    port.bind(("127.0.0.1", 0))
    return port


def take_all(port):
    port.setblocking(False)
    packets = []
    while True:
        try:
            packets.append(port.recv(65536))
        except BlockingIOError:
            return packets


def main():
    jsbsim, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    text, native = listen(), listen()
    directives = (HERE / "text_output.xml").read_text()
    with tempfile.TemporaryDirectory() as scratch:
        options = []
        for name, content, port in (("text", directives, text),
                                    ("native", '<output name="localhost" type="FLIGHTGEAR" port="@PORT@" '
                                               'protocol="UDP" rate="25"/>', native)):
            path = pathlib.Path(scratch, name + ".xml")
            path.write_text(content.replace("@PORT@", str(port.getsockname()[1])))
            options.append(f"--logdirectivefile={path}")
        subprocess.run([jsbsim, f"--root={HERE.resolve()}", "--script=scripts/coast.xml", "--end=20",
                        "--nohighlight", *options], check=True, stdout=subprocess.DEVNULL)
    lines, packets = take_all(text), take_all(native)
    (folder / "jsbsim").mkdir(exist_ok=True)
    (folder / "jsbsim" / "flight.txt").write_bytes(b"".join(lines))
    # The labels are one datagram more.
    (folder / "jsbsim" / "turn.txt").write_bytes(lines[0] + lines[TURN + 1])
    (folder / "flightgear" / "jsbsim_turn.bin").write_bytes(packets[TURN])


if __name__ == "__main__":
    main()
