// Damaged OpenFlight files are read or refused, in bounded memory. Environment: YARS_SCENE_MUTATIONS, number of damaged
// copies of each file; YARS_SCENE_SEED, seed of the random numbers.
#include "tests/model/scene/openflight/mutation.hpp"

#include <sys/resource.h>

#include <cstdlib>
#include <map>

#include "model/scene/placement/placed_scene.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "tests/model/scene/openflight/every_record.hpp"
#include "tests/model/scene/support.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::scene {
namespace {

// Number in an environment variable, or `otherwise` if the variable is not set.
std::uint64_t number_from(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

// Limits so small that damaged files often exceed them.
constexpr FlattenLimits kLimits{.triangles = 100'000, .vertices = 300'000, .visits = 1'000'000};

void read_mutations(std::span<const std::byte> original, std::uint64_t count) {
  const std::uint64_t seed = number_from("YARS_SCENE_SEED", 1);
  SCOPED_TRACE("YARS_SCENE_SEED=" + std::to_string(seed));
  ASSERT_TRUE(read_openflight(original, "original"));
  const Mutation mutation(original);
  const terrain::AnalyticTerrain ground(terrain::flat(0));
  random::CounterRng rng(seed);
  std::uint64_t read = 0, refused = 0;
  std::map<std::string, std::uint64_t> refusals;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::vector<std::byte> bytes = mutation.made(rng);
    const auto model = read_openflight(bytes, "f", kLimits);
    if (!model) {
      ++refused;
      EXPECT_FALSE(model.error().expected.empty());
      ++refusals[model.error().expected.substr(0, 24)];
      continue;
    }
    ++read;
    EXPECT_LE(model->triangles.size(), kLimits.triangles);
    for (const ModelTriangle& triangle : model->triangles)
      for (const std::uint32_t corner : triangle.corners) ASSERT_LT(corner, model->vertices.size());
    if (i % 64 != 0) continue;
    KindTable kinds;
    const PlacedScene placed = place_model(*model, {.position = {37, -122}}, ground, 0, kinds);
    EXPECT_EQ(placed.objects.size(), model->objects.size());
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%llu read, %llu refused in %zu ways, at most %ld MB\n", static_cast<unsigned long long>(read),
              static_cast<unsigned long long>(refused), refusals.size(), usage.ru_maxrss / 1024);
}

TEST(DamagedFiles, OfEveryRecordAreReadOrRefused) {
  read_mutations(every_record(), number_from("YARS_SCENE_MUTATIONS", 3000));
}

TEST(DamagedFiles, OfAnAirfieldAreReadOrRefused) {
  read_mutations(worldgen::generate_scene({.triangles = 1, .origin = {37, -122}}).file,
                 number_from("YARS_SCENE_MUTATIONS", 1000) / 10);
}

TEST(DamagedFiles, OfTheTankAreReadOrRefused) {
  YARS_NEEDS_SHARED_DATA();
  const auto bytes = terrain::read_file(test::shared_data() / "flt/tank.FLT", 1 << 20);
  ASSERT_TRUE(bytes);
  read_mutations(*bytes, number_from("YARS_SCENE_MUTATIONS", 1000) / 10);
}

}  // namespace
}  // namespace yars::model::scene
