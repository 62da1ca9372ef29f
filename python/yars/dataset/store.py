"""Folder of a data set: where its files lie, which blocks are whole, and the last step that joins the blocks' parts.

    DIR/dataset.json          count, arrays, fingerprint of the specification and of what it names, version of YARS
    DIR/specification.yaml    copy of the specification
    DIR/objects.json          classes, and the objects of the scenes
    DIR/chips.zarr/NAME/B.0.0   block B of an array; or DIR/items/KKK/K.npz
    DIR/boxes/BBB/B.npy       boxes of block B
    DIR/parts/BBB/B.jsonl     files of block B with size and hash, then one line an item; written last
    DIR/manifest.jsonl        one line an item, when all blocks are whole
    DIR/checks/NAME.json      sizes and hashes of the other files; written after them
A block is whole if its part and all files that the part names are there and fit."""
import hashlib
import itertools
import json
import mmap
import os
import pathlib
import re
import warnings

import numpy as np
import yaml

from . import DatasetError, files, formats, limits
from .maker import hasher

FORMAT = 2  # of the folder; part of the fingerprint
PARTS = 1000  # blocks of a folder of parts
_BITS_AT_ONCE = 1 << 20
# What is in a folder: files of the blocks, which go when the folder gets another specification; and the others.
_OF_BLOCKS = ("chips.zarr", "boxes", "items", "png", "geotiff", "parts", "objects.json", "manifest.jsonl",
              "annotations.json")
_OTHERS = ("dataset.json", "specification.yaml", "checks", "scenes", "terrain")


def _hash_of(*parts):
    return hashlib.blake2b(b"\0".join(parts), digest_size=16).hexdigest()


def inputs_of(plan, scene_paths):
    """{what decides the items: hash}: the specification's values, and contents of the files that it names."""
    result = {"specification": _hash_of(json.dumps([FORMAT, plan.plain()], sort_keys=True).encode())}
    for number, (scene, path) in enumerate(zip(plan.scenes, scene_paths)):
        if not scene.file:
            continue
        data = None if os.path.isdir(path) else files.read(path)
        if data is None:
            raise DatasetError(f"{plan.path}:{scene.line}: expected an OpenFlight file, found none: {path}; "
                               "check the path")
        result[f"scenes[{number}].file"] = _hash_of(data)
    if plan.config:
        result["radar.config"] = _hash_of(limits.printed(plan.config).encode())
    if plan.terrain:
        if not os.path.isdir(plan.terrain):
            raise DatasetError(f"{plan.where('terrain')}: expected a folder of elevation cells, found none: "
                               f"{plan.terrain}; check the path")
        sizes = (f"{name} {os.path.getsize(os.path.join(plan.terrain, name))}" for name in files.below(plan.terrain))
        result["terrain"] = _hash_of("\n".join(sizes).encode())
    return result


def different_keys(before, after, path=""):
    """Paths of the keys in which two readings of YAML differ."""
    if isinstance(before, dict) and isinstance(after, dict):
        return [key for name in dict.fromkeys([*before, *after])
                for key in different_keys(before.get(name), after.get(name), f"{path}.{name}".lstrip("."))]
    if (isinstance(before, list) and isinstance(after, list) and len(before) == len(after) and
            any(isinstance(item, dict) for item in after)):
        return [key for at, pair in enumerate(zip(before, after)) for key in different_keys(*pair, f"{path}[{at}]")]
    return [] if before == after else [path or "all"]


def absent_blocks(there, shard, shards, blocks):
    """Blocks shard, shard + shards, ... whose bit is not set, in ascending order. `there`: one bit a block."""
    for start in range(0, blocks, _BITS_AT_ONCE):
        bits = np.unpackbits(np.frombuffer(there, np.uint8)[start // 8:(start + _BITS_AT_ONCE) // 8], bitorder="little")
        numbers = np.flatnonzero(bits[:blocks - start] == 0) + start
        yield from numbers[numbers % shards == shard].tolist()


class Store:
    """Paths and states of the blocks of one data set. `inputs`: of inputs_of()."""

    def __init__(self, plan, folder, inputs):
        self.plan, self.folder, self.inputs = plan, str(folder), inputs
        self.mark = _hash_of(json.dumps(inputs, sort_keys=True).encode())
        self.hash_name, self.hash, self.hash_items = hasher()

    def path(self, name):
        return os.path.join(self.folder, name)

    def items(self, block):
        """First item of a block, and the item after its last."""
        return block * self.plan.block, min((block + 1) * self.plan.block, self.plan.count)

    @staticmethod
    def part_name(block):
        return f"parts/{block // PARTS:04d}/{block:07d}.jsonl"

    @staticmethod
    def boxes_name(block):
        return f"boxes/{block // PARTS:04d}/{block:07d}.npy"

    @staticmethod
    def item_name(folder, item, ending):
        return f"{folder}/{item // 1000:06d}/{item:09d}{ending}"

    # The folder

    def begin(self):
        """Makes the folder and its general files, or checks that it belongs to this specification. A folder without any
        block takes another specification."""
        plan = self.plan
        about = {"format": FORMAT, "yars": limits.version(), "model": limits.model(), "fingerprint": self.mark,
                 "inputs": self.inputs,
                 "count": plan.count, "block": plan.block, "seed": plan.seed, "size": plan.size,
                 "arrays": list(plan.arrays), "files": plan.format, "hash": self.hash_name}
        try:
            os.makedirs(self.folder, exist_ok=True)
        except OSError as error:
            raise files.failure(self.folder, error, "a folder for --out") from None
        text = files.read(self.path("dataset.json"))
        there = _json_object(text)
        made_by = there.get("model", 1) if there else about["model"]
        if made_by != about["model"] and self.has_blocks():
            raise DatasetError(f"{self.folder}: expected a data set of radar model {about['model']}, found one of "
                               f"model {made_by}; choose another --out, or use YARS {there.get('yars')}")
        if there is not None and {**there, "yars": None} == {**about, "yars": None}:
            if there.get("yars") != about["yars"]:
                warnings.warn(f"{self.folder}: begun by YARS {there.get('yars')}, this is {about['yars']}: "
                              "items made now may differ from those that are there; make all of them by one version")
        else:
            self._change(text, there)
            files.remove(self.path("specification.yaml"))
            files.write(self.path("dataset.json"), (json.dumps(about, indent=1) + "\n").encode())
        self._keep_specification()

    def _keep_specification(self):
        """Copies the specification where there is no whole copy.
        Another copy may be whole: of the same meaning, with other comments."""
        name = "specification.yaml"
        fault = self.unfit("specification", True)
        if not fault:
            return
        there = files.read(self.path(name))
        if there != self._given():
            if there is not None:
                warnings.warn(f"{self.path(name)} is made again: {fault}")
            files.write(self.path(name), self._given())
        self.note("specification", [name])

    def _given(self):
        return pathlib.Path(self.plan.path).read_bytes()

    def _first_mark(self):
        """Fingerprint that the first readable part bears; "": none is readable; None: there is no part."""
        mark = None
        for block in itertools.chain.from_iterable(map(self._parts_of, self._part_folders())):
            head, _ = self._split(files.read(self.path(self.part_name(block))) or b"")
            mark = str((_json_object(head) or {}).get("dataset", ""))
            if mark:
                break
        return mark

    def _change(self, text, there):
        """Clears the folder for this specification, or raises DatasetError.
        `text`, `there`: dataset.json, None if absent or broken."""
        mark = self._first_mark()
        if mark == self.mark:
            warnings.warn(f"{self.path('dataset.json')} is made again: "
                          f"it was {'absent' if text is None else 'damaged'}")
        elif mark is None and text is None:
            ours = files.read(self.path("specification.yaml")) == self._given()
            made = {"terrain"} if self.plan.terrain_generate else set()
            made |= {"scenes"} if any(scene.generate for scene in self.plan.scenes) else set()
            known = ({*_OF_BLOCKS, *_OTHERS} if ours else {"scenes", "terrain", "dataset.json", "specification.yaml"} -
                     made)
            other = sorted(name for name in os.listdir(self.folder) if name not in known and not name.startswith("."))
            if other and not os.path.exists(self.path("dataset.json")):  # another shard may have begun
                raise DatasetError(f"{self.folder}: expected a new or empty folder, or a data set, found other files: "
                                   f"{', '.join(other[:5])}; choose another --out")
        elif mark is None:
            for name in _OF_BLOCKS:
                files.remove(self.path(name))
        elif there is None:
            found = "none" if text is None else "one that is no JSON"
            raise DatasetError(f"{self.path('dataset.json')}: expected the description of a data set, found {found}, "
                               f"and blocks of another specification than {self.plan.path}; run with the "
                               f"specification that they were made by ({self.path('specification.yaml')} is its copy), "
                               "with the same files: then it is made again and no item is lost")
        else:
            raise DatasetError(f"{self.folder}: expected the data set of {self.plan.path}, "
                               "found one of another specification (different: "
                               f"{', '.join(self._differences(there))}); choose another --out, or remove this folder")

    def _differences(self, there):
        """Differences between this data set and the one whose dataset.json is `there`, one text each."""
        if there.get("format") != FORMAT:
            return [f"format {there.get('format')} of the folder, this YARS writes {FORMAT}"]
        before = there.get("inputs") if isinstance(there.get("inputs"), dict) else {}
        names = [name for name in {**before, **self.inputs} if before.get(name) != self.inputs.get(name)]
        result = [f"contents of {name}" for name in names if name != "specification"]
        if there.get("hash") != self.hash_name:
            result.append(f"kind of hash {there.get('hash')}")
        if "specification" in names:
            try:
                texts = files.read(self.path("specification.yaml")) or b"", self._given()
                keys = different_keys(*(yaml.load(text, yaml.BaseLoader) for text in texts))
            except yaml.YAMLError:
                keys = []
            result = (keys or ["values of the specification"]) + result
        return result or ["dataset.json"]

    def describe(self, objects_text, kinds):
        """Writes objects.json and the metadata of the Zarr arrays where they differ. `kinds`: types of the arrays."""
        contents = {"objects.json": objects_text.encode()}
        if self.plan.format == "zarr":
            contents.update(
                {f"chips.zarr/{name}": text.encode() for name, text in formats.zarr_metadata(self.plan, kinds).items()})
        for name, content in contents.items():
            if files.read(self.path(name)) != content:
                files.write(self.path(name), content)
        self.note("objects", contents)

    # Sizes and hashes of files that belong to no block

    def size_and_hash(self, name):
        """[size, hash] of a file, without reading it into memory."""
        path = self.path(name)
        try:
            with open(path, "rb") as file:
                size = os.fstat(file.fileno()).st_size
                if not size:
                    return [0, f"{self.hash(b''):016x}"]
                with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
                    return [size, f"{self.hash(content):016x}"]
        except FileNotFoundError:
            return None
        except OSError as error:
            raise files.failure(path, error, "to read") from None

    def note(self, subject, names, mark=None):
        """Writes checks/SUBJECT.json for files that were written."""
        text = json.dumps({"of": mark or self.mark, "files": {name: self.size_and_hash(name) for name in names}}) + "\n"
        path = self.path(f"checks/{subject}.json")
        if files.read(path) != text.encode():
            files.write(path, text.encode())

    def noted(self, subject, mark=None):
        """{name: [size, hash]} of checks/SUBJECT.json; {} if it is absent, damaged or of something else."""
        about = _json_object(files.read(self.path(f"checks/{subject}.json"))) or {}
        return about["files"] if about.get("of") == (mark or self.mark) and isinstance(about.get("files"), dict) else {}

    def unfit(self, subject, full, mark=None):
        """Why files of checks/SUBJECT.json are not complete; None: they are. Compares sizes, with `full` all bytes."""
        names = self.noted(subject, mark)
        if not names:
            return "its sizes and hashes are absent"
        for name, known in names.items():
            try:
                size = os.stat(self.path(name)).st_size
            except OSError:
                return f"{name} is absent"
            if not isinstance(known, list) or size != known[0]:
                return f"{name} has another size"
            if full and self.size_and_hash(name) != known:
                return f"{name} has another content"
        return None

    # Blocks

    @staticmethod
    def _split(data):
        head, _, lines = data.partition(b"\n")
        return head, lines

    def read_part(self, block):
        """(head, lines as bytes) of a block's part; (None, reason) if it is not whole."""
        data = files.read(self.path(self.part_name(block)))
        if data is None:
            return None, "absent"
        first, lines = self._split(data)
        try:
            head = json.loads(first)
            good = (head["block"] == block and head["dataset"] == self.mark and isinstance(head["files"], dict) and
                    head["lines"] == f"{self.hash(lines):016x}")
        except (ValueError, KeyError, TypeError):
            good = False
        return (head, lines) if good else (None, "its part is damaged")

    def fault(self, block, full=False):
        """Why a block is not complete; None: it is. Compares sizes, with `full` all bytes."""
        head, reason = self.read_part(block)
        if head is None:
            return reason
        for name, (size, check) in head["files"].items():
            path = self.path(name)
            try:
                if os.stat(path).st_size != size:
                    return f"{name} has another size"
                if full and f"{self.hash(files.read(path)):016x}" != check:
                    return f"{name} has another content"
            except FileNotFoundError:
                return f"{name} is absent"
            except OSError as error:
                raise files.failure(path, error, "to read") from None
        return None

    def _part_folders(self):
        """Numbers of the folders of parts that are there, ascending."""
        try:
            return sorted(int(name) for name in os.listdir(self.path("parts")) if name.isdigit())
        except OSError:
            return []

    def _parts_of(self, number):
        """Blocks with a part in a folder of parts, ascending."""
        names = map(re.compile(r"(\d+)\.jsonl$").match,
                    os.listdir(os.path.dirname(self.path(self.part_name(number * PARTS)))))
        return sorted(block for block in (int(match.group(1)) for match in names if match) if block < self.plan.blocks)

    def whole_blocks(self, shard, shards, full, damaged):
        """(bits, number): one bit for each block, set for the whole ones of a shard.
        Calls damaged(block, reason) for others with a part."""
        # Zeros of NumPy take no memory before something else is written there.
        there, number = np.zeros(-(-self.plan.blocks // _BITS_AT_ONCE) * (_BITS_AT_ONCE // 8), np.uint8), 0
        for block in itertools.chain.from_iterable(map(self._parts_of, self._part_folders())):
            if block % shards != shard:
                continue
            reason = self.fault(block, full)
            if reason:
                damaged(block, reason)
            else:
                there[block // 8] |= 1 << block % 8
                number += 1
        return there, number

    def has_blocks(self):
        """True if a part is there."""
        return self._first_mark() is not None

    def complete(self):
        """True if the parts of all blocks are there."""
        return sum(len(self._parts_of(number)) for number in self._part_folders()) == self.plan.blocks

    def merge(self, again, full):
        """Joins the parts to manifest.jsonl, and annotations.json if wanted. Several shards may do it at once: they
        write the same bytes. Without `again` only what is absent or does not fit.
        Returns blocks that are not whole, at most 20."""
        if again or self.unfit("manifest", full):
            broken = []

            def lines():
                for block in range(self.plan.blocks):
                    head, text = self.read_part(block)
                    if head is not None:
                        yield text
                    elif len(broken) < 20:
                        broken.append(block)
            files.write_stream(self.path("manifest.jsonl"), lines(), lambda: not broken)
            if broken:
                return broken
            self.note("manifest", ["manifest.jsonl"])
        if self.plan.coco and (again or self.unfit("annotations", full)):
            files.write_stream(self.path("annotations.json"), formats.coco(self), lambda: True)
            self.note("annotations", ["annotations.json"])
        return []


def _json_object(data):
    """Object of a JSON text as bytes; None if it is none."""
    try:
        value = json.loads(data or b"")
        return value if isinstance(value, dict) else None
    except ValueError:
        return None
