#include "display/gl/damage.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace yars::display::gl {

namespace {

constexpr auto kEdge = static_cast<float>(Damage::kTile);

}  // namespace

void Damage::reset(int size) {
  size_ = size;
  tiles_across_ = (size + kTile - 1) / kTile;
  tiles_.assign(static_cast<std::size_t>(tiles_across_) * static_cast<std::size_t>(tiles_across_), 0);
  all_ = marked_ = built_ = false;
}

void Damage::mark_all() {
  all_ = marked_ = size_ > 0;
  built_ = false;
}

void Damage::mark_tiles(int row, float left, float right) {
  const float edge = static_cast<float>(size_);
  if (!(right > 0.0F && left < edge)) return;
  const int first = static_cast<int>(std::max(left, 0.0F)) / kTile;
  const int last = std::min(static_cast<int>(std::min(right, edge)) / kTile, tiles_across_ - 1);
  const auto begin = tiles_.begin() + static_cast<std::ptrdiff_t>(row) * tiles_across_;
  std::fill(begin + first, begin + last + 1, std::uint8_t{1});
  marked_ = true;
  built_ = false;
}

void Damage::mark(const Rect& box) {
  const std::array<Point, 4> corners{Point{box.left, box.top}, Point{box.right, box.top}, Point{box.right, box.bottom},
                                     Point{box.left, box.bottom}};
  mark_polygon(corners, 0.0F);
}

void Damage::mark_polygon(std::span<const Point> corners, float margin) {
  if (std::ranges::any_of(corners, [](Point at) { return !std::isfinite(at.x) || !std::isfinite(at.y); }))
    return mark_all();
  const auto [top, bottom] = std::ranges::minmax(corners, {}, &Point::y);
  const float edge = static_cast<float>(size_);
  if (all_ || !(bottom.y + margin > 0.0F && top.y - margin < edge)) return;
  const int first = static_cast<int>(std::max(top.y - margin, 0.0F)) / kTile;
  const int last = std::min(static_cast<int>(std::min(bottom.y + margin, edge)) / kTile, tiles_across_ - 1);
  for (int row = first; row <= last; ++row) {
    // The extent of a convex polygon within a band is that of its edges within the band.
    const float band_top = static_cast<float>(row) * kEdge - margin, band_bottom = band_top + kEdge + 2.0F * margin;
    float left = std::numeric_limits<float>::infinity(), right = -left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point from = corners[i], to = corners[(i + 1) % corners.size()];
      if (std::max(from.y, to.y) < band_top || std::min(from.y, to.y) > band_bottom) continue;
      for (const float y : {std::clamp(from.y, band_top, band_bottom), std::clamp(to.y, band_top, band_bottom)}) {
        const float x = from.y == to.y ? from.x : from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y);
        left = std::min(left, x);
        right = std::max(right, x);
      }
      if (from.y != to.y) continue;
      left = std::min(left, to.x);
      right = std::max(right, to.x);
    }
    mark_tiles(row, left - margin, right + margin);
  }
}

void Damage::add(const Damage& other, int left, int top) {
  const bool same_picture = other.size_ == size_ && left == 0 && top == 0;
  if (other.all_ && same_picture) return mark_all();
  for (const Rect& rect : other.rects()) {
    const auto x = static_cast<float>(left), y = static_cast<float>(top);
    // The last pixel of a rectangle is in the tile before its right and lower edge.
    mark({rect.left + x, rect.top + y, rect.right + x - 1.0F, rect.bottom + y - 1.0F});
  }
}

void Damage::build() const {
  built_ = true;
  rects_.clear();
  row_begin_.assign(1, 0);
  const float edge = static_cast<float>(size_);
  if (all_) rects_.push_back({0.0F, 0.0F, edge, edge});
  for (int row = 0; row < tiles_across_; ++row) {
    const auto tiles =
        std::span(tiles_).subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles_across_),
                                  static_cast<std::size_t>(tiles_across_));
    for (std::size_t at = 0; !all_ && at < tiles.size();) {
      const auto begin = std::find(tiles.begin() + static_cast<std::ptrdiff_t>(at), tiles.end(), 1);
      const auto end = std::find(begin, tiles.end(), 0);
      at = static_cast<std::size_t>(end - tiles.begin());
      if (begin == end) break;
      const float top = static_cast<float>(row) * kEdge;
      rects_.push_back({static_cast<float>(begin - tiles.begin()) * kEdge, top,
                        std::min(static_cast<float>(at) * kEdge, edge), std::min(top + kEdge, edge)});
    }
    row_begin_.push_back(rects_.size());
  }
}

std::span<const Rect> Damage::rects() const {
  if (!built_) build();
  return rects_;
}

Rect Damage::bounds() const {
  if (rects().empty()) return {};
  Rect bounds = rects_.front();
  for (const Rect& rect : rects_) {
    bounds.left = std::min(bounds.left, rect.left);
    bounds.top = std::min(bounds.top, rect.top);
    bounds.right = std::max(bounds.right, rect.right);
    bounds.bottom = std::max(bounds.bottom, rect.bottom);
  }
  return bounds;
}

}  // namespace yars::display::gl
