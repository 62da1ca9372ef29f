"""Table of all keys of a specification: kind, range, unit, default, purpose. yars.dataset.spec checks files by it.
`yars dataset --keys` prints it, and the build makes the page dataset_keys.md of it: `python3 keys.py`, which needs no
other module of the package. A key of a list's item has the path of its list."""
import collections
import math

INFINITY = float("inf")

# kind: whole, number, text, yes/no, list, section, path, place, names, any. `drawn`: a distribution is allowed. `most`:
# a whole number or number lies in [least, most]; of a text, `values` are the words allowed.
Key = collections.namedtuple("Key", "path kind least most unit drawn default text values", defaults=((),))

ARRAYS = ("video", "power", "shadow", "layover", "object", "material", "height", "grazing_angle")
PRESETS = ("1996", "draft", "standard", "fine", "reference")  # generated
COMPRESSIONS = ("lz4", "zstd", "none")
# Groups of sections, in the order of the documentation.
SECTIONS = ("chip", "radar", "weather", "weather.rain", "terrain.generate", "scenes", "targets", "geometry", "movers",
            "classes", "output")


# Values that keys share with records and requests.
# begin: lib/values/generate.py
_COUNTS = {"kMaxRainCells": 64, "kMaxJammers": 16, "kMaxMovers": 64, "kMaxWorldPoints": 256}
_VALUES = {  # least, greatest, unit, default, purpose
    "TrafficEntity.height": (0, 1000, "m", None, "height of the reflecting point above the ground or water"),
    "TrafficEntity.cross_section": (0, 1e7, "m2", None, "radar cross section"),
    "WorldRainCell.radius": (0.1, 100, "NM", "5", "radius of the rim"),
    "WorldRainCell.rate": (0.1, 300, "mm/h", "10", "rain rate at the axis"),
    "WorldRainCell.top": (500, 60000, "ft", "15000", "top above mean sea level"),
    "WorldMover.speed": (0, 10000, "kt", "0", "over ground"),
    "WorldMover.heading": (-360, 360, "deg", "0",
                           "true heading at the beginning; later the direction of the great circle"),
    "WorldState.sea_state": (0, 6, "", None, "state of the sea, WMO code 3700"),
    "WorldState.wind_speed": (0, 120, "kt", "10", "wind over the sea; used if the sea state is not given"),
    "WorldState.wind_from": (0, 360, "deg", "270",
                             "true direction from which the wind blows; the sea is brightest in this direction"),
    "PatchRequest.altitude": (-3000, 600000, "ft", "15000", "altitude of the aircraft above mean sea level"),
    "PatchRequest.speed": (0, 10000, "kt", "480", "speed over ground"),
    "PatchRequest.window": (0.01, 200, "NM", None, "side of the map"),
    "PatchRequest.looks": (1, 16, "", None, "number of looks to average"),
    "PatchRequest.size": (16, 4096, "pixels", None, "per side; up to 1024 with the preset reference"),
    "PatchRequest.time": (0, 576460752, "s", "0", "sim time at the start, for moving targets"),
    "TerrainGeneration.south": (-90, 89, "deg", "36", "south edge"),
    "TerrainGeneration.west": (-180, 179, "deg", "-124", "west edge"),
    "TerrainGeneration.cells_lat": (1, 180, "", "4", "cells northward"),
    "TerrainGeneration.cells_lon": (1, 360, "", "4", "cells eastward"),
    "TerrainGeneration.level": (0, 2, "", "1", "DTED level"),
    "SceneGeneration.triangles": (1, 8000000, "", "20000", "approximate number; an instance counts at each use"),
}
# end: lib/values/generate.py


def _key(path, kind, ends=None, unit="", drawn=False, default="required", text="", values=()):
    least, most = ends or (-INFINITY, INFINITY)
    return Key(path, kind, least, most, unit, drawn, default, text, tuple(values))


def _value(path, name, default=None, text=None, kind="number", drawn=True):
    """A key whose limits, unit, default and purpose are those of a value of the description."""
    least, most, unit, its_default, purpose = _VALUES[name]
    return _key(path, kind, (least, most), unit, drawn, default or its_default or "required", text or purpose)


_ROWS = [
    _key("count", "whole", (1, 10**9), text="number of items (chips)"),
    _key("seed", "whole", (0, 2**53), default="1",
         text="seed of every draw; item k depends on the seed and on k alone"),
    _key("chip", "section", default="see below", text="the picture"),
    _key("radar", "section", default="the radar of YARS", text="the sensor"),
    _key("weather", "section", default="the configuration's", text="sea, wind and rain"),
    _key("terrain", "path", default="built-in hills", text="folder of elevation cells; or {generate: ...}"),
    _key("scenes", "list", default="none", text="polygonal scenes on the terrain, given or generated"),
    _key("targets", "list", default="at the scenes",
         text="where the chips' centres lie; an item takes one entry, by weight"),
    _key("geometry", "section", text="where the aircraft is, seen from the target"),
    _key("movers", "list", default="none", text="groups of moving targets"),
    _key("classes", "section", default="names without digits",
         text="class: pattern or list of patterns of object names"),
    _key("output", "section", default="see below", text="the files"),

    _key("chip.size", "whole", _VALUES["PatchRequest.size"][:2], "pixels", default="128", text="pixels along the edge"),
    _value("chip.window_nm", "PatchRequest.window", "the radar's at power-up", "edge of the ground shown"),
    _value("chip.looks", "PatchRequest.looks", "the radar's for ML1", kind="whole"),
    _key("chip.arrays", "names", default="[video, shadow, layover, object, material]", text="arrays to keep",
         values=ARRAYS),

    _key("radar.preset", "text", default="the configuration's", text="fidelity", values=PRESETS),
    _key("radar.config", "path", default="built-in APG-70", text="GUF file of the radar"),
    _key("radar.knobs", "any", default="none", text="slots of the form Fidelity in snake_case, such as map_noise"),
    _key("radar.settings", "any", drawn=True, default="none", text="GUF slots by form: {Receiver: {frequency: 9.4}}"),
    _key("radar.every", "whole", (1, 10**9), "items", default="64",
         text="settings and weather are drawn once for so many successive items"),

    _value("weather.sea_state", "WorldState.sea_state", "by the wind"),
    _value("weather.wind_speed_kt", "WorldState.wind_speed", "the configuration's"),
    _value("weather.wind_from_deg", "WorldState.wind_from", "the configuration's"),
    _key("weather.rain", "section", default="the configuration's", text="showers"),
    _key("weather.rain.cells", "whole", (0, _COUNTS["kMaxRainCells"]), "", True, "1", "number of showers"),
    _key("weather.rain.area", "place", unit="deg", text="[south, west, north, east] of their centres"),
    _value("weather.rain.radius_nm", "WorldRainCell.radius"),
    _value("weather.rain.rate_mm_h", "WorldRainCell.rate"),
    _value("weather.rain.top_ft", "WorldRainCell.top"),

    _key("terrain.generate", "section", default="none", text="made-up terrain, written to DIR/terrain"),
    _value("terrain.generate.south", "TerrainGeneration.south", "required", kind="whole", drawn=False),
    _value("terrain.generate.west", "TerrainGeneration.west", "required", kind="whole", drawn=False),
    _value("terrain.generate.cells_lat", "TerrainGeneration.cells_lat", "1", kind="whole", drawn=False),
    _value("terrain.generate.cells_lon", "TerrainGeneration.cells_lon", "1", kind="whole", drawn=False),
    _value("terrain.generate.level", "TerrainGeneration.level", "1", kind="whole", drawn=False),
    _key("terrain.generate.seed", "whole", (0, 2**53), "", default="12", text="seed of the landscape"),
    _key("terrain.generate.edge", "text", default="coast", text="what is at the area's edge", values=("coast", "cut")),

    _key("scenes.file", "path", default="none", text="OpenFlight file; this or `generate`"),
    _key("scenes.generate", "text", default="none", text="kind of a made-up scene, written to DIR/scenes",
         values=("airfield", "harbour", "bridge", "town")),
    _value("scenes.triangles", "SceneGeneration.triangles", "20000", "of a made-up scene: approximate number",
           kind="whole", drawn=False),
    _key("scenes.seed", "whole", (0, 2**53), "", default="1", text="of a made-up scene"),
    _key("scenes.at", "place", unit="deg", default="the file's own",
         text="[latitude, longitude] or [latitude, longitude, heading]"),
    _key("scenes.without", "names", default="[]", text="of a file: names of nodes to leave out, with * and ?"),

    _key("targets.weight", "number", (0, 1e9), "", default="1", text="how often, relative to the other entries"),
    _key("targets.area", "place", unit="deg", default="none", text="[south, west, north, east]: anywhere in it"),
    _key("targets.on", "text", default="any", text="of an area: draw again until the centre is on",
         values=("any", "land", "sea")),
    _key("targets.scenes", "any", default="none", text="at the centre of a scene: all, or numbers from 0"),
    _key("targets.objects", "names", default="none", text="at an object of these classes"),
    _key("targets.north_m", "number", (-1e6, 1e6), "m", True, "0", "offset of the centre to the north"),
    _key("targets.east_m", "number", (-1e6, 1e6), "m", True, "0", "offset of the centre to the east"),

    _key("geometry.range_nm", "number", (0.01, 1000), "NM", True, text="ground range from the aircraft to the target"),
    _value("geometry.altitude_ft", "PatchRequest.altitude", "this or depression_deg"),
    _key("geometry.depression_deg", "number", (0.01, 89), "deg", True, "this or altitude_ft",
         "angle of the line of sight below the horizontal, on a flat earth"),
    _key("geometry.bearing_deg", "number", (-360, 360), "deg", True, "{uniform: [0, 360]}",
         "true bearing of the target, at the target, of the line from the aircraft"),
    _key("geometry.squint_deg", "number", (0, 180), "deg", True, "{uniform: [20, 60]}",
         "angle of the target off the ground track"),
    _key("geometry.side", "text", default="both", text="side of the track on which the target lies",
         values=("left", "right", "both")),
    _value("geometry.speed_kt", "PatchRequest.speed"),
    _value("geometry.time_s", "PatchRequest.time", text="sim time, for movers of the configuration"),
    _key("geometry.force", "yes/no", default="false", text="ignore the radar's limits"),
    _key("geometry.attempts", "whole", (1, 10000), "", default="100",
         text="draws of an item before the run ends with an error"),

    _key("movers.count", "whole", (0, _COUNTS["kMaxMovers"]), "", True, "1", "number in an item"),
    _key("movers.north_m", "number", (-1e6, 1e6), "m", True, "0", "position relative to the target"),
    _key("movers.east_m", "number", (-1e6, 1e6), "m", True, "0", "position relative to the target"),
    _value("movers.heading_deg", "WorldMover.heading", "{uniform: [0, 360]}", "true heading"),
    _value("movers.speed_kt", "WorldMover.speed", "20"),
    _value("movers.cross_section_m2", "TrafficEntity.cross_section", "10"),
    _value("movers.height_m", "TrafficEntity.height", "3"),

    _key("output.format", "text", default="zarr", text="of the arrays", values=("zarr", "npz")),
    _key("output.block", "whole", (1, 65536), "items", default="64",
         text="items of a block: the unit of work and of a chunk"),
    _key("output.compression", "text", default="lz4", text="of the arrays, without loss", values=COMPRESSIONS),
    _key("output.min_pixels", "whole", (0, 10**8), "pixels", default="1",
         text="boxes of objects with fewer labelled pixels are left out"),
    _key("output.manifest_boxes", "yes/no", default="false", text="boxes in the lines of the manifest, too"),
    _key("output.png", "yes/no", default="false", text="the video of each item as PNG"),
    _key("output.geotiff", "names", default="[]", text="arrays to write as GeoTIFF, one file an item and array",
         values=ARRAYS),
    _key("output.coco", "yes/no", default="false",
         text="annotations.json for COCO readers; needs png, or video in geotiff"),
]

KEYS = {row.path: row for row in _ROWS}


def children(section):
    """Names of the keys directly in a section; '' is the top of the file."""
    prefix = section + "." if section else ""
    return [path[len(prefix):] for path in KEYS if path.startswith(prefix) and "." not in path[len(prefix):]]


def number_text(value):
    """A number without an exponent where it is whole."""
    if value == 2**53:
        return "2^53"
    return str(int(value)) if math.isfinite(value) and value == int(value) else f"{value:g}"


def value_text(key):
    """What a value of the key has to be, in words."""
    bounds = ""
    if key.least > -INFINITY:
        bounds = f" in [{number_text(key.least)}, {number_text(key.most)}]"
    words = {"whole": f"a whole number{bounds}", "number": f"a number{bounds}", "yes/no": "true or false",
             "list": "a list", "section": "a section (key: value, indented)", "path": "a path",
             "names": "a list of names", "place": key.text.split(":")[0], "any": key.text, "text": "a word"}[key.kind]
    if key.values:
        words = ("a list of " if key.kind == "names" else "one of ") + ", ".join(key.values)
    return words + (f" {key.unit}" if key.unit and key.kind in ("whole", "number") else "")


def markdown():
    """Tables of all keys."""
    lines = []
    for section in ("",) + SECTIONS:
        names = children(section)
        if not names:
            continue
        lines += [f"## {section or 'The file'}", "", "| key | value | drawn | default | means |",
                  "| --- | --- | --- | --- | --- |"]
        for name in names:
            key = KEYS[f"{section}.{name}" if section else name]
            value = value_text(key) if key.kind not in ("any", "place") else key.kind.replace("any", "see right")
            lines.append(f"| `{name}` | {value} | {'yes' if key.drawn else ''} | {key.default} | {key.text} |")
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    print("# Keys of a data set's specification\n\nHow a specification is used: `docs/datasets.md`.\n\n" + markdown())
