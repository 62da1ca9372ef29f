#include "station/page_message.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "lib/imageio/png.hpp"

namespace yars::station {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using databuffer::Key;

tl::unexpected<error::Error> refused(std::string found) {
  return error::fail("message", R"({"event": TEXT}, {"key": NAME, "down": true|false} or {"release": true})",
                     std::move(found));
}

InputEvent centred_tdc() {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(EventKind::tdc);
  return event;
}

}  // namespace

Key key_of_browser(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Key>, 13> kNamed{{{"ArrowUp", Key::up},
                                                                            {"ArrowDown", Key::down},
                                                                            {"ArrowLeft", Key::left},
                                                                            {"ArrowRight", Key::right},
                                                                            {"Enter", Key::enter},
                                                                            {"Tab", Key::tab},
                                                                            {"PageUp", Key::page_up},
                                                                            {"PageDown", Key::page_down},
                                                                            {"F4", Key::f4},
                                                                            {"F5", Key::f5},
                                                                            {"F6", Key::f6},
                                                                            {"F7", Key::f7},
                                                                            {"Spacebar", Key::space}}};
  if (name.size() == 1) return databuffer::key_of_character(name.front());
  const auto* named = std::ranges::find(kNamed, name, &std::pair<std::string_view, Key>::first);
  return named == kNamed.end() ? Key::none : named->second;
}

error::Expected<std::vector<InputEvent>> PagePilot::events_of(std::string_view message) {
  if (message.size() > kMaxMessageBytes) return refused(std::to_string(message.size()) + " bytes");
  const auto object = nlohmann::json::parse(message, nullptr, false);
  if (!object.is_object()) return refused("something else");
  if (const auto event = object.find("event"); event != object.end()) {
    if (!event->is_string()) return refused("an event that is no text");
    const auto parsed = databuffer::event_from_text(event->get_ref<const std::string&>());
    if (!parsed) return tl::unexpected(parsed.error());
    if (static_cast<EventKind>(parsed->kind) == EventKind::tdc) deflected_ = parsed->x != 0.0 || parsed->y != 0.0;
    return std::vector{*parsed};
  }
  if (const auto key = object.find("key"); key != object.end()) {
    const auto down = object.find("down");
    if (!key->is_string() || down == object.end() || !down->is_boolean()) return refused("a key without both");
    return keyboard_.change(key_of_browser(key->get_ref<const std::string&>()), down->get<bool>());
  }
  if (object.contains("release")) return release_all();
  return refused("an object without them");
}

std::vector<InputEvent> PagePilot::release_all() {
  std::vector<InputEvent> events = keyboard_.release_all();
  if (std::exchange(deflected_, false)) events.push_back(centred_tdc());
  return events;
}

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
