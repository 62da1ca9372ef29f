#!/usr/bin/env python3
"""Writes the packets of tests/flightmodel/bridges/packets from the descriptions of their formats, by no code of YARS.

usage: make_packets.py [FOLDER]
flightgear/: native FDM, big-endian, versions 24 and 25. xplane/: an RREF reply, little-endian. dis/: Entity State PDUs
(IEEE 1278.1), their orientation by products of rotation matrices. The files flightgear/jsbsim_turn.bin and
jsbsim/*.txt beside them are recorded from JSBSim itself (as in FlightGear 2020.3.16) by jsbsim/record_jsbsim.py.
The numbers below are those that the tests expect.
"""
import math
import pathlib
import struct
import sys

FOOT = 0.3048
RADIANS = math.pi / 180.0


def flightgear(version, size, latitude, longitude, altitude_m, heading, pitch, roll, velocity_mps, rates_dps):
    packet = bytearray(size)
    struct.pack_into(">I", packet, 0, version)
    struct.pack_into(">ddd", packet, 8, longitude * RADIANS, latitude * RADIANS, altitude_m)
    struct.pack_into(">f", packet, 32, altitude_m - 100.0)
    struct.pack_into(">fff", packet, 36, roll * RADIANS, pitch * RADIANS, heading * RADIANS)
    struct.pack_into(">fff", packet, 56, *(rate * RADIANS for rate in rates_dps))  # roll, pitch, heading
    struct.pack_into(">ff", packet, 68, 480.0, -velocity_mps[2] / FOOT)
    struct.pack_into(">fff", packet, 76, *(part / FOOT for part in velocity_mps))  # north, east, down
    return bytes(packet)


def xplane(values):
    return b"RREF," + b"".join(struct.pack("<if", number, value) for number, value in enumerate(values))


def turn(axis, angle):
    """Takes a vector's parts from the axes before a turn to those after it."""
    c, s = math.cos(angle), math.sin(angle)
    return {"x": [[1, 0, 0], [0, c, s], [0, -s, c]],
            "y": [[c, 0, -s], [0, 1, 0], [s, 0, c]],
            "z": [[c, s, 0], [-s, c, 0], [0, 0, 1]]}[axis]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def ecef(latitude, longitude, height):
    a, f = 6378137.0, 1 / 298.257223563
    e2 = f * (2 - f)
    n = a / math.sqrt(1 - e2 * math.sin(latitude) ** 2)
    return ((n + height) * math.cos(latitude) * math.cos(longitude),
            (n + height) * math.cos(latitude) * math.sin(longitude), (n * (1 - e2) + height) * math.sin(latitude))


def dis(identity, kind, domain, latitude, longitude, height_m, attitude_deg, velocity_mps, stamp_s=100.0, algorithm=2,
        appearance=0, parameters=0, version=6, acceleration_mps2=(0, 0, 0), body_rates_dps=(0, 0, 0)):
    """`attitude_deg`: heading, pitch, roll; `velocity_mps`: north, east, down."""
    latitude, longitude = latitude * RADIANS, longitude * RADIANS
    # North, east, down from earth: about z by the longitude, then about y by -(90 deg + latitude).
    ned_from_earth = product(turn("y", -(math.pi / 2 + latitude)), turn("z", longitude))
    heading, pitch, roll = (angle * RADIANS for angle in attitude_deg)
    body_from_ned = product(turn("x", roll), product(turn("y", pitch), turn("z", heading)))
    body = product(body_from_ned, ned_from_earth)
    psi, theta, phi = math.atan2(body[0][1], body[0][0]), -math.asin(body[0][2]), math.atan2(body[1][2], body[2][2])
    to_earth = lambda ned: [sum(ned_from_earth[i][j] * ned[i] for i in range(3)) for j in range(3)]
    to_body = lambda ned: [sum(body_from_ned[i][j] * ned[j] for j in range(3)) for i in range(3)]
    velocity = to_body(velocity_mps) if algorithm >= 6 else to_earth(velocity_mps)
    packet = bytearray(144 + 16 * parameters)
    stamp = int(stamp_s / 3600.0 * 2 ** 31) << 1 | 1
    struct.pack_into(">BBBBIHH", packet, 0, version, 1, 1, 1, stamp, len(packet), 0)
    struct.pack_into(">HHHBB", packet, 12, *identity, 1, parameters)
    struct.pack_into(">BBHBBBB", packet, 20, kind, domain, 225, 1, 5, 1, 0)
    struct.pack_into(">fff", packet, 36, *velocity)
    struct.pack_into(">ddd", packet, 48, *ecef(latitude, longitude, height_m))
    struct.pack_into(">fff", packet, 72, psi, theta, phi)
    struct.pack_into(">I", packet, 84, appearance)
    struct.pack_into(">B", packet, 88, algorithm)
    struct.pack_into(">fff", packet, 104, *to_earth(acceleration_mps2))
    struct.pack_into(">fff", packet, 116, *(rate * RADIANS for rate in body_rates_dps))
    struct.pack_into(">B11s", packet, 128, 1, b"YARS")
    return bytes(packet)


FLIGHT = dict(latitude=36.6, longitude=-121.9, altitude_m=4572.0, heading=80.0, pitch=2.5, roll=-15.0,
              velocity_mps=(40.0, 230.0, -5.0), rates_dps=(1.0, 0.5, -2.0))
AIR = dict(kind=1, domain=2, latitude=36.6, longitude=-121.9, height_m=4572.0, attitude_deg=(80.0, 2.5, -15.0),
           velocity_mps=(40.0, 230.0, -5.0))
SHIP = dict(kind=1, domain=3, latitude=36.7, longitude=-122.1, height_m=0.0, attitude_deg=(270.0, 0.0, 0.0),
            velocity_mps=(0.0, -10.0, 0.0))

PACKETS = {
    "flightgear/v24.bin": flightgear(24, 408, **FLIGHT),
    "flightgear/v25.bin": flightgear(25, 552, **FLIGHT),
    "flightgear/south_east.bin": flightgear(24, 408,
                                            **{**FLIGHT, "latitude": -33.9, "longitude": 151.2, "heading": 359.5}),
    # latitude, longitude, elevation, vx (east), vy (up), vz (south) at the reference point, that point, true psi,
    # theta, phi, P, Q, R
    "xplane/level.bin": xplane([36.5, -122.0, 3000.0, 100.0, 2.0, -200.0, 36.5, -122.0, 26.6, 1.5, 0.0, 0, 0, 0]),
    "xplane/far_from_reference.bin": xplane([60.5, 11.0, 3000.0, 100.0, 0, 0, 60.0, 10.0, 90.0, 0, 0, 0, 0, 0]),
    "dis/air.bin": dis((1, 2, 3), **AIR),
    "dis/air_body_axes.bin": dis((1, 2, 3), **AIR, algorithm=6),
    "dis/air_turning.bin": dis((1, 2, 3), **AIR, algorithm=4, acceleration_mps2=(3.0, -1.0, 0.5),
                               body_rates_dps=(0.0, 0.0, 3.0)),
    "dis/air_version_7.bin": dis((1, 2, 3), **AIR, version=7, stamp_s=101.0),
    "dis/air_articulated.bin": dis((1, 2, 3), **AIR, parameters=2, stamp_s=102.0),
    "dis/ship.bin": dis((1, 2, 9), **SHIP),
    "dis/ship_later.bin": dis((1, 2, 9), **SHIP, stamp_s=105.0),
    "dis/ship_gone.bin": dis((1, 2, 9), **SHIP, stamp_s=106.0, appearance=1 << 23),
    "dis/ship_frozen.bin": dis((1, 2, 9), **SHIP, stamp_s=107.0, appearance=1 << 21),
    "dis/truck.bin": dis((1, 2, 10), **{**SHIP, "domain": 1, "latitude": 36.6, "longitude": -121.8, "height_m": 30.0}),
}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "packets"
    for name, packet in PACKETS.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(packet)


if __name__ == "__main__":
    main()
