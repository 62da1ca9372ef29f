"""Writer of the page records.md: containers with offsets, fields with type, unit and range, values."""
from . import schema, stability
from .schema import Bitmask, Constant, Enumeration

HEAD = """# Records of the shared segment

Offsets of containers count from the beginning of the segment, those of fields from the beginning of the record, in
bytes. Both ends of a range belong to it. A number without a range may have any value. Made from the IDL of the records
by `lib/values/generate.py`. How to read and write the segment: `docs/shared_memory.md`.

"""


def shown_unit(unit):
    return unit.replace("m2", "m²")


def cell(text):
    return text.replace("|", "\\|")


def container_rows(layout):
    """Table of the containers: offset of each in the segment, and offsets of the parts inside one container."""
    yield "| offset | what | container | record | inside, from its beginning |\n| ---: | --- | --- | --- | --- |\n"
    for offset, name, kind, record, inside in stability.rows_of(layout, "container"):
        yield f"| {offset} | `{name}` | {kind} | {record} | {inside} |\n"
    yield "\n"


def record_table(record):
    yield f"## {record.name}: {record.size} bytes\n\n" + (" ".join(record.doc) + "\n\n" if record.doc else "")
    yield "| offset | bytes | field | type | unit | range | |\n| ---: | ---: | --- | --- | --- | --- | --- |\n"
    for field in record.fields:
        if field.reserved:
            continue
        if field.heading:
            yield f"|  |  |  |  |  |  | *{cell(' '.join(field.heading))}* |\n"
        limits = " or ".join(filter(None, [schema.range_text(field), "NaN" if field.nan is not None else ""]))
        yield (f"| {field.offset} | {field.size} | `{field.name}` | {schema.type_text(field)} | "
               f"{shown_unit(field.unit)} | {limits} | {cell(field.sentence())} |\n")
    yield "\n"


def values(chapters):
    """Lists of all enumerations, bit masks and constants."""
    for one in (one for chapter in chapters for one in chapter.declarations):
        if isinstance(one, Enumeration):
            texts = [f"{number} {name}" + (f" ({' '.join(doc)})" if doc else "")
                     for number, (name, doc) in enumerate(one.values)]
            long = any(doc for _, doc in one.values)
            yield (f"- `{one.name}`, uint{one.bits}:" + ("\n  - " if long else " ") +
                   ("\n  - " if long else ", ").join(texts) + "\n")
        elif isinstance(one, Bitmask):
            texts = [f"{1 << position} {name}" + (f" ({' '.join(doc)})" if doc else "")
                     for name, position, doc in one.flags]
            long = any(doc for _, _, doc in one.flags)
            yield (f"- `{one.name}`, bits:" + ("\n  - " if long else " ") +
                   ("\n  - " if long else ", ").join(texts) + "\n")
    yield "- Constants:\n"
    for one in (one for chapter in chapters for one in chapter.declarations if isinstance(one, Constant)):
        yield f"  - {schema.shown(one.value)} {one.name}" + (f": {' '.join(one.doc)}" if one.doc else "") + "\n"


def document(chapters, layout):
    """The page. `layout`: text of layout.tsv, which has the offsets of the containers."""
    version, size, digits = stability.rows_of(layout, "layout")[0]
    text = HEAD + f"Layout version {version}, {size} bytes, hash `{digits}`.\n\n## Containers\n\n"
    text += "".join(container_rows(layout))
    text += "".join("".join(record_table(one)) for one in schema.records_of(chapters))
    return text + "## Values\n\n" + "".join(values(chapters))
