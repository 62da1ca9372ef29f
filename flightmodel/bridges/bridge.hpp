// Bridge: decoder and encoder of the protocol by which an external program flies the aircraft; decoders of FlightGear,
// JSBSim and X-Plane. SenderGate: choice of one sender among several.
// Inputs: UDP datagrams with sender and arrival time, one at a time. Outputs: validated samples of the aircraft,
// nullopt for a label line or an incomplete state; traffic; datagrams to send.
// Frame: geodetic latitude, altitude above mean sea level, true heading, velocity north, east, down.
// Errors: a datagram with another format, or with values out of range, is refused with an Error that has the reason.
// Threads: one thread per object. A Bridge opens no socket and reads no clock.
// Source: docs/spec/formats.md#flightgear, #jsbsim and #xplane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flightmodel/bridges/dis.hpp"
#include "flightmodel/bridges/external_flight.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::flightmodel::bridges {

struct Sender {
  std::string address;  // IPv4 or IPv6 in numbers, as in 127.0.0.1 or fe80::1%eth0
  std::uint16_t port = 0;
  friend bool operator==(const Sender&, const Sender&) = default;
};

// Silence [s] after which another sender may take over. It equals the time for which the aircraft's state in a
// lane counts as fresh.
inline constexpr geo::Duration kSenderSilence = geo::Duration::seconds(0.5);

// Lets one sender at a time fly the aircraft: the sender of the last accepted report, until that sender has been silent
// for kSenderSilence. Without this rule, two programs that send to one port by mistake would make the aircraft jump.
class SenderGate {
 public:
  bool admits(const Sender& sender, geo::Duration now) const {
    return !holder_ || *holder_ == sender || now - last_report_ > kSenderSilence;
  }
  // Records an accepted report of this sender. True: the sender differs from the previous one.
  bool taken(const Sender& sender, geo::Duration now) {
    const bool is_new = holder_ != sender;
    holder_ = sender;
    last_report_ = now;
    return is_new;
  }

 private:
  std::optional<Sender> holder_;
  geo::Duration last_report_;
};

using Datagram = std::vector<std::byte>;

// Interface of one protocol. `now` is the time of any clock that does not go back.
class Bridge {
 public:
  virtual ~Bridge() = default;

  // Decodes one datagram. nullopt: valid, but no new sample of the aircraft (column names, another entity, part of a
  // state). An error holds the reason for the refusal.
  virtual error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) = 0;

  // Sets the sender of the datagram that the next receive() gets.
  virtual void set_sender(const Sender&) {}

  // Datagrams to send to the external program now. Call at least once a second.
  virtual std::vector<Datagram> requests(geo::Duration) { return {}; }
  // Datagrams to send when the bridge ends.
  virtual std::vector<Datagram> closing_datagrams() const { return {}; }

  // True if the protocol reports entities other than the aircraft.
  virtual bool has_traffic() const { return false; }
  // All entities except the aircraft, extrapolated to `now`.
  virtual std::vector<TrackedEntity> traffic(geo::Duration) const { return {}; }
  // Text for the log about an event since the last call, such as a change of the aircraft's entity. nullopt: no event.
  virtual std::optional<std::string> take_log_message() { return std::nullopt; }

  // Time after a packet during which the aircraft is dead reckoned (extrapolated).
  virtual geo::Duration extrapolation_limit() const { return geo::Duration::seconds(1.0); }
  // True if several senders are normal, because the packets of the protocol identify their entity.
  virtual bool allows_many_senders() const { return false; }
};

// Decodes FlightGear's native FDM (flight dynamics model) packet, which JSBSim's output of type FLIGHTGEAR also sends.
// One datagram contains one state, all numbers big-endian. Version 24 has 408 bytes and version 25 has 552; the decoded
// fields are the same in both. Other pairs of version and length are refused. The packet has no time stamp, so old
// packets cannot be recognized.
// Source: FlightGear's manual, option --native-fdm. Tests compare the fields with what JSBSim sends
// (tests/flightmodel/bridges).
error::Expected<ExternalSample> decode_flightgear(memory::Bytes packet);

// JSBSim's socket output is comma-separated text. A line that begins with <LABELS> names the columns by whole property
// names or by the last parts of these names. This line may be repeated. Columns may be in any order, and further
// columns are ignored.
// Required: position/lat-geod-deg, position/long-gc-deg, position/h-sl-ft, attitude/phi-deg, theta-deg, psi-deg,
// velocities/v-north-fps, v-east-fps, v-down-fps, and Time, which JSBSim always sends and which orders the lines.
// JSBSim sends its labels once, at its start. A receiver that starts later needs them in --source. Labels apply to the
// lines of the same sender only.
// Accuracy: JSBSim prints seven digits. A longitude beyond 100 deg therefore has steps of 0.0001 deg, up to 11 m.
// JSBSim's output of type FLIGHTGEAR has full precision.

// Maximum length [characters] of a line. JSBSim's lines have some hundreds of characters.
inline constexpr std::size_t kMaxJsbsimLine = 16'384;

inline constexpr std::size_t kJsbsimValues = 10;  // values read from a line: the required properties above
struct JsbsimColumns {
  // Column index of each value. The values have the order of the required properties above.
  std::array<std::size_t, kJsbsimValues> of_value{};
  std::size_t count = 0;  // number of columns in a line
};

// Parses a label line. The error names the missing properties.
error::Expected<JsbsimColumns> parse_jsbsim_labels(std::string_view line);

struct JsbsimState {
  geo::Duration time;
  ExternalSample sample;
};
error::Expected<JsbsimState> parse_jsbsim_line(const JsbsimColumns& columns, std::string_view line);

class JsbsimBridge final : public Bridge {
 public:
  // `columns`: columns of a sender that has sent no labels. nullopt: its lines are refused until it sends labels.
  explicit JsbsimBridge(const std::optional<JsbsimColumns>& columns = std::nullopt) : columns_(columns) {}
  error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) override;
  void set_sender(const Sender& sender) override { sender_ = sender; }

 private:
  struct Labels {
    Sender sender;
    JsbsimColumns columns;
  };
  static constexpr std::size_t kMaxSenders = 8;  // maximum number of senders with stored labels

  void keep(const JsbsimColumns& columns);
  const JsbsimColumns* columns() const;  // columns of the current sender; nullptr: unknown

  std::optional<JsbsimColumns> columns_;  // columns of senders that have sent no labels
  Sender sender_;
  Sender flying_sender_;  // sender of the last accepted line
  std::vector<Labels> labels_;
  StampOrder order_;
};

// X-Plane's datarefs (named values) by UDP, little-endian. A request has 413 bytes: "RREF", a zero, i32 rate [Hz], i32
// number, 400 characters of name. A reply has "RREF", one byte, then pairs of i32 number and f32 value. A state is
// complete when each dataref has arrived since the last complete state. Numbers that were not requested are ignored.
// Accuracy: positions are f32, so the rounding error of longitude and of latitude is up to 0.85 m.
// Frame: velocity is in X-Plane's local axes, which are level at a reference point. The decoder rotates it to the axes
// north, east, down at the aircraft.
// Source: "Exchanging Data with X-Plane.rtfd" in every installation of X-Plane; names from its DataRefs.txt.
inline constexpr std::size_t kXplaneDatarefs = 14;
// Names, indexed by their numbers in requests and replies.
extern const std::array<std::string_view, kXplaneDatarefs> kXplaneNames;

inline constexpr int kXplaneRate_hz = 30;  // [Hz] requested rate; most installations of X-Plane draw no faster

// Encodes a request; `times_a_second` 0 ends the subscription.
Datagram xplane_request(std::size_t number, int times_a_second);

class XplaneBridge final : public Bridge {
 public:
  error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) override;
  // Requests for all datarefs: at the start, and once per second while no reply arrives.
  std::vector<Datagram> requests(geo::Duration now) override;
  std::vector<Datagram> closing_datagrams() const override;

 private:
  std::optional<geo::Duration> last_request_;
  std::optional<geo::Duration> last_reply_;
  std::array<float, kXplaneDatarefs> values_{};
  std::uint32_t received_mask_ = 0;  // bit n: dataref n has arrived since the last complete state
};

}  // namespace yars::flightmodel::bridges
