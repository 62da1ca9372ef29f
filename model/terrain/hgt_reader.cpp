#include "model/terrain/hgt_reader.hpp"

#include <utility>

namespace yars::model::terrain {

namespace {
constexpr int kPosts[] = {1201, 3601};  // a side: 3 arc seconds, 1 arc second
constexpr std::size_t bytes_of(int posts) {
  return 2 * static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts);
}
}  // namespace

int hgt_posts_for_size(std::uintmax_t bytes) {
  for (const int posts : kPosts)
    if (bytes == bytes_of(posts)) return posts;
  return 0;
}

failure::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject,
                                         CellPlace place) {
  const int posts = hgt_posts_for_size(bytes.size());
  if (posts == 0)
    return failure::fail(subject,
                         "an HGT file of " + std::to_string(bytes_of(kPosts[0])) + " or " +
                             std::to_string(bytes_of(kPosts[1])) + " bytes",
                         std::to_string(bytes.size()) + " bytes", "the file is truncated or no HGT; fetch it again");
  const auto side = static_cast<std::size_t>(posts);
  std::vector<std::int16_t> heights(side * side);
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side; ++column)
      heights[(side - 1 - row) * side + column] =
          static_cast<std::int16_t>(big_endian_16(&bytes[2 * (row * side + column)]));
  std::vector<std::string> warnings;
  void_impossible_heights(heights, warnings);
  return CellReading{Cell(place, posts, posts, heights), std::nullopt, std::move(warnings)};
}

failure::Expected<CellReading> read_hgt(const std::filesystem::path& path, CellPlace place) {
  const auto bytes = read_file(path, bytes_of(kPosts[1]));
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_hgt(*bytes, path.string(), place);
}

}  // namespace yars::model::terrain
