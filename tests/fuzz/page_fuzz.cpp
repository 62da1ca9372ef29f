// Any text as what a browser sends: a message of a page, a path, a header. Each gets an answer; events and worlds that
// come of it are valid.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>

#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/world.hpp"
#include "station/access.hpp"
#include "station/instructor_map.hpp"
#include "station/instructor_message.hpp"
#include "station/page_message.hpp"
#include "world/world_edit.hpp"
#include "world/world_values.hpp"

using namespace yars;

namespace {

station::AccessRules rules() {
  station::AccessRules rules;
  rules.port = 8096;
  rules.names = {"radar.example"};
  rules.instructor_token = "an instructor's token";
  rules.viewer_token = "the token of a viewer";
  return rules;
}

// A world with an entry in each list, so that a message can find one.
databuffer::WorldState small_world() {
  databuffer::WorldState world = world::world_state_from(radar::WorldConfiguration());
  for (std::size_t list = 0; list < databuffer::kWorldLists.size(); ++list) {
    const auto entry = world::default_entry(world, static_cast<world::WorldList>(list), {37.0, -122.0}, 0);
    YARS_REQUIRE(entry && world::add(world, *entry), ==, true);
  }
  return world;
}

void take_message(std::string_view text) {
  station::PagePilot pilot;
  if (const auto events = pilot.events_of(text))
    for (const databuffer::InputEvent& event : *events)
      YARS_REQUIRE(databuffer::validate(event).has_value(), ==, false);
  pilot.release_all();
  const auto object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object()) return;
  const auto message = station::instructor_message(object);
  if (!message) {
    const std::string answer = station::answer_to(1, message.error().message());
    YARS_REQUIRE(nlohmann::json::accept(answer), ==, true);
    return;
  }
  if (const auto* edit = std::get_if<station::EditWorld>(&message->command))
    if (const auto world = edit->edit(small_world(), 5'000'000'000))
      YARS_REQUIRE(databuffer::validate(*world).has_value(), ==, false);
}

void take_request(std::string_view text) {
  const std::string file = station::file_of_path(text);
  YARS_REQUIRE(file.find('/'), ==, std::string::npos);
  if (const auto tile = station::tile_of_path(text)) {
    const auto frame = station::frame_of(*tile);
    YARS_REQUIRE(frame.south_deg >= -90.0 && frame.north_deg <= 90.0, ==, true);
  }
  if (const auto value = station::parameter_of(text, "session")) YARS_REQUIRE(value->empty(), ==, false);
  station::right_of_cookies(text, rules());
  station::is_allowed_host(text, rules());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  take_message(text);
  take_request(text);
  return 0;
}
