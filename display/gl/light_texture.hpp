// The table from video to light on the graphics processor, one for all that draws video.
// Needs a current context for its lifetime.
#pragma once

#include <array>
#include <cstdint>

namespace yars::display::gl {

class LightTexture {
 public:
  LightTexture();
  ~LightTexture();
  LightTexture(const LightTexture&) = delete;
  LightTexture& operator=(const LightTexture&) = delete;

  void set(const std::array<float, 256>& light);  // [video] -> light
  void bind(int unit) const;                      // as a texture 256 wide, 1 high

 private:
  std::uint32_t texture_ = 0;
};

}  // namespace yars::display::gl
