#include "model/terrain/formats/cell_reading.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include "lib/text/plain_text.hpp"
namespace yars::model::terrain {

namespace {
// [m] MSL. Bounds of possible heights: below the deepest sea floor, above the highest mountain.
constexpr std::int16_t kLowestPost_m = -12'000;
constexpr std::int16_t kHighestPost_m = 10'000;
constexpr std::int16_t kCommonVoid_m = -9999;  // [m] written by some producers where they have no data
}  // namespace

void void_impossible_heights(std::vector<std::int16_t>& posts, std::vector<std::string>& warnings) {
  // A count of one piece fits 16 bits, so that a SIMD register counts as many posts at a time as it holds.
  constexpr std::size_t kPiece = 32'768;
  std::size_t impossible = 0;
  for (std::span<std::int16_t> rest = posts; !rest.empty();) {
    const auto piece = rest.first(std::min(kPiece, rest.size()));
    rest = rest.subspan(piece.size());
    std::uint16_t count = 0;
    for (std::int16_t& post : piece) {
      // Without branches, so that the compiler uses SIMD.
      const int outside = static_cast<int>(post < kLowestPost_m) | static_cast<int>(post > kHighestPost_m) |
                          static_cast<int>(post == kCommonVoid_m);
      const bool wrong = (outside & static_cast<int>(post != kVoidPost)) != 0;
      post = wrong ? kVoidPost : post;
      count = static_cast<std::uint16_t>(count + (wrong ? 1U : 0U));
    }
    impossible += count;
  }
  if (impossible > 0) warnings.push_back(impossible_heights_warning(impossible));
}

namespace {

// Counts where the ground crosses the level of the sea, along rows and columns of posts.
class Shores {
 public:
  // A row or column up to its last post.
  struct Line {
    int side = 0;   // of the last post that is not at 0 m: 1 above, -1 below the sea
    int zeros = 0;  // posts at 0 m since then
  };

  void add(std::int16_t post, Line& line) {
    if (post == kVoidPost) {
      line = {};
      return;
    }
    if (post == 0) {
      ++line.zeros;
      return;
    }
    const int side = post > 0 ? 1 : -1;
    // Between land and a floor, only a few posts happen to lie at 0 m. More of them are a strip of sea.
    constexpr int kStrip = 8;
    if (line.zeros >= kStrip)
      coasts_ += static_cast<std::size_t>(line.side > 0) + static_cast<std::size_t>(side > 0);
    else
      floors_ += static_cast<std::size_t>(side * line.side < 0);
    line = {side, 0};
  }
  std::size_t floors() const { return floors_; }  // crossings between land and posts below the sea
  std::size_t coasts() const { return coasts_; }  // crossings between land and sea at 0 m

 private:
  std::size_t floors_ = 0, coasts_ = 0;
};

}  // namespace

std::optional<std::string> sea_floor_note(const Cell& cell) {
  constexpr double kFewPosts = 0.02;  // share of the posts; fewer are errors of measurement
  if (cell.lowest_m() >= kLowLand_m || cell.highest_m() <= 0.0) return std::nullopt;
  const int low_land = static_cast<int>(std::lround(kLowLand_m / cell.unit_m()));
  Shores shores;
  std::size_t deep = 0;
  std::vector<Shores::Line> columns(static_cast<std::size_t>(cell.columns()));
  std::vector<std::int16_t> row(columns.size());
  for (int y = 0; y < cell.rows(); ++y) {
    cell.blocks().copy_row(y, row);
    Shores::Line along;
    for (std::size_t x = 0; x < row.size(); ++x) {
      shores.add(row[x], along);
      shores.add(row[x], columns[x]);
      deep += static_cast<std::size_t>(row[x] != kVoidPost && row[x] < low_land);
    }
  }
  if (static_cast<double>(deep) < kFewPosts * static_cast<double>(cell.post_count()) ||
      shores.floors() <= shores.coasts())
    return std::nullopt;
  std::array<char, 320> text{};
  std::snprintf(
      text.data(), text.size(),
      "%zu of %zu posts lie below -10 m, down to %.0f m, and meet the land without sea at 0 m between: the "
      "radar sees them as land. If they are the floor of the sea, make them 0 m: gdal_calc.py -A IN --outfile "
      "OUT --calc 'maximum(A,0)'",
      deep, cell.post_count(), cell.lowest_m());
  return text.data();
}

ReadingBuffers& reading_buffers() {
  thread_local ReadingBuffers buffers;
  return buffers;
}

void free_reading_buffers() {
  reading_buffers() = {};
}

std::string impossible_heights_warning(std::size_t posts) {
  return "impossible heights: " + std::to_string(posts) +
         " posts; they are made void, and the file may be damaged or may not declare its no-data value";
}

error::Expected<std::uintmax_t> file_length(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return error::fail(path.string(), "an elevation file",
                       code ? error::reason_of(code.value()) : "not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) return error::fail(path.string(), "a readable file", error::reason_of(code.value()));
  return size;
}

namespace {

error::Expected<void> read_part(const std::filesystem::path& path, std::uintmax_t offset, std::size_t bytes,
                                std::vector<std::byte>& part) {
  const error::Expected<std::uintmax_t> length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  if (offset > *length || bytes > *length - offset)
    return error::fail(path.string(), "at least " + text::counted(offset + bytes, "byte"),
                       text::counted(*length, "byte"), "the file is truncated; fetch it again");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  part.resize(bytes);
  file.read(reinterpret_cast<char*>(part.data()), static_cast<std::streamsize>(bytes));
  if (!file)
    return error::fail(path.string(), "a readable file of " + text::counted(*length, "byte"),
                       errno != 0 ? error::reason_of(errno) : "a failed read",
                       "check the rights of the file and the disk");
  return {};
}

}  // namespace

error::Expected<std::vector<std::byte>> read_file_part(const std::filesystem::path& path, std::uintmax_t offset,
                                                       std::size_t bytes) {
  std::vector<std::byte> part;
  if (const auto read = read_part(path, offset, bytes, part); !read) return tl::unexpected(read.error());
  return part;
}

error::Expected<void> read_file(const std::filesystem::path& path, std::size_t limit_bytes,
                                std::vector<std::byte>& bytes) {
  const error::Expected<std::uintmax_t> length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  if (*length > limit_bytes)
    return error::fail(path.string(), "at most " + text::counted(limit_bytes, "byte"), text::counted(*length, "byte"),
                       "this is not a one-degree cell");
  return read_part(path, 0, *length, bytes);
}

error::Expected<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::vector<std::byte> bytes;
  if (const auto read = read_file(path, limit_bytes, bytes); !read) return tl::unexpected(read.error());
  return bytes;
}

namespace {

// Adds each text as a sentence about the file.
void add_sentences(const std::filesystem::path& path, const std::vector<std::string>& texts,
                   std::vector<std::string>& sentences) {
  for (const std::string& text : texts) sentences.push_back(path.string() + ": " + text);
}

// The same, without sentences that are in `reported`, which receives the others.
void add_new_sentences(const std::filesystem::path& path, const std::vector<std::string>& texts,
                       std::set<std::string>& reported, std::vector<std::string>& sentences) {
  for (const std::string& text : texts) {
    std::string sentence = path.string() + ": " + text;
    if (reported.insert(sentence).second) sentences.push_back(std::move(sentence));
  }
}

}  // namespace

FileSentences ReadingNotes::take_new(const std::filesystem::path& path, const CellReading& reading) {
  FileSentences found;
  add_sentences(path, reading.warnings, found.problems);
  add_sentences(path, reading.notes, found.notes);
  add_new_sentences(path, reading.file_notes, reported_, found.notes);
  if (reading.impossible > 0 && reported_.insert(path.string()).second)
    found.problems.push_back(path.string() + ": " + impossible_heights_warning(reading.impossible));
  return found;
}

void AllReadingNotes::add(const std::filesystem::path& path, const CellReading& reading) {
  add_sentences(path, reading.warnings, problems_);
  add_sentences(path, reading.notes, notes_);
  add_file(path, reading.file_notes, reading.impossible);
}

void AllReadingNotes::add(FileSentences sentences) {
  for (std::string& problem : sentences.problems) problems_.push_back(std::move(problem));
  for (std::string& note : sentences.notes) notes_.push_back(std::move(note));
}

void AllReadingNotes::add_file(const std::filesystem::path& path, const std::vector<std::string>& notes,
                               std::size_t impossible) {
  add_new_sentences(path, notes, reported_, notes_);
  if (impossible > 0) impossible_[path.string()] += impossible;
}

std::vector<std::string> AllReadingNotes::problems() const {
  std::vector<std::string> sentences = problems_;
  for (const auto& [path, posts] : impossible_) sentences.push_back(path + ": " + impossible_heights_warning(posts));
  return sentences;
}

}  // namespace yars::model::terrain
