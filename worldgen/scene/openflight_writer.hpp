// Writer of OpenFlight 16.0 files: big-endian records, palettes and the tree of nodes.
// Input: calls in the order of the nodes in the file. Output: the whole file as bytes. Units: metres.
// Precondition: the caller ends each node that it begins. Threads: one thread per object.
// Source: docs/spec/formats.md#openflight.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/memory/byte_order.hpp"
#include "model/scene/openflight/node_tree.hpp"

namespace yars::worldgen {

using geo::Vector3;
using model::scene::rotation_about_up;
using model::scene::scaling;
using model::scene::SurfaceKind;
using model::scene::Transform;
using model::scene::transformed_normal;
using model::scene::transformed_point;
using model::scene::translation;

// Sequence of big-endian records.
class RecordBuilder {
 public:
  // Begins a record of `bytes` bytes, filled with zeros. Offsets in put() and put_text() count from its first byte.
  void begin(std::uint16_t opcode, std::size_t bytes) {
    start_ = bytes_.size();
    bytes_.resize(start_ + bytes);
    put<std::uint16_t>(0, opcode);
    put<std::uint16_t>(2, static_cast<std::uint16_t>(bytes));
  }

  template <class Number>
  void put(std::size_t offset, Number value) {
    std::ranges::copy(memory::bytes_of(value, std::endian::big),
                      bytes_.begin() + static_cast<std::ptrdiff_t>(start_ + offset));
  }

  void put_text(std::size_t offset, const std::string& text, std::size_t max_bytes) {
    for (std::size_t i = 0; i < std::min(text.size(), max_bytes); ++i)
      bytes_[start_ + offset + i] = static_cast<std::byte>(text[i]);
  }

  void append(const RecordBuilder& other) { bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end()); }
  std::size_t size() const { return bytes_.size(); }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t start_ = 0;
};

struct WriterVertex {
  Vector3 position;
  Vector3 normal;
};

// Builds an OpenFlight file. Corners with equal position and normal share an entry in the vertex palette. Each surface
// material has one material record. Colours after the 1024th are written as the 1024th.
class OpenFlightWriter {
 public:
  // `origin`: position of the scene's origin; nullopt: the file has none. `revision`: format revision, 1600 = 16.0.
  explicit OpenFlightWriter(std::optional<geo::GeoPoint> origin, std::int32_t revision = 1600);

  void begin_group(const std::string& name, const Transform* matrix = nullptr);
  void begin_object(const std::string& name);
  // The node is visible while the viewer's distance from `centre` is between switch_out_m and switch_in_m.
  void begin_level_of_detail(const std::string& name, double switch_in_m, double switch_out_m, Vector3 centre);
  // Bit i of `mask` is 1 if child i of the node is visible.
  void begin_switch(const std::string& name, std::uint32_t mask);
  // The nodes up to end() are the definition `number`. They are visible only where instance() places them.
  void begin_definition(std::uint16_t number);
  void end();

  // Places the definition `number`, transformed by `matrix`.
  void instance(std::uint16_t number, const Transform& matrix);
  // Places the contents of another OpenFlight file, transformed by `matrix`. A path beyond 199 bytes is truncated.
  void external(const std::string& file, const Transform& matrix);
  // Corners are counter-clockwise seen from outside. A two-sided face is visible from both sides.
  void face(std::span<const WriterVertex> corners, const SurfaceKind& kind, bool two_sided = false);
  // Faces up to end_subfaces() are subfaces of the face before begin_subfaces().
  void begin_subfaces();
  void end_subfaces();

  // Corners of the area that the scene covers. They are rounded to 1e-9 degrees.
  void set_corners(geo::GeoPoint south_west, geo::GeoPoint north_east);
  // The whole file. Call once, at the end.
  std::vector<std::byte> take();

 private:
  void named(std::uint16_t opcode, const std::string& name, std::size_t bytes, RecordBuilder& record);
  void long_name(const std::string& name);
  void write_matrix(const Transform& matrix);
  std::uint32_t vertex(const WriterVertex& vertex);
  std::int32_t color_index(std::uint32_t rgb);
  void write_header(RecordBuilder& out) const;
  void write_palettes(RecordBuilder& out) const;

  std::optional<geo::GeoPoint> origin_;
  std::optional<geo::GeoPoint> south_west_, north_east_;
  std::int32_t revision_;
  RecordBuilder nodes_, vertices_;
  std::unordered_map<std::string, std::uint32_t> vertex_offsets_;  // by the bytes of position and normal
  std::vector<std::uint32_t> colors_;
  std::map<std::uint32_t, std::int32_t> color_numbers_;
  std::map<std::uint8_t, std::uint32_t> materials_;  // colour of the first face of each surface material
};

}  // namespace yars::worldgen
