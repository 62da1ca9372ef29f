// Passes a file of bytes to the reader and returns the model or the error.
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

inline std::string refusal(ByteFile& file) {
  const auto model = read_openflight(file.bytes(), "test.flt");
  EXPECT_FALSE(model);
  return model ? "" : model.error().message();
}

// A square of 10 m about which files of bytes are built.
inline const std::vector<Vector3> kSquare{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};

}  // namespace yars::model::scene
