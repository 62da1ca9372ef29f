// What a slot holds in a draft, as GUF text.
#pragma once

#include <string>

#include "config/schema.hpp"

namespace yars::config {

// Empty when there is nothing to write: the slot is used by nothing, holds forms, or stands for "unknown".
std::string slot_text(Draft& draft, const SlotSchema& slot);

}  // namespace yars::config
