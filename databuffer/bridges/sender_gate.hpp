// Of several senders to one port, one flies the aircraft: whose report was taken last, until it has been silent for a
// while. Two programs that send to the same port by mistake would else tear the aircraft to and fro.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

struct Sender {
  std::uint32_t address = 0;  // IPv4, the first number highest
  std::uint16_t port = 0;
  friend bool operator==(const Sender&, const Sender&) = default;
};

// Silence after which another sender may take over: as long as a lane is taken for fresh.
inline constexpr geo::Duration kSenderSilence = geo::Duration::seconds(0.5);

class SenderGate {
 public:
  bool admits(const Sender& sender, geo::Duration now) const {
    return !holder_ || *holder_ == sender || now - heard_ > kSenderSilence;
  }
  // A report of this sender was taken. True: another one than before.
  bool taken(const Sender& sender, geo::Duration now) {
    const bool is_new = holder_ != sender;
    holder_ = sender;
    heard_ = now;
    return is_new;
  }

 private:
  std::optional<Sender> holder_;
  geo::Duration heard_;
};

}  // namespace yars::databuffer::bridges
