"""Geometry that no draw can make possible: found when the specification is read, by the limits of the radar."""
import math

from .distributions import Choice, Fixed
from .errors import SpecError
from .limits import DECIDING, NEAREST_WINDOWS

HIGHEST_GROUND_M = 9000.0
FOOT_M, MILE_M = 0.3048, 1852.0
# Values that lie on a limit are moved inside by so much: a float's last digit must not decide.
RANGE_MARGIN_NM, ANGLE_MARGIN_DEG = 1e-6, 1e-6


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
        unknown = ["an interval"] if windows is None else [f"{window:g}" for window in windows if window not in limits.windows]
        if unknown:
            fault("chip.window_nm", f"windows of the radar ({known} NM)", ", ".join(unknown), f"choose from them, {forced}")
            windows = []
        outside = impossible(plan.geometry["squint_deg"], squint_intervals(limits))
        if outside:
            low, high = (squint_intervals(limits) or [(0, 0)])[0]
            fault("geometry.squint_deg", f"angles off the track between blind zone and gimbal ({low:g} to {high:g} deg)", outside,
                  f"give others, {forced}")
    for window in windows if windows is not None else [plan.window_nm.ends()[-1]]:
        low, high = range_intervals(plan, limits, window)[0]
        outside = impossible(plan.geometry["range_nm"], [(low, high)])
        if outside:
            fault("geometry.range_nm", f"ranges at which the window of {window:g} NM can be mapped ({low:g} to {high:g} NM)", outside,
                  f"give others, {forced}")
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
            fault("geometry.depression_deg", f"angles within the gimbal ({limits.elevation_deg:g} deg)", outside, "give others")
        return
    lowest_m = max(min(geometry["altitude_ft"].ends()) * FOOT_M - HIGHEST_GROUND_M, 0.0)
    farthest_m = max(geometry["range_nm"].ends()) * MILE_M
    if math.degrees(math.atan2(lowest_m, farthest_m)) > limits.elevation_deg:
        fault("geometry.altitude_ft", f"a line of sight within {limits.elevation_deg:g} deg below the horizontal",
              f"a steeper one from {lowest_m / FOOT_M:.0f} ft over any ground", "fly lower or farther away")
