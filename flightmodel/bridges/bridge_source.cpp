#include "flightmodel/bridges/bridge_source.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "flightmodel/bridges/bridge.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::flightmodel::bridges {

std::optional<std::string> RefusalNotes::refused(const std::string& reason, geo::Duration now) {
  ++count_;
  if (written_ && now - *written_ < kRefusalInterval) return std::nullopt;
  const std::uint64_t unreported = count_ - reported_ - 1;
  written_ = now;
  reported_ = count_;
  return unreported == 0 ? reason : reason + " (and " + std::to_string(unreported) + " more refused before)";
}

DisBridge::DisBridge(const std::optional<EntityId>& aircraft, std::optional<std::uint8_t> exercise, geo::Geoid geoid)
    : geoid_(std::move(geoid)),
      exercise_(exercise),
      exercise_is_configured_(exercise.has_value()),
      aircraft_(aircraft),
      configured_(aircraft.has_value()) {
  tell(geoid_.has_data() ? "altitudes are above mean sea level by the geoid " + geoid_.name()
                         : "no grid of a geoid is installed (geographiclib-get-geoids egm96-5): heights above the "
                           "ellipsoid are taken as altitudes above mean sea level, up to 107 m off");
}

error::Expected<std::optional<ExternalSample>> DisBridge::receive(memory::Bytes datagram, geo::Duration now) {
  std::optional<ExternalSample> newest;
  std::optional<error::Error> fault;
  for (const memory::Bytes pdu : pdus_of(datagram)) {
    auto sample = receive_pdu(pdu, now);
    if (!sample && !fault) fault = sample.error();
    if (sample && *sample) newest = **std::move(sample);
  }
  if (!newest && fault) return tl::unexpected(*std::move(fault));
  return newest;
}

// Exercises share networks. PDUs of another one are no fault.
bool DisBridge::is_of_exercise(const EntityState& state, geo::Duration now) {
  if (exercise_ && !exercise_is_configured_ && now - exercise_heard_ > kEntityTimeout) {
    tell("exercise " + std::to_string(*exercise_) + " has been silent for 12 s: the next one heard counts");
    exercise_.reset();
    other_exercises_.reset();
  }
  if (!exercise_) {
    exercise_ = state.exercise;
    tell("exercise " + std::to_string(state.exercise) + ", the first one heard");
  }
  if (state.exercise == *exercise_) {
    exercise_heard_ = now;
    return true;
  }
  if (!other_exercises_[state.exercise])
    tell("exercise " + std::to_string(state.exercise) +
         " is heard too and left out; `exercise=" + std::to_string(state.exercise) + "` in --source chooses it");
  other_exercises_.set(state.exercise);
  return false;
}

error::Expected<std::optional<ExternalSample>> DisBridge::receive_pdu(memory::Bytes pdu, geo::Duration now) {
  if (is_other_pdu(pdu)) return std::nullopt;
  const auto state = decode_entity_state(pdu, geoid_);
  if (!state) return tl::unexpected(state.error());
  if (!is_of_exercise(*state, now)) return std::nullopt;
  if (!configured_ && aircraft_ && now - last_report_ > kEntityTimeout) release_aircraft("has been silent for 12 s");
  const bool flies = state->kind == EntityKind::platform && state->domain == EntityDomain::air;
  if (!aircraft_ && flies && !state->deactivated) {
    aircraft_ = state->id;
    order_ = StampOrder(kDisStampPeriod);
    traffic_.forget(state->id);
    tell("the aircraft is entity " + text_of(state->id) + ", the first air platform received");
  }
  if (state->id != aircraft_) {
    if (const auto reason = traffic_.update(*state, now)) return error::fail("dis", "traffic without fault", *reason);
    return std::nullopt;
  }
  if (const auto reason = state->stamp ? order_.order_fault(*state->stamp) : std::nullopt)
    return error::fail("dis", "a newer report", *reason);
  last_report_ = now;
  if (state->deactivated) {
    if (!configured_) release_aircraft("was deactivated");
    return std::nullopt;
  }
  if (!state->frozen) return state->sample;
  ExternalSample sample{state->sample.ownship, AttitudeRates{}, geo::Vector3{}};
  sample.ownship.velocity_north_mps = sample.ownship.velocity_east_mps = sample.ownship.velocity_down_mps = 0.0;
  return sample;
}

void DisBridge::tell(const std::string& news) {
  log_message_ = log_message_ ? *log_message_ + "; " + news : news;
}

void DisBridge::release_aircraft(std::string_view why) {
  tell("entity " + text_of(*aircraft_) + " " + std::string(why) +
       ": the next air platform received becomes the aircraft");
  aircraft_.reset();
}

std::optional<std::string> DisBridge::take_log_message() {
  return std::exchange(log_message_, std::nullopt);
}

namespace {

using error::Expected;

constexpr std::string_view kDefaultHost = "127.0.0.1";

tl::unexpected<error::Error> bad_usage(std::string_view expected, std::string_view found) {
  return tl::unexpected(error::usage_error("--source", std::string(expected), '"' + std::string(found) + '"'));
}

struct Text {
  std::string_view whole, kind, address, rest;  // KIND:ADDRESS,REST
};

Text parts_of(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view after = text.substr(std::min(colon + 1, text.size()));
  const std::size_t comma = std::min(after.find(','), after.size());
  return {text, text.substr(0, colon), after.substr(0, comma), after.substr(std::min(comma + 1, after.size()))};
}

Expected<BridgeSource> parse_address(const Text& text, std::string_view form, bool requests_data) {
  const std::size_t colon = text.address.rfind(':');
  const bool has_host = colon != std::string_view::npos && !text.address.ends_with(']');
  const auto port = text::whole_number<std::uint16_t>(has_host ? text.address.substr(colon + 1) : text.address);
  std::string_view host = has_host ? text.address.substr(0, colon) : kDefaultHost;
  const bool in_brackets = host.starts_with('[') && host.ends_with(']');
  if (in_brackets) host = host.substr(1, host.size() - 2);
  if (host.find_first_of("[]") != std::string_view::npos || (!in_brackets && host.find(':') != std::string_view::npos))
    return bad_usage(std::string(form) + ", an IPv6 address in brackets", text.whole);
  if (!port || host.empty() || (requests_data && (!has_host || *port == 0))) return bad_usage(form, text.whole);
  return BridgeSource{nullptr, std::string(text.kind), std::string(host), *port, requests_data};
}

class FlightgearBridge final : public Bridge {
 public:
  Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration) override {
    auto sample = decode_flightgear(datagram);
    if (!sample) return tl::unexpected(std::move(sample.error()));
    return *std::move(sample);
  }
};

Expected<BridgeSource> open_flightgear(const Text& text) {
  constexpr std::string_view kForm = "flightgear:[HOST:]PORT";
  auto source = parse_address(text, kForm, false);
  if (!source) return source;
  if (!text.rest.empty()) return bad_usage(kForm, text.whole);
  source->bridge = std::make_unique<FlightgearBridge>();
  return source;
}

Expected<BridgeSource> open_jsbsim(const Text& text) {
  auto source = parse_address(text, "jsbsim:[HOST:]PORT[,COLUMN,COLUMN...]", false);
  if (!source) return source;
  std::optional<JsbsimColumns> columns;
  if (!text.rest.empty()) {
    auto parsed = parse_jsbsim_labels("<LABELS>," + std::string(text.rest));
    if (!parsed) return tl::unexpected(error::usage_error(parsed.error()));
    columns = *parsed;
  }
  source->bridge = std::make_unique<JsbsimBridge>(columns);
  return source;
}

Expected<BridgeSource> open_xplane(const Text& text) {
  constexpr std::string_view kForm = "xplane:HOST:PORT; X-Plane listens on port 49000";
  auto source = parse_address(text, kForm, true);
  if (!source) return source;
  if (!text.rest.empty()) return bad_usage(kForm, text.whole);
  source->bridge = std::make_unique<XplaneBridge>();
  return source;
}

Expected<BridgeSource> open_dis(const Text& text) {
  constexpr std::string_view kForm =
      "dis:[HOST:]PORT[,SITE,APP,ENTITY][,exercise=N], each number 0 to 65535, the exercise to 255";
  auto source = parse_address(text, kForm, false);
  if (!source) return source;
  auto fields = text.rest.empty() ? std::vector<std::string_view>() : text::fields_of(text.rest, ',');
  std::optional<std::uint8_t> exercise;
  constexpr std::string_view kExercise = "exercise=";
  if (!fields.empty() && fields.back().starts_with(kExercise)) {
    exercise = text::whole_number<std::uint8_t>(fields.back().substr(kExercise.size()));
    if (!exercise) return bad_usage(kForm, text.whole);
    fields.pop_back();
  }
  std::optional<EntityId> aircraft;
  if (!fields.empty()) {
    if (fields.size() != 3) return bad_usage(kForm, text.whole);
    const auto site = text::whole_number<std::uint16_t>(fields[0]),
               application = text::whole_number<std::uint16_t>(fields[1]),
               entity = text::whole_number<std::uint16_t>(fields[2]);
    if (!site || !application || !entity) return bad_usage(kForm, text.whole);
    aircraft = EntityId{*site, *application, *entity};
  }
  source->bridge = std::make_unique<DisBridge>(aircraft, exercise, geo::Geoid());
  return source;
}

}  // namespace

bool names_bridge(std::string_view text) {
  const std::string_view kind = parts_of(text).kind;
  return kind == "flightgear" || kind == "jsbsim" || kind == "xplane" || kind == "dis";
}

Expected<BridgeSource> open_bridge(std::string_view text) {
  const Text parts = parts_of(text);
  if (parts.kind == "flightgear") return open_flightgear(parts);
  if (parts.kind == "jsbsim") return open_jsbsim(parts);
  if (parts.kind == "xplane") return open_xplane(parts);
  if (parts.kind == "dis") return open_dis(parts);
  return bad_usage("flightgear:PORT, jsbsim:PORT, xplane:HOST:PORT or dis:PORT", text);
}

}  // namespace yars::flightmodel::bridges
