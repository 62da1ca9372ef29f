#include "databuffer/bridges/refusal_notes.hpp"

namespace yars::databuffer::bridges {

std::optional<std::string> RefusalNotes::refused(const std::string& reason, geo::Duration now) {
  ++count_;
  if (written_ && now - *written_ < kQuiet) return std::nullopt;
  const std::uint64_t unsaid = count_ - told_ - 1;
  written_ = now;
  told_ = count_;
  return unsaid == 0 ? reason : reason + " (and " + std::to_string(unsaid) + " more refused before)";
}

}  // namespace yars::databuffer::bridges
