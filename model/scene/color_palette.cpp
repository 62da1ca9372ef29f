#include "model/scene/color_palette.hpp"

#include <algorithm>
#include <cmath>

#include "model/scene/openflight_format.hpp"

namespace yars::model::scene {

using namespace openflight;

namespace {

constexpr std::uint32_t kWhite = 0xFFFFFF;
constexpr std::int32_t kIndexRevision = 1510;  // colours by index; before it the name field held it

// Alpha, blue, green, red.
std::uint32_t rgb_of_abgr(std::uint32_t abgr) {
  return (abgr & 0xFFU) << 16U | (abgr & 0xFF00U) | (abgr >> 16U & 0xFFU);
}

std::uint32_t byte_of(double share) {
  return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(std::isfinite(share) ? share : 1.0, 0.0, 1.0)));
}

}  // namespace

void ColorPalette::read_colors(const Record& record, std::int32_t revision) {
  // A palette longer than its colours has their names behind them.
  const std::size_t most = revision >= kIndexRevision ? palette::kColors : palette::kColors / 2;
  colors_.clear();
  for (std::size_t at = palette::kFirstColor; colors_.size() < most; at += 4) {
    const auto color = record.number<std::uint32_t>(at);
    if (!color) break;
    colors_.push_back(rgb_of_abgr(*color));
  }
}

void ColorPalette::read_material(const Record& record) {
  constexpr std::size_t kIndexAt = 4, kDiffuseAt = 36;
  const auto index = record.number<std::int32_t>(kIndexAt);
  if (!index) return;
  std::uint32_t color = 0;
  for (std::size_t channel = 0; channel < 3; ++channel)
    color = color << 8U | byte_of(record.number_or<float>(kDiffuseAt + 4 * channel, 1.0F));
  diffuse_[*index] = color;
}

std::optional<std::uint32_t> ColorPalette::by_index(std::int64_t index) const {
  if (index < 0 || static_cast<std::size_t>(index / palette::kIntensities) >= colors_.size()) return std::nullopt;
  const std::uint32_t full = colors_[static_cast<std::size_t>(index / palette::kIntensities)];
  const double intensity = static_cast<double>(index % palette::kIntensities) / (palette::kIntensities - 1);
  std::uint32_t color = 0;
  for (const unsigned shift : {16U, 8U, 0U})
    color |= static_cast<std::uint32_t>(std::lround(intensity * (full >> shift & 0xFFU))) << shift;
  return color;
}

std::uint32_t ColorPalette::color_of(const Record& record, std::size_t shift, std::int32_t revision) const {
  const auto flags = record.number_or<std::uint32_t>(face::kFlags + shift, 0);
  if ((flags & face::kNoColor) == 0) {
    if ((flags & face::kPacked) != 0)
      if (const auto packed = record.number<std::uint32_t>(face::kPackedColor + shift)) return rgb_of_abgr(*packed);
    const std::int64_t index = revision >= kIndexRevision
                                   ? record.number_or<std::int32_t>(face::kColorIndex + shift, -1)
                                   : record.number_or<std::int16_t>(face::kColorName + shift, -1);
    if (const auto color = by_index(index)) return *color;
  }
  const auto material = diffuse_.find(record.number_or<std::int16_t>(face::kMaterial + shift, -1));
  return material == diffuse_.end() ? kWhite : material->second;
}

}  // namespace yars::model::scene
