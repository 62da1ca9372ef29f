"""Pictures of results by matplotlib: PPI of a scan, patch map, map with coast and footprints, front of a trade.

    ax = yars.plot.ppi(radar.scan(terrain, latitude_deg=38.39, longitude_deg=-121.02, altitude_ft=15000,
                                  heading_deg=195, range_nm=40))
    ax.figure.savefig("scan.png")

Each function draws into `ax`, or into a figure of its own, and returns the Axes. Axes have units; values with a unit
have a colour bar. No function chooses a backend or opens a window: matplotlib's Agg draws where there is no screen.
What is drawn is any object with the arrays of yars.Scan and yars.Patch. Errors: ValueError.
"""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from . import _require
from .arguments import shown, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes

numpy = _require("numpy", "yars.plot")
_require("matplotlib", "yars.plot")

NM = 1852.0  # [m]
_METRES = {"m": 1.0, "km": 1000.0, "NM": NM}
# Array -> its words, its colours, range of its values; None: that of the data.
_QUANTITIES = {
    "video": ("video", "gray", (0, 255)), "power": ("power", "gray", None), "shadow": ("shadow", "gray_r", (0, 1)),
    "layover": ("layover", "gray_r", (0, 1)), "object": ("object", "tab20", None),
    "material": ("material", "tab20", None), "height": ("height", "viridis", None),
    "slant_range": ("slant range", "viridis", None), "ground_range": ("ground range", "viridis", None),
    "grazing_angle": ("grazing angle", "viridis", None), "latitude": ("latitude", "viridis", None),
    "longitude": ("longitude", "viridis", None)}
_WITHOUT_UNIT = ("video", "shadow", "layover", "object", "material")
_FOOTPRINTS = ("#c81e1e", "#1e5abe", "#823ca0", "#b46414", "#147d82")
_FAMILIES = ("#c81e1e", "#1e5abe", "#1e8c46", "#b46414", "#823ca0", "#147d82", "#a0a01e", "#5a5a5a", "#be3c82",
             "#3c3cc8", "#6e4b2d", "#28a078")


def ppi(scan: Any, ax: Axes | None = None, quantity: str = "video") -> Axes:
    """Plan position indicator of a scan: the middle of the scan points up, distances are ground range [NM].
    `quantity`: name of an array of the scan; power is drawn in decibels."""
    _check("yars.plot.ppi: scan", scan, "a scan", ("azimuth", "ground_range", "units"))
    values, style, label = _values(scan, quantity)
    azimuth_deg = numpy.unwrap(numpy.atleast_1d(numpy.asarray(scan.azimuth, float)), period=360.0)
    if azimuth_deg.shape != values.shape[:1]:
        raise ValueError(f"scan: expected an azimuth for each of its {values.shape[0]} sweeps, "
                         f"found {azimuth_deg.shape}")
    up_deg = 0.5 * (azimuth_deg.min() + azimuth_deg.max())
    range_nm = _filled(numpy.broadcast_to(scan.ground_range, values.shape) * _metres(scan, "ground_range") / NM)
    range_nm = numpy.maximum(_edges(_edges(range_nm, 1), 0), 0.0)
    turn = numpy.radians(_edges(azimuth_deg, 0) - up_deg)[:, None]
    ax = _axes(ax)
    mesh = ax.pcolormesh(range_nm * numpy.sin(turn), range_nm * numpy.cos(turn), values, rasterized=True, **style)
    ax.set_aspect("equal")
    ax.set_xlabel(f"ground range across azimuth {up_deg % 360.0:.1f}\N{DEGREE SIGN} [NM]")
    ax.set_ylabel(f"ground range along azimuth {up_deg % 360.0:.1f}\N{DEGREE SIGN} [NM]")
    _color_bar(ax, mesh, label)
    return ax


def patch(patch: Any, ax: Axes | None = None, quantity: str = "video") -> Axes:
    """Patch map: the far edge is at the top, distances are from the map's centre [m], pixels are square.
    `quantity`: name of an array of the patch; power is drawn in decibels."""
    _check("yars.plot.patch: patch", patch, "a patch map", ("ground_range", "units"), ("azimuth",))
    values, style, label = _values(patch, quantity)
    rows, columns = values.shape
    pixel_m = _pixel_m(patch, rows, columns)
    half_width_m, half_height_m = 0.5 * columns * pixel_m, 0.5 * rows * pixel_m
    ax = _axes(ax)
    image = ax.imshow(values, origin="upper", aspect="equal", interpolation="nearest",
                      extent=(-half_width_m, half_width_m, -half_height_m, half_height_m), **style)
    ax.set_xlabel("across the line of sight [m]")
    ax.set_ylabel("along the line of sight [m]")
    _color_bar(ax, image, label)
    return ax


def map(terrain: Any, *results: Any, ax: Axes | None = None, bounds: tuple[float, float, float, float] | None = None,
        posts: int = 400) -> Axes:
    """Elevation with the coast, a line between ground above 0 m MSL and the rest, and the outline of each scan or
    patch. Water and ground at or below 0 m are blue, voids are gray. `bounds`: (south, west, north, east) [deg]; None:
    around `results`. `posts`: rows and columns of the elevations that are read."""
    _check("yars.plot.map: terrain", terrain, "a yars.Terrain", ("elevation",))
    for result in results:
        _check("yars.plot.map", result, "scans and patch maps after the terrain", ("latitude", "longitude"))
    posts = whole("yars.plot.map: posts", posts, 2, 10000)
    if bounds is not None and numpy.shape(bounds) != (4,):
        raise ValueError(f"bounds: expected (south, west, north, east) in degrees, found {shown(bounds)}")
    outlines = [_outline(result) for result in results]
    south, west, north, east = _around(outlines) if bounds is None else (float(edge) for edge in bounds)
    if not (-90.0 <= south < north <= 90.0 and west < east <= west + 360.0):
        raise ValueError(f"bounds: expected (south, west, north, east) in degrees, found {(south, west, north, east)}")
    latitude, longitude = numpy.linspace(south, north, posts), numpy.linspace(west, east, posts)
    grid = numpy.meshgrid(latitude, (longitude + 180.0) % 360.0 - 180.0, indexing="ij")
    elevation_m = numpy.ma.masked_invalid(numpy.asarray(terrain.elevation(*grid), float))
    ax = _axes(ax)
    ax.set_facecolor("#c8c8c8")
    land = numpy.ma.masked_where(elevation_m <= 0.0, elevation_m)
    ax.pcolormesh(longitude, latitude, numpy.ma.masked_where(elevation_m > 0.0, elevation_m * 0.0), cmap="Blues",
                  vmin=-1.0, vmax=2.0, shading="nearest", rasterized=True)
    mesh = ax.pcolormesh(longitude, latitude, land, cmap="YlGn_r", vmin=0.0, shading="nearest", rasterized=True)
    is_land = (elevation_m > 0.0).astype(float)
    if is_land.count() and is_land.min() < is_land.max():
        ax.contour(longitude, latitude, is_land, [0.5], colors="#14365a", linewidths=1.0)
    if land.count():
        _color_bar(ax, mesh, "elevation [m MSL]")
    for number, (result, (outline_latitude, outline_longitude)) in enumerate(zip(results, outlines)):
        kind = "scan" if hasattr(result, "azimuth") else "patch"
        ax.plot(outline_longitude + 360.0 * round((0.5 * (west + east) - outline_longitude.mean()) / 360.0),
                outline_latitude, color=_FOOTPRINTS[number % len(_FOOTPRINTS)], linewidth=1.5,
                label=f"{kind} {number + 1}" if results[1:] else kind)
    if results:
        ax.legend()
    ax.set_xlim(west, east)
    ax.set_ylim(south, north)
    ax.set_aspect(1.0 / math.cos(math.radians(0.5 * (south + north))))
    ax.ticklabel_format(useOffset=False)
    ax.locator_params(axis="x", nbins=5)
    ax.set_xlabel("longitude [deg]")
    ax.set_ylabel("latitude [deg]")
    return ax


def trade_front(rows: dict[str, Any], ax: Axes | None = None, error: str | None = None) -> Axes:
    """Time against error of what yars.trade() or `yars trade --out FILE.json` found. A marker is the mean over the
    scenes, an error bar ends at the worst scene; the thick gray line is the Pareto front.
    `error`: column of the errors, such as "shadow_percent"; None: the first of rows["axes"]["errors"]."""
    if not isinstance(rows, dict) or not {"axes", "points"} <= set(rows):
        raise TypeError(f"yars.plot.trade_front: rows: expected the dict that yars.trade() gives, found {shown(rows)}")
    ax = _axes(ax)
    labels = draw_front(rows, ax, error)
    ax.figure.canvas.draw()
    label_points(ax, labels)
    return ax


# ---- parts of the pictures of scans, patches and maps
def _check(where, value, expected, has, has_not=()):
    """Refuses an object without the attributes `has`, or with one of `has_not`."""
    kind = type(value)
    if (not all(hasattr(kind, name) or hasattr(value, name) for name in has) or
            any(hasattr(kind, name) or hasattr(value, name) for name in has_not)):
        raise TypeError(f"{where}: expected {expected}, found {shown(value)}")


def _axes(ax):
    if ax is not None:
        _check("ax", ax, "the Axes of matplotlib or None", ("pcolormesh", "figure"))
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(constrained_layout=True)[1]


def _values(result, quantity):
    """The array to draw, masked where it is not known; colours; the label of its colour bar or None."""
    if quantity not in _QUANTITIES or not hasattr(result, quantity):
        there = ", ".join(name for name in _QUANTITIES if hasattr(result, name))
        raise ValueError(f"quantity: expected one of {there}, found {quantity!r}")
    words, colors, limits = _QUANTITIES[quantity]
    values = numpy.asarray(getattr(result, quantity))
    if values.ndim != 2:
        raise ValueError(f"{quantity}: expected an array of two dimensions, found the shape {values.shape}")
    unit = result.units.get(quantity, "")
    style = {"cmap": colors}
    if limits:
        style.update(vmin=limits[0], vmax=limits[1])
    if quantity == "power":
        values = numpy.ma.masked_invalid(numpy.asarray(values, float))
        values = 10.0 * numpy.ma.log10(numpy.ma.masked_less_equal(values, 0.0))
        unit = "dB" + (unit if unit == "W" else "")
    elif quantity == "object":
        values = numpy.ma.masked_less(values, 0)
    else:
        values = numpy.ma.masked_invalid(values)
    return values, style, None if quantity in _WITHOUT_UNIT or not unit else f"{words} [{unit}]"


def _metres(result, quantity):
    """[m] of the unit of an array."""
    unit = result.units.get(quantity, "m")
    if unit not in _METRES:
        raise ValueError(f"units: expected {', '.join(_METRES)} for {quantity}, found {unit!r}")
    return _METRES[unit]


def _color_bar(ax, drawn, label):
    if label:
        ax.figure.colorbar(drawn, ax=ax, label=label)


def _filled(rows):
    """Rows whose unknown elements follow the line of their known neighbours; a row without these is that before it."""
    filled = numpy.array(rows, float)
    at = numpy.arange(filled.shape[1])
    good = numpy.flatnonzero(numpy.isfinite(filled).sum(axis=1) >= 2)
    if not good.size:
        raise ValueError("ground_range: expected a sweep with at least two known samples, found none")
    filled = filled[good[numpy.maximum(numpy.searchsorted(good, numpy.arange(len(filled)), side="right") - 1, 0)]]
    for row in filled:
        known = numpy.flatnonzero(numpy.isfinite(row))
        first, last = known[0], known[-1]
        row[:] = numpy.interp(at, known, row[known])
        step = (row[last] - row[first]) / (last - first)
        row[:first] = row[first] + step * (at[:first] - first)
        row[last + 1:] = row[last] + step * (at[last + 1:] - last)
    return filled


def _edges(centres, axis):
    """Edges of cells with these centres: one more along `axis`, half a step beyond the first and the last. A single
    sweep is 1 degree wide."""
    centres = numpy.moveaxis(centres, axis, 0)
    if len(centres) < 2:
        edges = (numpy.stack([centres[0] - 0.5, centres[0] + 0.5]) if axis == 0 and centres.ndim == 1
                 else numpy.stack([centres[0]] * 2))
    else:
        middle = 0.5 * (centres[1:] + centres[:-1])
        edges = numpy.concatenate([[2.0 * centres[0] - middle[0]], middle, [2.0 * centres[-1] - middle[-1]]])
    return numpy.moveaxis(edges, 0, axis)


def _pixel_m(patch, rows, columns):
    """[m] side of a pixel: ground range by row, down the middle column."""
    distance_m = (numpy.broadcast_to(patch.ground_range, (rows, columns))[:, columns // 2] *
                  _metres(patch, "ground_range"))
    known = numpy.flatnonzero(numpy.isfinite(distance_m))
    if known.size < 2:
        raise ValueError("ground_range: expected at least two known rows, found fewer")
    return abs(float(numpy.polyfit(known, distance_m[known], 1)[0]))


def _outline(result):
    """Latitude and longitude [deg] around a scan or patch, closed; unknown positions are left out."""
    sides = []
    for array in (result.latitude, result.longitude):
        array = numpy.asarray(array, float)
        sides.append(numpy.concatenate([array[0], array[:, -1], array[-1, ::-1], array[::-1, 0]]))
    known = numpy.isfinite(sides[0]) & numpy.isfinite(sides[1])
    if not known.any():
        raise ValueError("latitude, longitude: expected known positions around the scan or patch, found none")
    latitude, longitude = sides[0][known], numpy.unwrap(sides[1][known], period=360.0)
    return numpy.append(latitude, latitude[0]), numpy.append(longitude, longitude[0])


def _around(outlines):
    if not outlines:
        raise ValueError("bounds: expected (south, west, north, east) or a scan or patch to draw, found neither")
    for _, longitude in outlines:
        if numpy.ptp(longitude) > 180.0:
            raise ValueError("bounds: expected a scan or patch that does not reach around a pole, found one that spans "
                             f"{numpy.ptp(longitude):.0f} degrees of longitude; give bounds=(south, -180, north, 180)")
    first = outlines[0][1].mean()
    latitude = numpy.concatenate([latitude for latitude, _ in outlines])
    longitude = numpy.concatenate([longitude - 360.0 * numpy.round((longitude.mean() - first) / 360.0)
                                   for _, longitude in outlines])
    margin_deg = 0.1 * max(numpy.ptp(latitude), numpy.ptp(longitude) * math.cos(math.radians(latitude.mean())), 0.01)
    return (max(latitude.min() - margin_deg, -90.0), longitude.min() - margin_deg,
            min(latitude.max() + margin_deg, 90.0), longitude.max() + margin_deg)


# ---- parts of the picture of a trade; plot_trade draws panels with them
def pareto_front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Of (time, error) pairs those that no other beats in both, by time."""
    front: list[tuple[float, float]] = []
    for point in sorted(points):
        if not front or point[1] < front[-1][1]:
            front.append(point)
    return front


def _error_of(rows, error):
    errors = rows["axes"]["errors"]
    for one in errors:
        if error in (None, one["column"]):
            return one
    raise ValueError(f"error: expected one of {', '.join(one['column'] for one in errors)}, found {error!r}")


def draw_front(rows: dict[str, Any], ax: Axes, error: str | None = None) -> list[tuple[float, float, float, str, str]]:
    """Draws all of trade_front but the names of the points, and returns these for label_points."""
    chosen, time = _error_of(rows, error), rows["axes"]["time"]
    families = list(dict.fromkeys(point["family"] for point in rows["points"]))
    points = [(point[time["column"]]["mean"], point[chosen["column"]]["mean"], point[chosen["column"]]["worst"], point)
              for point in rows["points"] if point[chosen["column"]]["mean"] is not None]
    floor = min((mean for _, mean, _, _ in points if mean > 0), default=1.0) / 3  # the row of those without an error
    ax.set_xscale("log")
    ax.set_yscale("log")
    front = pareto_front([(x, max(mean, floor)) for x, mean, _, _ in points])
    ax.plot([x for x, _ in front], [y for _, y in front], color="#c8c8c8", linewidth=7, solid_capstyle="round",
            zorder=1, label="Pareto front")
    labels = []
    for number, family in enumerate(families):
        mine = sorted((x, max(mean, floor), max(worst, floor), point["point"]) for x, mean, worst, point in points
                      if point["family"] == family)
        if not mine:
            continue
        color = _FAMILIES[number % len(_FAMILIES)]
        xs, means, worsts, _ = zip(*mine)
        ax.errorbar(xs, means, yerr=[[0] * len(xs), [w - m for w, m in zip(worsts, means)]], color=color, marker="o",
                    markersize=6, linewidth=1 if family != "preset" else 0, elinewidth=1, capsize=3, label=family,
                    zorder=2)
        labels += [(x, mean, worst, name, color) for x, mean, worst, name in mine]
    if any(mean <= 0 for _, mean, _, _ in points):
        ax.axhline(floor, color="#888888", linestyle=":", linewidth=1, zorder=0)
        ax.text(0.995, floor, "none", transform=ax.get_yaxis_transform(), fontsize=9, va="bottom", ha="right",
                color="#555555")
    ax.margins(x=0.12, y=0.12)
    ax.set_xlabel(time["title"])
    ax.set_ylabel(chosen["title"])
    ax.grid(True, which="major", color="#e4e4e4")
    return labels


# Of a name from its marker [pixels].
_OFFSETS = [(radius * math.cos(turn * math.pi / 8), radius * math.sin(turn * math.pi / 8))
            for radius in (9, 16, 26, 40, 58, 80, 110, 150)
            for turn in (0, 8, 4, 12, 2, 6, 14, 10, 1, 7, 15, 9, 3, 5, 11, 13)]


def _best_box(at, size, frame, taken):
    """The box [pixels] for a text of `size` beside the point `at` that covers least, and its distance."""
    best = None
    for dx, dy in _OFFSETS:
        left = at[0] + dx - (size[0] if dx < -1 else size[0] / 2 if abs(dx) <= 1 else 0)
        bottom = at[1] + dy - size[1] / 2
        one = (left - 1, bottom - 1, left + size[0] + 1, bottom + size[1] + 1)
        inside = one[0] >= frame.x0 and one[1] >= frame.y0 and one[2] <= frame.x1 and one[3] <= frame.y1
        covered = sum(one[0] < o[2] and o[0] < one[2] and one[1] < o[3] and o[1] < one[3] for o in taken)
        cost = (covered + (0 if inside else 100), math.hypot(dx, dy))
        if best is None or cost < best[0]:
            best = (cost, one, math.hypot(dx, dy))
        if cost[0] == 0:
            break
    return best[1], best[2]


def label_points(ax: Axes,
                 labels: list[tuple[float, float, float, str, str]]) -> list[tuple[float, float, float, float]]:
    """Puts a text beside each (x, y, worst, text, color); no text covers another one, a marker or an error bar while
    there is room. The figure must have been drawn. The boxes [pixels] of the texts."""
    frame = ax.get_window_extent()
    at = [ax.transData.transform((x, y)) for x, y, _, _, _ in labels]
    ends = [ax.transData.transform((x, worst)) for x, _, worst, _, _ in labels]
    taken = [(px - 5, py - 5, px + 5, py + 5) for px, py in at]
    taken += [(px - 3, py, px + 3, end) for (px, py), (_, end) in zip(at, ends)]
    placed = []
    for point, (x, y, _, text, color) in sorted(zip(at, labels), key=lambda one: -one[0][1]):
        probe = ax.text(x, y, text, fontsize=9, color=color)
        box = probe.get_window_extent()
        probe.remove()
        one, distance = _best_box(point, (box.width, box.height), frame, taken)
        taken.append(one)
        placed.append(one)
        middle = ((one[0] + one[2]) / 2, (one[1] + one[3]) / 2)
        line = {"arrowprops": {"arrowstyle": "-", "color": color, "lw": 0.5}} if distance > 20 else {}
        ax.annotate(text, (x, y), xytext=ax.transData.inverted().transform(middle), fontsize=9, color=color,
                    ha="center", va="center", bbox={"facecolor": "white", "alpha": 0.7, "pad": 0.5, "linewidth": 0},
                    **line)
    return placed
