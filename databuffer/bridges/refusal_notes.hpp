// What is written of refused packets: the first at once, with its reason; then one line in kQuiet that counts the rest.
// A flood fills neither the log nor the session's flight recorder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

inline constexpr geo::Duration kQuiet = geo::Duration::seconds(5.0);

class RefusalNotes {
 public:
  // The line to write, if one is due.
  std::optional<std::string> refused(const std::string& reason, geo::Duration now);
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
  std::uint64_t told_ = 0;
  std::optional<geo::Duration> written_;
};

}  // namespace yars::databuffer::bridges
