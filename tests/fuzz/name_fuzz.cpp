// Any text as the name of a cell file, of a scene file with its position, and of a session. Positions are in range, and
// names that are not allowed open no session.
#include <cmath>
#include <cstdint>
#include <string>

#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/world.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/terrain/store/cell_files.hpp"

using namespace yars;

namespace {

void require_place(double latitude_deg, double longitude_deg) {
  YARS_REQUIRE(std::abs(latitude_deg), <=, 90.0);
  YARS_REQUIRE(std::abs(longitude_deg), <=, 180.0);
}

// Requires that a name that is not allowed opens no session.
void try_session(const std::string& name) {
  const bool allowed =
      !name.empty() && name.size() <= 40 &&
      name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
  if (allowed) return;
  YARS_REQUIRE(databuffer::Session::open(name, "fuzz").has_value(), ==, false);
  YARS_REQUIRE(databuffer::Session::open_read_only(name).has_value(), ==, false);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string file = text.substr(std::min(slash + 1, text.size()));
  if (const auto named = model::terrain::cell_named(text.substr(0, slash), file)) {
    require_place(named->corner.south_deg + 0.5, named->corner.west_deg + 0.5);
    YARS_REQUIRE(named->level, <=, 2);
  }
  if (const auto position = model::scene::position_in_name(text))
    require_place(position->latitude_deg, position->longitude_deg);
  const auto scene = model::scene::parse_scene(text);
  if (scene && std::isfinite(scene->position.latitude_deg))
    require_place(scene->position.latitude_deg, scene->position.longitude_deg);
  try_session(text);
  return 0;
}
