// Reads a ByteFile: read() expects a model, refusal() expects an error.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/parser.hpp"
#include "tests/model/scene/openflight/every_record.hpp"

namespace yars::model::scene {

inline Model read(ByteFile& file) {
  auto model = read_openflight(file.bytes(), "test.flt");
  EXPECT_TRUE(model) << (model ? "" : model.error().message());
  return model ? std::move(*model) : Model{};
}

// Error message of the reader.
inline std::string refusal(ByteFile& file) {
  const auto model = read_openflight(file.bytes(), "test.flt");
  EXPECT_FALSE(model);
  return model ? "" : model.error().message();
}

// Corners of a square of 10 m, for vertex palettes.
inline const std::vector<Vector3> kSquare{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};

}  // namespace yars::model::scene
