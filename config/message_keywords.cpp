#include "config/message_keywords.hpp"

#include <algorithm>
#include <array>

#include "config/schema.hpp"

namespace yars::config {
namespace {

constexpr std::string_view kAnyOwner = "*";
constexpr std::string_view kOutermost;

struct Row {
  std::string_view keyword;
  std::string_view owner;
  std::string_view meant;
};

constexpr std::array kForms{Row{"Radar", kAnyOwner, "System"},
                            Row{"MgDmaDatabase", kAnyOwner, "DedDbase"},  // MultiGen's files of DMA elevations
                            Row{"Display", kOutermost, "Window"},
                            Row{"Display", "System", "Window"},
                            Row{"Display", "Apg70", "Window"},
                            Row{"Display", "RealBeamMode", "RbmDisplay"},
                            Row{"Display", "SarMode", "SarDisplay"},
                            Row{"Antenna", kOutermost, "AntennaServo"},
                            Row{"Antenna", "System", "AntennaServo"},
                            Row{"Antenna", "Apg70", "AntennaServo"},
                            Row{"Antenna", kAnyOwner, "RbmAntenna"}};

constexpr std::array kSlots{Row{"samplesPerSweep", kAnyOwner, "samples"}, Row{"mode", "Window", "bmode"}};

template <std::size_t count>
std::string_view meant(const std::array<Row, count>& rows, std::string_view keyword, std::string_view owner) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& one) {
    return one.keyword == keyword && (one.owner == owner || one.owner == kAnyOwner);
  });
  return row == rows.end() ? std::string_view() : row->meant;
}

}  // namespace

std::string_view form_of_keyword(std::string_view keyword, std::string_view owner) {
  const std::string_view renamed = meant(kForms, keyword, owner);
  if (!renamed.empty()) return renamed;
  const auto form = find_form(keyword);
  return form.schema != nullptr && form.schema->name == keyword ? form.schema->name : std::string_view();
}

std::string_view slot_of_keyword(std::string_view keyword, std::string_view owner) {
  const std::string_view renamed = meant(kSlots, keyword, owner);
  return renamed.empty() ? keyword : renamed;
}

InnerForm inner_form_of_keyword(std::string_view keyword, std::string_view owner) {
  if (keyword == "scanBars" && owner == "RealBeamMode") return {"antenna", "RbmAntenna"};
  return {};
}

}  // namespace yars::config
