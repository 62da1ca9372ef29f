#include "world/world_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "databuffer/messages/inspection.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::world {

namespace {

constexpr int kChannels = 8;
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
  for (int channel = 1; channel <= kChannels; ++channel)
    if (std::ranges::find(channels, channel) != channels.end()) mask |= 1U << (channel - 1);
  return mask;
}

std::vector<double> channels_of(std::uint32_t mask) {
  std::vector<double> channels;
  for (int channel = 1; channel <= kChannels; ++channel)
    if ((mask >> (channel - 1) & 1U) != 0U) channels.push_back(channel);
  return channels;
}

databuffer::WorldRainCell record_of(const radar::RainCell& cell) {
  databuffer::WorldRainCell record{};
  record.latitude_deg = cell.position.latitude_deg;
  record.longitude_deg = cell.position.longitude_deg;
  record.radius_m = cell.radius_m;
  record.rate_mmh = cell.rate_mmh;
  record.top_m = cell.top_m;
  return record;
}

databuffer::WorldJammer record_of(const radar::Jammer& jammer) {
  databuffer::WorldJammer record{};
  write_name(record.name, jammer.name);
  record.latitude_deg = jammer.position.latitude_deg;
  record.longitude_deg = jammer.position.longitude_deg;
  record.altitude_m = jammer.altitude_m;
  record.power_w = jammer.power_w;
  record.band = jammer.band;
  record.channels = mask_of(jammer.channels);
  return record;
}

databuffer::WorldMover record_of(const radar::Mover& mover) {
  databuffer::WorldMover record{};
  write_name(record.name, mover.name);
  record.latitude_deg = mover.position.latitude_deg;
  record.longitude_deg = mover.position.longitude_deg;
  record.since_ns = std::llround(mover.since.seconds() / kSecondsPerNanosecond);
  record.speed_mps = mover.speed_mps;
  record.heading_deg = mover.heading_deg;
  record.cross_section_m2 = mover.cross_section_m2;
  record.height_m = mover.height_m;
  return record;
}

databuffer::WorldPoint record_of(const radar::RoutePoint& point) {
  databuffer::WorldPoint record{};
  write_name(record.name, point.name);
  record.latitude_deg = point.position.latitude_deg;
  record.longitude_deg = point.position.longitude_deg;
  record.elevation_m = point.elevation_m;
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
  static_assert(databuffer::kMaxWorldPoints == radar::kMaxRoutePoints);
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
    world.rain.cells.push_back({.position = {cell.latitude_deg, cell.longitude_deg},
                                .radius_m = cell.radius_m,
                                .rate_mmh = cell.rate_mmh,
                                .top_m = cell.top_m});
  world.jamming.jammers.clear();
  for (const databuffer::WorldJammer& jammer : databuffer::used(state.jammers, state.jammer_count))
    world.jamming.jammers.push_back({.name = std::string(text::text_of(jammer.name)),
                                     .position = {jammer.latitude_deg, jammer.longitude_deg},
                                     .altitude_m = jammer.altitude_m,
                                     .band = jammer.band,
                                     .channels = channels_of(jammer.channels),
                                     .power_w = jammer.power_w});
  world.movers.clear();
  for (const databuffer::WorldMover& mover : databuffer::used(state.movers, state.mover_count))
    world.movers.push_back(
        {.name = std::string(text::text_of(mover.name)),
         .position = {mover.latitude_deg, mover.longitude_deg},
         .speed_mps = mover.speed_mps,
         .heading_deg = mover.heading_deg,
         .cross_section_m2 = mover.cross_section_m2,
         .height_m = mover.height_m,
         .since = geo::Duration::seconds(static_cast<double>(mover.since_ns) * kSecondsPerNanosecond)});
}

std::vector<radar::RoutePoint> route_of(const databuffer::WorldState& state) {
  std::vector<radar::RoutePoint> route;
  for (const databuffer::WorldPoint& point : databuffer::used(state.points, state.point_count))
    route.push_back({.name = std::string(text::text_of(point.name)),
                     .kind = static_cast<radar::PointKind>(point.kind),
                     .position = {point.latitude_deg, point.longitude_deg},
                     .elevation_m = point.elevation_m});
  return route;
}

}  // namespace yars::world
