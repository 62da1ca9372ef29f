// Colours of an OpenFlight file: the palette (record 32), whose entries come in 128 intensities, and the diffuse
// colours of its materials (record 113). Colours are 0xRRGGBB.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "model/scene/record_stream.hpp"

namespace yars::model::scene {

class ColorPalette {
 public:
  void read_colors(const Record& record, std::int32_t revision);
  void read_material(const Record& record);
  // The colour of a face or of a mesh, whose fields lie `shift` bytes further on. In order: packed, by index and
  // intensity, the material's diffuse colour, white.
  std::uint32_t color_of(const Record& face, std::size_t shift, std::int32_t revision) const;
  std::size_t materials() const { return diffuse_.size(); }

 private:
  std::optional<std::uint32_t> by_index(std::int64_t index) const;

  std::vector<std::uint32_t> colors_;
  std::map<std::int32_t, std::uint32_t> diffuse_;
};

}  // namespace yars::model::scene
