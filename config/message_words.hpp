// What scanner and grammar of the messages of 1996 need beyond scan_state.hpp.
#pragma once

#include <string>
#include <string_view>

#include "config/message_text.hpp"
#include "config/scan_state.hpp"

namespace yars::config {

// "N37@30.5" to ( lat-long N 37 30.5 ); `state.token` is the place of its parts and of a complaint.
Form coordinate_of(std::string_view text, const ScanState& state);

// "name :=" to "name".
std::string first_name(std::string_view text);

Slot include_slot(const Location& where, const std::string& file);

}  // namespace yars::config
