// Legends of land cover: those that come with YARS, and files with faults.
#include "model/terrain/formats/cover_legend.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "model/terrain/formats/culture.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::HasSubstr;

std::map<int, std::uint8_t> shipped(const std::string& name) {
  const auto legend = read_cover_legend(std::string(YARS_SOURCE_DIR) + "/config/legends/" + name + ".csv");
  std::map<int, std::uint8_t> materials;
  if (!legend) ADD_FAILURE() << legend.error().message();
  if (legend)
    for (const CoverClass& row : *legend)
      for (const std::uint16_t value : row.values) materials[value] = row.material;
  return materials;
}

TEST(CoverLegend, OfEachSourceHasItsClasses) {
  const auto material = [](Material named) { return static_cast<std::uint8_t>(named); };
  const auto worldcover = shipped("worldcover"), corine = shipped("corine"), nlcd = shipped("nlcd"),
             copernicus = shipped("copernicus");
  EXPECT_EQ(worldcover.size(), 11U);
  EXPECT_EQ(worldcover.at(80), material(Material::water));
  EXPECT_EQ(corine.size(), 88U) << "44 classes, by code and by number";
  EXPECT_EQ(corine.at(523), material(Material::water));
  EXPECT_EQ(corine.at(24), material(Material::trees));
  EXPECT_EQ(nlcd.size(), 20U);
  EXPECT_EQ(nlcd.at(11), material(Material::water));
  EXPECT_EQ(copernicus.size(), 22U);
  EXPECT_EQ(copernicus.at(200), material(Material::water));
}

TEST(CoverLegend, FaultsNameTheirLine) {
  const test::TemporaryFolder folder;
  const std::string heading = "class,name,material,source\n", path = (folder.path() / "l.csv").string();
  for (const auto& [text, expected] :
       {std::pair<std::string, std::string>{"", "columns class, name, material and source, found no line"},
        {"class,material\n", "source, found class,material"},
        {heading, "at least one class"},
        {heading + "1,a,trees\n", "l.csv:2: expected a field for each column"},
        {heading + "1,a,tree,\n", "l.csv:2: expected a material: land, metal, part metal"},
        {heading + "1,a,32,\n", "or a code up to 31"},
        {heading + "-1,a,trees,\n", "classes from 0 to 65535, found -1"},
        {heading + ",a,trees,\n", "at least one class, found none"},
        {heading + "# two\n1 2,a,trees,\n3 2,b,water,\n", "l.csv:4: expected each class once, found class 2 again"}}) {
    std::ofstream(path) << text;
    const auto legend = read_cover_legend(path);
    ASSERT_FALSE(legend.has_value()) << text;
    EXPECT_THAT(legend.error().message(), HasSubstr(expected)) << text;
  }
  std::ofstream(path) << "name,class,source,material,more\n a b , 7 9 ,why, 14 ,x\n";
  const auto legend = read_cover_legend(path);
  ASSERT_TRUE(legend.has_value()) << legend.error().message();
  EXPECT_EQ(legend->front().name, "a b");
  EXPECT_EQ(legend->front().material, 14);
  EXPECT_EQ(legend->front().values, (std::vector<std::uint16_t>{7, 9}));
}

}  // namespace
}  // namespace yars::model::terrain
