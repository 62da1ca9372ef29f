// The front of a trade as a picture: time a scan to the right, error upwards, both logarithmic; one panel for gray
// levels, one for shadow. A disc is the mean over the scenes, the hair above it the worst one. Knob sweeps hang
// together by a line; the thick line joins what nothing beats in both. What has no error stands on the row "0".
#pragma once

#include "lib/imageio/png.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

imageio::Image front_picture(const TradeTable& table);

}  // namespace yars::tools::trade
