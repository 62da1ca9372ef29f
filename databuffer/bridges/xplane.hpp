// X-Plane's datarefs by UDP, little-endian. Asked for with RREF (413 bytes: "RREF", a zero, i32 times a second, i32
// number, 400 characters of name), answered with "RREF", one byte, then pairs of i32 number and f32 value. A state is
// whole when each dataref has come since the one before; whatever is asked for by others is passed over.
// Places come as f32: longitude and latitude in steps of up to 0.85 m. Velocity is told in X-Plane's own frame, level
// at a reference point, and is turned by where that point is. Source: "Exchanging Data with X-Plane.rtfd" of every
// X-Plane; names by its DataRefs.txt.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "databuffer/bridges/bridge.hpp"

namespace yars::databuffer::bridges {

inline constexpr std::size_t kXplaneDatarefs = 14;
// In the order of their numbers in requests and replies.
extern const std::array<std::string_view, kXplaneDatarefs> kXplaneNames;

inline constexpr int kXplaneRate = 30;  // [Hz] more than the pictures of most X-Planes a second brings nothing

// `times_a_second` 0 ends the subscription.
Datagram xplane_request(std::size_t number, int times_a_second);

class XplaneBridge final : public Bridge {
 public:
  failure::Expected<std::optional<ExternalSample>> receive(Bytes datagram, geo::Duration now) override;
  // All datarefs, at first and each second while nothing comes.
  std::vector<Datagram> requests(geo::Duration now) override;
  std::vector<Datagram> farewell() const override;

 private:
  std::optional<geo::Duration> asked_;
  std::optional<geo::Duration> heard_;
  std::array<float, kXplaneDatarefs> values_{};
  std::uint32_t come_ = 0;  // bit n: dataref n has come since the last whole state
};

}  // namespace yars::databuffer::bridges
