// The front of a trade as a picture: time a scan to the right, error upwards, both logarithmic; two panels
// of errors. A disc is the mean over the scenes, the hair above it the worst one. Knob sweeps hang
// together by a line; the thick line joins what nothing beats in both. What has no error stands on the row "0".
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "lib/imageio/png.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

// Columns of the table, and what the axes say.
struct Front {
  std::size_t time_column;
  std::string_view time_title;
  struct Error {
    std::size_t column;
    std::string_view title;
  };
  std::array<Error, 2> errors;
};

imageio::Image front_picture(const TradeTable& table, const Front& front);

}  // namespace yars::tools::trade
