#!/usr/bin/env python3
"""Draws elevation files as a shaded relief in the geometry of the radar display, for comparison with a radar picture.

Shares no code with the radar: own DTED and HGT reader, own geodesic (Vincenty's direct formula on WGS84, Survey
Review 23, 1975). The picture has its apex at --lat --lon and --track up. From the apex it shows -0.6 to 0.6 of the
range across and -0.1 to 1.1 of the range up. It is dark beyond the range and outside of +-50 degrees from --track.
Distances are ground range. Curvature of the earth and shadows are left out. Prints the pixel of each --mark.

  ppi_from_elevation.py --terrain DIR --lat 36.9 --lon -122.6 --track 90 --range-nm 40 --size 480 --out ppi.png \\
      --mark 36.95 -122.06 "Point Santa Cruz"
"""
import argparse
import json
import pathlib
import re
import sys

import numpy as np
from PIL import Image, ImageDraw

WIDTH = (-0.6, 0.6)       # left and right edge of the picture, in fractions of the range
HEIGHT = (-0.1, 1.1)      # bottom and top, in fractions of the range
HALF_SECTOR_DEG = 50.0
METRES_PER_NM = 1852.0
SEMI_MAJOR_M, FLATTENING = 6378137.0, 1 / 298.257223563
VOID = np.nan


def vincenty_direct(latitude_deg, longitude_deg, azimuth_deg, distance_m):
    """Latitude and longitude [deg] of the end of a geodesic. Azimuth (from true north) and distance may be arrays."""
    minor = SEMI_MAJOR_M * (1 - FLATTENING)
    azimuth, distance_m = np.radians(azimuth_deg), np.asarray(distance_m, float)
    tan_u1 = (1 - FLATTENING) * np.tan(np.radians(latitude_deg))
    cos_u1 = 1 / np.sqrt(1 + tan_u1**2)
    sin_u1 = tan_u1 * cos_u1
    sigma1 = np.arctan2(tan_u1, np.cos(azimuth))
    sin_alpha = cos_u1 * np.sin(azimuth)
    cos2_alpha = 1 - sin_alpha**2
    u2 = cos2_alpha * (SEMI_MAJOR_M**2 - minor**2) / minor**2
    a = 1 + u2 / 16384 * (4096 + u2 * (-768 + u2 * (320 - 175 * u2)))
    b = u2 / 1024 * (256 + u2 * (-128 + u2 * (74 - 47 * u2)))
    sigma = distance_m / (minor * a)
    for _ in range(20):
        middle = np.cos(2 * sigma1 + sigma)
        s, c = np.sin(sigma), np.cos(sigma)
        change = b * s * (middle +
                          b / 4 * (c * (2 * middle**2 - 1) - b / 6 * middle * (4 * s**2 - 3) * (4 * middle**2 - 3)))
        sigma = distance_m / (minor * a) + change
    middle, s, c = np.cos(2 * sigma1 + sigma), np.sin(sigma), np.cos(sigma)
    across = sin_u1 * s - cos_u1 * c * np.cos(azimuth)
    latitude = np.arctan2(sin_u1 * c + cos_u1 * s * np.cos(azimuth),
                          (1 - FLATTENING) * np.sqrt(sin_alpha**2 + across**2))
    turn = np.arctan2(s * np.sin(azimuth), cos_u1 * c - sin_u1 * s * np.cos(azimuth))
    k = FLATTENING / 16 * cos2_alpha * (4 + FLATTENING * (4 - 3 * cos2_alpha))
    bend = (1 - k) * FLATTENING * sin_alpha * (sigma + k * s * (middle + k * c * (2 * middle**2 - 1)))
    longitude = longitude_deg + np.degrees(turn - bend)
    return np.degrees(latitude), (longitude + 180) % 360 - 180


def way_to(latitude_deg, longitude_deg, to_latitude_deg, to_longitude_deg):
    """Azimuth [deg true] and distance [m] of the geodesic between two places, by iteration of the direct formula."""
    metres = np.pi / 180 * SEMI_MAJOR_M
    def flat(lat, lon):
        east = ((to_longitude_deg - lon + 180) % 360 - 180) * metres * np.cos(np.radians(to_latitude_deg))
        return east, (to_latitude_deg - lat) * metres
    aim = np.array(flat(latitude_deg, longitude_deg))
    for _ in range(30):
        at = vincenty_direct(latitude_deg, longitude_deg, np.degrees(np.arctan2(aim[0], aim[1])), np.hypot(*aim))
        miss = np.array(flat(*at))
        aim = aim + miss
        if np.hypot(*miss) < 1e-3:
            break
    return np.degrees(np.arctan2(aim[0], aim[1])) % 360, float(np.hypot(*aim))


def read_dted(path):
    """Elevations [m above mean sea level], rows from south to north; absent and void posts are NaN."""
    data = path.read_bytes()
    columns, rows = int(data[47:51]), int(data[51:55])
    cell = np.full((rows, columns), VOID)
    record = 12 + 2 * rows
    for start in range(3428, len(data) - record + 1, record):
        column, first = np.frombuffer(data, ">u2", 2, start + 4)
        words = np.frombuffer(data, ">u2", rows, start + 8).astype(int)
        heights = np.where(words & 0x8000, -(words & 0x7FFF), words).astype(float)
        heights[words == 0xFFFF] = VOID
        cell[first:, column] = heights[:rows - first]
    return cell


def read_hgt(path):
    posts = np.fromfile(path, ">i2").astype(float)
    side = int(round(np.sqrt(posts.size)))
    posts[posts == -32768] = VOID
    return posts.reshape(side, side)[::-1]


def find_cells(folder):
    """{(latitude, longitude) of the cell's south-west corner [deg]: file}. Of several files of one cell, the finest."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = f"{path.parent.name}/{path.name}".lower()
        dted = re.fullmatch(r"([ew])(\d{3})/([ns])(\d{2})\.dt([012])", name)
        hgt = re.fullmatch(r"([ns])(\d{2})([ew])(\d{3})\.hgt", path.name.lower())
        if dted:
            side, longitude, half, latitude, level = dted.groups()
            fineness = (120, 1200, 3600)[int(level)]
        elif hgt:
            half, latitude, side, longitude = hgt.groups()
            fineness = int(round(np.sqrt(path.stat().st_size / 2))) - 1
        else:
            continue
        place = (int(latitude) * (1 if half == "n" else -1), int(longitude) * (1 if side == "e" else -1))
        if place not in found or fineness > found[place][0]:
            found[place] = (fineness, path)
    return {place: path for place, (_, path) in found.items()}


def elevations(files, latitude, longitude):
    """Elevations [m] at positions, by bilinear interpolation. An absent cell is sea at 0 m. NaN beside a void post."""
    result = np.zeros(latitude.shape)
    south, west = np.floor(latitude).astype(int), np.floor(longitude).astype(int)
    for place in set(zip(south.ravel().tolist(), west.ravel().tolist())) & set(files):
        path = files[place]
        cell = read_dted(path) if path.suffix.lower().startswith(".dt") else read_hgt(path)
        here = (south == place[0]) & (west == place[1])
        row = (latitude[here] - place[0]) * (cell.shape[0] - 1)
        column = (longitude[here] - place[1]) * (cell.shape[1] - 1)
        r, c = np.minimum(row.astype(int), cell.shape[0] - 2), np.minimum(column.astype(int), cell.shape[1] - 2)
        up, right = row - r, column - c
        result[here] = ((1 - up) * ((1 - right) * cell[r, c] + right * cell[r, c + 1])
                        + up * ((1 - right) * cell[r + 1, c] + right * cell[r + 1, c + 1]))
    return result


def glass_place(options, x, y):
    """Latitude and longitude [deg] of picture positions: x right of the apex, y above it, as fractions of the range."""
    azimuth = options.track + np.degrees(np.arctan2(x, y))
    return vincenty_direct(options.lat, options.lon, azimuth, np.hypot(x, y) * options.range_nm * METRES_PER_NM)


def pixel_of(options, azimuth_deg, distance_m):
    turn = np.radians(azimuth_deg - options.track)
    fraction = distance_m / (options.range_nm * METRES_PER_NM)
    x = (fraction * np.sin(turn) - WIDTH[0]) / (WIDTH[1] - WIDTH[0]) * options.size
    y = (HEIGHT[1] - fraction * np.cos(turn)) / (HEIGHT[1] - HEIGHT[0]) * options.size
    return float(x), float(y)


def draw(options):
    files = find_cells(pathlib.Path(options.terrain))
    if not files:
        sys.exit(f"{options.terrain}: expected DTED or HGT cells, found none")
    step = (WIDTH[1] - WIDTH[0]) / options.size
    x, y = np.meshgrid(WIDTH[0] + (np.arange(options.size) + 0.5) * step,
                       HEIGHT[1] - (np.arange(options.size) + 0.5) * step)
    height = elevations(files, *glass_place(options, x, y))
    metres = step * options.range_nm * METRES_PER_NM
    known = np.nan_to_num(height, nan=0.0)
    down_slope, right_slope = np.gradient(known, metres)
    # The light comes from the apex, like the radar's beam. Slopes up from the apex are bright, slopes down dark.
    distance = np.maximum(np.hypot(x, y), 1e-9)
    rise = (right_slope * x - down_slope * y) / distance
    shade = np.clip(0.42 + 2.2 * rise, 0.06, 1)
    sea = known == 0
    around = np.pad(sea, 1, mode="edge")
    coast = sea & ~(around[:-2, 1:-1] & around[2:, 1:-1] & around[1:-1, :-2] & around[1:-1, 2:])
    picture = np.stack([shade * 235, shade * 235, shade * 215], -1)
    picture[sea] = (10, 16, 34)
    picture[np.isnan(height)] = (150, 30, 120)
    picture[coast] = (0, 220, 235)
    outside = (np.hypot(x, y) > 1) | (np.abs(np.degrees(np.arctan2(x, y))) > HALF_SECTOR_DEG)
    picture[outside] *= 0.25
    return Image.fromarray(np.clip(picture, 0, 255).astype("uint8"))


def add_marks(options, image):
    pen = ImageDraw.Draw(image)
    marks = []
    for latitude, longitude, name in options.mark:
        azimuth, distance = way_to(options.lat, options.lon, float(latitude), float(longitude))
        x, y = pixel_of(options, azimuth, distance)
        marks.append({"name": name, "x": round(x, 2), "y": round(y, 2), "azimuth_deg": round(float(azimuth), 3),
                      "range_nm": round(distance / METRES_PER_NM, 3)})
        pen.ellipse((x - 4, y - 4, x + 4, y + 4), outline=(255, 80, 60))
        pen.text((x + 7, y - 6), name, fill=(255, 190, 60))
    return marks


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrain", required=True, help="folder with DTED (wLLL/nBB.dtN) or HGT cells")
    parser.add_argument("--lat", type=float, required=True)
    parser.add_argument("--lon", type=float, required=True)
    parser.add_argument("--track", type=float, required=True, help="[deg true] up on the picture")
    parser.add_argument("--range-nm", type=float, required=True)
    parser.add_argument("--size", type=int, default=480, help="[pixels] a side")
    parser.add_argument("--out", required=True, help="PNG file")
    parser.add_argument("--mark", nargs=3, action="append", default=[], metavar=("LAT", "LON", "NAME"))
    options = parser.parse_args()
    image = draw(options)
    marks = add_marks(options, image)
    image.save(options.out)
    print(json.dumps({"metres_per_pixel": (WIDTH[1] - WIDTH[0]) / options.size * options.range_nm * METRES_PER_NM,
                      "marks": marks}))


if __name__ == "__main__":
    main()
