// Helpers of the scene tests: a temporary folder with files, and scenes in a few lines.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/reader.hpp"
#include "worldgen/scene/openflight_writer.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {

class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            ("yars_scene_" + std::to_string(::getpid()) + "_" + test->test_suite_name() + "_" + test->name());
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::span<const std::byte> bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline constexpr SurfaceKind kTestKind{3, 77, 0x102030};

// A square with its south-west corner at (x, y), facing up.
inline std::vector<worldgen::WriterVertex> square(double x, double y, double side, double z = 0.0) {
  const Vector3 up{0, 0, 1};
  return {{{x, y, z}, up}, {{x + side, y, z}, up}, {{x + side, y + side, z}, up}, {{x, y + side, z}, up}};
}

inline Model read(worldgen::OpenFlightWriter& writer) {
  const std::vector<std::byte> bytes = writer.take();
  auto model = read_openflight(bytes, "test.flt");
  EXPECT_TRUE(model) << (model ? "" : model.error().message());
  return model ? std::move(*model) : Model{};
}

inline Vector3 position_of(const Model& model, std::uint32_t vertex) {
  const auto& p = model.vertices[vertex].position_m;
  return Vector3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])} + model.base;
}

inline Vector3 normal_of(const Model& model, std::uint32_t vertex) {
  const auto& n = model.vertices[vertex].normal;
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

// Normal vector with twice the triangle's area as its length. The corners are counter-clockwise as seen from its tip.
inline Vector3 area_of(const Model& model, const ModelTriangle& t) {
  const Vector3 a = position_of(model, t.corners[0]);
  return cross(position_of(model, t.corners[1]) - a, position_of(model, t.corners[2]) - a);
}

inline double total_area_m2(const Model& model) {
  double sum = 0.0;
  for (const ModelTriangle& triangle : model.triangles) sum += length(area_of(model, triangle)) / 2;
  return sum;
}

}  // namespace yars::model::scene
