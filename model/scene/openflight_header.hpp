// The header record of an OpenFlight file: revision, unit, origin and what it covers. A place of exactly 0, 0 counts as
// none: files write it that have none. Errors: other bytes than a header, a revision but 14 to 16.5, a foreign unit.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lib/failure/error.hpp"
#include "model/scene/node_tree.hpp"

namespace yars::model::scene {

// `bytes` may end behind the header.
failure::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject);

}  // namespace yars::model::scene
