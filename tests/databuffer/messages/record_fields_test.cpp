// Tests of the table of records' fields, and of validation against its ranges.
#include "databuffer/messages/record_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "databuffer/messages/validation.hpp"

namespace yars::databuffer {
namespace {

const RecordFields& fields_of(std::string_view record) {
  return *std::ranges::find(record_fields(), record, &RecordFields::record);
}

TEST(RecordFields, AreInOrderAndWithinTheirRecord) {
  for (const RecordFields& record : record_fields()) {
    std::size_t end = 0;
    for (const RecordField& field : record.fields) {
      EXPECT_GE(field.offset, end) << record.record << "." << field.name;
      end = field.offset + field.size;
    }
    EXPECT_LE(end, record.size) << record.record;
  }
}

TEST(RecordFields, GiveOffsetTypeUnitAndRange) {
  const RecordFields& ownship = fields_of("Ownship");
  EXPECT_EQ(ownship.size, 144U);
  const auto field = std::ranges::find(ownship.fields, "altitude_msl_m", &RecordField::name);
  ASSERT_NE(field, ownship.fields.end());
  EXPECT_EQ(field->offset, 24U);
  EXPECT_EQ(field->size, 8U);
  EXPECT_EQ(field->type, "double");
  EXPECT_EQ(field->unit, "m");
  EXPECT_EQ(field->min, -1'000.0);
  EXPECT_EQ(field->max, 200'000.0);
  const auto source = std::ranges::find(ownship.fields, "source", &RecordField::name);
  EXPECT_EQ(source->type, "char[16]");
  EXPECT_EQ(source->max, std::numeric_limits<double>::infinity());
}

TEST(RecordFields, IncludeNoReservedFields) {
  for (const RecordFields& record : record_fields())
    EXPECT_TRUE(
        std::ranges::none_of(record.fields, [](const auto& field) { return field.name.starts_with("reserved"); }));
}

// Fields that validation checks only under a condition, such as a valid cursor. They are not tested here.
const std::set<std::string_view> kConditional{
    "reposition_latitude_deg",      "reposition_longitude_deg",     "reposition_altitude_m", "reposition_heading_deg",
    "cursor_latitude_deg",          "cursor_longitude_deg",         "cursor_bearing_deg",    "cursor_range_nm",
    "cursor_believed_latitude_deg", "cursor_believed_longitude_deg"};

// Expects that validation accepts both ends of each field's range, and refuses the next number beyond each end.
template <class Record>
void expect_ranges_hold(std::string_view name, const Record& good) {
  ASSERT_EQ(validate(good), std::nullopt) << name;
  int checked = 0;
  for (const RecordField& field : fields_of(name).fields) {
    if (field.type != "double" || !std::isfinite(field.min) || kConditional.contains(field.name)) continue;
    const auto refusal_with = [&](double value) {
      Record record = good;
      std::memcpy(reinterpret_cast<char*>(&record) + field.offset, &value, sizeof value);
      return validate(record);
    };
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal_with(field.min), std::nullopt) << name << "." << field.name;
    EXPECT_EQ(refusal_with(field.max), std::nullopt) << name << "." << field.name;
    for (const double beyond : {std::nextafter(field.min, -infinity), std::nextafter(field.max, infinity)})
      EXPECT_TRUE(refusal_with(beyond).value_or("").starts_with(std::string(field.name) + ": expected ["))
          << name << "." << field.name;
    ++checked;
  }
  EXPECT_GT(checked, 0) << name;
}

TEST(RecordFields, HaveTheRangesThatValidationChecks) {
  RadarState state{};
  state.channel = 1;
  PatchMap map{};
  map.size = 1;
  map.window_nm = 1.0;
  expect_ranges_hold("Ownship", Ownship{});
  expect_ranges_hold("Nav", Nav{});
  expect_ranges_hold("ClockState", ClockState{});
  expect_ranges_hold("RadarState", state);
  expect_ranges_hold("ModelStatus", ModelStatus{});
  expect_ranges_hold("Sweep", Sweep{});
  expect_ranges_hold("PatchMap", map);
}

TEST(Validation, WholeNumbersAreComparedExactly) {
  RadarState state{};
  state.channel = 1;
  state.tick = kLatestStateTick;
  EXPECT_EQ(validate(state), std::nullopt);
  ++state.tick;
  EXPECT_EQ(validate(state), "tick: expected [-1, 9007199254740992], found 9007199254740993");
}

TEST(Validation, AFaultInANestedRecordIsNamedWithThatRecord) {
  RadarState state{};
  state.channel = 1;
  state.ins.east_m = 20100001.5;
  EXPECT_EQ(validate(state), "ins.east_m: expected [-20100000, 20100000], found 20100001.5");
  ModelStatus status{};
  status.ownship.heading_deg = 361.0;
  EXPECT_EQ(validate(status), "ownship: heading_deg: expected [0, 360], found 361");
}

}  // namespace
}  // namespace yars::databuffer
