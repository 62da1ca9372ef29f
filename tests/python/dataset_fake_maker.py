"""A maker for tests of yars.dataset: arrays of the right shapes that depend on orders, movers and settings alone.

`command` runs the data set maker with it: python3 dataset_fake_maker.py SPEC --out DIR ..."""
import errno
import hashlib
import os
import pathlib
import sys
import time
import types

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "python"))

OBJECT = np.dtype([("name", "U16"), ("latitude", "f8"), ("longitude", "f8"), ("height_m", "f4")])
GEO = np.dtype([("origin_latitude", "f8"), ("origin_longitude", "f8"), ("plane_from_pixel", "f8", (6,)),
                ("up_deg", "f8")])
TYPES = {"video": "u1", "power": "f4", "shadow": "u1", "layover": "u1", "object": "i4", "material": "u1",
         "height": "f4", "grazing_angle": "f4"}


class FakeMaker:
    def __init__(self, plan):
        self.plan = plan
        self.objects = np.array(
            [(f"house{number}" if number % 3 else f"car_{number}", 37.5 + number * 1e-3, -122.3, 5.0)
             for number in range(12)], OBJECT)

    def elevation(self, latitude, longitude):
        return np.maximum(0.0, 400.0 * np.sin(50.0 * np.asarray(latitude)) * np.cos(50.0 * np.asarray(longitude)))

    def warm(self, sample, settings):
        self.patches(sample.orders[:1], sample.movers[:0], settings)

    def patches(self, orders, movers, settings):
        time.sleep(float(os.environ.get("FAKE_MAKER_S", "0")))
        deadly = os.environ.get("FAKE_MAKER_DEADLY_MAP")  # the item with this number ends its worker
        if deadly and int(deadly) in orders["map"] and len(orders) > 1:
            os.kill(os.getpid(), 9)
        size, count = self.plan.size, len(orders)
        seeds = []
        for at in range(count):
            mine = movers[movers["order"] == at].copy()
            mine["order"] = 0
            text = orders[at].tobytes() + mine.tobytes() + settings.encode()
            seeds.append(int.from_bytes(hashlib.blake2b(text, digest_size=8).digest(), "little"))
        words = (np.array(seeds, np.uint64)[:, None, None] +
                 np.arange(size * size, dtype=np.uint64).reshape(size, size) * np.uint64(0x9E3779B97F4A7C15))
        words ^= words >> np.uint64(29)
        result = {name: (words >> np.uint64(7 * number) &
                         np.uint64(1 if name in ("shadow", "layover") else 7)).astype(TYPES[name])
                  for number, name in enumerate(self.plan.arrays)}
        result["hash"] = np.array(seeds, np.uint64)
        result["geo"] = np.zeros(count, GEO)
        result["geo"]["origin_latitude"], result["geo"]["origin_longitude"] = orders["latitude"], orders["longitude"]
        result["geo"]["plane_from_pixel"] = [0.0, 10.0, 0.0, 0.0, 0.0, -10.0]
        from yars.dataset.blocks import RADAR_BOX
        boxes = np.zeros(count * 3, RADAR_BOX)
        boxes["order"], boxes["object"] = np.repeat(np.arange(count), 3), np.tile([7, 2, 0], count)
        boxes["pixels"], boxes["corners"] = np.tile([4, 2, 0], count), [[1, 1], [5, 1], [5, 3], [1, 3]]
        result["boxes"] = boxes[boxes["pixels"] >= self.plan.min_pixels]
        return result


def fill_disk(after):
    """Lets `after` more files be written; then the disk is full for a rest of each file."""
    from yars.dataset import files
    real, left = os.write, [after]

    def write(file, data):
        if len(data) > 200 and left[0] <= 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        left[0] -= len(data) > 200
        return real(file, data)
    files.os = types.SimpleNamespace(**{**vars(os), "write": write})


def open_maker(plan, terrain, scenes):
    if "FAKE_MAKER_FULL" in os.environ:
        fill_disk(int(os.environ["FAKE_MAKER_FULL"]))
    return FakeMaker(plan)


if __name__ == "__main__":
    from yars.dataset.run import main
    sys.exit(main(maker="dataset_fake_maker:open_maker"))
