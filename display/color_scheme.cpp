#include "display/color_scheme.hpp"

namespace yars::display {
namespace {

Color color(const radar::Rgb& rgb) {
  return {static_cast<float>(rgb.red), static_cast<float>(rgb.green), static_cast<float>(rgb.blue)};
}

}  // namespace

ColorScheme color_scheme(const radar::ColorConfiguration& colors) {
  return {{}, color(colors.video), color(colors.symbols), color(colors.lines)};
}

}  // namespace yars::display
