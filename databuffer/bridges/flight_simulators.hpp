// Packets of flight simulators: FlightGear, JSBSim, X-Plane.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/bridges/bridge.hpp"
#include "databuffer/bridges/external_flight.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::databuffer::bridges {

// FlightGear's native FDM packet (also what JSBSim's output of type FLIGHTGEAR sends): one datagram a state, all
// numbers big-endian, versions 24 (408 bytes) and 25 (552 bytes), the same as far as they are read here. The version
// says which length is right; any other pair is refused. The packet has no stamp that tells an old one from a new.
// Source: FlightGear's manual, option --native-fdm; the fields are held to what JSBSim sends
// (tests/databuffer/bridges). Latitude is geodetic, altitude above mean sea level, angles true, velocity north, east,
// down.
error::Expected<ExternalSample> decode_flightgear(memory::Bytes packet);

// JSBSim's socket output in text: comma separated lines. A line that begins with <LABELS> names the columns by the last
// part of their property's name; it may come again, with columns in any order, and with more than are read here.
// Demanded: position/lat-geod-deg, position/long-gc-deg, position/h-sl-ft, attitude/phi-deg, theta-deg, psi-deg,
// velocities/v-north-fps, v-east-fps, v-down-fps. The column Time, which JSBSim always sends, orders the lines.
// JSBSim sends its labels once, at its start: who comes later must know the columns from elsewhere. Labels hold for
// the lines of their own sender: nobody else's swap the columns of a running source.
// Accuracy: JSBSim prints seven digits, so a longitude beyond 100 degrees comes in steps of 0.0001 deg, up to 11 m;
// its output of type FLIGHTGEAR has all digits.

// Of a text line; JSBSim's have some hundreds of characters.
inline constexpr std::size_t kLongestJsbsimLine = 16'384;

inline constexpr std::size_t kJsbsimValues = 10;  // what is read of a line: Reading's nine and the time
// Which column holds what.
struct JsbsimColumns {
  std::array<std::size_t, kJsbsimValues> of_value{};
  std::size_t count = 0;  // of columns in a line
};

// From a line of labels. The error names the properties that are missing.
error::Expected<JsbsimColumns> parse_jsbsim_labels(std::string_view line);

struct JsbsimState {
  geo::Duration time;
  ExternalSample sample;
};
// From a line of numbers.
error::Expected<JsbsimState> parse_jsbsim_line(const JsbsimColumns& columns, std::string_view line);

class JsbsimBridge final : public Bridge {
 public:
  // `columns`: what the lines hold until labels come; none: nothing is believed before.
  explicit JsbsimBridge(const std::optional<JsbsimColumns>& columns = std::nullopt) : columns_(columns) {}
  error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) override;
  void hears_from(const Sender& sender) override { sender_ = sender; }

 private:
  struct Labels {
    Sender sender;
    JsbsimColumns columns;
  };
  static constexpr std::size_t kMostSenders = 8;  // whose labels are kept: of more, those that came last

  void keep(const JsbsimColumns& columns);
  const JsbsimColumns* columns() const;  // of the sender; nullptr: unknown

  std::optional<JsbsimColumns> columns_;  // of senders without labels
  Sender sender_;
  Sender flies_;  // whose line was read last
  std::vector<Labels> labels_;
  StampOrder order_;
};

// X-Plane's datarefs by UDP, little-endian. Asked for with RREF (413 bytes: "RREF", a zero, i32 times a second, i32
// number, 400 characters of name), answered with "RREF", one byte, then pairs of i32 number and f32 value. A state is
// whole when each dataref has come since the one before; whatever is asked for by others is passed over.
// Places come as f32: longitude and latitude in steps of up to 0.85 m. Velocity is told in X-Plane's own frame, level
// at a reference point, and is turned by where that point is. Source: "Exchanging Data with X-Plane.rtfd" of every
// X-Plane; names by its DataRefs.txt.
inline constexpr std::size_t kXplaneDatarefs = 14;
// In the order of their numbers in requests and replies.
extern const std::array<std::string_view, kXplaneDatarefs> kXplaneNames;

inline constexpr int kXplaneRate = 30;  // [Hz] more than the pictures of most X-Planes a second brings nothing

// `times_a_second` 0 ends the subscription.
Datagram xplane_request(std::size_t number, int times_a_second);

class XplaneBridge final : public Bridge {
 public:
  error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) override;
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
