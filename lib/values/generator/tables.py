"""Writer of the tables in docs/shared_memory.md: containers with offsets, fields with type, unit and range, values."""
import re

from . import schema
from .schema import Bitmask, Constant, Enumeration


def shown_unit(unit):
    return unit.replace("m2", "m²")


def cell(text):
    return text.replace("|", "\\|")


def container_rows(layout):
    """Table of the containers: offset of each in the segment, and offsets of the parts inside one container."""
    yield "| offset | what | container | record | inside, from its begin |\n| ---: | --- | --- | --- | --- |\n"
    for name, offset in layout["offsets"].items():
        part = dict(layout["containers"].get(name, {}))
        kind, record = part.pop("kind", ""), part.pop("record", "")
        count, stride = part.pop("count", 1), part.pop("stride", 0)
        times = f"{count} of {stride} bytes; " if count > 1 else ""
        slots = [f"{key.removeprefix('slot_')} {part.pop(key)}" for key in list(part) if re.match("slot_(?!count|stride)", key)]
        if slots:
            slots = [f"{part.pop('slot_count')} slots of {part.pop('slot_stride')} bytes from {part.pop('slots', 0)}: "
                     + ", ".join(slots)]
        inside = "; ".join([f"{key} {value}" for key, value in part.items()] + slots).replace("_", " ")
        yield f"| {offset} | `{name}` | {kind} | {record} | {times}{inside} |\n"
    yield "\n"


def record_table(record):
    yield f"### {record.name}: {record.size} bytes\n\n" + (" ".join(record.doc) + "\n\n" if record.doc else "")
    yield "| offset | bytes | field | type | unit | range | |\n| ---: | ---: | --- | --- | --- | --- | --- |\n"
    for field in record.fields:
        if field.reserved:
            continue
        if field.heading:
            yield f"|  |  |  |  |  |  | *{cell(' '.join(field.heading))}* |\n"
        limits = " or ".join(filter(None, [schema.range_text(field), "NaN" if field.nan is not None else ""]))
        yield (f"| {field.offset} | {field.size} | `{field.name}` | {schema.type_text(field)} | {shown_unit(field.unit)} | "
               f"{limits} | {cell(field.sentence())} |\n")
    yield "\n"


def values(chapters):
    """Lists of all enumerations, bit masks and constants."""
    for one in (one for chapter in chapters for one in chapter.declarations):
        if isinstance(one, Enumeration):
            texts = [f"{number} {name}" + (f" ({' '.join(doc)})" if doc else "") for number, (name, doc) in enumerate(one.values)]
            long = any(doc for _, doc in one.values)
            yield f"- `{one.name}`, uint{one.bits}:" + ("\n  - " if long else " ") + ("\n  - " if long else ", ").join(texts) + "\n"
        elif isinstance(one, Bitmask):
            texts = [f"{1 << position} {name}" + (f" ({' '.join(doc)})" if doc else "") for name, position, doc in one.flags]
            long = any(doc for _, _, doc in one.flags)
            yield f"- `{one.name}`, bits:" + ("\n  - " if long else " ") + ("\n  - " if long else ", ").join(texts) + "\n"
    yield "- Constants:\n"
    for one in (one for chapter in chapters for one in chapter.declarations if isinstance(one, Constant)):
        yield f"  - {schema.shown(one.value)} {one.name}" + (f": {' '.join(one.doc)}" if one.doc else "") + "\n"


def document(chapters, layout):
    """Text for the generated part of docs/shared_memory.md, which lies between two marks."""
    text = f"Layout version {layout['version']}, {layout['size']} bytes, hash `{layout['hash']}`.\n\n"
    text += "".join(container_rows(layout))
    text += "".join("".join(record_table(one)) for one in schema.records_of(chapters))
    return text + "### Values\n\n" + "".join(values(chapters))
