"""Limits of a radar for patch maps, read from its configuration: blind zone, gimbal, ranges of each window.
Source: `yars config print`; docs/spec/pilots_interface.md#rule-2, #rule-3 and #rule-4."""
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from .errors import DatasetError, SpecError

_NUMBER = r"[-+0-9.eE]+"
# The nearest target, as a fraction of the window's edge, with or without `force`: kMinDistanceFraction of `yars patch`.
NEAREST_WINDOWS = 0.75
# Slots that decide the limits. They are the same for all items of a data set.
DECIDING = {"AntennaServo": ("azimuthLimits", "elevationLimits"), "HighResolution": ("blindZone",),
            "WindowLimits": None, "SarMode": None}


@dataclasses.dataclass
class Limits:
    blind_zone_deg: float
    azimuth_deg: float
    elevation_deg: float
    windows: dict  # window [NM] -> (least, greatest) ground range [NM]
    power_up_nm: float
    looks: int


def command():
    """The program `yars`: of $YARS_BIN, beside the package in a build tree, or of the path."""
    here = pathlib.Path(__file__).absolute()  # in a build tree a link, which is not followed
    places = [os.environ.get("YARS_BIN"), *(str(folder / "bin") for folder in here.parents[2:5])]
    for place in filter(None, places):
        path = pathlib.Path(place) / "yars"
        if path.is_file() and os.access(path, os.X_OK):
            return str(path)
    found = shutil.which("yars")
    if not found:
        raise DatasetError("expected the command yars, found none; install the package yars, or set YARS_BIN to the folder "
                           "of the programs")
    return found


def parse(text):
    """Limits of the output of `yars config print`."""
    def numbers(pattern):
        match = re.search(pattern, text, re.S)
        if not match:
            raise DatasetError(f"expected {pattern} in the output of `yars config print`, found none")
        return [float(number) for number in match.group(1).split()]
    table = rf"\( WindowLimits.*?:%s `\(\s*({_NUMBER}(?:\s+{_NUMBER})*)\s*\)"
    windows, least, greatest = (numbers(table % slot) for slot in ("windows", "least", "greatest"))
    list_of = rf":%s `\(\s*({_NUMBER}(?:\s+{_NUMBER})*)\s*\)"
    return Limits(numbers(rf":blindZone ({_NUMBER})")[0], max(map(abs, numbers(list_of % "azimuthLimits"))),
                  max(map(abs, numbers(list_of % "elevationLimits"))), dict(zip(windows, zip(least, greatest))),
                  numbers(rf"\( WindowLimits.*?:powerUp ({_NUMBER})")[0],
                  int(numbers(rf"\( HighResolution\s+:looks `\(\s*({_NUMBER})")[0]))


def _run(verb, path):
    """(exit code, output, messages) of `yars config VERB`."""
    run = subprocess.run([command(), "config", verb] + ([str(path)] if path else []), capture_output=True, text=True, check=False)
    return run.returncode, run.stdout, run.stderr


def printed(path):
    """Output of `yars config print PATH`; None: its defaults. Raises DatasetError with the command's message."""
    code, output, messages = _run("print", path)
    if code:
        lines = messages.strip().splitlines() or [f"yars config print: exit code {code}"]
        raise DatasetError(re.sub(r"^yars[a-z ]*: ", "", lines[-1]))
    return output


def read_limits(plan, lines):
    """Limits of the specification's radar. `lines`: (GUF text of one line, line of the specification) of its knobs and
    settings, which are checked here. Raises SpecError at the specification's line."""
    try:
        text = printed(plan.config)
    except DatasetError as error:
        raise SpecError(f"{plan.where('radar.config')}: {error}") from None
    if not lines:
        return parse(text)
    first = text.count("\n") + 1
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "radar.guf"
        path.write_text(text + "".join(line + "\n" for line, _ in lines))
        _, output, messages = _run("check", path)
        found = re.compile(rf"(?:yars[a-z ]*: )?{re.escape(str(path))}:(\d+):\d+: (.*)")
        faults = []
        for match in filter(None, map(found.match, (messages + output).splitlines())):
            at = int(match.group(1)) - first
            if 0 <= at < len(lines) and ("ignored" in match.group(2) or "expected" in match.group(2)):
                faults.append(f"{plan.path}:{lines[at][1]}: {match.group(2)}")
        if faults:
            raise SpecError("\n".join(dict.fromkeys(faults)))
        try:
            return parse(printed(path))
        except DatasetError as error:
            raise SpecError(f"{plan.where('radar')}: {error}") from None
