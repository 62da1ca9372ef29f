// Any bytes as an HGT file: a cell with the elevations of the file, void where these are impossible, or an error if the
// length is not that of a cell. The input modifies a file of 1201 x 1201 zeros. Its first two bytes may shorten or
// lengthen the file.
#include "lib/error/error.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "tests/fuzz/pieces.hpp"

using namespace yars::model::terrain;

namespace {

constexpr std::size_t kSide = 1201;  // [posts] along an edge
constexpr std::size_t kBytes = 2 * kSide * kSide;

// Decodes single posts by the definition of the format, and compares.
void require_same(const Cell& cell, const std::vector<std::byte>& file) {
  YARS_REQUIRE(cell.rows(), ==, static_cast<int>(kSide));
  YARS_REQUIRE(cell.columns(), ==, static_cast<int>(kSide));
  constexpr std::size_t kStride = 97;  // [posts] between the compared posts; no divisor of kSide
  for (std::size_t post = 0; post < kSide * kSide; post += kStride) {
    const auto high = std::to_integer<unsigned>(file[2 * post]), low = std::to_integer<unsigned>(file[2 * post + 1]);
    const auto height_m = static_cast<std::int16_t>(high << 8U | low);
    const bool possible = height_m >= -12'000 && height_m <= 10'000 && height_m != -9'999;
    const auto row = static_cast<int>(kSide - 1 - post / kSide), column = static_cast<int>(post % kSide);
    YARS_REQUIRE(cell.post(row, column), ==, possible ? height_m : kVoidPost);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static std::vector<std::byte> file(kBytes);
  if (size < 2) return 0;
  const std::span<const std::uint8_t> input(data + 2, size - 2);
  file.resize(kBytes);
  yars::fuzz::lay_pieces(file, input, 45);
  if (data[0] % 8 == 0) file.resize(kBytes - data[1] * std::size_t{11'000});
  if (data[0] % 8 == 1) file.resize(kBytes + data[1]);
  const auto reading = parse_hgt(file, "fuzz", {36, -122});
  YARS_REQUIRE(reading.has_value(), ==, file.size() == kBytes);
  if (reading) require_same(reading->cell, file);
  // Reset the modified bytes to zero.
  file.resize(kBytes);
  std::vector<std::uint8_t> zeros(input.begin(), input.end());
  for (std::size_t at = 0; at + 3 <= zeros.size();) {
    const std::size_t length = std::min<std::size_t>(zeros[at + 2], zeros.size() - at - 3);
    std::fill_n(zeros.begin() + static_cast<std::ptrdiff_t>(at) + 3, length, std::uint8_t{0});
    at += 3 + length;
  }
  yars::fuzz::lay_pieces(file, zeros, 45);
  return 0;
}
