// Any text as a legend of land cover: an error with the file's name, or classes that each have numbers of their own and
// a material.
#include <set>
#include <string>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cover_legend.hpp"
#include "model/terrain/formats/culture.hpp"
#include "tests/fuzz/memory_file.hpp"

using namespace yars;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file("legend.csv");
  const std::string heading = size > 0 && data[0] % 8 != 0 ? "class,name,material,source\n" : "";
  std::vector<std::byte> bytes(heading.size() + size);
  std::memcpy(bytes.data(), heading.data(), heading.size());
  if (size > 0) std::memcpy(bytes.data() + heading.size(), data, size);
  file.write(bytes);
  const auto legend = model::terrain::read_cover_legend(file.path());
  if (!legend) {
    YARS_REQUIRE(legend.error().message().find("legend.csv"), !=, std::string::npos);
    return 0;
  }
  std::set<std::uint16_t> values;
  YARS_REQUIRE(legend->empty(), ==, false);
  for (const model::terrain::CoverClass& row : *legend) {
    YARS_REQUIRE(row.values.empty(), ==, false);
    YARS_REQUIRE(row.material, <=, model::terrain::kMaxMaterial);
    for (const std::uint16_t value : row.values) YARS_REQUIRE(values.insert(value).second, ==, true);
  }
  return 0;
}
