"""Items of a data set: poses of the aircraft, targets and movers, drawn by counter. Item k is a function of the
specification and k. A block of items is drawn by array operations; order and size of blocks change no bit.

    sampler = Sampler(plan, limits, world)      # world: ground, scenes, objects; see World
    sample = sampler.draw(numpy.arange(0, 64))  # orders and movers for radar.patches"""
import collections
import dataclasses

import numpy as np

from . import DatasetError, SpecError
from .distributions import Choice, Fixed, Streams
from .limits import ANGLE_MARGIN_DEG, FOOT_M, MILE_M, NEAREST_WINDOWS, RANGE_MARGIN_NM
from .settings import Settings

# As yars.PATCH_ORDER and yars.MOVER.
ORDER = np.dtype([("latitude", "f8"), ("longitude", "f8"), ("altitude_ft", "f8"), ("heading", "f8"), ("speed_kt", "f8"),
                  ("target_latitude", "f8"), ("target_longitude", "f8"), ("window_nm", "f8"), ("looks", "i4"),
                  ("map", "u4"),
                  ("time_s", "f8")])
MOVER = np.dtype([("order", "i4"), ("latitude", "f8"), ("longitude", "f8"), ("heading", "f8"), ("speed_kt", "f8"),
                  ("cross_section_m2", "f8"), ("height_m", "f8")])
ANGLE_DIGITS, OTHER_DIGITS = 9, 6  # of drawn values: 0.1 mm, and hides the last digits of a mathematical library
_GEOMETRY = ("range_nm", "altitude_ft", "depression_deg", "bearing_deg", "squint_deg", "speed_kt", "time_s")
_MOVER = ("north_m", "east_m", "heading_deg", "speed_kt", "cross_section_m2", "height_m")


@dataclasses.dataclass
class World:
    """What draws need of terrain and scenes. `elevation(latitudes, longitudes)`: [m MSL], NaN: void."""
    elevation: object
    scene_centres: np.ndarray  # (scenes, 2) [deg]
    objects: np.ndarray        # structured: name, latitude, longitude; may be empty
    classes: list              # class of each object; None: ignored


@dataclasses.dataclass
class Sample:
    items: np.ndarray
    orders: np.ndarray    # ORDER
    movers: np.ndarray    # MOVER; `order` counts from the first item of the sample
    entry: np.ndarray     # index into plan.targets
    scene: np.ndarray     # index of the scene of a target with `scenes`; -1: none
    object: np.ndarray    # index of the target's object; -1: none
    attempt: np.ndarray   # redraws of each item


class Sampler:
    def __init__(self, plan, limits, world):
        self.plan, self.limits, self.world = plan, limits, world
        # Drawn once for an item, so that redraws do not shift the weights of entries and windows.
        self._kept = Streams(plan.seed, ["target.entry", "geometry.side", "chip.window_nm", "chip.looks"])
        names = ["target.first", "target.second"]
        names += [f"target.{name}" for name in ("north_m", "east_m")] + [f"geometry.{name}" for name in _GEOMETRY]
        self._streams = Streams(plan.seed, names)
        fields = Settings.fields(plan)
        self.settings = Settings(plan, Streams(plan.seed, fields))
        self._movers = [Streams(plan.seed, [f"movers.{group}.{name}" for name in ("count", *_MOVER)])
                        for group in range(len(plan.movers))]
        self._entries = Choice(range(len(plan.targets)), [target.weight for target in plan.targets])
        self._picks = [self._candidates(target) for target in plan.targets]
        self._offsets = any(law.plain() != 0.0 for target in plan.targets for law in (target.north_m, target.east_m))
        self._window = plan.window_nm or Fixed(limits.power_up_nm)
        self._looks = plan.looks or Fixed(limits.looks)
        self._reach = np.array([[window, *ends] for window, ends in sorted(limits.windows.items())])

    def _candidates(self, target):
        """Objects, or scenes, at which an entry's centres lie."""
        if target.scenes is not None:
            return np.arange(len(self.plan.scenes)) if target.scenes == "all" else np.array(target.scenes)
        if target.objects is None:
            return None
        known = sorted({label for label in self.world.classes if label})
        for label in target.objects:
            if label not in known:
                raise SpecError(f"{self.plan.path}:{target.line}: expected a class of the scenes' objects "
                                f"({', '.join(known) or 'none'}) for targets.objects, found {label}")
        return np.flatnonzero([label in target.objects for label in self.world.classes])

    def run_of(self, items):
        """Runs of items that share settings and weather."""
        return np.asarray(items) // self.plan.every if self.settings.drawn() else np.zeros(len(items), np.int64)

    def draw(self, items):
        """Sample of the items. Raises DatasetError if an item stays impossible."""
        items = np.asarray(items, np.int64)
        sample = Sample(items, np.zeros(len(items), ORDER), None, np.zeros(len(items), np.int32),
                        np.full(len(items), -1, np.int32), np.full(len(items), -1, np.int32),
                        np.zeros(len(items), np.int32))
        left, most = np.arange(len(items)), self.plan.geometry["attempts"]
        begin, width = 0, 1
        kept = self._kept.uniform(items)
        while begin < most:
            # Later rounds draw several attempts of the few items that are left at once, and take the first possible.
            width = min(width, most - begin)
            tries = np.tile(np.arange(begin, begin + width), len(left))
            orders, (entry, scene, thing), problem = self._attempt(np.repeat(items[left], width), tries,
                                                                   np.repeat(kept[:, left], width, axis=1))
            table = problem.reshape(len(left), width)
            first = np.where((table == 0).any(axis=1), np.argmax(table == 0, axis=1), width - 1)
            row = np.arange(len(left)) * width + first
            sample.orders[left], sample.entry[left], sample.scene[left], sample.object[left] = (
                orders[row], entry[row], scene[row], thing[row])
            sample.attempt[left] = begin + first
            if not problem[row].any():
                sample.movers = self._draw_movers(sample)
                return sample
            left, begin, width = left[problem[row] > 0], begin + width, width * 4
        raise DatasetError(self._impossible(items, left, kept))

    def _impossible(self, items, left, kept):
        """Message about items for which no draw was possible."""
        most = self.plan.geometry["attempts"]
        first = left[0]
        problem = self._attempt(np.full(most, items[first]), np.arange(most),
                                np.repeat(kept[:, [first]], most, axis=1))[2]
        counts = collections.Counter(_REASONS[code] for code in problem).most_common()
        text = ", ".join(f"{reason} {number} times" for reason, number in counts)
        return (f"{self.plan.where('geometry')}: expected a possible geometry for item {items[first]} in {most} draws, "
                f"found none: {text} ({len(left)} of {len(items)} items drawn together have none); "
                "change geometry or targets, or raise geometry.attempts")

    def _attempt(self, items, attempt, kept):
        u = dict(zip(self._streams.names + self._kept.names, [*self._streams.uniform(items, attempt), *kept]))
        geometry = self.plan.geometry
        window, looks = self._window.sample(u["chip.window_nm"]), self._looks.sample(u["chip.looks"])
        kind, latitude, longitude = self._draw_targets(u)
        drawn = {name: geometry[name].sample(u[f"geometry.{name}"]) for name in _GEOMETRY if name in geometry}
        low, high = self._range_limits(window)
        range_nm = _moved_inside(drawn["range_nm"], low, high, RANGE_MARGIN_NM)
        squint = drawn["squint_deg"]
        if not geometry["force"]:
            blind = self.limits.blind_zone_deg
            squint = _moved_inside(squint, blind, min(180.0 - blind, self.limits.azimuth_deg), ANGLE_MARGIN_DEG)
        back = drawn["bearing_deg"] + 180.0
        own_latitude, own_longitude, away = direct(latitude, longitude, back, range_nm * MILE_M)
        right = {"right": True, "left": False}.get(geometry["side"], u["geometry.side"] < 0.5)
        heading = (away + 180.0 - np.where(right, squint, -squint)) % 360.0
        ground = self.world.elevation(np.concatenate([latitude, own_latitude]),
                                      np.concatenate([longitude, own_longitude]))
        ground = np.nan_to_num(np.asarray(ground, float))
        target_m, beneath_m = ground[:len(items)], ground[len(items):]
        if "depression_deg" in drawn:
            altitude_ft = (target_m + range_nm * MILE_M * np.tan(np.radians(drawn["depression_deg"]))) / FOOT_M
        else:
            altitude_ft = drawn["altitude_ft"]
        orders = np.empty(len(items), ORDER)
        for name, value, digits in (
                ("latitude", own_latitude, ANGLE_DIGITS), ("longitude", own_longitude, ANGLE_DIGITS),
                ("altitude_ft", altitude_ft, OTHER_DIGITS), ("heading", heading, ANGLE_DIGITS),
                ("speed_kt", drawn["speed_kt"], OTHER_DIGITS), ("target_latitude", latitude, ANGLE_DIGITS),
                ("target_longitude", longitude, ANGLE_DIGITS), ("window_nm", window, ANGLE_DIGITS),
                ("time_s", drawn["time_s"], OTHER_DIGITS)):
            orders[name] = np.round(value, digits)
        orders["looks"], orders["map"] = looks, ((items + 1) & 0xFFFFFFFF).astype(np.uint32)
        return orders, kind, self._problems(orders, kind[0], range_nm, squint, (low, high), target_m, beneath_m)

    def _draw_targets(self, u):
        """((entry, scene, object), latitude, longitude) of each item."""
        plan = self.plan
        entry = self._entries.index(u["target.entry"]).astype(np.int32)
        latitude, longitude, north_m, east_m = np.zeros((4, len(entry)))
        scene, thing = np.full((2, len(entry)), -1, np.int32)
        for number, target in enumerate(plan.targets):
            at = np.flatnonzero(entry == number)
            if not len(at):
                continue
            first = u["target.first"][at]
            if target.area:
                south, west, north, east = target.area
                sines = np.sin(np.radians([south, north]))
                base = (np.degrees(np.arcsin(sines[0] + first * (sines[1] - sines[0]))),
                        west + u["target.second"][at] * ((east - west) % 360.0 or (360.0 if east != west else 0.0)))
            else:
                picks = self._picks[number]
                pick = picks[np.minimum((first * len(picks)).astype(np.int64), len(picks) - 1)]
                if target.objects is None:
                    scene[at] = pick
                    base = self.world.scene_centres[pick].T
                else:
                    thing[at] = pick
                    base = self.world.objects["latitude"][pick], self.world.objects["longitude"][pick]
            latitude[at], longitude[at] = base
            north_m[at], east_m[at] = (law.sample(u[f"target.{name}"][at]) for name, law in
                                       (("north_m", target.north_m), ("east_m", target.east_m)))
        if self._offsets:
            latitude, longitude = offset(latitude, longitude, north_m, east_m)
        return (entry, scene, thing), latitude, wrapped(longitude)

    def _range_limits(self, window):
        """Least and greatest ground range [NM] for each window."""
        nearest = NEAREST_WINDOWS * window
        if self.plan.geometry["force"]:
            return nearest, np.full(len(window), np.inf)
        row = self._reach[np.minimum(np.searchsorted(self._reach[:, 0], window), len(self._reach) - 1)]
        return np.maximum(row[:, 1], nearest), row[:, 2]

    def _problems(self, orders, entry, range_nm, squint, limits_nm, target_m, beneath_m):
        """Index into _REASONS for each item; 0: possible."""
        problem = np.zeros(len(orders), np.int8)
        problem[(range_nm < limits_nm[0]) | (range_nm > limits_nm[1])] = 1
        if not self.plan.geometry["force"]:
            off = np.minimum(squint, 180.0 - squint)
            problem[off < self.limits.blind_zone_deg] = 2
            problem[squint > self.limits.azimuth_deg] = 3
            steep = np.degrees(np.arctan2(np.abs(orders["altitude_ft"] * FOOT_M - target_m), range_nm * MILE_M))
            problem[steep > self.limits.elevation_deg] = 4
            problem[orders["altitude_ft"] * FOOT_M < beneath_m + 0.01] = 5
        for number, target in enumerate(self.plan.targets):
            if target.on != "any":
                sea = target_m == 0.0
                problem[(entry == number) & (sea if target.on == "land" else ~sea)] = 6
        return problem

    def _draw_movers(self, sample):
        parts = []
        for streams, group in zip(self._movers, self.plan.movers):
            most = max(group["count"].ends())
            if most == 0:
                continue
            count = group["count"].sample(streams.uniform(sample.items)[0])
            order, number = np.nonzero(np.arange(most) < count[:, None])
            u = streams.uniform(sample.items[order], draw=number)
            value = {name: group[name].sample(u[1 + row]) for row, name in enumerate(_MOVER)}
            part = np.empty(len(order), MOVER)
            base = sample.orders[order]
            latitude, longitude = offset(base["target_latitude"], base["target_longitude"], value["north_m"],
                                         value["east_m"])
            part["order"] = order
            part["latitude"], part["longitude"] = np.round(latitude, ANGLE_DIGITS), np.round(longitude, ANGLE_DIGITS)
            part["heading"] = np.round(value["heading_deg"] % 360.0, ANGLE_DIGITS)
            for name in ("speed_kt", "cross_section_m2", "height_m"):
                part[name] = np.round(value[name], OTHER_DIGITS)
            parts.append(part)
        movers = np.concatenate(parts) if parts else np.empty(0, MOVER)
        return movers[np.argsort(movers["order"], kind="stable")]


_REASONS = ("possible", "range beyond the window's limits", "blind zone", "azimuth beyond the gimbal",
            "elevation beyond the gimbal", "aircraft beneath the ground", "centre not on land or sea as wanted")


def _moved_inside(value, low, high, margin):
    """Values on a limit, moved inside by a margin."""
    value = np.where(np.abs(value - low) < margin, low + margin, value)
    return np.where(np.abs(value - high) < margin, high - margin, value)


# Geodesics on WGS84 for whole arrays: Vincenty,
# "Direct and Inverse Solutions of Geodesics on the Ellipsoid with Application of Nested
# Equations", Survey Review 23 (1975). Accuracy: 1 mm, up to 2,000 km. Angles in degrees.
_MAJOR_M, _FLATTENING = 6378137.0, 1.0 / 298.257223563
_MINOR_M = _MAJOR_M * (1.0 - _FLATTENING)
_STEPS = 3  # each step gains three digits or more


def direct(latitude, longitude, azimuth, distance_m):
    """(latitude, longitude, azimuth at the end) of the point at a distance along a geodesic."""
    alpha = np.radians(azimuth)
    sin_alpha1, cos_alpha1 = np.sin(alpha), np.cos(alpha)
    tan_u1 = (1.0 - _FLATTENING) * np.tan(np.radians(latitude))
    cos_u1 = 1.0 / np.sqrt(1.0 + tan_u1 * tan_u1)
    sin_u1 = tan_u1 * cos_u1
    sigma1 = np.arctan2(tan_u1, cos_alpha1)
    sin_alpha = cos_u1 * sin_alpha1
    cos2_alpha = 1.0 - sin_alpha * sin_alpha
    u2 = cos2_alpha * (_MAJOR_M**2 - _MINOR_M**2) / _MINOR_M**2
    a = 1.0 + u2 / 16384.0 * (4096.0 + u2 * (-768.0 + u2 * (320.0 - 175.0 * u2)))
    b = u2 / 1024.0 * (256.0 + u2 * (-128.0 + u2 * (74.0 - 47.0 * u2)))
    first = sigma = np.asarray(distance_m, float) / (_MINOR_M * a)
    for _ in range(_STEPS):
        middle = np.cos(2.0 * sigma1 + sigma)
        sin_sigma, cos_sigma = np.sin(sigma), np.cos(sigma)
        sigma = first + b * sin_sigma * (middle + b / 4.0 * (
            cos_sigma * (2.0 * middle**2 - 1.0) -
            b / 6.0 * middle * (4.0 * sin_sigma**2 - 3.0) * (4.0 * middle**2 - 3.0)))
    sin_sigma, cos_sigma, middle = np.sin(sigma), np.cos(sigma), np.cos(2.0 * sigma1 + sigma)
    across = sin_u1 * sin_sigma - cos_u1 * cos_sigma * cos_alpha1
    latitude2 = np.arctan2(sin_u1 * cos_sigma + cos_u1 * sin_sigma * cos_alpha1,
                           (1.0 - _FLATTENING) * np.sqrt(sin_alpha**2 + across**2))
    lam = np.arctan2(sin_sigma * sin_alpha1, cos_u1 * cos_sigma - sin_u1 * sin_sigma * cos_alpha1)
    c = _FLATTENING / 16.0 * cos2_alpha * (4.0 + _FLATTENING * (4.0 - 3.0 * cos2_alpha))
    lon = lam - (1.0 - c) * _FLATTENING * sin_alpha * (
        sigma + c * sin_sigma * (middle + c * cos_sigma * (2.0 * middle**2 - 1.0)))
    return np.degrees(latitude2), wrapped(longitude + np.degrees(lon)), np.degrees(np.arctan2(sin_alpha, -across))


def offset(latitude, longitude, north_m, east_m):
    """(latitude, longitude) of a point north_m and east_m away."""
    latitude, longitude, _ = direct(latitude, longitude, np.degrees(np.arctan2(east_m, north_m)),
                                    np.hypot(north_m, east_m))
    return latitude, longitude


def wrapped(longitude):
    """[-180, 180)."""
    return (np.asarray(longitude) + 180.0) % 360.0 - 180.0
