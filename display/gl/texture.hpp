// Textures that hold video or light: one value a texel, smooth between them, no wrap at the edges.
#pragma once

#include <cstdint>

namespace yars::display::gl {

// Bound when it returns; rows of bytes without padding can be uploaded. Needs a current context.
std::uint32_t new_texture();

}  // namespace yars::display::gl
