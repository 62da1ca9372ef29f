"""Finds the programs of YARS that belong to this package."""
import os
import pathlib
import shutil

NAMES = ("yars", "yars-start", "radar-model", "state-machine", "radar-display", "input-monitor", "flight-model",
         "yars-station", "gateway")


def path_of(name):
    """Path of a program: in $YARS_BIN, in the folder bin of a build tree or prefix around the package, or on PATH;
    else None."""
    here = pathlib.Path(__file__).absolute()  # in a build tree a link, which is not followed
    places = [os.environ.get("YARS_BIN"), *(str(folder / "bin") for folder in here.parents[1:5])]
    for place in filter(None, places):
        path = pathlib.Path(place) / name
        if path.is_file() and os.access(path, os.X_OK):
            return str(path)
    return shutil.which(name)
