#!/usr/bin/env python3
"""Example of a flight model in Python. It attaches to a running set and publishes an aircraft until the set ends or
Ctrl-C. The aircraft flies circles about LAT LON [deg], by default off the Californian coast. The set needs no flight
model of its own (scripts/start --no-flight). If it has one, this program prevails: its priority is 50, the set's 10.

usage: examples/fly.py [SESSION [LAT LON]]"""
import math
import pathlib
import signal
import sys
import time

# of the sources; else the installed one
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
from yars.session import Session, YarsError  # noqa: E402


def fly(session, latitude_deg, longitude_deg, radius_m=8000.0, speed_mps=200.0):
    session.claim_ownship_lane(priority=50)
    begin_s = time.monotonic()
    while session.set_runs():
        angle = speed_mps / radius_m * (time.monotonic() - begin_s)  # [rad] on the circle, clockwise from north
        session.publish_ownship(
            latitude_deg=latitude_deg + radius_m * math.cos(angle) / 111000.0,  # 111,000 m: one degree of latitude
            longitude_deg=longitude_deg +
                radius_m * math.sin(angle) / (111000.0 * math.cos(math.radians(latitude_deg))),
            # bank: atan(v^2/(g r))
            altitude_msl_m=4500.0, heading_deg=(math.degrees(angle) + 90.0) % 360.0, roll_deg=27.0,
            velocity_north_mps=-speed_mps * math.sin(angle), velocity_east_mps=speed_mps * math.cos(angle),
            source="fly.py")
        session.heartbeat()
        time.sleep(0.02)


if __name__ == "__main__":
    position_deg = (float(sys.argv[2]), float(sys.argv[3])) if len(sys.argv) > 3 else (36.5, -122.3)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        with Session(sys.argv[1] if len(sys.argv) > 1 else "default", "fly.py") as running:
            fly(running, *position_deg)
    except YarsError as error:
        sys.exit(str(error))
    except KeyboardInterrupt:
        pass
