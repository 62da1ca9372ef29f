"""Opens a data set for work: checks the specification against the radar, makes what it wants made, opens the maker.

`prepare` runs once in the coordinator and reads no terrain;
`load` runs in the host process, before workers are forked."""
import functools
import importlib
import json
import os
import subprocess
import tempfile
import warnings

import numpy as np

from .. import Error
from . import DatasetError, files, formats
from .blocks import BlockMaker
from .distributions import Streams
from .formats import dump
from .limits import check, command, read_limits, version, without_name
from .sampling import Sampler, World
from .settings import Settings
from .spec import read_spec
from .store import Store, inputs_of

MAKER = "yars.dataset.maker:open_maker"
WARM_ITEMS = 16
FIRST_ITEMS = 1024  # drawn by --check


def open_store(spec_path, folder):
    """(plan, limits, store) of a specification, with all checks that need no terrain.
    Raises SpecError, DatasetError."""
    plan = read_spec(spec_path)
    settings = Settings(plan, Streams(plan.seed, Settings.fields(plan)))
    limits = read_limits(plan, settings.checked_lines())
    check(plan, limits)
    return plan, limits, Store(plan, folder, inputs_of(plan, scene_paths(plan, folder)))


def prepare(spec_path, folder):
    """(plan, store) of a folder that is ready for blocks: general files, made-up terrain and scenes."""
    plan, _, store = open_store(spec_path, folder)
    store.begin()
    make_inputs(plan, store)
    return plan, store


def scene_paths(plan, folder):
    """Files of the scenes; those of made-up ones are to be made."""
    return [scene.file or os.path.join(folder, _made_name(number, scene)) for number, scene in enumerate(plan.scenes)]


def _made_name(number, scene):
    return f"scenes/{number}_{scene.generate}.flt"


def make_inputs(plan, store, read=True):
    """Makes made-up scenes and terrain that are absent; with `read` also those whose contents have changed."""
    from ..places import Scene, Terrain  # the compiled part, which has read the limits before
    for number, scene in enumerate(plan.scenes):
        if scene.generate:
            origin = [f"{value:.12g}" for value in scene.at]
            _made(store, _made_name(number, scene), f"{plan.path}:{scene.line}", read, functools.partial(
                Scene.generate, kind=scene.generate, triangles=scene.triangles, seed=scene.seed,
                origin=[float(value) for value in origin]),
                  f"scene generate --kind {scene.generate} --triangles {scene.triangles} --seed {scene.seed} "
                  f"--origin={','.join(origin)}")
    if plan.terrain_generate:
        _made(store, "terrain", plan.where("terrain"), read,
              functools.partial(Terrain.generate, **plan.terrain_generate, airfields="soil"),
              " ".join(["terrain generate"] + [f"--{name.replace('_', '-')}={value}"
                                               for name, value in plan.terrain_generate.items()] +
                       ["--airfields=soil"]))


def _made(store, name, where, read, make, of):
    """Makes a file or folder by make(path), if it is not there or not as it was made: by `yars` with the words `of`.
    Its sizes and hashes are noted afterwards."""
    subject, path = os.path.basename(name), store.path(name)
    known = store.noted(subject, of)
    reason = store.unfit(subject, read, of) or (read and known.keys() != set(_names_of(store, name)) and
                                                "there are other files")
    if not reason:
        return
    temporary = files.temporary_name(path)
    try:
        _generate(where, path, temporary, make)
        new = {made: store.size_and_hash(temporary + made[len(name):] if made != name else temporary)
               for made in (_names_of(store, name, temporary))}
        if known and known != new and store.has_blocks():
            raise DatasetError(f"{path}: expected what the items there were made with, "
                               f"found that this YARS ({version()}) makes another; use the "
                               "version that dataset.json names, or choose another --out")
        if known:
            warnings.warn(f"{path} is made again: {reason}")
        if {made: store.size_and_hash(made) for made in _names_of(store, name)} != new:  # else another shard was faster
            _replace(temporary, path)
        store.note(subject, new, of)
    finally:
        files.remove(temporary)


def _names_of(store, name, place=None):
    """Names of the files of a file or folder, as they are or will be below DIR. `place`: where it lies now."""
    place = place or store.path(name)
    if os.path.isdir(place):
        return [f"{name}/{inside}" for inside in files.below(place)]
    return [name] if os.path.exists(place) else []


def _replace(temporary, path):
    """Gives a file or folder its name, in place of what has it."""
    old = temporary + "-old"
    try:
        if os.path.isdir(temporary) and os.path.exists(path):
            os.rename(path, old)
        os.rename(temporary, path)
    except OSError as error:
        raise files.failure(path, error) from None
    finally:
        files.remove(old)


def _generate(where, path, temporary, make):
    """Makes a file or folder under a temporary name."""
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        make(temporary)
    except OSError as error:
        raise files.failure(path, error) from None
    except (ValueError, Error) as error:
        raise DatasetError(f"{where}: {without_name(error).replace(temporary, path)}") from None


def _centre(scene, path, where):
    """(latitude, longitude) of a scene: that of the specification, else the file's."""
    if scene.at:
        return scene.at[:2]
    run = subprocess.run([command(), "scene", "info", "--json", str(path)], capture_output=True, text=True, check=False)
    if not run.stdout:  # with 1 and an output, the file is read in part: it has its position
        raise DatasetError(f"{where}: {without_name(run.stderr.strip())}")
    entry = json.loads(run.stdout)["files"][0]
    origin = entry["origin_in_name"] or entry["origin"]
    return origin["latitude_deg"], origin["longitude_deg"]


def load(spec_path, folder, maker_name=MAKER, mark=None, warm=True):
    """BlockMaker of a prepared folder. Reads terrain and scenes; with `warm`, those of items from the whole set.
    `mark`: the fingerprint that the coordinator found."""
    plan, limits, store = open_store(spec_path, folder)
    if mark and mark != store.mark:
        raise DatasetError(f"{spec_path}: expected the specification, terrain and scenes that the run began with "
                           f"(fingerprint {mark}), found others ({store.mark}); have all computers see the same files")
    paths = scene_paths(plan, folder)
    terrain = store.path("terrain") if plan.terrain_generate else plan.terrain
    module, _, function = maker_name.partition(":")
    scenes = [(path, scene.at if scene.file else None, scene.without) for scene, path in zip(plan.scenes, paths)]
    maker = getattr(importlib.import_module(module), function)(plan, terrain, scenes)
    labels = [plan.class_of(str(name)) for name in maker.objects["name"]]
    classes = sorted({label for label in labels if label})
    ids = [classes.index(label) if label else -1 for label in labels]
    # For targets at scenes only: a given file without `at` is asked for its origin.
    centres = []
    if any(target.scenes for target in plan.targets):
        centres = [_centre(scene, path, f"{plan.path}:{scene.line}") for scene, path in zip(plan.scenes, paths)]
    sampler = Sampler(plan, limits,
                      World(maker.elevation, np.array(centres, float).reshape(-1, 2), maker.objects, labels))
    store.describe(_objects_text(maker.objects, labels, classes), formats.types(len(maker.objects)))
    if warm:
        step = max(1, plan.count // WARM_ITEMS)
        maker.warm(sampler.draw(np.arange(0, plan.count, step)[:WARM_ITEMS]), sampler.settings.text(0))
    return BlockMaker(plan, store, sampler, maker, ids)


def try_out(spec_path, maker_name=MAKER):
    """Makes the first items of a specification in a temporary folder, with its terrain and scenes,
    and some of the whole set. Raises SpecError, DatasetError."""
    with tempfile.TemporaryDirectory(prefix="yars-dataset-") as folder:
        plan, store = prepare(spec_path, folder)
        made = load(spec_path, folder, maker_name, store.mark)
        made.sampler.draw(np.arange(min(plan.count, FIRST_ITEMS)))


def _objects_text(objects, labels, classes):
    """objects.json: classes, and a line for each object, in the order of the array `object`."""
    rows = []
    for row, label in zip(objects.tolist(), labels):
        values = {name: value.decode() if isinstance(value, bytes) else value
                  for name, value in zip(objects.dtype.names, row)}
        rows.append(dump({"class": label, **values}))
    return f'{{"classes":{dump(classes)},\n"objects":[\n' + ",\n".join(rows) + "\n]}\n"
