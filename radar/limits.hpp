// Errors inside the library: fail() throws a Failure, and guarded() turns it into the error of a public function.
// Limits of the requests, and of the radar for a scan and a patch map.
// Errors: check_fields() throws Failure; the beyond_... and beneath_... functions return an Error if a limit is
// exceeded, else nullopt. Messages name fields of requests.idl in backquotes, with a value as `heading_deg=45`;
// spelled() puts the words of a command line or of keywords there.
// Source: lib/radar/mission.hpp (limits of maps).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/mission.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "model/hrm/patch_geometry.hpp"

namespace yars::radar {

struct Failure {
  Error error;
};

[[noreturn]] inline void fail(Error error) {
  throw Failure{std::move(error)};
}

// Returns the result of call(), or the error that it has thrown.
template <class Function>
auto guarded(const Function& call) -> Expected<std::invoke_result_t<Function>> {
  const text::DecimalPoint numbers;  // in GUF, messages and names, whatever the caller's locale has
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Function>>) {
      call();
      return {};
    } else {
      return call();
    }
  } catch (const Failure& failure) {
    return tl::unexpected(failure.error);
  } catch (const parallel::Stopped&) {
    return tl::unexpected(Error{"", "a call that goes on", "one that was ended", "", ErrorCode::cancelled, {}, {}});
  }
}

struct AntennaConfiguration;

// The error of a number beyond the limits of a field. `subject`: the field's name, or the path of an entry.
Error beyond_field(std::string subject, const values::Field& field, double found);
// Throws Failure if a field of a request lies beyond its limits.
template <class Request>
void check_fields(const Request& request) {
  values::visit_fields(request, [](const values::Field& field, const auto& value) {
    std::optional<double> found;
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
      found = static_cast<double>(value);
    else if constexpr (requires { value.has_value(); })
      if (value) found = static_cast<double>(*value);
    if (found && !field.contains(*found)) fail(beyond_field(std::string(field.name), field, *found));
  });
}

// Limits of a patch map in level flight along the ground track, by radar::map_rejection(). `target_ground_m` [m] MSL:
// terrain elevation at the map's centre; NaN: void, counts as sea level; nullopt: not known yet, so the elevation angle
// to the target is not checked.
std::optional<Error> beyond_limits(const model::hrm::PatchOrder& order, const MapLimits& limits,
                                   std::optional<double> target_ground_m = std::nullopt);

// Gimbal limits of a scan centred on the nose, in level flight: antenna elevation above the horizontal, and scan width
// from edge to edge.
std::optional<Error> beyond_gimbal(geo::Angle elevation, geo::Angle width, const AntennaConfiguration& antenna);

// `ground_m` [m] MSL: terrain elevation below the aircraft; NaN: void, which is not checked.
std::optional<Error> beneath_ground(geo::AltitudeMsl altitude, double ground_m);

// An error with other words for the fields of requests that it names. spell(field, value): value is empty where none is
// given. Requests spell a field alike.
using Spell = std::function<std::string(const values::Field& field, std::string_view value)>;
Error spelled(Error error, const Spell& spell);

}  // namespace yars::radar
