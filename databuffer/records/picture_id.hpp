// Ids of the pictures in a session, patch maps and frames of the glass: they count up from 1.
#pragma once

#include <cstdint>

namespace yars::databuffer {

// A greater one is damage: at a thousand a second a session comes to it in 280,000 years.
inline constexpr std::uint64_t kLatestPictureId = std::uint64_t{1} << 53U;

}  // namespace yars::databuffer
