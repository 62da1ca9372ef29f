"""Writers of the records for programs: yars_records.h in C, and the records of python/yars/session.py.

Offsets and sizes of the segment, for C alone, are from `yars status --layout`, the records from the IDL.
"""
import re
import textwrap

from . import comments, schema
from .schema import Bitmask, Enumeration, Record

# Record -> its name in yars_records.h. Records that only YARS itself uses are left out.
C_NAMES = {"ClockState": "yars_clock", "Ownship": "yars_ownship", "Nav": "yars_nav", "InputEvent": "yars_input_event",
           "DrawnPoint": "yars_drawn_point", "NavigatorError": "yars_navigator_error", "Mark": "yars_mark",
           "RadarState": "yars_radar_state", "ModelStatus": "yars_model_status", "Outputs": "yars_outputs",
           "TrafficEntity": "yars_traffic_entity", "Traffic": "yars_traffic", "GlassFrame": "yars_glass_frame",
           "Sweep": "yars_sweep", "CaptionLine": "yars_caption_line", "Caption": "yars_caption"}
# Enumeration -> prefix of its values in yars_records.h, and name of its class in session.py.
ENUMERATIONS = {"EventKind": ("EVENT", "Event"), "Power": ("POWER", "Power"), "Mode": ("MODE", "Mode"),
                "Master": ("MASTER", "Master"), "ScanWidth": ("SCAN", "ScanWidth"),
                "CursorFunction": ("CURSOR", "CursorFunction"), "Navigator": ("NAVIGATOR", "Navigator"),
                "PointKind": ("POINT", "PointKind"), "Recall": ("RECALL", "Recall"),
                "SteeringLine": ("STEERING_LINE", "SteeringLine"), "SteeringCommand": ("STEERING", "SteeringCommand"),
                "RadarFlags": ("RADAR", "RadarFlags"), "SweepFlags": ("SWEEP", "SweepFlags"),
                "ModelFlags": ("MODEL", "ModelFlags"), "OwnshipFlags": ("OWNSHIP", "OwnshipFlags"),
                "NavFlags": ("NAV", "NavFlags")}
# Record -> its name in session.py, for the records that session.py reads or writes as a whole.
PYTHON_NAMES = {"ClockState": "CLOCK", "Ownship": "OWNSHIP", "Nav": "NAV", "InputEvent": "INPUT_EVENT",
                "GlassFrame": "GLASS_FRAME", "Sweep": "SWEEP", "Outputs": "OUTPUTS", "Mark": "MARK",
                "CaptionLine": "CAPTION_LINE", "Caption": "CAPTION"}
STRUCT_CODES = {"double": "d", "float": "f", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
                "uint32": "I", "int64": "q", "uint64": "Q"}
PYTHON_COMMENTS = comments.Style("  ", "# ", "", "# ", "# ")
OFFSETS = ["clock", "ownship_priority", "ownship", "nav", "radar_state", "model_status", "outputs", "sweeps", "input",
           "processes", "traffic", "frames", "caption"]


def constants_of(chapters):
    return {one.name: one.value for chapter in chapters for one in chapter.declarations
            if isinstance(one, schema.Constant)}


def segment_numbers(layout, chapters):
    """[(description of a group, {name: number})]: constants other than identity and offsets."""
    parts, locks, constants = layout["containers"], layout["lock_bytes"], constants_of(chapters)
    frames, sweeps = parts["frames"], parts["sweeps"]
    return [
        ("Pictures of the display: number of slots, distance of slots [bytes]. Offsets in a slot [bytes]: WORDS of the "
         "record yars_glass_frame, PIXELS of the pixels; the id is at offset 0. MOST: maximum size of the pixels.", {
            "FRAMES": frames["slot_count"], "FRAME_STRIDE": frames["slot_stride"], "FRAME_WORDS": frames["slot_words"],
            "FRAME_PIXELS": frames["slot_pixels"], "MOST_FRAME_BYTES": 4 * constants["kMaxFramePixels"] ** 2}),
        ("The ring of sweeps: number of slots, distance of slots [bytes], maximum number of samples of a sweep.", {
            "SWEEPS": sweeps["slot_count"], "SWEEP_STRIDE": sweeps["slot_stride"],
            "MOST_SAMPLES": constants["kMaxSamples"]}),
        ("Lock bytes of the file, and how many there are of a kind.", {
            "RADAR_MODEL_BYTE": locks["radar-model"], "STATE_MACHINE_BYTE": locks["state-machine"],
            "TRAFFIC_BYTE": locks["traffic"], "TOUR_BYTE": locks["tour"],
            "FIRST_OWNSHIP_BYTE": locks["first_ownship_lane"],
            "FIRST_INPUT_BYTE": locks["first_input_lane"], "FIRST_PROCESS_BYTE": locks["first_process"],
            "OWNSHIP_LANES": parts["ownship"]["count"], "INPUT_LANES": parts["input"]["count"],
            "PROCESSES": parts["processes"]["count"]}),
        ("Number of events that an input lane holds.", {"INPUT_DEPTH": parts["input"]["depth"]}),
    ]


def values_of(one):
    """Values of an enumeration or bit mask: [(name in upper case without its prefix, number, C++ name, doc)]."""
    if isinstance(one, Enumeration):
        return [(name.upper(), number, f"{one.scoped}::{name}", doc) for number, (name, doc) in enumerate(one.values)]
    prefix = ENUMERATIONS[one.name][0]
    values = []
    for name, position, doc in one.flags:
        words = re.sub(r"(?<=.)([A-Z])", r"_\1", name.removeprefix("k")).upper()
        values.append((words.removeprefix(prefix + "_"), 1 << position, name, doc))
    return values


def in_client(text, spell):
    """Text with the names of C++ enumerations, radar::Mode, as a client's: `spell` of the entry in ENUMERATIONS."""
    return re.sub(r"\bradar::(\w+)", lambda found: spell(ENUMERATIONS[found.group(1)]), text)


def enumerations_of(chapters):
    named = {one.name: one for chapter in chapters for one in chapter.declarations
             if isinstance(one, (Enumeration, Bitmask))}
    return [named[name] for name in ENUMERATIONS if name in named]


# ---- C
def c_enumeration(one):
    prefix = ENUMERATIONS[one.name][0]
    values = values_of(one)
    shown = (lambda number: f"0x{number:X}") if isinstance(one, Bitmask) else str
    items = [([], f"YARS_{prefix}_{name} = {shown(number)}" + ("," if at + 1 < len(values) else ""),
              in_client(" ".join(doc), lambda names: f"YARS_{names[0]}_..."))
             for at, (name, number, _, doc) in enumerate(values)]
    about = " ".join(one.doc) or ("Bits of " if isinstance(one, Bitmask) else "Values of ") + one.name + "."
    return comments.C.above(about) + "enum {\n" + comments.aligned(items, comments.C, "  ") + "};\n"


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
    text = ("/* Records and numbers of the segment, for yars.h and yars_client.h: layout version, offsets, "
            "lock bytes, structures.\n"
            " * Comments of fields give unit, range and sense. docs/shared_memory.md#records says where "
            "all values and bits are.\n"
            " * Generated by lib/values/generate.py from records.idl and `yars status --layout`. Do not edit. */\n"
            "#ifndef YARS_RECORDS_H\n#define YARS_RECORDS_H\n\n/* clang-format off */\n#include <stdint.h>\n\n"
            "/* What this header was made for. */\n")
    text += (f"#define YARS_LAYOUT_VERSION UINT32_C({layout['version']})\n"
             f"#define YARS_LAYOUT_SIZE UINT64_C({layout['size']})\n"
             f"#define YARS_LAYOUT_HASH UINT64_C(0x{layout['hash']})\n\n"
             "/* Offsets [bytes] from the segment's begin. */\n")
    text += "".join(f"#define YARS_AT_{name.upper()} {layout['offsets'][name]}\n" for name in OFFSETS)
    for about, numbers in segment_numbers(layout, chapters):
        text += "\n" + comments.C.above(about) + "".join(f"#define YARS_{name} {number}\n"
                                                         for name, number in numbers.items())
    constants = constants_of(chapters)
    text += ("\n/* The greatest id of a picture; the latest base [ns] of the session's clock. */\n"
             f"#define YARS_LATEST_PICTURE_ID UINT64_C({constants['kLatestPictureId']})\n"
             f"#define YARS_LATEST_CLOCK_BASE_NS INT64_C({constants['kLatestClockBase_ns']})\n")
    text += "".join("\n" + c_enumeration(one) for one in enumerations_of(chapters))
    text += "".join("\n" + c_record(one) for one in schema.records_of(chapters) if one.name in C_NAMES)
    return text + "\n#endif\n"


def c_asserts(chapters):
    """C++ that compares every field of yars_records.h with the C++ records."""
    text = ("// Generated by lib/values/generate.py: each structure of yars_records.h has "
            "the layout of its C++ record.\n"
            "#pragma once\n\n#include <cstddef>\n\n#include \"databuffer/client/yars_records.h\"\n"
            "#include \"databuffer/messages/record_checks.hpp\"\n\nnamespace yars::databuffer {\n")
    for one in schema.records_of(chapters):
        if one.name not in C_NAMES:
            continue
        text += f"\nstatic_assert(sizeof({C_NAMES[one.name]}) == sizeof({one.name}));\n"
        for field in one.fields:
            text += (f"static_assert(offsetof({C_NAMES[one.name]}, {field.name}) == "
                     f"offsetof({one.name}, {field.name}) &&\n"
                     f"              sizeof({C_NAMES[one.name]}::{field.name}) == sizeof({one.name}::{field.name}));\n")
    for one in enumerations_of(chapters):
        text += "\n"
        for name, _, original, _ in values_of(one):
            text += f"static_assert(YARS_{ENUMERATIONS[one.name][0]}_{name} == static_cast<int>({original}));\n"
    return text + "\n}  // namespace yars::databuffer\n"


# ---- Python
def python_enumeration(one):
    kind = "IntFlag" if isinstance(one, Bitmask) else "IntEnum"
    text = f"\n\nclass {ENUMERATIONS[one.name][1]}(enum.{kind}):\n"
    if one.doc:
        text += textwrap.fill('"""' + " ".join(one.doc) + '"""', comments.WIDTH, initial_indent="    ",
                              subsequent_indent="    ") + "\n\n"
    items = [([], f"{name} = {number}", in_client(" ".join(doc), lambda names: names[1]))
             for name, number, _, doc in values_of(one)]
    return text + comments.aligned(items, PYTHON_COMMENTS, "    ")


def python_code(field):
    return STRUCT_CODES[field.number] if field.number and not field.dimensions else f"{field.size}s"


def python_list(name, entries):
    text = f"{name} = [" + ", ".join(entries) + "]"
    # Blanks inside an entry are replaced during the wrap, so that no line break falls into an entry.
    marked = re.sub(r"\([^()]*\)", lambda found: found.group().replace(" ", "\0"), text)
    lines = textwrap.wrap(marked, comments.WIDTH, subsequent_indent=" " * (len(name) + 4), break_on_hyphens=False,
                          break_long_words=False)
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
    """Python assignment of all numbers to their names, on one line or, if that is too long, on two."""
    text = (f"{', '.join(name for name, _ in names_and_numbers)} = "
            f"{', '.join(str(number) for _, number in names_and_numbers)}")
    names, _, numbers = text.partition(" = ")
    return text + "\n" if len(text) <= comments.WIDTH else f"{names} = \\\n    {numbers}\n"


def python_records(chapters):
    """Text for the generated part of session.py, which lies between two marks."""
    named = {one.name: one for one in schema.records_of(chapters)}
    text = python_constants([("SWEEP_VIDEO_AT", next(f.offset for f in named["Sweep"].fields if f.cut)),
                             ("MOST_SAMPLES", constants_of(chapters)["kMaxSamples"])])
    text += "\n# Records: (name, struct code) in order; names that begin with an underscore are reserved.\n"
    text += "".join(packed_record(named[name]) for name in PYTHON_NAMES)
    text += "# Limits of numbers that programs publish: name, least, greatest, whether NaN stands for no value.\n"
    text += "".join(python_list(f"{PYTHON_NAMES[name]}_LIMITS", [
        f'("{field.name}", {schema.shown(field.minimum.value)}, {schema.shown(field.maximum.value)}, '
        f'{field.nan is not None})'
        for field in named[name].fields if field.minimum and field.maximum]) for name in ("Ownship", "Nav"))
    state = named["RadarState"]
    text += ("# The numbers and texts of the radar state: name, offset, struct code; the legends are of 8 characters "
             "each.\n")
    text += python_list("RADAR_STATE",
                        [f'("{field.name}", {field.offset}, "{python_code(field)}")' for field in state.fields
                         if not field.reserved and not field.dimensions and not isinstance(field.type, Record)])
    classes = "".join(python_enumeration(one) for one in enumerations_of(chapters))
    legends = next(field for field in state.fields if field.name == "legends")
    return text + python_constants([("RADAR_STATE_SIZE", state.size), ("LEGENDS_AT", legends.offset),
                                    ("LEGENDS", legends.entries)]) + classes
