"""Opens a data set for work: checks the specification against the radar, makes what it wants made, opens the maker.

`prepare` runs once in the coordinator and reads no terrain; `load` runs in the host process, before workers are forked."""
import importlib
import json
import os
import pathlib
import re
import shutil
import subprocess

import numpy as np

from . import DatasetError, files, formats
from .blocks import BlockMaker, dump
from .distributions import Streams
from .limits import check, command, read_limits
from .sampling import Sampler, World
from .settings import Settings
from .spec import read_spec
from .store import Store, fingerprint

MAKER = "yars.dataset.maker:open_maker"
WARM_ITEMS = 16


def open_store(spec_path, folder):
    """(plan, limits, store) of a specification, with all checks that need no terrain. Raises SpecError, DatasetError."""
    plan = read_spec(spec_path)
    settings = Settings(plan, Streams(plan.seed, Settings.fields(plan)))
    limits = read_limits(plan, settings.checked_lines())
    check(plan, limits)
    store = Store(plan, folder, "")
    store.mark = fingerprint(plan, scene_paths(plan, store))
    return plan, limits, store


def prepare(spec_path, folder):
    """(plan, store) of a folder that is ready for blocks: general files, made-up terrain and scenes."""
    plan, _, store = open_store(spec_path, folder)
    store.begin()
    files.remove_leftovers(folder)
    for scene, path in zip(plan.scenes, scene_paths(plan, store)):
        if scene.generate and not os.path.exists(path):
            origin = ",".join(f"{number:.12g}" for number in scene.at)
            _generate(path, ["scene", "generate", "--kind", scene.generate, "--triangles", str(scene.triangles), "--seed", str(scene.seed),
                             f"--origin={origin}"])
    made = plan.terrain_generate
    if made and not os.path.isdir(store.path("terrain")):
        _generate(store.path("terrain"), ["terrain", "generate"] + [
            f"--{name.replace('_', '-')}={value}" for name, value in made.items()] + ["--airfields=soil"])
    return plan, store


def _generate(path, arguments):
    """Runs `yars` with --out under a temporary name, which is renamed: other shards may do the same."""
    folder = os.path.dirname(path)
    temporary = files.temporary_name(path)
    try:
        os.makedirs(folder, exist_ok=True)
        run = subprocess.run([command(), *arguments, f"--out={temporary}"], capture_output=True, text=True, check=False)
        if run.returncode:
            raise DatasetError(re.sub("^yars[a-z ]*: ", "", run.stderr.strip()) or f"yars {' '.join(arguments)}: code {run.returncode}")
        try:
            os.rename(temporary, path)
        except OSError:
            if not os.path.exists(path):
                raise
    except OSError as error:
        raise files.failure(path, error) from None
    finally:
        if os.path.isdir(temporary):
            shutil.rmtree(temporary, ignore_errors=True)
        else:
            pathlib.Path(temporary).unlink(missing_ok=True)


def scene_paths(plan, store):
    return [scene.file or store.path(f"scenes/{number}_{scene.generate}.flt") for number, scene in enumerate(plan.scenes)]


def _centre(scene, path):
    """(latitude, longitude) of a scene: that of the specification, else the file's."""
    if scene.at:
        return scene.at[:2]
    run = subprocess.run([command(), "scene", "info", "--json", str(path)], capture_output=True, text=True, check=False)
    if run.returncode:
        raise DatasetError(run.stderr.strip())
    entry = json.loads(run.stdout)["files"][0]
    origin = entry["origin_in_name"] or entry["origin"]
    return origin["latitude_deg"], origin["longitude_deg"]


def load(spec_path, folder, maker_name=MAKER, mark=None, warm=True):
    """BlockMaker of a prepared folder. Reads terrain and scenes; with `warm`, those of items from the whole set. `mark`: the
    fingerprint that the coordinator found."""
    plan, limits, store = open_store(spec_path, folder)
    if mark and mark != store.mark:
        raise DatasetError(f"{spec_path}: expected the specification, terrain and scenes that the run began with (fingerprint {mark}), found others "
                           f"({store.mark}); have all computers see the same files")
    paths = scene_paths(plan, store)
    terrain = store.path("terrain") if plan.terrain_generate else plan.terrain
    module, _, function = maker_name.partition(":")
    scenes = [(path, scene.at if scene.file else None, scene.without) for scene, path in zip(plan.scenes, paths)]
    maker = getattr(importlib.import_module(module), function)(plan, terrain, scenes)
    labels = [plan.class_of(str(name)) for name in maker.objects["name"]]
    classes = sorted({label for label in labels if label})
    ids = [classes.index(label) if label else -1 for label in labels]
    # For targets at scenes only: a given file without `at` is asked for its origin.
    centres = [_centre(scene, path) for scene, path in zip(plan.scenes, paths)] if any(target.scenes for target in plan.targets) else []
    sampler = Sampler(plan, limits, World(maker.elevation, np.array(centres, float).reshape(-1, 2), maker.objects, labels))
    _write_objects(store, maker.objects, labels, classes)
    store.describe_arrays(formats.types(len(maker.objects)))
    if warm:
        step = max(1, plan.count // WARM_ITEMS)
        maker.warm(sampler.draw(np.arange(0, plan.count, step)[:WARM_ITEMS]), sampler.settings.text(0))
    return BlockMaker(plan, store, sampler, maker, ids)


def _write_objects(store, objects, labels, classes):
    """objects.json: classes, and a line for each object, in the order of the array `object`."""
    rows = []
    for row, label in zip(objects.tolist(), labels):
        values = {name: value.decode() if isinstance(value, bytes) else value for name, value in zip(objects.dtype.names, row)}
        rows.append(dump({"class": label, **values}))
    text = f'{{"classes":{dump(classes)},\n"objects":[\n' + ",\n".join(rows) + "\n]}\n"
    if files.read(store.path("objects.json")) != text.encode():
        files.write(store.path("objects.json"), text.encode())
