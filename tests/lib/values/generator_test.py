#!/usr/bin/env python3
"""Facts about lib/values/generate.py: what it reads, what it refuses, what it writes, what it finds stale."""
import contextlib
import enum
import io
import json
import pathlib
import re
import struct
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
MESSAGES = ROOT / "lib/values"
sys.path.insert(0, str(MESSAGES))
import generate  # noqa: E402
from generator import clients, cpp, dds, fields, idl, presets, schema, segment, stability  # noqa: E402

GOOD = """// One record.
module yars {
  const uint32 kMost = 4;

  @bit_bound(8)
  enum Gear { Gear_up, Gear_down };  // of the aircraft

  @final
  struct Place {
    @unit("deg") @range(min=-90.0, max=90.0) double latitude_deg;  // WGS84
    // -- What is optional.
    // above mean sea level
    @unit("m") @nan("unknown") double height_m;
    @range(min=0, max=4) uint32 count;
    Gear gear;
    uint8 reserved[3];
    @default(2) uint64 looks;
    string<7> names[kMost];
    @counted_by("count") uint16 marks[kMost];
  };
};
"""


def chapters_of(text):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "records.idl").write_text(text)
        return idl.read(pathlib.Path(folder))


def changed(old, new):
    assert old in GOOD, old
    return GOOD.replace(old, new)


class TheParser(unittest.TestCase):
    def test_reads_types_units_ranges_and_comments(self):
        place = schema.records_of(chapters_of(GOOD))[0]
        latitude, height, count, gear, reserved, looks, names, marks = place.fields
        self.assertEqual((latitude.unit, latitude.minimum.value, latitude.maximum.value, latitude.doc),
                         ("deg", -90.0, 90.0, ["WGS84"]))
        self.assertEqual((height.nan, height.heading, height.doc),
                         ("unknown", ["What is optional."], ["above mean sea level"]))
        self.assertEqual((gear.type.name, gear.size, reserved.reserved, looks.default.value), ("Gear", 1, True, 2))
        self.assertEqual((names.size, schema.type_text(names), marks.counted_by), (32, "char[4][8]", "count"))
        self.assertEqual([field.offset for field in place.fields], [0, 8, 16, 20, 21, 24, 32, 64])
        self.assertEqual((place.size, count.offset), (72, 16))

    def refuses(self, text, message):
        with self.assertRaises(schema.IdlError) as caught:
            chapters_of(text)
        self.assertIn(message, str(caught.exception))
        self.assertRegex(str(caught.exception), r"^[\w.]+:\d+: expected .*, found ")
        self.assertNotIn("\n", str(caught.exception))

    def test_says_what_it_expected_and_found(self):
        self.refuses(changed("uint32 count;", "uint32 count"), "records.idl:15: expected ';', found 'Gear'")
        self.refuses(changed("uint32 count;", "uint count;"),
                     "or the name of an enumeration, bit mask or record, found 'uint'; declare")
        self.refuses(changed("@final\n", ""), "expected @final or @request at Place, found none")
        self.refuses(changed("  @bit_bound(8)\n", ""), "expected @bit_bound(8), (16), (32) or (64), found none")
        self.refuses(changed("Gear_up", "up"), "expected a value named Gear_..., found 'up'")
        self.refuses(changed("@unit(", "@units("), "found @units")
        self.refuses(changed("};\n", "}\n"), "expected ';', found")
        self.refuses(changed("const uint32", "const $"), "records.idl:3: expected IDL, found '$'")
        self.refuses(changed("kMost = 4", "kMost = kLeast"), "found 'kLeast'; declare it above")
        self.refuses('#include "absent.idl"\n',
                     "records.idl:1: expected the name of a file beside records.idl, found 'absent.idl'")

    def test_refuses_names_that_idl_does_not_tell_apart(self):
        self.refuses(changed("struct Place", "struct GEAR"),
                     "expected a new name in module yars, found 'GEAR' beside 'Gear'")
        self.refuses(changed("uint32 count;", "uint32 count, Count;"), "expected one Count in Place, found two")

    def test_refuses_a_range_that_cannot_hold(self):
        self.refuses(changed("min=-90.0, max=90.0", "min=90.0, max=-90.0"),
                     "range of latitude_deg that begins below its end, found [90, -90]")
        self.refuses(changed("min=0, max=4) uint32", "min=-1, max=4) uint32"),
                     "whole number of uint32, 0 to 4294967295, at count, found -1")
        self.refuses(changed("min=0, max=4) uint32", "min=0, max=4.5) uint32"),
                     "whole number of uint32, 0 to 4294967295, at count, found 4.5")
        self.refuses(changed("max=4) uint32", "max=5) uint32"),
                     "expected @range(min=0, max=4), the entries of marks, found [0, 5]")
        self.refuses(changed("string<7> names", "@min(1) string<7> names"), "expected a number type for names")
        self.refuses(changed("@default(2) uint64", "@default(2) @range(min=3, max=4) uint64"),
                     "a default of looks in [3, 4], found 2")
        self.refuses(changed("@range(min=0, max=4)", "@range(min=0)"), "expected @range with max, found min")

    def test_refuses_a_unit_that_the_name_contradicts(self):
        self.refuses(changed('@unit("deg")', '@unit("rad")'),
                     'expected @unit("deg") of latitude_deg, whose name has this unit as suffix, found @unit("rad")')
        self.refuses(changed('@unit("m") @nan', "@nan"),
                     'expected @unit("m") of height_m, whose name has this unit as suffix, found none')
        self.refuses(changed("double height_m", "uint64 height_m"), "expected double or float for @nan of height_m")

    def test_refuses_arrays_of_arrays(self):
        self.refuses(changed("uint16 marks[kMost]", "uint16 marks[2][2]"), "expected one dimension at marks, found 2")

    def test_refuses_padding(self):
        self.refuses(changed("reserved[3]", "reserved[2]"),
                     "Place.looks at a multiple of 8 bytes, found offset 23; put 1 reserved")
        self.refuses(changed('@counted_by("count") uint16', "uint8"),
                     "expected a size of Place that is a multiple of 8 bytes, found 68 bytes")

    def test_refuses_a_count_that_counts_nothing(self):
        self.refuses(changed('counted_by("count")', 'counted_by("number")'),
                     "a whole number with @range named number in Place, found none")
        self.refuses(changed('uint64 looks', '@cut uint64 looks'),
                     "expected @cut on the last field, an array of bytes with @counted_by")


class TheRecordsOfTheTree(unittest.TestCase):
    def setUp(self):
        self.chapters = idl.read(MESSAGES)
        self.records = {one.name: one for one in schema.records_of(self.chapters)}

    def test_come_back_from_c_as_they_went(self):
        header = clients.c_header(self.chapters, layout_of(self.chapters))
        for name, c_name in clients.C_NAMES.items():
            body = re.search(r"typedef struct \{\n((?:(?!typedef).)*?)\} " + c_name + ";", header, re.S).group(1)
            found = re.findall(r"^  ([\w]+) (\w+)((?:\[\d+\])*);", body, re.M)
            expected = [(clients.c_type(field), field.name, schema.type_text(field))
                        for field in self.records[name].fields]
            self.assertEqual([(kind, field) for kind, field, _ in found],
                             [(kind, field) for kind, field, _ in expected])
            for (kind, _, dimensions), (_, _, text) in zip(found, expected):
                self.assertEqual(dimensions, re.sub(r"^\w+", "", text))

    def test_come_back_from_python_as_they_went(self):
        made = {"enum": enum}
        exec(clients.python_records(self.chapters), made)  # what session.py has
        for name, python_name in clients.PYTHON_NAMES.items():
            at, fields = 0, {field.name: field.offset for field in self.records[name].fields}
            for field, code in made[python_name]:
                if field != "_reserved":
                    self.assertEqual(at, fields[field], f"{name}.{field}")
                at += struct.calcsize("<" + code)
            self.assertEqual(at, next((f.offset for f in self.records[name].fields if f.cut), self.records[name].size))

    def test_values_have_the_same_numbers_in_c_and_in_python(self):
        header = clients.c_header(self.chapters, layout_of(self.chapters))
        in_c = {name: int(number, 0) for name, number in re.findall(r"^  (YARS_\w+) = (\w+),?", header, re.M)}
        made = {"enum": enum}
        exec(clients.python_records(self.chapters), made)
        declared = {one.name for chapter in self.chapters for one in chapter.declarations
                    if isinstance(one, (schema.Enumeration, schema.Bitmask))}
        self.assertLessEqual(set(clients.ENUMERATIONS), declared)
        found = {f"YARS_{prefix}_{value.name}": int(value) for prefix, name in clients.ENUMERATIONS.values()
                 for value in made[name].__members__.values()}
        self.assertEqual(found, in_c)
        self.assertEqual((in_c["YARS_EVENT_PUSH_BUTTON"], in_c["YARS_RADAR_FREEZE"], in_c["YARS_MODE_PATCH"]),
                         (1, 2, 2))

    def test_a_default_becomes_an_initialiser(self):
        place = schema.records_of(chapters_of(GOOD))[0]
        self.assertIn("  std::uint64_t looks = 2;\n", cpp.record(place))

    def test_one_end_of_a_range_is_enough(self):
        chapters = chapters_of(changed("@range(min=-90.0, max=90.0) double", "@min(-90.0) double"))
        self.assertIn('inspection.range("latitude_deg", record.latitude_deg, -90.0, kInfinity);',
                      cpp.checks_source(chapters))

    def test_a_text_is_checked_entry_by_entry_and_numbers_as_far_as_they_count(self):
        chapters = chapters_of(changed("uint16 marks", "@max(9) uint16 marks"))
        made = cpp.checks_source(chapters)
        self.assertIn('  for (const auto& entry : record.names) {\n    inspection.text("names", entry);\n  }\n', made)
        self.assertIn('  for (const auto& entry : used(record.marks, record.count)) {\n'
                      '    inspection.at_most("marks", entry, 9);', made)

    def test_a_record_is_validated_by_its_checks_or_by_hand(self):
        self.assertIn("Refusal validate(const Place& record) {\n  Inspection inspection;\n  check_fields(",
                      cpp.checks_source(chapters_of(GOOD)))
        for old, new in (("@final\n  struct Place", "@final @by_hand\n  struct Place"),
                         ("@range(min=-90.0, max=90.0) double", "@range(min=-90.0, max=90.0) @by_hand double")):
            chapters = chapters_of(changed(old, new))
            self.assertNotIn("validate(", cpp.checks_source(chapters))
            self.assertIn("Refusal validate(const Place& record);\n", cpp.checks_header(chapters))

    def test_a_default_of_all_is_zero(self):
        self.assertEqual([field.name for one in self.records.values() for field in one.fields if field.default], [])

    def test_every_range_that_is_not_by_hand_is_checked(self):
        made = cpp.checks_source(self.chapters)
        for one in (one for one in self.records.values() if not one.nested):
            body = re.search(rf"const {one.name}& record\) {{\n(.*?)\n}}\n", made, re.S)
            for field in one.fields:
                if (field.minimum or field.maximum) and not field.by_hand:
                    self.assertIn(f'"{field.name}"', body.group(1))

    def test_are_described_in_words_where_a_name_does_not_say_all(self):
        for one in self.records.values():
            self.assertTrue(one.doc, one.name)


REQUESTS = """module yars {
  @bit_bound(8)
  enum Band { Band_A, Band_B };

  @request @nested
  struct Pose {
    @option("lat") @unit("deg") @range(min=-90.0, max=90.0) @default(37.8) double latitude_deg;  // of the aircraft
  };

  // One look.
  @request
  struct Look : Pose {
    boolean force;  // ignore limits
    @optional @otherwise("the configuration's") @range(min=1, max=16) int32 looks;  // to average
    Band band;  // of the radar
  };

  // Another look.
  @request
  struct Texts {
    @default(TRUE) boolean noise;  // of the receiver
    @default("fine") string preset;  // of the fidelity
    @optional @otherwise("none") sequence<string> scenes;  // on the ground
  };
};
"""


class Requests(unittest.TestCase):
    def test_become_a_struct_and_a_table(self):
        structs, table, _ = fields.files([], chapters_of(REQUESTS)).values()
        self.assertIn("enum class Band : std::uint8_t { A, B };", structs)
        self.assertIn("struct Look {\n  double latitude_deg = 37.8;  // [deg] -90 to 90: of the aircraft\n", structs)
        self.assertIn("bool force = false;", structs)
        self.assertIn("std::optional<int> looks;    // 1 to 16: to average; left out: the configuration's", structs)
        self.assertIn("Band band = Band::A;", structs)
        self.assertIn("bool noise = true;  ", structs)
        self.assertIn('std::string preset = "fine";  ', structs)
        self.assertIn("std::vector<std::string> scenes;  // on the ground; left out: none", structs)
        self.assertNotIn("struct Pose", structs)
        self.assertIn('Field latitude{"latitude_deg", "latitude", "lat", "deg", -90, 90,\n'
                      '      "of the aircraft", "", {}}', table)
        self.assertIn('Field looks{"looks", "looks", "looks", "", 1, 16,\n'
                      '      "to average", "the configuration\'s", {}}', table)
        self.assertIn('"of the radar", "", {"A", "B"}}', table)
        self.assertIn("each(looks, entry.looks);", table)

    def test_that_contradict_themselves_are_refused(self):
        for old, new, message in (('@option("lat")', '@option("looks")',
                                   "expected one option looks in Look, found two"),
                                  (' @otherwise("the configuration\'s")', "",
                                   "expected @optional with @otherwise at looks, found one of them"),
                                  ("boolean force;", "boolean force[2];",
                                   "expected a number, boolean or enumeration for force"),
                                  ("@default(37.8)", "@default(97.8)",
                                   "expected a default of latitude_deg in [-90, 90], found 97.8"),
                                  ("@request\n  struct Look", "@request @final\n  struct Look",
                                   "expected @final or @request at Look, found both"),
                                  (": Pose {", ": Place {", "expected the name of a request, found 'Place'")):
            assert old in REQUESTS, old
            with self.assertRaises(schema.IdlError) as caught:
                chapters_of(REQUESTS.replace(old, new))
            self.assertIn(message, str(caught.exception))
        with self.assertRaises(schema.IdlError) as caught:
            chapters_of(changed("uint32 count;", "boolean count;").replace("@range(min=0, max=4) ", ""))
        self.assertIn("expected a number, a text or a record for count, found boolean", str(caught.exception))


SHOWN = GOOD.replace('@unit("m") @nan("unknown")',
                     '@unit("m") @shown(unit="ft", min=-100.0, max=1000.0, initial=20.0) @nan("unknown")')


class WhatPeopleGive(unittest.TestCase):
    def height(self, note):
        return schema.records_of(chapters_of(changed('@unit("m") @nan', f'@unit("m") {note} @nan')))[0].fields[1]

    def test_has_limits_that_are_rounded_outwards_in_the_record(self):
        field = self.height('@shown(unit="ft", min=0.0, max=1000.0, initial=20.0)')
        self.assertEqual((field.minimum.value, field.maximum.value), (0.0, 305.0))
        self.assertEqual((field.shown_name, field.option, field.stem), ("height_ft", "height-ft", "height"))
        self.assertEqual(field.sentence(), "above mean sea level; 0 to 1000 ft, 20 if not given; NaN = unknown")
        field = self.height('@shown(unit="NM", min=-10.0, max=10.0)')
        self.assertEqual((field.minimum.value, field.maximum.value), (-18521.0, 18521.0))
        field = self.height("@shown(min=0.5, max=2.5)")
        self.assertEqual((field.minimum.value, field.maximum.value, field.shown_name), (0.5, 2.5, "height_m"))

    def test_has_limits_of_whole_numbers_inside_a_range_that_is_given(self):
        field = self.height('@range(min=-100.0, max=100.0) @shown(unit="ft")')
        self.assertEqual((field.minimum.value, field.shown.low, field.shown.high), (-100.0, -328.0, 328.0))

    def test_is_refused_where_it_says_too_little_or_too_much(self):
        for note, message in (('@shown(unit="ft")',
                               "expected @shown with min and max, or @range, at height_m, found unit"),
                              ('@shown(unit="kt", min=0.0, max=1.0)',
                               "a unit of @shown that becomes [m], found [kt]; add it to"),
                              ("@shown(min=0.0, max=1.0, initial=2.0)",
                               "an initial height_m in [0.0, 1.0] m, found 2")):
            with self.assertRaises(schema.IdlError) as caught:
                self.height(note)
            self.assertIn(message, str(caught.exception))

    def test_becomes_fields_defaults_forms_and_keys(self):
        chapters = chapters_of(SHOWN)
        table, defaults = fields.table(chapters), fields.defaults(chapters)
        self.assertIn('Field height{"height_ft", "height", "height-ft", "ft", -100, 1000,\n'
                      '      "above mean sea level", "unknown", {}, 20, 0.3048}', table)
        self.assertIn("struct PlaceDefaults {\n  static constexpr double height_m = 20.0 * (0.3048);\n};", defaults)
        self.assertIn("inline constexpr int kMost = 4;", defaults)
        self.assertIn("  using Values = values::Place;", cpp.record(schema.records_of(chapters)[0]))
        keys = fields.python_values(chapters, [], '_value("a", "Place.height")')
        self.assertIn('"Place.height": (-100, 1000, "ft", "20", "above mean sea level"),', keys)
        self.assertNotIn("Place", fields.python_values(chapters, [], ""))

    def test_in_the_tree_contains_what_was_valid_before(self):
        """The ranges of the records of 0.3."""
        before = {"WorldRainCell.radius_m": (185.0, 185201.0), "WorldRainCell.rate_mmh": (0.1, 300.0),
                  "WorldRainCell.top_m": (152.0, 18289.0), "WorldJammer.altitude_m": (-458.0, 30481.0),
                  "WorldJammer.power_w": (0.0, 1e9), "WorldMover.speed_mps": (0.0, 514.5),
                  "WorldMover.heading_deg": (0.0, 360.0), "WorldMover.cross_section_m2": (0.0, 1e7),
                  "WorldMover.height_m": (0.0, 1000.0), "WorldPoint.elevation_m": (-12000.0, 10000.0),
                  "WorldState.sea_state": (0.0, 6.0), "WorldState.wind_speed_mps": (0.0, 61.8),
                  "WorldState.wind_from_deg": (0.0, 360.0), "TrafficEntity.height_m": (0.0, 1000.0),
                  "TrafficEntity.cross_section_m2": (0.0, 1e7)}
        found = {f"{one.name}.{field.name}": (field.minimum.value, field.maximum.value)
                 for one in schema.records_of(idl.read(MESSAGES)) for field in one.fields if field.shown}
        for name, (low, high) in before.items():
            self.assertTrue(found[name][0] <= low and high <= found[name][1], (name, found[name]))


class TheIdlForDds(unittest.TestCase):
    def test_has_numbers_for_enumerations_and_bytes_for_texts(self):
        text = dds.idl(chapters_of(GOOD))
        self.assertIn("  const uint32 kMost = 4;\n", text)
        self.assertIn("  // Values of Gear.\n  const uint8 Gear_up = 0;    // of the aircraft\n"
                      "  const uint8 Gear_down = 1;", text)
        self.assertIn("    uint8 gear;       // Gear\n", text)
        self.assertIn("    char names[4][8];\n", text)

    def test_keeps_units_ranges_and_meaning_as_comments(self):
        text = dds.idl(chapters_of(GOOD))
        self.assertIn("    double latitude_deg;  // [deg] [-90, 90] WGS84\n", text)
        self.assertIn("    // What is optional.\n    double height_m;  // [m] above mean sea level; NaN = unknown\n",
                      text)
        self.assertIn("    uint16 marks[4];  // the first `count` are in use\n", text)
        self.assertNotIn("@unit", text)

    def test_numbers_the_bits_of_a_mask(self):
        text = dds.idl(chapters_of(GOOD.replace("enum Gear { Gear_up, Gear_down };",
                                                "bitmask Gear { @position(0) kUp, @position(3) kDown };")))
        self.assertIn("  // Bits of Gear.\n  const uint8 kUp = 1;    // of the aircraft\n  const uint8 kDown = 8;",
                      text)

    def test_has_the_head_of_a_record_whose_last_array_is_cut(self):
        text = dds.idl(chapters_of(changed('@counted_by("count") uint16 marks',
                                           'uint32 reserved1; @counted_by("count") @cut uint8 marks')))
        head = text.split("struct PlaceHeader {")[1]
        self.assertIn("char names[4][8];", head)
        self.assertNotIn("marks", head)

    def test_opens_and_closes_modules(self):
        text = dds.idl(chapters_of(GOOD + "module yars { module radar { const int32 kOne = 1; }; };\n"))
        self.assertTrue(text.endswith("\n  module radar {\n    const int32 kOne = 1;\n  };\n};\n"), text)

    def test_is_compared_with_the_records_field_by_field(self):
        text = dds.asserts(chapters_of(GOOD))
        self.assertIn("sizeof(yars_Place) == sizeof(Place)", text)
        self.assertEqual(text.count("static_assert(offsetof("), 8)


def layout_of(chapters):
    """A made-up answer of `yars status --layout` with the records of these chapters."""
    numbers = dict.fromkeys(("count", "stride", "depth", "popped", "records", "slot_count", "slot_stride", "slot_words",
                             "slot_pixels"), 8)
    names = clients.OFFSETS
    return {"version": 3, "size": 4096, "hash": "0123456789abcdef", "offsets": {name: 64 for name in names},
            "containers": {name: {"kind": "LatestValue", "record": "X", **numbers} for name in names},
            "lock_bytes": dict.fromkeys(("radar-model", "state-machine", "traffic", "tour", "first_ownship_lane",
                                         "first_input_lane", "first_process"), 1),
            "records": {one.name: {"size": one.size,
                                   "fields": {field.name: [field.offset, field.size] for field in one.fields
                                              if not field.reserved}}
                        for one in schema.records_of(chapters)}}


class TheFilesOfTheTree(unittest.TestCase):
    def setUp(self):
        self.chapters = idl.read(MESSAGES)
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        for name in (generate.PYTHON, generate.HEADER, generate.LAYOUT, generate.KEYS, generate.PAGES):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        self.names = presets.names(generate.preset_kinds())
        for name in (*presets.LISTS, presets.PAGE, segment.PAGE):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(", ".join(self.names))
        (self.root / presets.PAGE).write_text(page_of(self.names))
        (self.root / segment.PAGE).write_text(segment.TABLE + segment.END)
        (self.root / generate.COMMANDS).write_text(f"<!-- {generate.BEGIN[2:-1]} -->\n<!-- {generate.END[2:-1]} -->\n")
        (self.root / generate.KEYS).write_text(f"{generate.BEGIN}{generate.END}# {', '.join(self.names)}\n")
        (self.root / generate.PYTHON).write_text(f"before\n{generate.BEGIN}{generate.END}after\n")
        for file, names in generate.STUBS.items():
            (self.root / file).write_text(f"# {', '.join(self.names)}\n" + "".join(
                f"        # begin: lib/values/generate.py, {name}\n        # end: {name}\n" for name in names))
        self.program = self.root / "yars"
        self.tell(layout_of(self.chapters))
        self.tree, generate.ROOT = generate.ROOT, self.root
        self.addCleanup(setattr, generate, "ROOT", self.tree)

    def tell(self, layout):
        self.program.write_text(f"#!/bin/sh\ncat <<'END'\n{json.dumps(layout)}\nEND\n")
        self.program.chmod(0o755)

    def run_with(self, option):
        with contextlib.redirect_stdout(io.StringIO()):
            generate.main([option, str(self.program)])

    def refuses(self, kind, message):
        with self.assertRaises(kind) as caught:
            self.run_with("--check")
        self.assertIn(message, str(caught.exception))

    def test_are_written_and_then_found_fresh(self):
        self.refuses(generate.StaleError,
                     "python/yars/results.pyi, python/yars/places.pyi, python/yars/dataset/keys.py, docs/commands.md, "
                     "station/web/src/values.ts, docs/shared_memory.md: expected what the IDL says, found otherwise; "
                     "run lib/values/generate.py --write")
        self.run_with("--write")
        self.run_with("--check")
        text = (self.root / generate.PYTHON).read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("after\n"))

    def test_are_found_stale_one_by_one(self):
        for name in (generate.HEADER, generate.PYTHON, generate.LAYOUT):
            self.run_with("--write")
            path = self.root / name
            path.write_text(path.read_text().replace("latitude_deg", "latitude_rad"))
            with self.assertRaises((generate.StaleError, stability.MovedError)) as caught:
                self.run_with("--check")
            self.assertIn("latitude_rad" if name == generate.LAYOUT else f"{name}: expected", str(caught.exception))
            path.write_text(path.read_text().replace("latitude_rad", "latitude_deg"))

    def test_hold_the_layout_that_the_tables_are_made_of(self):
        self.run_with("--write")
        page = self.root / "made/records.md"
        generate.main(["--tables", str(page)])
        text = page.read_text()
        self.assertIn("Layout version 3, 4096 bytes, hash `0123456789abcdef`.\n", text)
        self.assertIn("| 64 | `clock` | LatestValue | X | 8 of 8 bytes; ", text)
        self.assertRegex(text, r"\n## Nav: \d+ bytes\n")
        self.assertIn("\n## Values\n", text)

    def test_need_their_marks(self):
        (self.root / generate.PYTHON).write_text("nothing\n")
        self.refuses(generate.StaleError,
                     "python/yars/session.py: expected the lines '# begin: lib/values/generate.py'")

    def test_need_a_measurement_of_each_preset(self):
        (self.root / presets.PAGE).write_text(page_of(self.names[:-1]))
        self.refuses(generate.StaleError, f"docs/performance.md: expected a row of the preset '{self.names[-1]}'")

    def test_need_their_lists_of_presets(self):
        (self.root / "config/apg70nd.guf").write_text("draft, fine\n")
        self.refuses(generate.StaleError, "config/apg70nd.guf: expected a list of the presets " + ', '.join(self.names))

    def test_hold_all_presets_in_their_lists(self):
        name = "scripts/starting/options.py"
        self.run_with("--write")
        (self.root / name).write_text(", ".join(self.names[1:]))
        self.refuses(generate.StaleError, f"{name}: expected what the IDL says")
        self.run_with("--write")
        self.assertEqual((self.root / name).read_text(), ", ".join(self.names))

    def test_need_a_program_of_the_same_records(self):
        layout = layout_of(self.chapters)
        layout["records"]["Nav"]["fields"]["flags"] = [0, 4]
        self.tell(layout)
        self.refuses(generate.StaleError, "expected the Nav of values/records.idl, found another; build it anew")
        self.program.write_text("#!/bin/sh\nexit 1\n")
        self.refuses(generate.StaleError, "to print the layout, found:")


PRESETS = """module yars {
  @bit_bound(8)
  enum Preset {
    @different_picture Preset_1984,
    @cost(1.0) @wrong_shadow(0.02) Preset_plain,  // the default
    // with all
    // effects
    @cost(2.5) @wrong_shadow(0.01) @parameters("samples=9 "
                                               "earth=flat")
    Preset_full,
    @cost(1.0) @wrong_shadow(0.01) @like("full") @parameters("samples=8") Preset_fast
  };
};
"""


def page_of(names):
    """docs/performance.md with a row of each preset."""
    return ("# Speed\n\n## Speed against accuracy\nEach\n\n| point | ms a scan | shadow % | power dB | gray |\n" +
            "| --- | --- | --- | --- | --- |\n" +
            "".join(f"| {name} | 0.70 / 1.01 @3 | 7.15 / 19.5 @3 | 0 | 136 / 182 @1 |\n" for name in names) + "\nend\n")


class Presets(unittest.TestCase):
    def setUp(self):
        self.kinds = chapters_of(PRESETS)[-1].declarations[0]

    def test_become_constants(self):
        made = presets.header(self.kinds)
        self.assertIn('std::array<std::string_view, 4> kPresets{{\n    "1984",\n    "plain",  // the default\n'
                      '    "full",   // with all effects\n    "fast",\n}};', made)
        self.assertIn('std::array<ComparablePreset, 3> kComparablePresets{{\n    {"plain", 1, 0.02},\n'
                      '    {"full", 2.5, 0.01},\n    {"fast", 1, 0.01},\n}};', made)

    def test_need_their_numbers(self):
        text = PRESETS.replace("@wrong_shadow(0.02)", "")
        with self.assertRaisesRegex(schema.IdlError, "@wrong_shadow at Preset_plain"):
            presets.header(chapters_of(text)[-1].declarations[0])

    def test_set_their_parameters_and_those_of_the_one_that_they_are_like(self):
        self.assertIn('  if (preset == "full") {\n    fidelity.samples = 9;\n'
                      '    fidelity.earth = decltype(fidelity.earth)::flat;\n  }\n  if (preset == "fast") {\n'
                      '    fidelity.samples = 8;\n    fidelity.earth = decltype(fidelity.earth)::flat;\n  }\n}\n',
                      presets.setter(self.kinds))

    def test_become_a_table_of_the_pages(self):
        made = presets.typescript(self.kinds, page_of(["1984", "plain", "full", "fast"]))
        self.assertIn('  "1984": { gray: null, power_db: null, shadow_percent: 7.15, scan_ms: 0.7 },\n'
                      '  "plain": { gray: 136, power_db: 0, shadow_percent: 7.15, scan_ms: 0.7 },\n', made)

    def test_stand_in_lists_that_keep_their_quotes_and_what_is_around_them(self):
        known = ["draft", "coarse", "fine", "exact"]
        for old, new in (('("draft", "fine", "exact")', '("draft", "coarse", "fine", "exact")'),
                         ("preset: draft, fine or exact; else", "preset: draft, coarse, fine or exact; else"),
                         ("one of draft, fine, exact, found 'fast'", "one of draft, coarse, fine, exact, found 'fast'"),
                         ("fine, exact, coarse", "draft, coarse, fine, exact"),
                         ("draft, old, fine, exact", "draft, coarse, fine, exact"),
                         ("draft or fine", "draft or fine"), ("a, b, c", "a, b, c")):
            self.assertEqual(presets.listed(old, known), new)
        self.assertFalse(presets.has_list("draft or fine", known))


SEGMENT = GOOD + """module yars {
  @segment
  struct Layout {
    @writer("everybody") Counters counters[kRoles];
    @writer("model") @status("place") latest<Place> place;  // of the aircraft
    @reserve @writer("model") ring<Place, 16> places;
  };
};
"""


class ASegment(unittest.TestCase):
    def setUp(self):
        text = SEGMENT.replace('@unit("deg")', '@status @unit("deg")', 1)
        self.segment = chapters_of(text)[-1].declarations[-1]

    def test_becomes_a_struct_and_a_visitor(self):
        made = segment.containers_header(self.segment)
        self.assertIn("struct Layout {\n  shm::SegmentHeader header;\n  std::array<Counters, kRoles> counters;\n"
                      "  shm::LatestValue<Place> place;  // of the aircraft\n  shm::BroadcastRing<Place, 16> places;\n",
                      made)
        self.assertIn('visit(Container{"place", "Place", "place", "model",\n', made)
        reserve = made.partition("kReserveEnd")[2].partition(";")[0]
        self.assertIn("LatestValue", reserve)
        self.assertNotIn("BroadcastRing", reserve)

    def test_becomes_fields_of_the_status(self):
        made = segment.status_header(self.segment)
        self.assertIn('shown_fields(const Place& record) {\n  return {\n'
                      '      {"latitude_deg", "latitude", "deg", record.latitude_deg},\n  };\n', made)

    def test_becomes_a_table_of_writers(self):
        self.assertEqual(segment.writers(self.segment), "| `counters` | everybody |  |\n"
                         "| `place`, `places` | model | `place`: {`latitude_deg`} |\n")

    def test_has_numbers_and_texts_in_the_status(self):
        with self.assertRaisesRegex(schema.IdlError, "@status at a number or a text, not at names"):
            segment.status_header(chapters_of(SEGMENT.replace("string<7> names", "@status string<7> names"))[-1]
                                  .declarations[-1])

    def test_needs_a_writer_and_a_depth(self):
        for old, new in (('@writer("everybody") ', ""), ("ring<Place, 16>", "ring<Place>"),
                         ("latest<Place>", "latest<Place, 2>"), ("latest<Place>", "latest"),
                         ("latest<Place>", "Ring<Place, 2>")):
            with self.assertRaisesRegex(schema.IdlError, "expected @writer, and latest<RECORD>", msg=new):
                chapters_of(SEGMENT.replace(old, new))


class ALayout(unittest.TestCase):
    def text(self, text=GOOD, digits="0123456789abcdef"):
        chapters = chapters_of(text)
        return stability.text(chapters, {**layout_of(chapters), "hash": digits})

    def test_with_its_hash_keeps_its_fields(self):
        moved = self.text(changed("    Gear gear;\n    uint8 reserved[3];\n",
                                  "    uint8 reserved[3];\n    Gear gear;\n"))
        with self.assertRaises(stability.MovedError) as caught:
            stability.check(self.text(), moved)
        self.assertIn("Place.gear: expected offset 20, 1 bytes, uint8, as in the layout of the same hash, found offset "
                      "23, 1 bytes, uint8; raise the record's version", str(caught.exception))
        with self.assertRaises(stability.MovedError):
            stability.check(self.text(), self.text(changed("uint64 looks", "int64 looks")))
        with self.assertRaises(stability.MovedError):
            stability.check(self.text(), self.text(changed("    Gear gear;\n", "    uint8 reserved2;\n")))

    def test_with_another_hash_is_another(self):
        stability.check(self.text(), self.text(changed("uint64 looks", "int64 looks"), "fedcba9876543210"))

    def test_grows_into_reserved_bytes(self):
        stability.check(self.text(), self.text(changed("uint8 reserved[3];", "uint8 flaps;\n    uint8 reserved[2];")))


if __name__ == "__main__":
    unittest.main()
