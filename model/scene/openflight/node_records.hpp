// Records of nodes: the header, levels of detail, switches, matrices, degrees of freedom.
// Inputs: a record; the file's unit of length. Outputs: lengths in metres. A field that is absent or no number counts
// as not given.
// Source: docs/spec/formats.md#openflight.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

// Parses the header record: revision, unit, origin, covered area. A position of exactly 0, 0 counts as absent, because
// some files without a position have 0, 0. `bytes` may end after the header. Errors: not a header record, a revision
// outside 14 to 16.7, an unknown unit.
error::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject);

// Range and centre of a level of detail. Without a range, the level is drawn from everywhere.
LevelOfDetail level_of_detail_of(const Record& record, double metres_per_unit);

// Bits of the current mask of a switch, one for each child; empty: all are shown.
std::vector<std::uint32_t> switch_mask_of(const Record& record);

// The matrix of the node before it; nullopt if a number is NaN or infinite.
std::optional<Transform> matrix_of(const Record& record, double metres_per_unit);

// Current pose of a degree of freedom: scale, then rotation by yaw, roll and pitch, then translation, each along the
// local axes of the record. Points that span no axes give those of the node above. nullopt if points are absent or no
// numbers.
std::optional<Transform> pose_of(const Record& record, double metres_per_unit);

}  // namespace yars::model::scene
