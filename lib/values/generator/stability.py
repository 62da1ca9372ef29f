"""Check that a changed layout has a new identity (version, size, hash).

Programs recognize a segment by its identity. With an unchanged identity, a program compiled earlier would misread a
field that has moved or changed its meaning. The check compares the tables in docs/shared_memory.md with the new ones.
With an equal identity no field may be removed, moved, or have another size, type or unit. Allowed are a unit where
there was none, and new fields, because they replace reserved words, which are zero.
"""
import re


class MovedError(Exception):
    """A field was moved or changed without a new identity. The text names the field and the remedy."""


def identity(document):
    found = re.search(r"^Layout version (\d+), (\d+) bytes, hash `([0-9a-f]+)`\.$", document, re.M)
    return found.groups() if found else None


def fields(document):
    """{(record, field): (offset, bytes, type, unit)} from the tables of the document."""
    found = {}
    for record, body in re.findall(r"^### (\w+): \d+ bytes\n(.*?)(?=^### |\Z)", document, re.M | re.S):
        for offset, size, field, kind, unit in re.findall(r"^\| (\d+) \| (\d+) \| `(\w+)` \| ([^|]*) \| ([^|]*) \|", body, re.M):
            found[record, field] = (offset, size, kind.strip(), unit.strip())
    return found


def shown(field):
    if field is None:
        return "no such field"
    return f"offset {field[0]}, {field[1]} bytes, {field[2]}" + (f" [{field[3]}]" if field[3] else "")


def check(before, after):
    """Raises MovedError if a field moved without a new identity. `before`, `after`: texts of docs/shared_memory.md."""
    if identity(before) is None or identity(before) != identity(after):
        return
    old, new = fields(before), fields(after)
    for (record, field), was in old.items():
        now = new.get((record, field))
        if now is None or now[:3] != was[:3] or was[3] not in ("", now[3]):
            raise MovedError(
                f"{record}.{field}: expected {shown(was)}, as in the layout of the same hash, found {shown(now)}; raise the "
                "record's version in databuffer/session/session_layout.hpp and build again, or take reserved words for what is new")
