// Modes and switch positions with their numbers in records, sizes of arrays in records, names of sequence points; rules
// of a route of such points: which names go together, the kind of a name, and initial points.
// Inputs: a number from a record; the name of a sequence point; names of points and their kinds.
// Outputs: texts for legends; the number and offset in a sequence point's name; the order of the names; kinds,
//   conflicts, the position of an initial point.
// Errors: "?" for a number outside its enumeration; std::nullopt for a text that is no name of a sequence point.
// Compatibility: a changed enumerator changes the meaning of records. A changed size changes the layout of the segment
// and of recordings.
// Source: docs/pilots_manual.md#rule-11. Abbreviations: docs/glossary.md#cockpit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lib/values/defaults.hpp"

namespace yars::radar {

// Value of a slot that a configuration does not set.
inline constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

// Sizes of arrays in records, numbers of sequence points, and the duration of a tick.
inline constexpr int kMaxSamples = 4096;                         // maximum number of samples of a sweep
inline constexpr int kBezelButtons = 20;                         // buttons around the display
inline constexpr int kMaxPointsDrawn = 8;                        // sequence points in a record; state-machine uses five
inline constexpr int kMaxRoutePoints = values::kMaxWorldPoints;  // sequence points of a route, offsets included
inline constexpr int kMaxPointNumber = 100;                      // largest number of a sequence point
inline constexpr int kMaxPointOffset = 99;                       // largest offset of a target; other points have 1 to 9
inline constexpr std::int64_t kTickNanoseconds = 5'000'000;      // [ns] tick of all programs, in sim time
inline constexpr double kTickSeconds = 0.005;                    // [s] kTickNanoseconds in seconds

enum class Power : std::uint8_t { off = 0, standby = 1, operate = 2 };
enum class Mode : std::uint8_t {
  rbm = 0,
  hrm = 1,
  patch = 2,
  beacon = 3,
  pvu = 4,
  air_to_air = 5,
  ranging = 6,
  menu = 7
};
enum class Master : std::uint8_t { air_to_ground = 0, air_to_air = 1, ranging = 2 };
enum class ScanWidth : std::uint8_t { full = 0, half = 1, quarter = 2 };
enum class CursorFunction : std::uint8_t { map = 0, update = 1, cue = 2, target = 3, mark = 4 };
enum class Navigator : std::uint8_t { mission = 0, ins = 1 };
enum class PointKind : std::uint8_t { steer = 0, initial = 1, target = 2, steer_offset = 3, target_offset = 4 };
// Echo of a mover: fluctuating as Swerling's cases 1 or 3 with `noise`, else steady; or a corner reflector's.
enum class TargetEcho : std::uint8_t { swerling1 = 0, steady = 1, swerling3 = 2, trihedral = 3, dihedral = 4 };
enum class Recall : std::uint8_t { none = 0, newest = 1, old = 2, store = 3 };

// Settings of a configuration.
enum class EarthModel : std::uint8_t { flat = 0, sphere = 1, ellipsoid = 2 };
enum class BeamPattern : std::uint8_t { hard_edge = 0, gaussian = 1, cosecant_squared = 2, mapping = 3 };
enum class Interpolation : std::uint8_t { nearest = 0, bilinear = 1, cubic = 2 };
enum class Algorithm : std::uint8_t { standard = 0, reference = 1, report_1996 = 2 };
enum class SeaModel : std::uint8_t { nrl = 0, nathanson = 1 };
enum class Polarization : std::uint8_t { horizontal = 0, vertical = 1 };

// Height reference of a polygonal scene. ground: each object stands on the terrain below its centre, and flat faces
// follow the terrain. anchor: the whole scene stands on the terrain at the scene's origin. sea_level: heights are above
// mean sea level.
enum class SceneHeights : std::uint8_t { ground = 0, anchor = 1, sea_level = 2 };

// Surface materials have the codes of DFAD (Digital Feature Analysis Data). Code 0 is land without culture.
inline constexpr int kMaterials = 32;     // codes 0 to 31
inline constexpr int kWaterMaterial = 6;  // material code of water, which has the return of the sea

// Texts of the legends and of `yars watch`: "OPR", "RBM", "AG", "FULL", "MAP", "MN". "?" for an unknown number.
std::string_view name_of(Power power);
std::string_view name_of(Mode mode);
std::string_view name_of(Master master);
std::string_view name_of(ScanWidth scan);
std::string_view name_of(CursorFunction function);
std::string_view name_of(Navigator navigator);

// Number and offset in the name of a sequence point. "7." with a dot is a target. "7" without a dot is a steer point or
// an initial point. "7.1" to "7.9" are offsets of that point. "7.01" to "7.99" are offsets of a target.
// Numbers are 1 to 100.
// Source: docs/pilots_manual.md#rule-11.
struct PointName {
  int number = 0;       // 1 to 100
  int offset = 0;       // 1 to 99; 0 = the point itself
  bool target = false;  // a target, or a target offset
  friend bool operator==(const PointName&, const PointName&) = default;
};

// Number and offset in a name; nullopt: the text is no name of a sequence point.
std::optional<PointName> point_name(std::string_view text);

// The name as a text: "2", "2.", "2.1" or "2.01".
std::string text_of(const PointName& name);

// True if `left` comes before `right` when the pilot steps through the points: by number, a point before its offsets.
// Texts that are no names come last, in alphabetical order.
bool precedes(std::string_view left, std::string_view right);

// Words for the kinds, in the order of PointKind.
inline constexpr std::array<std::string_view, 5> kPointKindNames{"steer", "initial", "target", "steer-offset",
                                                                 "target-offset"};

// Words for the echoes, in the order of TargetEcho.
inline constexpr std::array<std::string_view, 5> kTargetEchoNames{"swerling1", "steady", "swerling3", "trihedral",
                                                                  "dihedral"};

constexpr bool is_reflector(TargetEcho echo) {
  return echo == TargetEcho::trihedral || echo == TargetEcho::dihedral;
}

struct NamedPoint {
  PointName name;
  PointKind kind = PointKind::steer;
};

// Kind of a point that has this name and no stated kind. A steer point may become an initial point.
PointKind kind_by_name(const PointName& name);

// True if a point with this name can be of this kind: the one of kind_by_name(), or initial instead of steer.
bool is_kind_of(PointKind kind, const PointName& name);

// Point of the route because of which a new point cannot have this name: it has the name already, or both are no
// offsets and have the same number. nullptr: the name is free.
const NamedPoint* conflict(const PointName& name, std::span<const NamedPoint> route);

// Index of the point that becomes the initial point of a target with this number: the last steer point between the
// target before it and the target, by number. nullopt: there is none, or an initial point lies between them.
std::optional<std::size_t> initial_point_before(int target_number, std::span<const NamedPoint> route);

}  // namespace yars::radar
