"""Folder of a data set: where its files lie, which blocks are whole, and the last step that joins the blocks' parts.

    DIR/dataset.json            count, arrays, fingerprint of the specification
    DIR/specification.yaml   copy of the specification
    DIR/objects.json            classes, and the objects of the scenes
    DIR/chips.zarr/NAME/B.0.0   block B of an array; or DIR/items/KKK/K.npz
    DIR/boxes/BBB/B.npy         boxes of block B
    DIR/parts/BBB/B.jsonl       files of block B with size and hash, then one line an item; written last
    DIR/manifest.jsonl          one line an item, when all blocks are whole
A block is whole if its part and all files that the part names are there and fit."""
import hashlib
import json
import os
import pathlib

from . import DatasetError, files, formats, limits
from .maker import hasher

FORMAT = 1  # of the folder; part of the fingerprint


def fingerprint(plan, scene_paths):
    """Hash of everything that decides the items: the specification, and contents of the files that it names."""
    digest = hashlib.blake2b(digest_size=16)
    digest.update(json.dumps([FORMAT, plan.plain()], sort_keys=True).encode())
    for scene, path in zip(plan.scenes, scene_paths):
        data = files.read(path) if scene.file else b""
        if data is None:
            raise DatasetError(f"{plan.path}:{scene.line}: expected an OpenFlight file, found none: {path}; check the path")
        digest.update(hashlib.blake2b(data, digest_size=16).digest())
    if plan.config:
        digest.update(limits.printed(plan.config).encode())
    if plan.terrain:
        if not os.path.isdir(plan.terrain):
            raise DatasetError(f"{plan.where('terrain')}: expected a folder of elevation cells, found none: {plan.terrain}; check the path")
        for folder, folders, names in os.walk(plan.terrain):
            folders.sort()
            for name in sorted(names):
                path = os.path.join(folder, name)
                digest.update(f"{os.path.relpath(path, plan.terrain)} {os.path.getsize(path)}\n".encode())
    return digest.hexdigest()


class Store:
    """Paths and states of the blocks of one data set."""

    def __init__(self, plan, folder, mark):
        self.plan, self.folder, self.mark = plan, str(folder), mark
        self.hash_name, self.hash, self.hash_items = hasher()

    def path(self, name):
        return os.path.join(self.folder, name)

    def items(self, block):
        """First item of a block, and the item after its last."""
        return block * self.plan.block, min((block + 1) * self.plan.block, self.plan.count)

    @staticmethod
    def part_name(block):
        return f"parts/{block // 1000:04d}/{block:07d}.jsonl"

    @staticmethod
    def boxes_name(block):
        return f"boxes/{block // 1000:04d}/{block:07d}.npy"

    @staticmethod
    def item_name(folder, item, ending):
        return f"{folder}/{item // 1000:06d}/{item:09d}{ending}"

    def begin(self):
        """Makes the folder and its general files, or checks that it belongs to this specification."""
        about = {"format": FORMAT, "fingerprint": self.mark, "count": self.plan.count, "block": self.plan.block, "seed": self.plan.seed,
                 "size": self.plan.size, "arrays": list(self.plan.arrays), "files": self.plan.format, "hash": self.hash_name}
        text = json.dumps(about, indent=1) + "\n"
        try:
            os.makedirs(self.folder, exist_ok=True)
        except OSError as error:
            raise files.failure(self.folder, error, "a folder") from None
        there = files.read(self.path("dataset.json"))
        if there is not None and there.decode(errors="replace") != text:
            try:
                differs = [name for name, value in about.items() if json.loads(there).get(name) != value]
            except (ValueError, AttributeError):
                differs = ["dataset.json, which is no JSON"]
            raise DatasetError(f"{self.folder}: expected the data set of {self.plan.path}, found one of another specification (different: "
                               f"{', '.join(differs)}); choose another --out, or remove this folder")
        if there is None:
            if any(name not in ("scenes", "terrain") and not name.startswith(".") for name in os.listdir(self.folder)):
                raise DatasetError(f"{self.folder}: expected a new or empty folder, or a data set, found other files; choose another --out")
            files.write(self.path("dataset.json"), text.encode())
        if not os.path.exists(self.path("specification.yaml")):
            files.write(self.path("specification.yaml"), pathlib.Path(self.plan.path).read_bytes())

    def describe_arrays(self, kinds):
        """Writes the metadata of the Zarr arrays, if they are not there. `kinds`: types of the arrays."""
        for name, content in (formats.zarr_metadata(self.plan, kinds) if self.plan.format == "zarr" else {}).items():
            if files.read(self.path(f"chips.zarr/{name}")) != content.encode():
                files.write(self.path(f"chips.zarr/{name}"), content.encode())

    def read_part(self, block):
        """(head, lines as bytes) of a block's part; (None, reason) if it is not whole."""
        data = files.read(self.path(self.part_name(block)))
        if data is None:
            return None, "absent"
        first, _, lines = data.partition(b"\n")
        try:
            head = json.loads(first)
            good = (head["block"] == block and head["dataset"] == self.mark and isinstance(head["files"], dict) and
                    head["lines"] == f"{self.hash(lines):016x}")
        except (ValueError, KeyError, TypeError):
            good = False
        return (head, lines) if good else (None, "its part is damaged")

    def fault(self, block, full=False):
        """What keeps a block from being whole; None if it is. Sizes only, or with `full` all bytes."""
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

    def complete(self):
        """True if the parts of all blocks are there."""
        return all(os.path.exists(self.path(self.part_name(block))) for block in range(self.plan.blocks))

    def merge(self, again):
        """Joins the parts to manifest.jsonl, and annotations.json if wanted. Several shards may do it at once: they write
        the same bytes. Without `again` only if something is absent. Returns blocks that are not whole."""
        names = ["manifest.jsonl"] + (["annotations.json"] if self.plan.coco else [])
        if not again and all(os.path.exists(self.path(name)) for name in names):
            return []
        broken = []

        def lines():
            for block in range(self.plan.blocks):
                head, text = self.read_part(block)
                if head is None:
                    broken.append(block)
                else:
                    yield text
        write_stream(self.path("manifest.jsonl"), lines(), lambda: not broken)
        if self.plan.coco and not broken:
            from .coco import annotations
            write_stream(self.path("annotations.json"), annotations(self), lambda: True)
        return broken


def write_stream(path, parts, good):
    """Writes bytes objects to a file under a temporary name; renames it if good() holds at the end."""
    temporary = files.temporary_name(path)
    try:
        with open(temporary, "wb") as file:
            for part in parts:
                file.write(part)
        if good():
            os.rename(temporary, path)
            return
    except OSError as error:
        raise files.failure(path, error) from None
    finally:
        try:
            os.unlink(temporary)
        except OSError:
            pass
