"""Specification of a data set: a YAML file, read, checked and completed by defaults. Keys: keys.py, docs/datasets.md.

    plan = read_spec("town.yaml")         # SpecError: every fault as FILE:LINE: expected ..., found ...; ...
Checks that need the radar's limits, terrain or scenes follow in limits.py, sampling.py and maker.py."""
import dataclasses
import fnmatch
import os
import pathlib
import re
import stat

import yaml

from . import SpecError
from .distributions import Fixed, Uniform
from .keys import ARRAYS, KEYS, children
from .yaml_reader import Reader

MOST_BYTES = 1 << 20
DEFAULT_ARRAYS = ("video", "shadow", "layover", "object", "material")
_SLOT = re.compile(r"[A-Za-z][A-Za-z0-9_-]*$")


def _distribution(key):
    """Default distribution of a drawn key; None: it has no number."""
    value = yaml.safe_load(key.default)
    if isinstance(value, dict):
        return Uniform([tuple(map(float, value["uniform"]))])
    return None if isinstance(value, str) else Fixed(value if key.kind == "whole" else float(value))


_DRAWN_DEFAULTS = {path: value
                   for path, value in ((path, _distribution(key)) for path, key in KEYS.items() if key.drawn) if value}


@dataclasses.dataclass
class Setting:
    """A slot of a GUF form. `value`: a distribution, or a list of numbers, booleans and texts."""
    form: str
    slot: str
    value: object
    line: int


@dataclasses.dataclass
class Scene:
    """One scene: an OpenFlight file, or a generated scene, whose kind is `generate`. `at`: None or (latitude,
    longitude[, heading]) in degrees."""
    line: int
    file: object = None
    generate: object = None
    triangles: int = 20000
    seed: int = 1
    at: object = None
    without: tuple = ()


@dataclasses.dataclass
class Target:
    """One entry of `targets`. Exactly one of `area`, `scenes` ("all" or numbers) and `objects` (classes) is set."""
    line: int
    north_m: object
    east_m: object
    weight: float = 1.0
    area: object = None
    on: str = "any"
    scenes: object = None
    objects: object = None


class Spec:
    """All values of a specification, with defaults. Distributions have ends(), sample(u) and plain()."""

    def __init__(self, path):
        self.path, self.folder = str(path), pathlib.Path(path).resolve().parent
        self.lines = {}  # path of a key -> line
        self.count, self.seed = 0, 1
        self.size, self.arrays, self.window_nm, self.looks = 128, DEFAULT_ARRAYS, None, None
        self.preset, self.config, self.knobs, self.settings, self.every = None, None, {}, [], 64
        self.weather, self.rain, self.rain_area = {}, None, None
        self.terrain, self.terrain_generate = None, None
        self.scenes, self.targets, self.geometry, self.movers, self.classes = [], [], {}, [], {}
        self.format, self.block, self.compression, self.min_pixels = "zarr", 64, "lz4", 1
        self.manifest_boxes, self.png, self.geotiff, self.coco = False, False, (), False

    @property
    def blocks(self):
        return -(-self.count // self.block)

    def where(self, key):
        """FILE:LINE of a key, else the file."""
        return f"{self.path}:{self.lines[key]}" if key in self.lines else self.path

    def class_of(self, name):
        """Class of an object by its name; None: ignored."""
        for label, patterns in self.classes.items():
            if any(fnmatch.fnmatchcase(name.lower(), pattern.lower()) for pattern in patterns):
                return None if label == "ignore" else label
        return re.sub(r"[\W_]*\d+", "", name) or "object"

    def plain(self):
        """All values that decide the items, as JSON types. Paths are left out: the store hashes what they name."""
        def simple(value):
            if hasattr(value, "plain"):
                return value.plain()
            if isinstance(value, (Setting, Scene, Target)):
                return {name: simple(item) for name, item in vars(value).items() if name not in ("line", "file")}
            if isinstance(value, dict):
                return {name: simple(item) for name, item in value.items()}
            return [simple(item) for item in value] if isinstance(value, (list, tuple)) else value
        left_out = ("path", "folder", "lines", "config", "terrain")
        return {name: simple(value) for name, value in vars(self).items() if name not in left_out}


class _SpecReader(Reader):
    def __init__(self, path, text):
        super().__init__(path, text)
        self.plan = Spec(path)

    def note(self, path, node):
        self.plan.lines.setdefault(path, node.start_mark.line + 1)

    def read(self):
        if self.root is None:
            raise SpecError(f"{self.path}: expected a specification, found an empty file; begin with "
                            "examples/dataset_town.yaml")
        top = self.section(self.root, "")
        plan = self.plan
        for name, node in top.items():
            self.note(name, node)
        for name in ("count", "seed"):
            if name in top:
                setattr(plan, name, self.key_number(top[name], KEYS[name]) or 0)
        for name in ("chip", "radar", "weather", "terrain", "scenes", "targets", "geometry", "movers", "classes",
                     "output"):
            if name in top:
                getattr(self, "_" + name)(top[name])
        if not plan.targets and plan.scenes and "targets" not in top:
            plan.targets.append(Target(1, Fixed(0.0), Fixed(0.0), scenes="all"))
        elif not plan.targets and not self.faults:
            self.fault(self.root, "targets, or scenes to put them on", "neither", "add targets: with an area")
        self._together()
        self.finish()
        return plan

    def values(self, node, path, names=None):
        """{name: value} of the scalar and drawn keys of a section."""
        result = {}
        for name, value in self.section(node, path).items():
            full = f"{path}.{name}"
            key = KEYS[full]
            self.note(full, value)
            if names is not None and name not in names:
                result[name] = value  # the caller reads the node
            elif key.drawn and key.kind != "any":
                result[name] = self.drawn(value, key)
            elif key.kind in ("whole", "number"):
                result[name] = self.key_number(value, key)
            elif key.kind == "text":
                result[name] = self.text(value, key)
            elif key.kind == "names":
                result[name] = tuple(self.names(value, key))
            elif key.kind == "yes/no":
                result[name] = self.yes_no(value, key)
            elif key.kind == "path":
                result[name] = self._path(value, key)
            else:
                result[name] = value
        return result

    def _path(self, node, key):
        text = self.text(node, key)
        return None if text is None else str(self.plan.folder / text)

    def _place(self, node, path, least_count):
        """[latitude, longitude, ...] or [south, west, north, east]."""
        expected = f"{KEYS[path].text.split(':')[0]} for {path}"
        values = self.numbers(node, (4,) if least_count == 4 else (2, 3), expected)
        if values is None:
            return None
        latitudes, longitudes = (values[0::2], values[1::2]) if least_count == 4 else (values[:1], values[1:2])
        if any(abs(value) > 90 for value in latitudes) or any(abs(value) > 360 for value in longitudes):
            self.fault(node, expected, str(values), "latitude comes first, in [-90, 90] deg")
            return None
        if least_count == 4 and values[0] > values[2]:
            self.fault(node, expected, f"a south of {values[0]:g} beyond a north of {values[2]:g}", "exchange them")
            return None
        return tuple(values)

    def _chip(self, node):
        for name, value in self.values(node, "chip").items():
            if value is not None:
                setattr(self.plan, name, value)

    def _output(self, node):
        for name, value in self.values(node, "output").items():
            if value is not None:
                setattr(self.plan, name, value)

    def _radar(self, node):
        values = self.values(node, "radar")
        for name in ("preset", "config", "every"):
            if values.get(name) is not None:
                setattr(self.plan, name, values[name])
        if "knobs" in values:
            for name, (key, value) in self.mapping(values["knobs"], "knobs as a section").items():
                self.note(f"radar.knobs.{name}", key)
                self.plan.knobs[name] = self._slot_value(value, KEYS["radar.knobs"])
        if "settings" in values:
            for form, (key, slots) in self.mapping(values["settings"], "settings as a section of GUF forms").items():
                if not _SLOT.match(form):
                    self.fault(key, "the name of a GUF form", f'"{form}"')
                for slot, (at, value) in self.mapping(slots, f"slots of {form} as a section").items():
                    if not _SLOT.match(slot):
                        self.fault(at, f"the name of a slot of {form}", f'"{slot}"')
                    self._setting(form, slot, at, value)

    def _setting(self, form, slot, at, node):
        if isinstance(node, yaml.SequenceNode):
            value = [self._slot_value(item, KEYS["radar.settings"]) for item in node.value]
        else:
            value = self.drawn(node, KEYS["radar.settings"]._replace(path=f"radar.settings.{form}.{slot}"),
                               self._slot_value)
        if value is not None:
            self.plan.settings.append(Setting(form, slot, value, at.start_mark.line + 1))

    def _slot_value(self, node, key):
        """Number, true, false or text of a GUF slot; a quoted text stays a string."""
        if not isinstance(node, yaml.ScalarNode) or not node.value or re.search(r'["\\\n\r]', node.value):
            self.fault(node, f"a number, true, false or a text for {key.path}")
            return None
        if node.style is None:
            for kind in (int, float):
                try:
                    value = kind(node.value)
                except ValueError:
                    continue
                if abs(value) >= 1e30:
                    self.fault(node, f"a number below 1e30 for {key.path}")
                    return None
                return value
            if node.value in ("true", "false"):
                return node.value == "true"
        return node.value

    def _weather(self, node):
        values = self.values(node, "weather")
        rain = values.pop("rain", None)
        self.plan.weather = {name: value for name, value in values.items() if value is not None}
        if rain is None:
            return
        values = self.values(rain, "weather.rain")
        if "area" in values:
            self.plan.rain_area = self._place(values.pop("area"), "weather.rain.area", 4)
        self.plan.rain = self._complete(values, "weather.rain")

    def _complete(self, values, path):
        """Values of a section, completed by the defaults of its drawn keys."""
        result = {key: value for key, value in _DRAWN_DEFAULTS.items() if key.rpartition(".")[0] == path}
        result = {key.rpartition(".")[2]: value for key, value in result.items()}
        result.update({name: value for name, value in values.items() if value is not None})
        return result

    def _terrain(self, node):
        if isinstance(node, yaml.ScalarNode):
            self.plan.terrain = self._path(node, KEYS["terrain"])
            return
        inner = self.section(node, "terrain").get("generate")
        if inner is None:
            if not self.faults:
                self.fault(node, "a folder, or {generate: ...} for terrain", "neither")
            return
        defaults = {"cells_lat": 1, "cells_lon": 1, "level": 1, "seed": 12, "edge": "coast"}
        self.plan.terrain_generate = {**defaults, **self.values(inner, "terrain.generate")}

    def _scenes(self, node):
        for item in self.items(node, "a list of scenes"):
            values = self.values(item, "scenes", names=set(children("scenes")) - {"at"})
            scene = Scene(item.start_mark.line + 1)
            if "at" in values:
                values["at"] = self._place(values["at"], "scenes.at", 2)
            for name, value in values.items():
                if value is not None:
                    setattr(scene, name, value)
            if values and ("file" in values) == ("generate" in values):
                self.fault(item, "one of file and generate in an entry of scenes",
                           "both" if "file" in values else "neither")
            if "generate" in values and "at" not in values:
                self.fault(item, "the key at with a made-up scene", "none", "add at: [LATITUDE, LONGITUDE]")
            self.plan.scenes.append(scene)

    def _targets(self, node):
        for item in self.items(node, "a list of targets"):
            values = self._complete(self.values(item, "targets", names=set(children("targets")) - {"area", "scenes"}),
                                    "targets")
            if "area" in values:
                values["area"] = self._place(values["area"], "targets.area", 4)
            if "scenes" in values:
                values["scenes"] = self._scene_numbers(values["scenes"])
            kinds = [name for name in ("area", "scenes", "objects") if name in values]
            if len(kinds) != 1:
                self.fault(item, "one of area, scenes and objects in an entry of targets",
                           " and ".join(kinds) or "none")
            if "on" in values and "area" not in values:
                self.fault(item, "the key area in an entry with the key on", "none")
            if "objects" in values and not self.plan.scenes and self.root is not None and not self._has("scenes"):
                self.fault(item, "scenes in the specification, for targets at objects", "none", "add scenes:")
            self.plan.targets.append(Target(item.start_mark.line + 1, **values))
        if self.plan.targets and not self.faults and sum(target.weight for target in self.plan.targets) <= 0:
            self.fault(node, "a weight above 0 in targets", "none")

    def _has(self, name):
        return isinstance(self.root, yaml.MappingNode) and any(key.value == name for key, _ in self.root.value)

    def _scene_numbers(self, node):
        if isinstance(node, yaml.ScalarNode) and node.value == "all":
            return "all"
        nodes = node.value if isinstance(node, yaml.SequenceNode) else [node]
        most = len(self.plan.scenes) - 1
        expected = (f"all, or numbers of scenes in [0, {most}], for targets.scenes" if most >= 0 else
                    "scenes in the specification")
        return [self.number(item, expected, True, 0, most) for item in nodes]

    def _geometry(self, node):
        values = self.values(node, "geometry")
        if ("altitude_ft" in values) == ("depression_deg" in values) and "range_nm" in values:
            self.fault(node, "one of altitude_ft and depression_deg in geometry",
                       "both" if "altitude_ft" in values else "neither")
        self.plan.geometry = self._complete(values, "geometry")
        for name, value in (("side", "both"), ("force", False), ("attempts", 100)):
            self.plan.geometry.setdefault(name, value)

    def _movers(self, node):
        for item in self.items(node, "a list of groups of movers"):
            self.plan.movers.append(self._complete(self.values(item, "movers"), "movers"))

    def _classes(self, node):
        for name, (_, value) in self.mapping(node, "classes as a section: NAME: PATTERN or [PATTERN, ...]").items():
            self.note(f"classes.{name}", value)
            self.plan.classes[name] = [pattern for pattern in self.names(value, KEYS["scenes.without"]) if pattern]

    def _together(self):
        """Adds the faults of keys that contradict each other."""
        plan = self.plan

        def fault(key, text):
            self.faults.append(f"{plan.where(key)}: {text}")
        if not plan.arrays:
            fault("chip.arrays", f"expected at least one array, found none; choose from {', '.join(ARRAYS)}")
        for name in plan.geotiff:
            if name not in plan.arrays:
                fault("output.geotiff", f"expected arrays of chip.arrays, found {name}; add it to chip.arrays")
        for key, wanted in (("output.png", plan.png), ("output.coco", plan.coco and "object")):
            need = "object" if wanted == "object" else "video"
            if wanted and need not in plan.arrays:
                fault(key, f"expected the array {need} in chip.arrays, found none; add it")
        if plan.coco and not plan.png and "video" not in plan.geotiff:
            fault("output.coco", "expected pictures for COCO, found none; add png: true, or video to geotiff")
        if plan.preset == "reference" and plan.size > 1024:
            fault("chip.size", f"expected at most 1024 pixels with the preset reference, found {plan.size}")


def read_spec(path):
    """Reads and checks a specification. Raises SpecError with all faults of the file, or with why it cannot be read."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise SpecError(f"{path}: expected a specification, found "
                            f"{'a folder' if os.path.isdir(path) else 'no regular file'}; give the path of a file: "
                            "each process of a run reads it")
        with open(path, "rb") as file:
            data = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise SpecError(f"{path}: expected a specification, found none: {error.strerror}; check the path") from None
    if len(data) > MOST_BYTES:
        raise SpecError(f"{path}: expected at most 1 MiB, found more; is this a specification?")
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        byte = f"byte {data[error.start]:#04x} at offset {error.start}"
        raise SpecError(f"{path}: expected UTF-8 text, found {byte}") from None
    return _SpecReader(path, text).read()
