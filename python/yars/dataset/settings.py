"""Drawn GUF settings: one line of GUF for each run of items (radar.every), from settings, weather and rain."""
import re

import numpy as np

from .distributions import Fixed, Normal

_WEATHER = {"sea_state": "state", "wind_speed_kt": "windSpeed", "wind_from_deg": "windFrom"}
_WORD = re.compile(r"[A-Za-z][A-Za-z0-9_.-]*$")
_RAIN = ("radius_nm", "rate_mm_h", "top_ft")


def guf(value):
    """A value as GUF."""
    if isinstance(value, (list, tuple)):
        return "`( " + " ".join(guf(item) for item in value) + " )"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return value if _WORD.match(value) else f'"{value}"'
    return f"{round(float(value), 9):.12g}"


def is_drawn(value):
    return not isinstance(value, (list, Fixed))


class Settings:
    """Settings of a specification. `text(run)`: GUF of a run of items; `values(run)`: its drawn values by name."""

    def __init__(self, plan, streams):
        self.plan, self._streams = plan, streams
        self._slots = [(setting.form, setting.slot, setting.value) for setting in plan.settings]
        self._slots += [("Sea", _WEATHER[name], value) for name, value in plan.weather.items()]

    @staticmethod
    def fields(plan):
        """Names of the streams that settings draw from."""
        names = [f"radar.{setting.form}.{setting.slot}" for setting in plan.settings]
        names += [f"radar.Sea.{_WEATHER[name]}" for name in plan.weather]
        if plan.rain:
            names += [f"rain.{name}" for name in ("cells", "latitude", "longitude", *_RAIN)]
        return list(dict.fromkeys(names))

    def drawn(self):
        """True if not all runs have equal settings."""
        return self.plan.rain is not None or any(is_drawn(value) for _, _, value in self._slots)

    def values(self, run):
        """{form.slot: value} of the drawn slots of a run."""
        u = self._streams.uniform(np.array([run]))
        result = {}
        for form, slot, value in self._slots:
            if is_drawn(value):
                drawn = value.sample(u[self._streams.row[f"radar.{form}.{slot}"]])[0]
                result[f"{form}.{slot}"] = (drawn if isinstance(drawn, (str, np.str_, np.bool_))
                                            else round(float(drawn), 9))
        return {name: value.item() if hasattr(value, "item") else value for name, value in result.items()}

    def rain(self, run):
        """List of showers of a run: (latitude, longitude, radius, rate, top)."""
        if not self.plan.rain:
            return []
        row = self._streams.row
        count = int(self.plan.rain["cells"].sample(self._streams.uniform(np.array([run]))[row["rain.cells"]])[0])
        u = self._streams.uniform(np.full(count, run), draw=np.arange(count))
        south, west, north, east = self.plan.rain_area
        latitude = south + u[row["rain.latitude"]] * (north - south)
        longitude = (west + u[row["rain.longitude"]] * ((east - west) % 360.0) + 180.0) % 360.0 - 180.0
        others = [self.plan.rain[name].sample(u[row[f"rain.{name}"]]) for name in _RAIN]
        return [tuple(round(float(value), 9) for value in cell) for cell in zip(latitude, longitude, *others)]

    def text(self, run):
        """GUF of a run, on one line: seed of the noise, settings, weather."""
        drawn = self.values(run) if self.drawn() else {}
        forms = {}
        for form, slot, value in self._slots:
            value = drawn.get(f"{form}.{slot}", value.value if isinstance(value, Fixed) else value)
            forms.setdefault(form, []).append(f":{slot} {guf(value)}")
        lines = [f"( {form} {' '.join(slots)} )" for form, slots in forms.items()]
        if self.plan.rain:
            lines.append("( Rain `( " +
                         " ".join(f"( RainCell {' '.join(map(guf, cell))} )" for cell in self.rain(run)) + " ) )")
        return " ".join([f"( Noise :seed {self.plan.seed} )"] + lines)

    def checked_lines(self):
        """[(GUF, line of the specification, path of a knob or None)]:
        each end that a setting can have, for a check by YARS."""
        where = self.plan.lines
        lines = [(f"( Fidelity :preset {self.plan.preset} )", where["radar.preset"], None)] if self.plan.preset else []
        for name, value in self.plan.knobs.items():
            slot, key = re.sub("_([a-z0-9])", lambda found: found.group(1).upper(), name), f"radar.knobs.{name}"
            lines.append((f"( Fidelity :{slot} {guf(value)} )", where[key], key))
        for setting in self.plan.settings:
            value = setting.value
            ends = [value] if isinstance(value, list) else value.ends()
            if isinstance(value, Normal):
                ends = [value.mean, *(end for end in (value.low, value.high) if abs(end) < 1e308)]
            lines += [(f"( {setting.form} :{setting.slot} {guf(end)} )", setting.line, None) for end in ends]
        return lines
