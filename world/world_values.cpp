#include "world/world_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "databuffer/messages/world_lists.hpp"
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

// What an entry has beside its position, name and values, from one shape to the other.
template <class From, class To>
void copy_others(const From& /*from*/, To& /*to*/) {}
void copy_others(const radar::Jammer& configured, databuffer::WorldJammer& record) {
  record.band = configured.band;
  record.channels = mask_of(configured.channels);
}
void copy_others(const databuffer::WorldJammer& record, radar::Jammer& configured) {
  configured.band = record.band;
  configured.channels = channels_of(record.channels);
}
void copy_others(const radar::Mover& configured, databuffer::WorldMover& record) {
  record.since_ns = std::llround(configured.since.seconds() / kSecondsPerNanosecond);
  record.echo = static_cast<std::uint8_t>(configured.echo);
  record.facing_deg = static_cast<std::uint16_t>(configured.facing_deg);
  record.tilt_deg = static_cast<std::int8_t>(configured.tilt_deg);
}
void copy_others(const databuffer::WorldMover& record, radar::Mover& configured) {
  configured.since = geo::Duration::seconds(static_cast<double>(record.since_ns) * kSecondsPerNanosecond);
  configured.echo = static_cast<radar::TargetEcho>(record.echo);
  configured.facing_deg = record.facing_deg;
  configured.tilt_deg = record.tilt_deg;
}
void copy_others(const radar::RoutePoint& configured, databuffer::WorldPoint& record) {
  record.kind = static_cast<std::uint8_t>(configured.kind);
}
void copy_others(const databuffer::WorldPoint& record, radar::RoutePoint& configured) {
  configured.kind = static_cast<radar::PointKind>(record.kind);
}

template <class From, class To>
void copy_values(const From& from, To& to) {
  std::apply([&](const auto&... member) { ((member(to) = member(from)), ...); }, From::Values::members);
  copy_others(from, to);
}

template <class Record, class Configured>
void write_list(databuffer::WorldState& world, const std::vector<Configured>& list) {
  using List = databuffer::ListOf<Record>;
  const std::span<Record> records = List::entries(world);
  std::uint32_t count = 0;
  for (const Configured& configured : std::span(list).first(std::min(list.size(), records.size()))) {
    Record& record = records[count];
    record.latitude_deg = configured.position.latitude_deg;
    record.longitude_deg = configured.position.longitude_deg;
    if constexpr (requires { record.name; }) write_name(record.name, configured.name);
    copy_values(configured, record);
    record.id = ++count;
  }
  List::count(world) = count;
  world.last_id = std::max(world.last_id, count);
}

template <class Record, class Configured>
void read_list(const databuffer::WorldState& world, std::vector<Configured>& list) {
  list.clear();
  for (const Record& record : databuffer::ListOf<Record>::entries_in_use(world)) {
    Configured& configured = list.emplace_back();
    configured.position = {record.latitude_deg, record.longitude_deg};
    if constexpr (requires { record.name; }) configured.name = std::string(text::text_of(record.name));
    copy_values(record, configured);
  }
}

// Calls use(type of the record's entries, list) for each list of a configured world.
template <class World, class Use>
void for_each_configured(World& world, const Use& use) {
  databuffer::for_each_list([&]<class Record>(std::type_identity<Record> record) {
    const auto use_if_same = [&]<class List>(List& list) {
      if constexpr (std::is_same_v<typename List::value_type::Values, typename Record::Values>) use(record, list);
    };
    std::apply([&](auto&... lists) { (use_if_same(lists), ...); }, radar::lists_of(world));
  });
}

}  // namespace

databuffer::WorldState world_state_from(const radar::WorldConfiguration& world,
                                        std::span<const radar::RoutePoint> route) {
  databuffer::WorldState state{};
  state.flags = databuffer::kWorldConfigured;
  state.sea_state = world.sea.state;
  state.wind_speed_mps = world.sea.wind_speed_mps;
  state.wind_from_deg = world.sea.wind_from_deg;
  for_each_configured(
      world, [&]<class Record>(std::type_identity<Record>, const auto& list) { write_list<Record>(state, list); });
  write_list<databuffer::WorldPoint>(state, std::vector(route.begin(), route.end()));
  return state;
}

void apply(const databuffer::WorldState& state, radar::WorldConfiguration& world) {
  world.sea.state = state.sea_state;
  world.sea.wind_speed_mps = state.wind_speed_mps;
  world.sea.wind_from_deg = state.wind_from_deg;
  for_each_configured(world,
                      [&]<class Record>(std::type_identity<Record>, auto& list) { read_list<Record>(state, list); });
}

std::vector<radar::RoutePoint> route_of(const databuffer::WorldState& state) {
  std::vector<radar::RoutePoint> route;
  read_list<databuffer::WorldPoint>(state, route);
  return route;
}

}  // namespace yars::world
