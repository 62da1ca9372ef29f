#include "model/terrain/formats/cell_reading.hpp"

#include <algorithm>
#include <cerrno>
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

// Turns warnings into sentences. Returns the sentences that are not yet in `reported`, and adds them to `reported`.
std::vector<std::string> new_sentences(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                                       std::set<std::string>& reported) {
  std::vector<std::string> sentences;
  for (const std::string& warning : warnings) {
    std::string sentence = path.string() + ": " + warning;
    if (reported.insert(sentence).second) sentences.push_back(std::move(sentence));
  }
  return sentences;
}

void append(std::vector<std::string> more, std::vector<std::string>& sentences) {
  for (std::string& sentence : more) sentences.push_back(std::move(sentence));
}

}  // namespace

std::vector<std::string> ReadingNotes::take_new(const std::filesystem::path& path, const CellReading& reading) {
  std::vector<std::string> sentences;
  for (const std::string& warning : reading.warnings) sentences.push_back(path.string() + ": " + warning);
  append(new_sentences(path, reading.file_warnings, reported_), sentences);
  if (reading.impossible > 0 && reported_.insert(path.string()).second)
    sentences.push_back(path.string() + ": " + impossible_heights_warning(reading.impossible));
  return sentences;
}

void AllReadingNotes::add(const std::filesystem::path& path, const CellReading& reading) {
  for (const std::string& warning : reading.warnings) sentences_.push_back(path.string() + ": " + warning);
  add_file(path, reading.file_warnings, reading.impossible);
}

void AllReadingNotes::add_file(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                               std::size_t impossible) {
  append(new_sentences(path, warnings, reported_), sentences_);
  if (impossible > 0) impossible_[path.string()] += impossible;
}

std::vector<std::string> AllReadingNotes::sentences() const {
  std::vector<std::string> sentences = sentences_;
  for (const auto& [path, posts] : impossible_) sentences.push_back(path + ": " + impossible_heights_warning(posts));
  return sentences;
}

}  // namespace yars::model::terrain
