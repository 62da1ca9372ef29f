"""Writer of the C++ files: a header for each chapter, the checks of ranges, the table of fields, layout asserts."""
import re

from . import comments, schema
from .schema import Bitmask, Constant, Enumeration, Record

MADE = "// Made by databuffer/messages/generate.py from {}: change that, not this."
MIRRORED = "radar_values"  # chapter without a generated header: lib/radar/modes.hpp has its C++


def cpp_type(idl_type):
    return idl_type if idl_type in schema.REALS else f"std::{idl_type}_t"


def element_type(field):
    if isinstance(field.type, int):
        return "char"
    return field.type.scoped if isinstance(field.type, Record) else cpp_type(field.number)


def declarator(field):
    dimensions = "".join(f"[{expression}]" for _, expression in field.dimensions)
    return field.name + dimensions + (f"[{field.type + 1}]" if isinstance(field.type, int) else "")


def commented(items, indent=""):
    return comments.aligned(items, comments.CPP, indent)


def doc_lines(declaration, indent=""):
    return "".join(f"{indent}// {line.removeprefix('--').strip()}\n" for line in declaration.doc)


# ---- headers
def constant(one):
    suffix = "U" if one.type == "uint32" and one.expression.isdigit() else ""
    code = f"inline constexpr {cpp_type(one.type)} {one.name} = {one.expression}{suffix};"
    return commented([(" ".join(one.heading), code, " ".join(one.doc))])


def enumeration(one):
    head = doc_lines(one) + f"enum class {one.name} : std::uint{one.bits}_t {{"
    plain = head + " " + ", ".join(f"{name} = {number}" for number, (name, _) in enumerate(one.values)) + " };\n"
    if not any(doc for _, doc in one.values) and max(map(len, plain.splitlines())) <= comments.WIDTH:
        return plain
    items = [("", f"{name} = {number},", " ".join(doc)) for number, (name, doc) in enumerate(one.values)]
    return head + "\n" + commented(items, "  ") + "};\n"


def bitmask(one):
    first = "1U" if one.bits <= 32 else "std::uint64_t{1}"
    items = [("", f"inline constexpr std::uint{one.bits}_t {name} = {first} << {position};", " ".join(doc))
             for name, position, doc in one.flags]
    return comments.CPP.above(" ".join(one.doc) or f"{one.name}.") + commented(items)


def field_item(field):
    default = f" = {field.default.expression}" if field.default else ""
    return " ".join(field.heading), f"{element_type(field)} {declarator(field)}{default};", schema.about(field)


def record(one):
    text = doc_lines(one) + f"struct {one.name} {{\n" + commented(map(field_item, one.fields), "  ") + "};\n"
    text += f"static_assert(sizeof({one.name}) == {one.size} && std::is_trivially_copyable_v<{one.name}>);\n"
    last = one.fields[-1]
    if last.cut:
        text += (f"\n// Bytes of the record that a ring copies: the fields, and the entries of {last.name} in use.\n"
                 f"inline std::size_t used_bytes(const {one.name}& record) {{\n  return offsetof({one.name}, {last.name}) + "
                 f"std::min<std::size_t>(record.{last.counted_by}, {last.dimensions[0][1]});\n}}\n")
    return text


WRITERS = {Constant: constant, Enumeration: enumeration, Bitmask: bitmask, Record: record}


def included(chapter, chapters):
    """Headers that the header of this chapter must include."""
    homes = {one.scoped: other.name for other in chapters for one in other.declarations}
    used = set()
    for one in chapter.declarations:
        fields = one.fields if isinstance(one, Record) else []
        texts = [one.expression] if isinstance(one, Constant) else []
        for field in fields:
            limits = [limit.expression for limit in (field.minimum, field.maximum, field.default) if limit]
            texts += [expression for _, expression in field.dimensions] + limits
            if isinstance(field.type, (Record, Enumeration, Bitmask)):
                used.add(homes[field.type.scoped])
        used.update(homes[name] for text in texts for name in re.findall(r"[A-Za-z_][\w:]*", text) if name in homes)
    used.discard(chapter.name)
    return sorted("lib/radar/modes.hpp" if name == MIRRORED else f"databuffer/messages/{name}.hpp" for name in used)


def header(chapter, chapters):
    records = [one for one in chapter.declarations if isinstance(one, Record)]
    system = ["cstdint"] + (["cstddef", "type_traits"] if records else [])
    system += ["algorithm"] if any(one.fields[-1].cut for one in records) else []
    text = "".join(f"// {line}\n" for line in chapter.doc) + MADE.format(chapter.name + ".idl") + "\n#pragma once\n\n"
    text += "".join(f"#include <{name}>\n" for name in sorted(system)) + "\n"
    text += "".join(f'#include "{name}"\n' for name in included(chapter, chapters))
    text += ("\n" if included(chapter, chapters) else "") + "namespace yars::databuffer {\n"
    before = None
    for one in chapter.declarations:
        in_a_row = isinstance(one, Constant) and isinstance(before, Constant) and not one.heading
        text += ("" if in_a_row else "\n") + WRITERS[type(one)](one)
        before = one
    return text + "\n}  // namespace yars::databuffer\n"


# ---- checks of ranges
def whole_limits(field):
    """(minimum, maximum) of an integer or enumeration field as C++ text; None: no limit."""
    if isinstance(field.type, Enumeration):
        return "0", str(len(field.type.values) - 1)
    return (field.minimum.expression if field.minimum else None), (field.maximum.expression if field.maximum else None)


def number_check(field, name, value):
    """C++ line that checks one number; empty if every value is valid."""
    least, greatest = whole_limits(field)
    if least is None and greatest is None:
        return ""
    if field.type in schema.REALS:
        least, greatest = least or "-kInfinity", greatest or "kInfinity"
        missing = ", Missing::allowed" if field.nan is not None else ""
        return f'inspection.range("{name}", {value}, {least}, {greatest}{missing});\n'
    if least is None and field.number.startswith("u"):
        return f'inspection.at_most("{name}", {value}, {greatest});\n'
    low, high = schema.INTEGERS[field.number][1:]
    return f'inspection.whole("{name}", {value}, {least or low}, {greatest or high});\n'


def checks(one, access, prefix, indent):
    """C++ lines that check all fields of a record except those with @by_hand."""
    text = ""
    for field in one.fields:
        if field.reserved or field.by_hand:
            continue
        name, value = prefix + field.name, f"{access}.{field.name}"
        element, inner = ("entry", indent + "  ") if field.dimensions else (value, indent)
        if isinstance(field.type, Record):
            body = checks(field.type, element, name + ("." if field.type.nested else ": "), inner)
        elif isinstance(field.type, int):
            body = f'{inner}inspection.text("{name}", {element});\n'
        else:
            line = number_check(field, name, element)
            body = inner + line if line else ""
        if field.dimensions and body:
            entries = f"used({value}, {access}.{field.counted_by})" if field.counted_by else value
            body = f"{indent}for (const auto& entry : {entries}) {{\n{body}{indent}}}\n"
        text += body
    return text


def by_hand_limits(one):
    """C++ struct with the ranges of the fields with @by_hand, for validation.cpp."""
    fields = [field for field in one.fields if field.by_hand and field.minimum and field.maximum]
    if not fields:
        return ""
    return f"struct {one.name}Limits {{\n" + "".join(
        f"  static constexpr Limits {field.name}{{{field.minimum.expression}, {field.maximum.expression}}};\n"
        for field in fields) + "};\n"


def whole_records(chapters):
    return [one for one in schema.records_of(chapters) if not one.nested]


def checks_header(chapters):
    text = ("// Checks of the records' fields against their ranges, and the ranges of fields with @by_hand.\n"
            + MADE.format("records.idl") + "\n#pragma once\n\n#include \"databuffer/messages/inspection.hpp\"\n")
    text += "".join(f'#include "databuffer/messages/{one.name}.hpp"\n' for one in chapters
                    if one.name not in (MIRRORED, "records")) + "\nnamespace yars::databuffer {\n\n"
    text += "".join(filter(None, map(by_hand_limits, schema.records_of(chapters)))) + "\n"
    text += "// Reports the first field that is out of range to the inspection. Fields with @by_hand are not checked.\n"
    text += "".join(f"void check_fields(Inspection& inspection, const {one.name}& record);\n" for one in whole_records(chapters))
    return text + "\n}  // namespace yars::databuffer\n"


def checks_source(chapters):
    text = MADE.format("records.idl") + '\n#include "databuffer/messages/record_checks.hpp"\n\n#include <limits>\n\n'
    text += "namespace yars::databuffer {\n\nnamespace {\n\n"
    text += "// Limit of a range without a limit.\n"
    text += "[[maybe_unused]] constexpr double kInfinity = std::numeric_limits<double>::infinity();\n\n}  // namespace\n"
    for one in whole_records(chapters):
        body = checks(one, "record", "", "  ")
        names = ("Inspection& inspection", f"const {one.name}& record") if body else ("Inspection&", f"const {one.name}&")
        text += f"\nvoid check_fields({', '.join(names)}) {{\n{body}}}\n"
    return text + "\n}  // namespace yars::databuffer\n"


# ---- the table of fields
def field_row(one, field):
    least, greatest = schema.limits(field)
    return (f'    {{"{field.name}", offsetof({one.name}, {field.name}), sizeof({one.name}::{field.name}),\n'
            f'     "{schema.type_text(field)}", "{field.unit}", {"-kInfinity" if least is None else float(least)}, '
            f'{"kInfinity" if greatest is None else float(greatest)}}},\n')


def table_source(chapters):
    records = schema.records_of(chapters)
    text = MADE.format("records.idl") + '\n#include "databuffer/messages/record_fields.hpp"\n\n#include <array>\n#include <limits>\n\n'
    text += "".join(f'#include "databuffer/messages/{one.name}.hpp"\n' for one in chapters if one.name not in (MIRRORED, "records"))
    text += '#include "lib/radar/modes.hpp"\n\nnamespace yars::databuffer {\n\nnamespace {\n\n'
    text += "constexpr double kInfinity = std::numeric_limits<double>::infinity();\n\n"
    for one in records:
        rows = "".join(field_row(one, field) for field in one.fields if not field.reserved)
        text += f"constexpr RecordField k{one.name}Fields[] = {{\n{rows}}};\n\n"
    text += "constexpr RecordFields kRecords[] = {\n" + "".join(
        f'    {{"{one.name}", sizeof({one.name}), k{one.name}Fields}},\n' for one in records) + "};\n\n}  // namespace\n\n"
    text += "std::span<const RecordFields> record_fields() {\n  return kRecords;\n}\n\n"
    text += "// Offsets and the values of lib/radar/modes.hpp are equal in the IDL and in C++.\n"
    for one in records:
        text += "".join(f"static_assert(offsetof({one.name}, {field.name}) == {field.offset});\n" for field in one.fields)
    return text + "".join(mirror_asserts(chapters)) + "\n}  // namespace yars::databuffer\n"


def mirror_asserts(chapters):
    for one in (one for chapter in chapters if chapter.name == MIRRORED for one in chapter.declarations):
        if isinstance(one, Constant):
            yield f"static_assert({one.scoped} == {one.value});\n"
        else:
            yield f"static_assert(sizeof({one.scoped}) == {one.bits // 8});\n"
            for number, (name, _) in enumerate(one.values):
                yield f"static_assert(static_cast<int>({one.scoped}::{name}) == {number});\n"


def files(chapters):
    """{path in the build folder: text of the file}"""
    made = {f"databuffer/messages/{one.name}.hpp": header(one, chapters) for one in chapters
            if one.declarations and one.name != MIRRORED}
    made["databuffer/messages/record_checks.hpp"] = checks_header(chapters)
    made["databuffer/messages/record_checks.cpp"] = checks_source(chapters)
    made["databuffer/messages/record_fields.cpp"] = table_source(chapters)
    return made
