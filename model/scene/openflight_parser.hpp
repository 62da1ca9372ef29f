// Reads the records of one OpenFlight file, revisions 14 to 16.5, into a tree; opens no other file. Skipped: textures,
// lights, sounds, extensions, switches' other masks, transforms 76-82 and 94 (record 49 holds their product). Wireframe
// and light faces are no surfaces; hidden ones are counted and left out. Errors: no header, a foreign revision or unit,
// torn records, more pops than pushes, corners outside their pool, and the limits below.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lib/failure/error.hpp"
#include "model/scene/node_tree.hpp"

namespace yars::model::scene {

inline constexpr std::size_t kDeepestPush = 512;      // levels of records; deeper ones are damage
inline constexpr std::size_t kMostNodes = 4'000'000;  // bounds on memory: about 0.5, 0.8 and 2.6 GB
inline constexpr std::size_t kMostFaces = 32'000'000;
inline constexpr std::size_t kMostVertices = 64'000'000;

// `subject` names the file in errors.
failure::Expected<NodeTree> parse_openflight(std::span<const std::byte> bytes, const std::string& subject);

}  // namespace yars::model::scene
