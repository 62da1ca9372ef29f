// Which faces of a scene are walls and which lie on the ground: one rule for whoever looks at them.
#pragma once

namespace yars::model::scene {

inline constexpr double kLevelNormal = 0.98;  // upward part of a unit normal that is level
inline constexpr double kOnGround_m = 0.5;    // above its object's base a level face lies on the ground
inline constexpr double kNearGround_m = 2.0;  // the same against terrain
// Steeper than 70 degrees a face is a wall: square of the upward part of its normal against the level part.
inline constexpr double kWallNormal2 = 0.13;

}  // namespace yars::model::scene
