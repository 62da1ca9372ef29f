#include "world/world_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "databuffer/messages/inspection.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"

namespace yars::world {

namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

template <std::size_t size>
void write_name(char (&into)[size], std::string_view name) {
  const std::size_t length = name.copy(into, size - 1);
  std::replace_if(into, into + length, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
}

// Number of entries that a record has room for.
template <class Entry, std::size_t size>
std::uint32_t count_in(const Entry (&)[size], std::size_t configured) {
  return static_cast<std::uint32_t>(std::min(configured, size));
}

std::uint32_t mask_of(const std::vector<double>& channels) {
  std::uint32_t mask = 0;
  for (int channel = 1; channel <= radar::kChannels; ++channel)
    if (std::ranges::find(channels, channel) != channels.end()) mask |= 1U << (channel - 1);
  return mask;
}

std::vector<double> channels_of(std::uint32_t mask) {
  std::vector<double> channels;
  for (int channel = 1; channel <= radar::kChannels; ++channel)
    if ((mask >> (channel - 1) & 1U) != 0U) channels.push_back(channel);
  return channels;
}

// A record, and an entry of a configuration, with the values that people give of the other.
template <class Record, class Configured>
Record record_with_values(const Configured& configured) {
  Record record{};
  record.latitude_deg = configured.position.latitude_deg;
  record.longitude_deg = configured.position.longitude_deg;
  Record::Values::copy(configured, record);
  return record;
}
template <class Configured, class Record>
Configured configured_with_values(const Record& record) {
  Configured configured{};
  configured.position = {record.latitude_deg, record.longitude_deg};
  Record::Values::copy(record, configured);
  if constexpr (requires { record.name; }) configured.name = std::string(text::text_of(record.name));
  return configured;
}

databuffer::WorldRainCell record_of(const radar::RainCell& cell) {
  return record_with_values<databuffer::WorldRainCell>(cell);
}

databuffer::WorldJammer record_of(const radar::Jammer& jammer) {
  auto record = record_with_values<databuffer::WorldJammer>(jammer);
  write_name(record.name, jammer.name);
  record.band = jammer.band;
  record.channels = mask_of(jammer.channels);
  return record;
}

databuffer::WorldMover record_of(const radar::Mover& mover) {
  auto record = record_with_values<databuffer::WorldMover>(mover);
  write_name(record.name, mover.name);
  record.since_ns = std::llround(mover.since.seconds() / kSecondsPerNanosecond);
  return record;
}

databuffer::WorldPoint record_of(const radar::RoutePoint& point) {
  auto record = record_with_values<databuffer::WorldPoint>(point);
  write_name(record.name, point.name);
  record.kind = static_cast<std::uint8_t>(point.kind);
  return record;
}

template <class Entry, std::size_t size, class Configured>
std::uint32_t write_list(Entry (&entries)[size], const Configured& configured) {
  const std::uint32_t count = count_in(entries, configured.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    entries[i] = record_of(configured[i]);
    entries[i].id = i + 1;
  }
  return count;
}

}  // namespace

databuffer::WorldState world_state_from(const radar::WorldConfiguration& world,
                                        std::span<const radar::RoutePoint> route) {
  databuffer::WorldState state{};
  state.flags = databuffer::kWorldConfigured;
  state.sea_state = world.sea.state;
  state.wind_speed_mps = world.sea.wind_speed_mps;
  state.wind_from_deg = world.sea.wind_from_deg;
  state.rain_count = write_list(state.rain, world.rain.cells);
  state.jammer_count = write_list(state.jammers, world.jamming.jammers);
  state.mover_count = write_list(state.movers, world.movers);
  state.point_count = write_list(state.points, route);
  state.last_id = std::max({state.rain_count, state.jammer_count, state.mover_count, state.point_count});
  return state;
}

void apply(const databuffer::WorldState& state, radar::WorldConfiguration& world) {
  world.sea.state = state.sea_state;
  world.sea.wind_speed_mps = state.wind_speed_mps;
  world.sea.wind_from_deg = state.wind_from_deg;
  world.rain.cells.clear();
  for (const databuffer::WorldRainCell& cell : databuffer::used(state.rain, state.rain_count))
    world.rain.cells.push_back(configured_with_values<radar::RainCell>(cell));
  world.jamming.jammers.clear();
  for (const databuffer::WorldJammer& jammer : databuffer::used(state.jammers, state.jammer_count)) {
    radar::Jammer& added = world.jamming.jammers.emplace_back(configured_with_values<radar::Jammer>(jammer));
    added.band = jammer.band;
    added.channels = channels_of(jammer.channels);
  }
  world.movers.clear();
  for (const databuffer::WorldMover& mover : databuffer::used(state.movers, state.mover_count)) {
    radar::Mover& added = world.movers.emplace_back(configured_with_values<radar::Mover>(mover));
    added.since = geo::Duration::seconds(static_cast<double>(mover.since_ns) * kSecondsPerNanosecond);
  }
}

std::vector<radar::RoutePoint> route_of(const databuffer::WorldState& state) {
  std::vector<radar::RoutePoint> route;
  for (const databuffer::WorldPoint& point : databuffer::used(state.points, state.point_count))
    route.emplace_back(configured_with_values<radar::RoutePoint>(point)).kind =
        static_cast<radar::PointKind>(point.kind);
  return route;
}

}  // namespace yars::world
