#include "station/frame_stream.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "lib/imageio/png.hpp"

namespace yars::station {

namespace {

constexpr std::size_t kPixelBytes = 4;

// Appends a number, least byte first.
template <class Number>
void append(std::vector<std::uint8_t>& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

}  // namespace

void FrameStream::take(const databuffer::GlassFrame& frame, std::span<const std::uint8_t> pixels) {
  const bool comparable = pixels.size() == pixels_.size() && frame.width == frame_.width && frame.id != frame_.id;
  before_ = comparable ? frame_.id : 0;
  if (comparable) part_ = changed_part(pixels);
  frame_ = frame;
  pixels_.assign(pixels.begin(), pixels.end());
  change_.reset();
  whole_.reset();
}

// Smallest rectangle that contains all pixels that differ from those of the frame before; one pixel if none differs.
FrameStream::Rect FrameStream::changed_part(std::span<const std::uint8_t> pixels) const {
  const std::size_t row_bytes = frame_.width * kPixelBytes;
  const int height = static_cast<int>(frame_.height), width = static_cast<int>(frame_.width);
  Rect part{width, height, 0, 0};
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* now = pixels.data() + static_cast<std::size_t>(row) * row_bytes;
    const std::uint8_t* then = pixels_.data() + static_cast<std::size_t>(row) * row_bytes;
    if (std::memcmp(now, then, row_bytes) == 0) continue;
    part.top = std::min(part.top, row);
    part.bottom = row + 1;
    const auto first = static_cast<std::size_t>(std::mismatch(now, now + row_bytes, then).first - now) / kPixelBytes;
    std::size_t last = row_bytes - 1;
    while (now[last] == then[last]) --last;
    part.left = std::min(part.left, static_cast<int>(first));
    part.right = std::max(part.right, static_cast<int>(last / kPixelBytes) + 1);
  }
  return part.bottom == 0 ? Rect{0, 0, 1, 1} : part;
}

Bytes FrameStream::message_after(std::uint64_t seen) {
  if (frame_.id == 0 || seen == frame_.id) return nullptr;
  if (before_ != 0 && seen == before_) {
    if (!change_) change_ = encode(before_, part_);
    return change_;
  }
  if (!whole_) whole_ = encode(0, {0, 0, static_cast<int>(frame_.width), static_cast<int>(frame_.height)});
  return whole_;
}

Bytes FrameStream::encode(std::uint64_t base, const Rect& part) const {
  constexpr std::int64_t kNsPerMs = 1'000'000;
  const std::size_t row_bytes = frame_.width * kPixelBytes;
  std::vector<std::uint8_t> message, png;
  append(message, frame_.id);
  append(message, base);
  append(message, static_cast<std::uint16_t>(frame_.width));
  append(message, static_cast<std::uint16_t>(frame_.height));
  append(message, static_cast<std::uint16_t>(part.left));
  append(message, static_cast<std::uint16_t>(part.top));
  append(message, static_cast<std::uint64_t>(frame_.sim_time_ns / kNsPerMs));
  const std::size_t first =
      static_cast<std::size_t>(part.top) * row_bytes + static_cast<std::size_t>(part.left) * kPixelBytes;
  imageio::encode_png({pixels_.data() + first, part.right - part.left, part.bottom - part.top, row_bytes}, png);
  message.insert(message.end(), png.begin(), png.end());
  return std::make_shared<const std::vector<std::uint8_t>>(std::move(message));
}

}  // namespace yars::station
