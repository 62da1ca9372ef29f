"""Writers of the containers of the segment (segment.idl): SessionLayout, its visitor, the table of who writes what, and
the fields that `yars status` shows.
"""
from . import comments, cpp, schema

CONTAINERS = "databuffer/session/session_containers.hpp"
STATUS = "databuffer/messages/shown_fields.hpp"
PAGE = "docs/shared_memory.md"
TABLE = "| what | written by | in `yars status --json` |\n| --- | --- | --- |\n"
END = "\nRecords from outside are validated"
TEMPLATES = {"latest": "shm::LatestValue<{0}>", "ring": "shm::BroadcastRing<{0}, {1}>"}


def cpp_type(one):
    kind = TEMPLATES[one.kind].format(one.record.name, one.depth) if one.record else one.kind
    return f"std::array<{kind}, {one.size}>" if one.size else kind


def members(containers):
    return ",\n    ".join(["shm::SegmentHeader", *map(cpp_type, containers)])


def containers_header(segment):
    parts = segment.containers
    reserve = next(number for number, one in enumerate(parts) if one.reserve)
    items = [("", f"{cpp_type(one)} {one.name};", " ".join(one.doc)) for one in parts]
    visits = ""
    for one in parts:
        texts = ", ".join(f'"{text}"' for text in (one.name, one.record.name if one.record else "", one.status,
                                                   one.writer))
        visits += (f"  visit(Container{{{texts},\n                  offsetof({segment.name}, {one.name})}},\n"
                   f"        &{segment.name}::{one.name});\n")
    return (f"// The segment of a session as a struct, and a visitor of its containers.\n"
            f"{cpp.MADE.format('segment.idl')}\n#pragma once\n\n"
            "#include <array>\n#include <atomic>\n#include <cstddef>\n#include <cstdint>\n#include <string_view>\n\n"
            '#include "databuffer/session/session_parts.hpp"\n\nnamespace yars::databuffer {\n\n'
            "// [bytes] End of the reserve, and end of the containers.\n"
            f"inline constexpr std::size_t kReserveEnd = size_of_members<\n    {members(parts[:reserve])}>() +\n"
            "    kReserveBytes;\n"
            f"inline constexpr std::size_t kContainersEnd = size_of_members<\n    {members(parts)}>();\n\n"
            "// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): the order is the layout, and cache lines "
            f"need the padding\nstruct {segment.name} {{\n  shm::SegmentHeader header;\n"
            + comments.aligned(items, comments.CPP, "  ") +
            "  std::array<std::atomic<std::uint64_t>, (kReserveEnd - kContainersEnd) / 8> spare;\n};\n"
            f"static_assert(offsetof({segment.name}, spare) == kContainersEnd);\n\n"
            "struct Container {\n  std::string_view name;\n  std::string_view record;  // empty: of no record\n"
            "  std::string_view status;  // name in `yars status`; empty: none\n  std::string_view writer;\n"
            "  std::size_t offset;       // [bytes] in the segment\n};\n\n"
            f"// Calls `visit` with each Container and the pointer to its member of {segment.name}, in order.\n"
            f"template <class Visit>\nvoid for_each_container(Visit visit) {{\n{visits}}}\n\n"
            "}  // namespace yars::databuffer\n")


def shown_field(field):
    value = f"record.{field.name}"
    if field.dimensions or isinstance(field.type, schema.Record):
        raise schema.IdlError(field.where, f"@status at a number or a text, not at {field.name}",
                              "an array or a record")
    if isinstance(field.type, int):
        value = f"shown_text({value})"
    elif field.type in schema.INTEGERS and schema.limits(field) == (0, 1):
        value += " != 0"
    elif field.number in schema.INTEGERS:
        value = f"std::int64_t{{{value}}}" if field.number.startswith("int") else f"std::uint64_t{{{value}}}"
    return f'      {{"{field.name}", "{field.stem}", "{field.unit}", {value}}},\n'


def status_header(segment):
    text = ("// The fields of records that `yars status` shows.\n" + cpp.MADE.format("segment.idl") +
            '\n#pragma once\n\n#include <vector>\n\n#include "databuffer/messages/record_checks.hpp"\n'
            '#include "databuffer/messages/shown_field.hpp"\n\nnamespace yars::databuffer {\n')
    for one in {part.record.name: part.record for part in segment.containers if part.status}.values():
        fields = "".join(shown_field(field) for field in one.fields if field.in_status)
        text += (f"\ninline std::vector<ShownField> shown_fields(const {one.name}& record) {{\n  return {{\n{fields}"
                 "  };\n}\n")
    return text + "\n}  // namespace yars::databuffer\n"


def writers(segment):
    """Rows of the table of the page: the containers of each writer, and what the status shows of them."""
    of_writer, shown = {}, {}
    for one in segment.containers:
        of_writer.setdefault(one.writer, []).append(f"`{one.name}`")
        if one.status:
            fields = ", ".join(f"`{field.name}`" for field in one.record.fields if field.in_status)
            shown.setdefault(one.writer, []).append(f"`{one.status}`: {{{fields}}}")
    return "".join(f"| {', '.join(names)} | {writer} | {', '.join(shown.get(writer, []))} |\n"
                   for writer, names in of_writer.items())


def files(segment):
    return {CONTAINERS: containers_header(segment), STATUS: status_header(segment)}
