// Why a record from outside is refused: nothing for a good one, else the first fault as text, "field: expected,
// found".
#pragma once

#include <optional>
#include <string>

namespace yars::databuffer {

using Refusal = std::optional<std::string>;

}  // namespace yars::databuffer
