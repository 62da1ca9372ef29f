// Any bytes as a packed HGT file: a cell or an error. The memory is limited to that of a cell, whatever sizes the
// archive states. The input modifies a well-formed archive: the first byte selects zip or gzip, the second cuts it.
#include <zip.h>
#include <zlib.h>

#include "lib/error/error.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/pieces.hpp"

using namespace yars;

namespace {

constexpr std::size_t kBytes = 2UL * 1201 * 1201;

std::vector<std::byte> read_back(const std::filesystem::path& path) {
  std::vector<std::byte> bytes(std::filesystem::file_size(path));
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  YARS_REQUIRE(::read(file, bytes.data(), bytes.size()), ==, static_cast<ssize_t>(bytes.size()));
  close(file);
  return bytes;
}

std::vector<std::byte> make_zip(const std::filesystem::path& path) {
  const std::vector<std::byte> posts(kBytes);
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  zip_file_add(archive, "N36W122.hgt", zip_source_buffer(archive, posts.data(), posts.size(), 0), 0);
  YARS_REQUIRE(zip_close(archive), ==, 0);
  return read_back(path);
}

std::vector<std::byte> make_gzip(const std::filesystem::path& path) {
  const std::vector<std::byte> posts(kBytes);
  gzFile file = gzopen(path.c_str(), "wb9");
  YARS_REQUIRE(gzwrite(file, posts.data(), static_cast<unsigned>(posts.size())), ==, static_cast<int>(kBytes));
  gzclose(file);
  return read_back(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile zip("N36W122.hgt.zip");
  static fuzz::MemoryFile gzip("N36W122.hgt.gz");
  static const std::vector<std::byte> zip_bytes = make_zip(zip.path()), gzip_bytes = make_gzip(gzip.path());
  if (size < 2) return 0;
  const bool zipped = data[0] % 2 == 0;
  std::vector<std::byte> bytes = zipped ? zip_bytes : gzip_bytes;
  fuzz::lay_pieces(bytes, {data + 2, size - 2});
  // For half of the inputs the pieces also count from the end of the archive, where a zip file has its directory.
  if (data[0] % 4 >= 2) std::reverse(bytes.begin(), bytes.end());
  fuzz::lay_pieces(bytes, {data + 2, size - 2});
  if (data[0] % 4 >= 2) std::reverse(bytes.begin(), bytes.end());
  bytes.resize(bytes.size() * (256U - data[1]) / 256U);
  fuzz::MemoryFile& file = zipped ? zip : gzip;
  file.write(bytes);
  const int posts = model::terrain::compressed_hgt_grid(file.path(), {36, -122}).rows;
  if (const auto cells = model::terrain::packed_hgt_files(file.path()))
    for (const model::terrain::CellCorner corner : cells->cells)
      YARS_REQUIRE(model::terrain::slot_of(corner), <, model::terrain::kCellRows * model::terrain::kCellColumns);
  YARS_REQUIRE((posts == 0 || posts == 1201 || posts == 3601), ==, true);
  const auto reading = model::terrain::read_compressed_hgt(file.path(), {36, -122});
  if (reading) YARS_REQUIRE((reading->cell.rows() == 1201 || reading->cell.rows() == 3601), ==, true);
  return 0;
}
