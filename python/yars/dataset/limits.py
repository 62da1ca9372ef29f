"""Limits of a radar for patch maps, read from its configuration: blind zone, gimbal, ranges of each window. Geometry
that no draw can make possible is found by them when a specification is read. Source:
docs/pilots_manual.md#rule-2, #rule-3 and #rule-4."""
import dataclasses
import functools
import math
import os
import subprocess

from .. import Error, _compiled, programs
from . import DatasetError, SpecError
from .distributions import Choice, Fixed

# The nearest target, as a fraction of the window's edge, with or without `force`: kMinDistanceFraction of `yars patch`.
NEAREST_WINDOWS = 0.75
# Slots that decide the limits. They are the same for all items of a data set.
DECIDING = {"AntennaServo": ("azimuthLimits", "elevationLimits"), "HighResolution": ("blindZone",),
            "WindowLimits": None, "SarMode": None}

MOST_FAULTS = 20
HIGHEST_GROUND_M = 9000.0
FOOT_M, MILE_M = 0.3048, 1852.0
# Values that lie on a limit are moved inside by so much: a float's last digit must not decide.
RANGE_MARGIN_NM, ANGLE_MARGIN_DEG = 1e-6, 1e-6


@dataclasses.dataclass
class Limits:
    blind_zone_deg: float
    azimuth_deg: float
    elevation_deg: float
    windows: dict  # window [NM] -> (least, greatest) ground range [NM]
    power_up_nm: float
    looks: int


def command():
    """The program `yars`."""
    found = programs.path_of("yars")
    if not found:
        raise DatasetError("expected the command yars, found none; install the package yars, "
                           "or set YARS_BIN to the folder of the programs")
    return found


@functools.lru_cache(maxsize=None)
def version():
    """Version of YARS."""
    return subprocess.run([command(), "--version"], capture_output=True, text=True, check=False).stdout.strip()


def model():
    """Number of the radar model: data of different models are not comparable."""
    return _compiled("dataset").MODEL


def limits_of(text):
    """Limits of a configuration in GUF text."""
    return Limits(**_compiled("dataset").make_radar("", b"", text, []).limits)


def without_name(message):
    """A message of `yars` or of the module, without the name of the command or function that it begins with."""
    name, _, text = str(message).partition(": ")
    return text if text and (name == "yars" or name.startswith(("yars ", "yars."))) else str(message)


def printed(path):
    """Configuration of a file, or the defaults (None), as `yars config print` prints it.
    Raises DatasetError with the message of the library."""
    try:
        return _compiled("dataset").guf_of_file(os.fsencode(path or ""))
    except (ValueError, Error) as error:
        raise DatasetError(str(error)) from None


def _fault_text(fault, key):
    """Message of a fault in a line of settings, for a run that is refused. `key`: path of a knob, or None."""
    defaults = "`yars config print --defaults`"
    if fault["kind"] == "form":
        nearest = fault["nearest"] and f"; nearest name: {fault['nearest']}"
        return f'expected the name of a form, found "{fault["form"]}"; {defaults} shows all{nearest}'
    nearest, slot = ("".join("_" + letter.lower() if letter.isupper() else letter for letter in name) if key else name
                     for name in (fault["nearest"], fault["slot"]))
    if fault["kind"] == "slot":
        expected = "a knob for radar.knobs" if key else f"a slot of {fault['form']}"
        action = (f"{defaults} explains every slot; the form {fault['owner']} has it" if fault["owner"] else
                  f'did you mean "{nearest}"?' if nearest else f"{defaults} explains every slot")
        return f'expected {expected}, found "{slot}"; {action}'
    of_slot = slot and f" for {'' if key else ':'}{slot}"
    action = fault["action"] and f"; {fault['action']}"
    return f"expected {fault['expected']}{of_slot}, found {fault['found']}{action}"


def _faults_of(text, lines, plan):
    """Faults of lines of GUF after a configuration.
    The check ends at the first wrong value, so it is done again without that line."""
    left, faults, first = list(lines), {}, text.count("\n") + 1
    while len(faults) < MOST_FAULTS:
        found = _compiled("dataset").guf_faults(text + "".join(line + "\n" for line, _, _ in left))
        wrong = [(fault["line"] - first, fault) for fault in found if 0 <= fault["line"] - first < len(left)]
        for at, fault in wrong:
            _, line, key = left[at]
            faults.setdefault(f"{plan.path}:{line}: {_fault_text(fault, key)}", line)
        if not wrong or found[-1]["kind"] != "value":
            break
        left = [line for at, line in enumerate(left) if at not in dict(wrong)]
    return sorted(faults, key=faults.get)


def read_limits(plan, lines):
    """Limits of the specification's radar. `lines`: (GUF text of one line, line of the specification, path of its knob
    or None) of knobs and settings, which are checked here.
    Raises SpecError with all faults at the specification's lines."""
    try:
        text = printed(plan.config)
    except DatasetError as error:
        raise SpecError(f"{plan.where('radar.config')}: {error}") from None
    faults = _faults_of(text, lines, plan) if lines else []
    if faults:
        raise SpecError("\n".join(faults))
    try:
        return limits_of(text + "".join(line + "\n" for line, _, _ in lines))
    except ValueError as error:
        raise SpecError(f"{plan.where('radar')}: {error}") from None


def impossible(law, intervals):
    """Values of a distribution, as text, that lie in none of the closed intervals; None if some value is possible."""
    if isinstance(law, (Fixed, Choice)):
        weights = getattr(law, "weights", [1.0])
        outside = [value for value, weight in zip(law.ends(), weights)
                   if weight > 0 and not any(low <= value <= high for low, high in intervals)]
        return ", ".join(f"{value:g}" for value in outside) or None
    pieces = getattr(law, "intervals", [law.ends()])
    if any(max(low, a) <= min(high, b) for low, high in intervals for a, b in pieces):
        return None
    return ", ".join(f"{a:g} to {b:g}" for a, b in pieces)


def windows_of(plan, limits):
    """Windows [NM] that the specification can give; None: an interval of them."""
    if plan.window_nm is None:
        return [limits.power_up_nm]
    return list(plan.window_nm.ends()) if isinstance(plan.window_nm, (Fixed, Choice)) else None


def range_intervals(plan, limits, window):
    """Ground ranges [NM] at which a window can be mapped."""
    low, high = (0.0, math.inf) if plan.geometry["force"] else limits.windows[window]
    return [(max(low, NEAREST_WINDOWS * window), high)]


def squint_intervals(limits):
    """Angles off the ground track [deg] that are neither in the blind zone nor beyond the gimbal."""
    low, high = limits.blind_zone_deg, 180.0 - limits.blind_zone_deg
    return [(low, min(high, limits.azimuth_deg))] if low < limits.azimuth_deg else []


def check(plan, limits):
    """Raises SpecError with every fault at its line."""
    faults = []

    def fault(key, expected, found, action):
        faults.append(f"{plan.where(key)}: expected {expected}, found {found}; {action}")

    forced = "or set geometry.force: true"
    for setting in plan.settings:
        slots = DECIDING.get(setting.form, ())
        if not isinstance(setting.value, (list, Fixed)) and (slots is None or setting.slot in slots):
            faults.append(f"{plan.path}:{setting.line}: expected one value for {setting.form}.{setting.slot}, found a "
                          "distribution; it decides what the radar can map and has to be the same for all items")
    windows = windows_of(plan, limits)
    if not plan.geometry["force"]:
        known = ", ".join(f"{window:g}" for window in limits.windows)
        unknown = ["an interval"] if windows is None else [f"{window:g}" for window in windows
                                                           if window not in limits.windows]
        if unknown:
            fault("chip.window_nm", f"windows of the radar ({known} NM)", ", ".join(unknown),
                  f"choose from them, {forced}")
            windows = []
        outside = impossible(plan.geometry["squint_deg"], squint_intervals(limits))
        if outside:
            low, high = (squint_intervals(limits) or [(0, 0)])[0]
            fault("geometry.squint_deg", f"angles off the track between blind zone and gimbal ({low:g} to "
                                         f"{high:g} deg)", outside, f"give others, {forced}")
    for window in windows if windows is not None else [plan.window_nm.ends()[-1]]:
        low, high = range_intervals(plan, limits, window)[0]
        outside = impossible(plan.geometry["range_nm"], [(low, high)])
        if outside:
            fault("geometry.range_nm", f"ranges at which the window of {window:g} NM can be mapped ({low:g} "
                                       f"to {high:g} NM)", outside, f"give others, {forced}")
    _check_heights(plan, limits, fault)
    if faults:
        raise SpecError("\n".join(faults))


def _check_heights(plan, limits, fault):
    geometry = plan.geometry
    if geometry["force"]:
        return
    if "depression_deg" in geometry:
        outside = impossible(geometry["depression_deg"], [(0.0, limits.elevation_deg)])
        if outside:
            fault("geometry.depression_deg", f"angles within the gimbal ({limits.elevation_deg:g} deg)", outside,
                  "give others")
        return
    lowest_m = max(min(geometry["altitude_ft"].ends()) * FOOT_M - HIGHEST_GROUND_M, 0.0)
    farthest_m = max(geometry["range_nm"].ends()) * MILE_M
    if math.degrees(math.atan2(lowest_m, farthest_m)) > limits.elevation_deg:
        fault("geometry.altitude_ft", f"a line of sight within {limits.elevation_deg:g} deg below the horizontal",
              f"a steeper one from {lowest_m / FOOT_M:.0f} ft over any ground", "fly lower or farther away")
