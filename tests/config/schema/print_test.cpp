// Tests of printed configurations: they read back equal. Also compares the APG-70 files of config/ with the built-in
// defaults, and the tables in docs/configuration/ with the printer's.
#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "config/schema/schema.hpp"
#include "config/schema/slot_text.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using testing::fields;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::loaded;

LoadedConfiguration loaded_file(const std::string& name) {
  const auto configuration = load_configuration(std::string(YARS_SOURCE_DIR) + "/config/" + name);
  EXPECT_TRUE(configuration) << configuration.error().message();
  return configuration ? *configuration : LoadedConfiguration{};
}

TEST(Defaults, AnEmptyPathIsTheBuiltInConfiguration) {
  const auto configuration = load_configuration("");
  ASSERT_TRUE(configuration);
  EXPECT_EQ(fields(configuration->radar), fields(radar::RadarConfiguration{}));
}

TEST(Defaults, EqualTheFilesOfTheApg70) {
  for (const char* name : {"apg70.guf", "apg70nd.guf", "apg70d.guf"}) {
    const auto configuration = loaded_file(name);
    EXPECT_EQ(fields(configuration.radar), fields(radar::RadarConfiguration{})) << name;
    EXPECT_THAT(configuration.warnings, IsEmpty()) << name;
  }
}

std::string text_of_file(const std::string& name) {
  std::ifstream file(std::string(YARS_SOURCE_DIR) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

// EqualTheFilesOfTheApg70 would also pass with files that set no slot.
TEST(Defaults, AreWrittenOutSlotBySlotInTheFiles) {
  const std::string text =
      text_of_file("config/apg70nd.guf") + text_of_file("config/apg70d.guf") + text_of_file("config/network.guf");
  int slots = 0;
  const BuilderPointer builder = new_builder();
  ConfigurationBuilder& draft = *builder;
  for (const FormSchema& form : schema()) {
    for (const SlotSchema& slot : form.slots) {
      if (form.part_of_value || !slot.same_as.empty() || slot_text(draft, slot).empty()) continue;
      ++slots;
      EXPECT_THAT(text, HasSubstr(std::string(":").append(slot.name) + " ")) << form.name;
    }
  }
  EXPECT_GT(slots, 30);
}

TEST(Print, OfTheDefaultsReadsBackEqual) {
  const radar::RadarConfiguration defaults;
  for (const std::string& text : {print_configuration(defaults), print_explained(defaults)}) {
    const auto again = loaded(text);
    EXPECT_EQ(fields(again.radar), fields(defaults));
    EXPECT_THAT(again.warnings, IsEmpty());
  }
}

class RandomConfiguration {
 public:
  explicit RandomConfiguration(std::uint64_t seed) : random_(seed) {}

  radar::RadarConfiguration make() {
    radar::RadarConfiguration made;
    made.name = "radar \"" + std::to_string(random_()) + "\"\\\n";
    made.ranges_nm = ascending(0.1, 500.0);
    made.windows_nm = ascending(0.1, 500.0);
    made.window_limits = limits_of(made.windows_nm);
    made.height_ranges.heights_ft = ascending(0.0, 100'000.0);
    made.height_ranges.heights_ft.resize(std::min<std::size_t>(made.height_ranges.heights_ft.size(), 15));
    made.height_ranges.ranges_nm.clear();
    for (std::size_t i = 0; i <= made.height_ranges.heights_ft.size(); ++i)
      made.height_ranges.ranges_nm.push_back(5.0 * double(i + 1) + number(0, 4));
    made.pulse_us = ascending(0.01, 100.0);
    made.scan_widths_deg = {number(70, 100), number(40, 70), number(1, 40)};
    made.antenna = {number(1, 1000),  number(1, 1000),        number(50, 180), number(1, 90),
                    number(0.001, 5), number(0, 60),          number(0.1, 30), number(0.1, 30),
                    coin(),           1 + int(random_() % 4), number(-50, 50), 0.0};
    made.antenna.start_elevation_deg = number(-1, 1) * made.antenna.elevation_limit_deg;
    made.view = {number(-4, 0), number(0, 4), number(-4, 0), number(0, 4), 64 + int(random_() % 4000), {}, {}};
    if (coin()) made.view.arc_spacing_nm = ascending(1.0, 40.0);
    made.view.colors = {radar::ColorPreset(random_() % 3), color(), color(), color()};
    made.fidelity = fidelity();
    made.receiver = {number(1, 40), number(0, 6),    coin(),          number(10, 120),
                     number(0, 40), number(-120, 0), number(-60, 20), 1 + int(random_() % 16)};
    made.terrain = {coin() ? "" : "/data/de\"d", coin()};
    made.seed = random_() >> 11U;  // below 2^53, the range of the slot
    made.magnetic_variation_deg = number(-180, 180);
    made.navigation = navigation();
    made.route = route();
    made.world = world();
    if (made.world.sea.model == radar::SeaModel::nathanson) made.receiver.frequency_ghz = number(8, 12);
    return made;
  }

 private:
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  bool coin() { return (random_() & 1U) != 0; }

  radar::Rgb color() { return {number(0, 1), number(0, 1), number(0, 1)}; }

  radar::WindowLimits limits_of(const std::vector<double>& windows_nm) {
    radar::WindowLimits made;
    made.windows_nm = windows_nm;
    made.min_range_nm.clear();
    made.max_range_nm.clear();
    for (std::size_t i = 0; i < windows_nm.size(); ++i) {
      made.min_range_nm.push_back(number(0, 100));
      made.max_range_nm.push_back(made.min_range_nm.back() + number(1, 100));
    }
    made.blank_min_range_nm = number(0, 10);
    made.blank_windows_nm = {windows_nm.back(), windows_nm.front()};
    made.blank_max_range_nm = {number(10, 20), number(20, 200)};
    made.power_up_nm = number(0.1, 100);
    return made;
  }

  std::vector<double> ascending(double low, double high) {
    std::vector<double> numbers(1 + random_() % 16);
    for (double& one : numbers) one = number(low, high);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }

  radar::Fidelity fidelity() {
    auto made = *radar::fidelity_preset(radar::fidelity_names()[random_() % radar::fidelity_names().size()]);
    made.earth = static_cast<radar::EarthModel>(random_() % 3);
    made.beam = static_cast<radar::BeamPattern>(random_() % 3);
    made.algorithm = static_cast<radar::Algorithm>(random_() % 2);
    if (coin()) made.earth_radius_factor = number(0.5, 10);
    made.samples = 1 + int(random_() % 4096);
    made.geodesic_knots = int(random_() % 10);
    made.interpolation = static_cast<radar::Interpolation>(random_() % 3);
    made.posts_per_sample = number(0, 100);
    made.sub_beams = 1 + int(random_() % 15);
    made.automatic = coin();
    made.core_share = number(0.001, 1);
    made.slant_range = coin();
    made.diffraction = coin();
    made.sea_lobes = coin();
    made.noise = coin();
    made.azimuth_smear = coin();
    made.pulse_smear = coin();
    made.map_noise = number(0, 1);
    made.map_smooth_ground = coin();
    return made;
  }

  geo::GeoPoint position() { return {number(-90, 90), number(-180, 180)}; }
  std::vector<double> five_numbers() { return {number(-200, 200), number(-200, 200), 0, 1, number(-1, 1)}; }

  radar::NavigationConfiguration navigation() {
    const auto feet = [this](double low, double high) { return number(low, high) * 0.3048; };
    return {feet(-6e5, 6e5),
            feet(-6e5, 6e5),
            feet(-1e3, 1e3),
            feet(-1e3, 1e3),
            feet(-1e3, 1e3),
            feet(0, 1e3),
            number(1, 3600),
            number(5, 3600),
            feet(0, 100),
            coin() ? "" : "wmm2020",
            coin() ? "" : "/data/field",
            number(1900, 2100),
            {-20, 20, 0},
            {20, 20, number(40, 60)},
            number(0.05, 10.0)};
  }

  // Lengths and speeds are converted from the units of a file: feet, nautical miles, knots. Optional values are missing
  // at random.
  radar::WorldConfiguration world() {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    radar::WorldConfiguration made;
    radar::LandConfiguration& land = made.land;
    land.frequency_slope_db = number(-20, 20);
    land.reference_frequency_ghz = number(1, 40);
    land.cardinal_width_deg = number(0.1, 45);
    land.texture = number(0, 100);
    land.materials[1 + random_() % 9].gamma_db = number(-60, 30);
    if (coin()) land.materials.push_back({31, "kelp", number(-60, 30), number(0, 30), number(0, 100)});
    made.sea = {coin() ? kUnknown : number(0, 6),
                number(0, 120) * (1852.0 / 3600.0),
                number(0, 360),
                radar::Polarization(random_() % 2),
                five_numbers(),
                five_numbers(),
                number(0, 2),
                coin() ? kUnknown : number(0, 100),
                radar::SeaModel(random_() % 2),
                number(0, 3600),
                coin()};
    made.rain = {number(0, 2000),
                 number(0.5, 3),
                 number(0, 1),
                 coin() ? kUnknown : number(0, 10),
                 coin() ? kUnknown : number(0.5, 3),
                 {}};
    made.jamming = {number(0, 120), number(-80, 0), {}};
    for (std::size_t i = random_() % 4; i > 0; --i) {
      made.rain.cells.push_back(
          {position(), number(0.1, 100) * 1852.0, number(0.1, 300), number(500, 60'000) * 0.3048});
      made.jamming.jammers.push_back({"J",
                                      position(),
                                      coin() ? kUnknown : number(0, 90'000) * 0.3048,
                                      static_cast<int>(random_() % 6) - 1,
                                      {1, 7},
                                      number(0, 1e9)});
      made.movers.push_back({"M", position(), number(0, 1000) * (1852.0 / 3600.0), number(0, 360), number(0, 1e7),
                             number(0, 1000) * 0.3048});
      made.scenes.push_back({"/s.flt", coin() ? position() : radar::Scene{}.position, number(-360, 360),
                             static_cast<radar::SceneHeights>(random_() % 3), coin() ? "box, env*" : ""});
      made.beacons.code = static_cast<int>(1 + random_() % 99);
      made.beacons.beacons.push_back({"B", position(), coin() ? kUnknown : number(0, 90'000) * 0.3048,
                                      static_cast<int>(1 + random_() % 99), number(0, 1000),
                                      static_cast<int>(2 + random_() % 5), number(0.1, 1000), number(0, 1e9)});
    }
    return made;
  }

  // Elevations are converted from feet, the unit of a file; every third is unknown.
  std::vector<radar::RoutePoint> route() {
    std::vector<radar::RoutePoint> points;
    const std::size_t count = random_() % 9;
    for (std::size_t i = 0; i < count; ++i) {
      radar::RoutePoint point;
      point.name = std::to_string(i + 1) + (coin() ? "." : "");
      const bool target = point.name.back() == '.';
      point.kind = target ? radar::PointKind::target : coin() ? radar::PointKind::steer : radar::PointKind::initial;
      point.position = {number(-90, 90), number(-180, 180)};
      point.elevation_m = i % 3 == 2 ? std::numeric_limits<double>::quiet_NaN() : number(-1500, 30'000) * 0.3048;
      points.push_back(point);
    }
    return points;
  }

  std::mt19937_64 random_;
};

TEST(Print, OfRandomConfigurationsReadsBackEqual) {
  const std::uint64_t seed = 70;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomConfiguration random(seed);
  for (int i = 0; i < 200; ++i) {
    const auto made = random.make();
    const std::string text = print_configuration(made);
    const auto again = loaded(text);
    ASSERT_EQ(fields(again.radar), fields(made)) << "configuration " << i << "\n" << text;
  }
}

TEST(Print, ExplainsEverySlotOfTheSchema) {
  const std::string text = print_explained({});
  for (const FormSchema& form : schema()) {
    for (const SlotSchema& slot : form.slots) {
      EXPECT_THAT(text, HasSubstr(std::string(":").append(slot.name) + " (")) << form.name;
      EXPECT_FALSE(slot.purpose.empty()) << form.name << " :" << slot.name;
    }
  }
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Manual, HasEveryFormInOneGroup) {
  std::string tables;
  for (const std::string& group : form_groups()) tables += print_markdown(group);
  for (const FormSchema& form : schema())
    EXPECT_EQ(occurrences(tables, "## " + std::string(form.name) + "\n"), 1U) << form.name;
}

TEST(Manual, ContainsTheTablesOfPrintMarkdown) {
  for (const std::string& group : form_groups()) {
    const std::string page = "docs/configuration/" + group + ".md";
    EXPECT_THAT(text_of_file(page), HasSubstr(print_markdown(group)))
        << page << ": paste the output of `yars config print --markdown " << group << "`";
  }
}

// The example that adds a shower, read as a file of a user beside the configurations that came with YARS.
TEST(Manual, TheExampleOfMoreCellsAddsOneShower) {
  const testing::Folder folder;
  std::filesystem::copy(std::filesystem::path(YARS_SOURCE_DIR) / "config", folder.path(),
                        std::filesystem::copy_options::recursive);
  const std::string manual = text_of_file("docs/configuration.md");
  const std::size_t middle = manual.find(":moreCells `(");
  ASSERT_NE(middle, std::string::npos);
  const std::size_t begin = manual.rfind("```\n", middle) + 4;
  const std::string example = manual.substr(begin, manual.find("```", middle) - begin);
  const auto without = load_configuration(folder.path() / "default.guf");
  const auto with = load_configuration(folder.write("own.guf", example));
  ASSERT_TRUE(without);
  ASSERT_TRUE(with) << with.error().message();
  EXPECT_EQ(with->radar.world.rain.cells.size(), without->radar.world.rain.cells.size() + 1);
  EXPECT_THAT(with->warnings, IsEmpty());
  EXPECT_THAT(with->notes, IsEmpty());
}

TEST(Manual, HasNoTablesForAnUnknownGroup) {
  EXPECT_EQ(print_markdown("unknown"), "");
}

}  // namespace
}  // namespace yars::config
