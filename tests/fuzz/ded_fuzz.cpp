// Any bytes as a DED file: an error, or a list of cells that can all be read. The input modifies a well-formed file, so
// that the reader gets past its magic number. Two bytes of the input set the length of the file. Then follow pieces of
// (offset in two bytes, length, bytes).
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/ded.hpp"
#include "tests/model/terrain/formats/ded_builder.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

using namespace yars::model::terrain;

namespace {

std::vector<std::byte> well_formed_file() {
  yars::test::DedFile file;
  file.cells = {yars::test::ded_cell(36, -122, 5, 4), yars::test::ded_cell(-90, 179, 3, 3)};
  return file.bytes();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::byte> well_formed = well_formed_file();
  std::vector<std::byte> file = well_formed;
  const std::uint8_t* const end = data + size;
  if (size >= 2) {
    file.resize(file.size() * (256U - data[0]) / 256U + data[1]);
    data += 2;
  }
  while (end - data >= 3 && !file.empty()) {
    const std::size_t offset = (data[0] * 256U + data[1]) % file.size();
    const std::size_t length =
        std::min({std::size_t{data[2]}, static_cast<std::size_t>(end - data - 3), file.size() - offset});
    std::memcpy(file.data() + offset, data + 3, length);
    data += 3 + length;
  }
  static const yars::test::TemporaryFolder folder;
  folder.write("fuzz.ded", file);
  const auto path = folder.path() / "fuzz.ded";
  const auto cells = ded_cells(path);
  if (!cells) return 0;
  for (const DedCell& cell : *cells) YARS_REQUIRE(read_ded(path, cell.corner).has_value(), ==, true);
  return 0;
}
