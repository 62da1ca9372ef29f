// JSBSim's socket output in text: comma separated lines. A line that begins with <LABELS> names the columns by the last
// part of their property's name; it may come again, with columns in any order, and with more than are read here.
// Demanded: position/lat-geod-deg, position/long-gc-deg, position/h-sl-ft, attitude/phi-deg, theta-deg, psi-deg,
// velocities/v-north-fps, v-east-fps, v-down-fps. The column Time, which JSBSim always sends, orders the lines.
// JSBSim sends its labels once, at its start: who comes later must know the columns from elsewhere. Labels hold for
// the lines of their own sender: nobody else's swap the columns of a running source.
// Accuracy: JSBSim prints seven digits, so a longitude beyond 100 degrees comes in steps of 0.0001 deg, up to 11 m;
// its output of type FLIGHTGEAR has all digits.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/bridges/bridge.hpp"
#include "databuffer/bridges/stamp_order.hpp"

namespace yars::databuffer::bridges {

// Of a text line; JSBSim's have some hundreds of characters.
inline constexpr std::size_t kLongestJsbsimLine = 16'384;

inline constexpr std::size_t kJsbsimValues = 10;  // what is read of a line: Reading's nine and the time
// Which column holds what.
struct JsbsimColumns {
  std::array<std::size_t, kJsbsimValues> of_value{};
  std::size_t count = 0;  // of columns in a line
};

// From a line of labels. The error names the properties that are missing.
failure::Expected<JsbsimColumns> parse_jsbsim_labels(std::string_view line);

struct JsbsimState {
  geo::Duration time;
  ExternalSample sample;
};
// From a line of numbers.
failure::Expected<JsbsimState> parse_jsbsim_line(const JsbsimColumns& columns, std::string_view line);

class JsbsimBridge final : public Bridge {
 public:
  // `columns`: what the lines hold until labels come; none: nothing is believed before.
  explicit JsbsimBridge(const std::optional<JsbsimColumns>& columns = std::nullopt) : columns_(columns) {}
  failure::Expected<std::optional<ExternalSample>> receive(Bytes datagram, geo::Duration now) override;
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

}  // namespace yars::databuffer::bridges
