// Features of the generated landscape: rivers, towns, airfields, land cover, the coast of an island, and equal posts at
// all DTED levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "model/terrain/formats/dted.hpp"
#include "worldgen/terrain/landscape.hpp"

namespace yars::model::terrain {
namespace {

using namespace worldgen;

using Default = DefaultLandscape;
constexpr LandscapeBox kIsland{Default::kSouth_deg, Default::kWest_deg, Default::kCellsNorth, Default::kCellsEast};

constexpr std::uint32_t kSeed = 12U * 4096U;  // seed of the tiles that Landscape derives from Default::kSeed = 12

// The default region as an island. The tests share one Landscape, because it caches tiles.
const Landscape& island() {
  static const Landscape landscape(Default::kSeed, kIsland);
  return landscape;
}

std::vector<CellCorner> island_cells() {
  std::vector<CellCorner> corners;
  for (int row = 0; row < Default::kCellsNorth; ++row)
    for (int column = 0; column < Default::kCellsEast; ++column)
      corners.push_back({Default::kSouth_deg + row, Default::kWest_deg + column});
  return corners;
}

TEST(LandscapeBox, MeasuresTheDistanceToItsNearestEdge) {
  const LandscapeBox box{10, 20, 4, 6};
  EXPECT_NEAR(box.inside_km({10.1, 23.0}), 11.12, 0.01);
  EXPECT_NEAR(box.inside_km({12.0, 20.2}), 0.2 * 111.195 * std::cos(12.0 * geo::kRadiansPerDegree), 0.01);
  EXPECT_LE(box.inside_km({9.9, 23.0}), 0.0);
  EXPECT_LE(box.inside_km({12.0, 19.9}), 0.0);
  EXPECT_LE(box.inside_km({12.0, 26.1}), 0.0);
  EXPECT_LT(box.inside_km({10.1, 20.1}), 11.0) << "corners are round";
}

TEST(LandscapeBox, HasNoEdgeAtPolesAndAtTheAntimeridian) {
  const LandscapeBox earth;
  EXPECT_GT(earth.inside_km({90.0, 0.0}), 1e5);
  EXPECT_GT(earth.inside_km({0.0, -180.0}), 1e5);
  const LandscapeBox across{-2, 178, 4, 4};  // across the antimeridian
  EXPECT_NEAR(across.inside_km({0.0, -179.0}), 111.2, 0.1);
}

TEST(LandscapeRivers, WaterNeverRisesOnItsWayToTheSea) {
  std::size_t nodes = 0;
  std::size_t mouths = 0;
  for (const CellCorner corner : island_cells()) {
    const Drainage& drainage = island().features(corner)->drainage;
    for (const RiverNode& node : drainage.nodes) {
      ++nodes;
      if (node.downstream < 0) {
        const double below_m = node.exit < 0 ? 0.0 : drainage.exits[static_cast<std::size_t>(node.exit)].water_m;
        EXPECT_GE(node.water_m, below_m);
        if (node.exit < 0) {
          EXPECT_EQ(node.water_m, 0.0) << "a river that does not leave the tile ends in the sea";
        }
        mouths += static_cast<std::size_t>(node.exit < 0);
        continue;
      }
      const RiverNode& next = drainage.nodes[static_cast<std::size_t>(node.downstream)];
      ASSERT_GE(node.water_m, next.water_m);
      ASSERT_GT(next.area_km2, node.area_km2);
    }
  }
  EXPECT_GT(nodes, 500U);
  EXPECT_GT(mouths, 20U);
}

TEST(LandscapeRivers, ARiverThatLeavesATileEntersTheNextAtTheSameHeight) {
  int gates = 0;
  for (const CellCorner corner : island_cells()) {
    const auto from = island().features(corner);
    for (std::size_t exit = 0; exit < from->drainage.exits.size(); ++exit) {
      const RiverGate& gate = from->drainage.exits[exit];
      const auto to = island().features(gate.to);
      const auto entry = std::find_if(to->drainage.entries.begin(), to->drainage.entries.end(), [&](const auto& each) {
        return each.gate.from == corner && each.gate.along == gate.along;
      });
      ASSERT_NE(entry, to->drainage.entries.end());
      EXPECT_EQ(entry->area_km2, from->drainage.exits_km2[exit]);
      EXPECT_EQ(entry->gate.water_m, gate.water_m);
      const TileNode target = gate_target(gate);
      for (const RiverNode& node : to->drainage.nodes)
        if (node.row == target.row && node.column == target.column && entry->area_km2 >= kRiverKm2) {
          EXPECT_LE(node.water_m, gate.water_m);
        }
      ++gates;
    }
  }
  EXPECT_GT(gates, 3);
}

TEST(LandscapeRivers, RiverPiecesNeverRiseAndAreShortAndWide) {
  for (const CellCorner corner : island_cells())
    for (const RiverPiece& piece : island().features(corner)->rivers) {
      ASSERT_GE(piece.ends[0].water_m, piece.ends[1].water_m - 1e-9);
      ASSERT_LT(std::hypot(piece.east_m, piece.north_m), 1500.0);
      ASSERT_GT(piece.ends[0].half_width_m, 20.0);
    }
}

TEST(LandscapeSites, TownsStandOnGentleLand) {
  std::size_t towns = 0;
  for (const CellCorner corner : island_cells()) {
    const auto relief = island().relief(corner);
    for (const Town& town : island().features(corner)->settlements.towns) {
      const int row = static_cast<int>(std::lround((town.centre.latitude_deg - corner.south_deg) * kTileNodes));
      const int column = static_cast<int>(std::lround((town.centre.longitude_deg - corner.west_deg) * kTileNodes));
      EXPECT_GE(relief->height_m(row, column), 3.0);
      EXPECT_LE(relief->steepness(row, column), kMaxTownSteepness);
      EXPECT_LE(town.radius_m, kMaxTownRadius_m);
      ++towns;
    }
  }
  EXPECT_GT(towns, 30U);
}

// For `--airfields soil`: a scene has the pavement, and no squares of the culture show beside it.
TEST(LandscapeSites, UnpavedAirfieldsAreSoilWhereOthersHavePavementAndHangars) {
  const Airfield airfield{{38.0, -121.0}, 20.0, 2500.0, 30.0};
  std::map<Material, int> paved;
  for (double north_deg = -0.02; north_deg <= 0.02; north_deg += 1.0 / 3600.0)
    for (double east_deg = -0.02; east_deg <= 0.02; east_deg += 1.0 / 3600.0) {
      const geo::GeoPoint at{38.0 + north_deg, -121.0 + east_deg};
      const Material cover = airfield_cover(airfield, at, Material::trees, true);
      ++paved[cover];
      EXPECT_EQ(airfield_cover(airfield, at, Material::trees, false),
                cover == Material::trees ? Material::trees : Material::soil);
    }
  EXPECT_GT(paved[Material::asphalt], 100);
  EXPECT_GT(paved[Material::metal], 20);
  EXPECT_GT(paved[Material::trees], 1000);
}

// Makes only the rows of level 1 posts near each airfield.
TEST(LandscapeSites, RunwaysAreFlatAndOfAsphalt) {
  LandscapeTiles tiles(kSeed, kIsland);
  int runways = 0;
  std::size_t posts = 0;
  for (const CellCorner corner : {CellCorner{37, -124}, CellCorner{38, -121}, CellCorner{36, -121}}) {
    for (const Airfield& airfield : tiles.features(corner)->settlements.airfields) {
      const LandscapeRows rows(tiles, kSeed, corner, 1201, 1201);
      std::vector<std::int16_t> heights_m(1201);
      std::vector<std::uint8_t> codes(1201);
      const int middle = static_cast<int>(std::lround((airfield.centre.latitude_deg - corner.south_deg) * 1200));
      for (int row = std::max(0, middle - 17); row <= std::min(1200, middle + 17); ++row) {
        rows.make(row, heights_m, codes);
        for (std::size_t column = 0; column < heights_m.size(); ++column) {
          const geo::GeoPoint at{corner.south_deg + row / 1200.0,
                                 corner.west_deg + static_cast<double>(column) / 1200.0};
          const RunwayPosition on = runway_position(airfield, at);
          if (std::abs(on.along_m) > airfield.length_m / 2 - 1 || std::abs(on.across_m) > kRunwayHalfWidth_m - 1)
            continue;
          ++posts;
          ASSERT_NEAR(heights_m[column], airfield.elevation_m, 1.0);
          ASSERT_EQ(codes[column], static_cast<std::uint8_t>(Material::asphalt));
        }
      }
      EXPECT_GE(airfield.length_m, 2000.0);
      EXPECT_LE(airfield.length_m, 3000.0);
      ++runways;
    }
  }
  EXPECT_GE(runways, 1);
  EXPECT_GE(posts, 20U);
}

TEST(LandscapeCover, NeighboursHaveEqualCoverAndHeightsOnTheirEdge) {
  const MadeCell here = island().make({37, -122}, 121, 121);
  const MadeCell east = island().make({37, -121}, 121, 121);
  const MadeCell north = island().make({38, -122}, 121, 121);
  for (int post = 0; post < 121; ++post) {
    ASSERT_EQ(here.culture.post(post, 120).material, east.culture.post(post, 0).material);
    ASSERT_EQ(here.culture.post(120, post).material, north.culture.post(0, post).material);
    ASSERT_EQ(here.cell.post(post, 120), east.cell.post(post, 0));
    ASSERT_EQ(here.cell.post(120, post), north.cell.post(0, post));
  }
}

TEST(LandscapeCover, CellsMeetAtTheAntimeridianAndAtDtedZoneLimits) {
  const Landscape landscape(Default::kSeed);
  const MadeCell west = landscape.make({10, 179}, 121, 121);
  const MadeCell east = landscape.make({10, -180}, 121, 121);
  const MadeCell south = landscape.make({49, 10}, 121, dted_columns({49, 10}, 0));
  const MadeCell north = landscape.make({50, 10}, 121, dted_columns({50, 10}, 0));
  ASSERT_EQ(2 * (north.cell.columns() - 1), south.cell.columns() - 1);
  for (int post = 0; post < 121; ++post) {
    ASSERT_EQ(west.culture.post(post, 120).material, east.culture.post(post, 0).material);
    ASSERT_EQ(west.cell.post(post, 120), east.cell.post(post, 0));
  }
  for (int post = 0; post < north.cell.columns(); ++post) {
    ASSERT_EQ(south.culture.post(120, 2 * post).material, north.culture.post(0, post).material);
    ASSERT_EQ(south.cell.post(120, 2 * post), north.cell.post(0, post));
  }
}

TEST(LandscapeCover, SeaIsWaterAndAllMaterialsOfLandOccur) {
  std::size_t counts[kMaxMaterial + 1] = {};
  for (const CellCorner corner : island_cells()) {
    if (!island().may_have_land(corner)) continue;
    const MadeCell made = island().make(corner, 121, 121);
    for (int row = 0; row < 121; ++row)
      for (int column = 0; column < 121; ++column) {
        const std::uint8_t code = made.culture.post(row, column).material;
        ++counts[code];
        if (made.cell.post(row, column) == 0) {
          ASSERT_EQ(code, static_cast<std::uint8_t>(Material::water));
        }
        ASSERT_NE(code, static_cast<std::uint8_t>(Material::none));
      }
  }
  const auto count = [&](Material material) { return counts[static_cast<std::size_t>(material)]; };
  for (const Material material : {Material::composition, Material::stone, Material::sand, Material::rock,
                                  Material::asphalt, Material::marsh, Material::snow})
    EXPECT_GT(count(material), 10U) << static_cast<int>(material);
  EXPECT_GT(count(Material::trees), 10000U);
  EXPECT_GT(count(Material::soil), 10000U);
}

TEST(LandscapeCover, SnowLiesLowerTowardThePoles) {
  EXPECT_GT(snow_line_m(0), 4000.0);
  EXPECT_GT(snow_line_m(38), 2500.0);
  EXPECT_LT(snow_line_m(-60), 1800.0);
  EXPECT_LT(snow_line_m(85), 0.0);
  EXPECT_EQ(snow_line_m(45), snow_line_m(-45));
}

TEST(LandscapeIsland, PostsOnTheEdgeOfTheBoxAreSea) {
  for (const CellCorner corner : island_cells()) {
    const Cell cell = island().cell(corner, 121, 121);
    for (int post = 0; post < 121; ++post) {
      if (corner.south_deg == kIsland.south_deg) {
        ASSERT_EQ(cell.post(0, post), 0);
      }
      if (corner.south_deg == kIsland.south_deg + kIsland.cells_north - 1) {
        ASSERT_EQ(cell.post(120, post), 0);
      }
      if (corner.west_deg == kIsland.west_deg) {
        ASSERT_EQ(cell.post(post, 0), 0);
      }
      if (corner.west_deg == kIsland.west_deg + kIsland.cells_east - 1) {
        ASSERT_EQ(cell.post(post, 120), 0);
      }
    }
    if (!island().may_have_land(corner)) {
      EXPECT_EQ(cell.highest_m(), 0);
    }
  }
}

TEST(LandscapeLevels, PostsOfCoarserLevelsEqualThoseOfLevelTwo) {
  LandscapeTiles tiles(kSeed, std::nullopt);
  const CellCorner corner{37, -121};
  const LandscapeRows coarse(tiles, kSeed, corner, 121, 121);
  const LandscapeRows middle(tiles, kSeed, corner, 1201, 1201);
  const LandscapeRows fine(tiles, kSeed, corner, 3601, 3601);
  for (const int row : {0, 7, 60, 113, 120}) {
    std::vector<std::int16_t> heights_m[3] = {std::vector<std::int16_t>(121), std::vector<std::int16_t>(1201),
                                              std::vector<std::int16_t>(3601)};
    std::vector<std::uint8_t> codes[3] = {std::vector<std::uint8_t>(121), std::vector<std::uint8_t>(1201),
                                          std::vector<std::uint8_t>(3601)};
    coarse.make(row, heights_m[0], codes[0]);
    middle.make(row * 10, heights_m[1], codes[1]);
    fine.make(row * 30, heights_m[2], codes[2]);
    for (std::size_t post = 0; post < 1201; ++post) {
      ASSERT_EQ(heights_m[1][post], heights_m[2][post * 3]) << "row " << row << " post " << post;
      ASSERT_EQ(codes[1][post], codes[2][post * 3]) << "row " << row << " post " << post;
      if (post % 10 == 0) {
        ASSERT_EQ(heights_m[0][post / 10], heights_m[1][post]);
      }
    }
  }
}

TEST(LandscapeRepeats, WithAnyNumberOfThreads) {
  const Landscape one(Default::kSeed, kIsland);
  const Landscape two(Default::kSeed, kIsland);
  const MadeCell first = one.make({37, -122}, 121, 121, 1);
  const MadeCell second = two.make({37, -122}, 121, 121, 2);
  EXPECT_EQ(first.cell.posts(), second.cell.posts());
  EXPECT_EQ(first.culture.posts(), second.culture.posts());
}

TEST(LandscapeRepeats, InAnyOrderOfCells) {
  const Landscape before(Default::kSeed, kIsland);
  const Landscape after(Default::kSeed, kIsland);
  for (const CellCorner corner : {CellCorner{39, -122}, CellCorner{37, -123}, CellCorner{38, -122}})
    after.features(corner);
  const MadeCell first = before.make({38, -123}, 121, 121);
  const MadeCell second = after.make({38, -123}, 121, 121);
  EXPECT_EQ(first.cell.posts(), second.cell.posts());
}

}  // namespace
}  // namespace yars::model::terrain
