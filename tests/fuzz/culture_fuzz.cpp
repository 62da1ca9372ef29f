// Any bytes as a culture map (an indexed PNG): covers in range, or an error. A map that was read is written and read
// again, with equal covers. The input modifies a well-formed PNG. Its first byte decides whether the checksums of
// the chunks are corrected (seven values of eight), and whether the file is cut (values from 224).
#include <zlib.h>

#include <string_view>

#include "lib/error/error.hpp"
#include "lib/imageio/png.hpp"
#include "model/terrain/formats/culture.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/pieces.hpp"

using namespace yars;

namespace {

constexpr std::size_t kSignature = 8;  // [bytes]

std::size_t number_at(const std::vector<std::byte>& file, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | std::to_integer<std::size_t>(file[at + i]);
  return value;
}

void correct_checksums(std::vector<std::byte>& file) {
  for (std::size_t at = kSignature; at + 12 <= file.size();) {
    const std::size_t length = number_at(file, at);
    if (length > file.size() - at - 12) return;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(file.data()) + at + 4, static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i) file[at + 8 + length + i] = static_cast<std::byte>(sum >> (24U - 8U * i));
    at += 12 + length;
  }
}

// 21 x 17 posts with every material and share of water.
std::vector<std::byte> well_formed_map(const std::filesystem::path& path) {
  std::vector<std::uint8_t> posts(21UL * 17UL);
  for (std::size_t i = 0; i < posts.size(); ++i) posts[i] = static_cast<std::uint8_t>(i);
  YARS_REQUIRE(model::terrain::write_culture(path, {{36, -122}, 17, 21, posts}).has_value(), ==, true);
  std::vector<std::byte> bytes(std::filesystem::file_size(path));
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  YARS_REQUIRE(::read(file, bytes.data(), bytes.size()), ==, static_cast<ssize_t>(bytes.size()));
  close(file);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file("n36.smc.png"), again("again.smc.png");
  static const std::vector<std::byte> well_formed = well_formed_map(file.path());
  if (size < 1) return 0;
  std::vector<std::byte> bytes = well_formed;
  fuzz::lay_pieces(bytes, {data + 1, size - 1});
  if (data[0] % 8 != 0) correct_checksums(bytes);
  if (data[0] >= 224) bytes.resize(bytes.size() * (256U - data[0]) / 32U);
  file.write(bytes);
  const auto culture = model::terrain::read_culture(file.path(), {36, -122});
  if (!culture) return 0;
  YARS_REQUIRE(culture->rows(), <=, model::terrain::kMaxCulturePosts);
  for (int row = 0; row < culture->rows(); ++row) {
    const model::terrain::Cover cover = culture->post(row, 0);
    YARS_REQUIRE(cover.material, <=, model::terrain::kMaxMaterial);
    YARS_REQUIRE(cover.water.value_or(0.0), <=, 1.0);
  }
  YARS_REQUIRE(model::terrain::write_culture(again.path(), *culture).has_value(), ==, true);
  const auto read = model::terrain::read_culture(again.path(), {36, -122});
  YARS_REQUIRE(read.has_value(), ==, true);
  YARS_REQUIRE(std::ranges::equal(read->posts(), culture->posts()), ==, true);
  return 0;
}
