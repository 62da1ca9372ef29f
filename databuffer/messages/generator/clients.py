"""Writers of the records for programs without C++: yars_records.h in C, and the records of examples/yars.py.

Offsets and sizes of the segment are from `yars status --layout`, the records from the IDL.
"""
import re
import textwrap

from . import comments, schema
from .schema import Record

# Record -> its name in yars_records.h. Records that only YARS itself uses are left out.
C_NAMES = {"ClockState": "yars_clock", "Ownship": "yars_ownship", "Nav": "yars_nav", "InputEvent": "yars_input_event",
           "DrawnPoint": "yars_drawn_point", "NavigatorError": "yars_navigator_error", "Mark": "yars_mark",
           "RadarState": "yars_radar_state", "ModelStatus": "yars_model_status", "Outputs": "yars_outputs",
           "TrafficEntity": "yars_traffic_entity", "Traffic": "yars_traffic", "GlassFrame": "yars_glass_frame",
           "Sweep": "yars_sweep"}
# Record -> its name in yars.py, for the records that yars.py reads or writes as a whole.
PYTHON_NAMES = {"ClockState": "CLOCK", "Ownship": "OWNSHIP", "Nav": "NAV", "InputEvent": "INPUT_EVENT",
                "GlassFrame": "GLASS_FRAME", "Sweep": "SWEEP", "Outputs": "OUTPUTS", "Mark": "MARK"}
STRUCT_CODES = {"double": "d", "float": "f", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
                "uint32": "I", "int64": "q", "uint64": "Q"}
OFFSETS = ["clock", "ownship_priority", "ownship", "nav", "radar_state", "model_status", "outputs", "sweeps", "input",
           "processes", "traffic", "frames"]


def constants_of(chapters):
    return {one.name: one.value for chapter in chapters for one in chapter.declarations if isinstance(one, schema.Constant)}


def segment_numbers(layout, chapters):
    """[(description of a group, {name: number})]: constants other than identity and offsets."""
    parts, locks, constants = layout["containers"], layout["lock_bytes"], constants_of(chapters)
    frames, sweeps = parts["frames"], parts["sweeps"]
    return [
        ("A picture of the display: its slot's id, words and pixels.", {
            "FRAMES": frames["slot_count"], "FRAME_STRIDE": frames["slot_stride"], "FRAME_WORDS": frames["slot_words"],
            "FRAME_PIXELS": frames["slot_pixels"], "MOST_FRAME_BYTES": 4 * constants["kMaxFramePixels"] ** 2}),
        ("The ring of sweeps: its count, then slots of sequence, words used, words.", {
            "SWEEPS": sweeps["slot_count"], "SWEEP_STRIDE": sweeps["slot_stride"], "MOST_SAMPLES": constants["kMaxSamples"]}),
        ("Lock bytes of the file, and how many there are of a kind.", {
            "RADAR_MODEL_BYTE": locks["radar-model"], "STATE_MACHINE_BYTE": locks["state-machine"],
            "TRAFFIC_BYTE": locks["traffic"], "FIRST_OWNSHIP_BYTE": locks["first_ownship_lane"],
            "FIRST_INPUT_BYTE": locks["first_input_lane"], "FIRST_PROCESS_BYTE": locks["first_process"],
            "OWNSHIP_LANES": parts["ownship"]["count"], "INPUT_LANES": parts["input"]["count"],
            "INPUT_DEPTH": parts["input"]["depth"], "PROCESSES": parts["processes"]["count"]}),
    ]


# ---- C
def c_type(field):
    if isinstance(field.type, int):
        return "char"
    return C_NAMES[field.type.name] if isinstance(field.type, Record) else {
        "double": "double", "float": "float"}.get(field.number, f"{field.number}_t")


def c_declaration(field):
    dimensions = "".join(f"[{count}]" for count, _ in field.dimensions)
    dimensions += f"[{field.type + 1}]" if isinstance(field.type, int) else ""
    return f"{c_type(field)} {field.name}{dimensions};"


def c_record(one):
    items = [(" ".join(field.heading), c_declaration(field), schema.about(field)) for field in one.fields]
    text = comments.C.above(" ".join(one.doc)) if one.doc else ""
    return text + "typedef struct {\n" + comments.aligned(items, comments.C, "  ") + f"}} {C_NAMES[one.name]};\n"


def c_header(chapters, layout):
    text = ("/* Records and numbers of the segment, for yars.h, which includes it: layout version, offsets, lock bytes, structures.\n"
            " * Units, ranges and senses stand at the fields; values of enumerations and bits in docs/shared_memory.md#values.\n"
            " * Made by databuffer/messages/generate.py from records.idl and `yars status --layout`: change those, not this. */\n"
            "#ifndef YARS_RECORDS_H\n#define YARS_RECORDS_H\n\n/* clang-format off */\n#include <stdint.h>\n\n"
            "/* What this header was made for. */\n")
    text += (f"#define YARS_LAYOUT_VERSION UINT32_C({layout['version']})\n#define YARS_LAYOUT_SIZE UINT64_C({layout['size']})\n"
             f"#define YARS_LAYOUT_HASH UINT64_C(0x{layout['hash']})\n\n/* Offsets [bytes] from the segment's begin. */\n")
    text += "".join(f"#define YARS_AT_{name.upper()} {layout['offsets'][name]}\n" for name in OFFSETS)
    for about, numbers in segment_numbers(layout, chapters):
        text += "\n" + comments.C.above(about) + "".join(f"#define YARS_{name} {number}\n" for name, number in numbers.items())
    constants = constants_of(chapters)
    text += ("\n/* The greatest id of a picture; the latest base [ns] of the session's clock. */\n"
             f"#define YARS_LATEST_PICTURE_ID UINT64_C({constants['kLatestPictureId']})\n"
             f"#define YARS_LATEST_CLOCK_BASE_NS INT64_C({constants['kLatestClockBase_ns']})\n")
    text += "".join("\n" + c_record(one) for one in schema.records_of(chapters) if one.name in C_NAMES)
    return text + "\n#endif\n"


def c_asserts(chapters):
    """C++ that compares every field of yars_records.h with the C++ records."""
    text = ("// Made by databuffer/messages/generate.py: every structure of yars_records.h lies as its C++ record does.\n"
            "#pragma once\n\n#include <cstddef>\n\n#include \"databuffer/client/yars_records.h\"\n"
            "#include \"databuffer/messages/record_checks.hpp\"\n\nnamespace yars::databuffer {\n")
    for one in schema.records_of(chapters):
        if one.name not in C_NAMES:
            continue
        text += f"\nstatic_assert(sizeof({C_NAMES[one.name]}) == sizeof({one.name}));\n"
        for field in one.fields:
            text += (f"static_assert(offsetof({C_NAMES[one.name]}, {field.name}) == offsetof({one.name}, {field.name}) &&\n"
                     f"              sizeof({C_NAMES[one.name]}::{field.name}) == sizeof({one.name}::{field.name}));\n")
    return text + "\n}  // namespace yars::databuffer\n"


# ---- Python
def python_code(field):
    return STRUCT_CODES[field.number] if field.number and not field.dimensions else f"{field.size}s"


def python_list(name, entries):
    text = f"{name} = [" + ", ".join(entries) + "]"
    # Blanks inside an entry are replaced during the wrap, so that no line break falls into an entry.
    marked = re.sub(r"\([^()]*\)", lambda found: found.group().replace(" ", "\0"), text)
    lines = textwrap.wrap(marked, comments.WIDTH, subsequent_indent=" " * (len(name) + 4), break_on_hyphens=False, break_long_words=False)
    return "\n".join(lines).replace("\0", " ") + "\n"


def packed_record(one):
    entries, rest = [], 0
    for field in one.fields:
        if field.cut:
            continue
        if field.reserved:
            rest += field.size
            continue
        entries += [f'("_reserved", "{rest}s")'] if rest else []
        entries.append(f'("{field.name}", "{python_code(field)}")')
        rest = 0
    return python_list(PYTHON_NAMES[one.name], entries + ([f'("_reserved", "{rest}s")'] if rest else []))


def python_constants(names_and_numbers):
    """Assignments in Python, one line for each group."""
    text = f"{', '.join(name for name, _ in names_and_numbers)} = {', '.join(str(number) for _, number in names_and_numbers)}"
    names, _, numbers = text.partition(" = ")
    return text + "\n" if len(text) <= comments.WIDTH else f"{names} = \\\n    {numbers}\n"


def python_records(chapters, layout):
    """Text for the generated part of yars.py, which lies between two marks."""
    parts, constants = layout["containers"], constants_of(chapters)
    named = {one.name: one for one in schema.records_of(chapters)}
    text = python_constants([("VERSION", layout["version"]), ("SIZE", layout["size"]), ("HASH", f"0x{layout['hash'].upper()}")])
    at = [(f"AT_{name.upper()}", layout["offsets"][name]) for name in OFFSETS]
    text += python_constants(at[:4]) + python_constants(at[4:8]) + python_constants(at[8:])
    for _, numbers in segment_numbers(layout, chapters):
        numbers = list(numbers.items())
        text += "".join(python_constants(numbers[first:first + 5]) for first in range(0, len(numbers), 5))
    text += python_constants([("LATEST_PICTURE_ID", constants["kLatestPictureId"]), ("PROCESS_STRIDE", parts["processes"]["stride"])])
    text += python_constants([("INPUT_STRIDE", parts["input"]["stride"]), ("INPUT_POPPED", parts["input"]["popped"]),
                              ("INPUT_RECORDS", parts["input"]["records"])])
    text += python_constants([("SWEEP_VIDEO_AT", next(f.offset for f in named["Sweep"].fields if f.cut))])
    text += "\n# Records: (name, struct code) in order; names that begin with an underscore are reserved.\n"
    text += "".join(packed_record(named[name]) for name in PYTHON_NAMES)
    state = named["RadarState"]
    text += "# The numbers and texts of the radar state: name, offset, struct code; the legends are of 8 characters each.\n"
    text += python_list("RADAR_STATE", [f'("{field.name}", {field.offset}, "{python_code(field)}")' for field in state.fields
                                        if not field.reserved and not field.dimensions and not isinstance(field.type, Record)])
    legends = next(field for field in state.fields if field.name == "legends")
    return text + python_constants([("RADAR_STATE_SIZE", state.size), ("LEGENDS_AT", legends.offset), ("LEGENDS", legends.entries)])
