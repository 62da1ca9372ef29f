// Damage of a picture: the parts that have changed since the picture was last shown, as tiles of kTile x kTile pixels.
// Inputs: boxes and convex polygons.
// Outputs: rectangles that cover all marked tiles once, so that only these parts are drawn.
// Units: pixels from the upper left corner of the picture, x right, y down.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "display/symbology/draw_list.hpp"

namespace yars::display::gl {

class Damage {
 public:
  // A wedge of video is some pixels wide and as long as the picture. Larger tiles would redraw much that has not
  // changed, smaller ones would make more rectangles.
  static constexpr int kTile = 16;  // [pixels]

  // Nothing is marked in a new picture of this edge [pixels].
  explicit Damage(int size = 0) { reset(size); }
  void reset(int size);
  void clear() { reset(size_); }

  int size() const { return size_; }
  bool empty() const { return !marked_; }
  bool is_all() const { return all_; }

  void mark_all();
  // Parts outside the picture are ignored; one with a NaN or infinite corner marks all.
  void mark(const Rect& box);
  // The polygon, enlarged by `margin` on all sides.
  void mark_polygon(std::span<const Point> corners, float margin);
  // The tiles of `other`, whose picture lies in this one with its upper left corner at (left, top).
  void add(const Damage& other, int left = 0, int top = 0);

  // Rectangles without common area; one, the whole picture, if all is marked.
  std::span<const Rect> rects() const;
  // The smallest rectangle around all of them.
  Rect bounds() const;
  // Calls f(rect) for each rectangle that shares area with the box.
  template <class Function>
  void visit(const Rect& box, const Function& f) const {
    if (rects().empty()) return;
    const auto row_of = [this](float y) {
      return static_cast<std::size_t>(std::clamp(y, 0.0F, static_cast<float>(size_ - 1))) / kTile;
    };
    const std::size_t end = row_begin_[row_of(box.bottom) + 1];
    for (std::size_t i = all_ ? 0 : row_begin_[row_of(box.top)]; i < end; ++i)
      if (intersect(rects_[i], box)) f(rects_[i]);
  }

 private:
  void mark_tiles(int row, float left, float right);
  void build() const;

  int size_ = 0, tiles_across_ = 0;
  bool all_ = false, marked_ = false;
  std::vector<std::uint8_t> tiles_;  // row by row from the top; 1: marked
  mutable bool built_ = false;       // rects_ and row_begin_ belong to the tiles
  mutable std::vector<Rect> rects_;
  mutable std::vector<std::size_t> row_begin_;  // index of the first rectangle of each row of tiles, and the end
};

}  // namespace yars::display::gl
