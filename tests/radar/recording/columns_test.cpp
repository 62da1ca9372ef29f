// Columnar coding: records decode to the same bytes, regular values give few bytes, and damaged input is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include "radar/recording/block.hpp"

namespace yars::recording {
namespace {

using Bytes = std::vector<std::byte>;

Bytes coded(const Bytes& records, std::size_t record_bytes) {
  Bytes bytes;
  encode_columns(records, record_bytes, bytes);
  return bytes;
}

// Records of one double each: value(0), value(1), ...
Bytes doubles(int count, double (*value)(int)) {
  Bytes records(static_cast<std::size_t>(count) * sizeof(double));
  for (int i = 0; i < count; ++i) {
    const double number = value(i);
    std::memcpy(records.data() + static_cast<std::size_t>(i) * sizeof number, &number, sizeof number);
  }
  return records;
}

TEST(Columns, DecodeToTheSameRecordsOfAnySizeAndCount) {
  std::mt19937_64 random(7);
  for (std::size_t record_bytes = 1; record_bytes <= 40; ++record_bytes)
    for (std::size_t count = 0; count <= 9; ++count) {
      SCOPED_TRACE(std::to_string(count) + " of " + std::to_string(record_bytes));
      Bytes records(count * record_bytes);
      for (auto& byte : records) byte = random() % 3 == 0 ? std::byte{0} : static_cast<std::byte>(random());
      Bytes again{std::byte{42}};
      ASSERT_TRUE(decode_columns(coded(records, record_bytes), count, record_bytes, again));
      ASSERT_EQ(again.size(), 1 + records.size());
      EXPECT_TRUE(std::equal(records.begin(), records.end(), again.begin() + 1)) << "appended to the existing byte";
    }
}

TEST(Columns, OfEqualRecordsTakeOneRecordAndTwoBytesPerColumn) {
  EXPECT_EQ(coded(Bytes(1000 * 24, std::byte{0xa5}), 24).size(), 24U + 3 * 2);
}

// Number of bytes that are not zero. Zstandard compresses zero bytes well.
std::ptrdiff_t bytes_not_zero(const Bytes& bytes) {
  return std::count_if(bytes.begin(), bytes.end(), [](std::byte byte) { return byte != std::byte{0}; });
}

TEST(Columns, OfAStraightLineTakeOneByteAValue) {
  const Bytes records = doubles(1000, [](int i) { return 37.0 + 1e-5 * i; });
  EXPECT_LT(bytes_not_zero(coded(records, sizeof(double))), 1020) << "1000 values";
}

TEST(Columns, OfAParabolaTakeOneByteAValue) {
  const Bytes records = doubles(1000, [](int i) { return 37.0 + 1e-5 * i + 1e-9 * i * i; });
  EXPECT_LT(bytes_not_zero(coded(records, sizeof(double))), 1020);
}

TEST(Columns, RefuseAWrongLengthCountOrOrder) {
  const Bytes records = doubles(20, [](int i) { return std::sin(i); });
  const Bytes whole = coded(records, sizeof(double));
  Bytes out;
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(decode_columns(std::span(whole).first(length), 20, sizeof(double), out)) << length;
  EXPECT_FALSE(decode_columns(whole, 19, sizeof(double), out));
  EXPECT_FALSE(decode_columns(whole, 21, sizeof(double), out));
  EXPECT_FALSE(decode_columns(whole, 0, sizeof(double), out));
  for (const int order : {0, 4, 255}) {
    Bytes other = whole;
    other[sizeof(double)] = static_cast<std::byte>(order);
    EXPECT_FALSE(decode_columns(other, 20, sizeof(double), out)) << order;
  }
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace yars::recording
