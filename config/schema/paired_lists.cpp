#include "config/schema/paired_lists.hpp"

#include <algorithm>
#include <string_view>

#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/view.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {

struct Pair {
  std::string_view first, first_unit;
  std::vector<double>& (*first_of)(ConfigurationBuilder&);
  std::string_view second, second_unit;
  std::vector<double>& (*second_of)(ConfigurationBuilder&);
};

// Not here: heights and ranges of HeightRanges, azimuths and depressions of the velocity beams. A change of one of them
// alone is usual, and FormSchema::check refuses different numbers.
constexpr std::array<Pair, 5> kTable{
    {{"ranges", "NM", YARS_FIELD(radar.ranges_nm), "pulseWidths", "us", YARS_FIELD(radar.pulse_us)},
     {"ranges", "NM", YARS_FIELD(radar.ranges_nm), "rangeRings", "NM", YARS_FIELD(radar.view.arc_spacing_nm)},
     {"windows", "NM", YARS_FIELD(radar.window_limits.windows_nm), "least", "NM",
      YARS_FIELD(radar.window_limits.min_range_nm)},
     {"windows", "NM", YARS_FIELD(radar.window_limits.windows_nm), "greatest", "NM",
      YARS_FIELD(radar.window_limits.max_range_nm)},
     {"blankWindows", "NM", YARS_FIELD(radar.window_limits.blank_windows_nm), "blankUpTo", "NM",
      YARS_FIELD(radar.window_limits.blank_max_range_nm)}}};

bool in_one_file(const std::optional<Location>& one, const Location& other) {
  return one && one->file && other.file && *one->file == *other.file;
}

// "10 NM has 0.26 us, 20 NM has 0.5 us". Positions beyond the second list have its last value.
std::string pairing_text(const Pair& pair, const std::vector<double>& first, const std::vector<double>& second) {
  std::string text;
  for (std::size_t i = 0; i < first.size(); ++i) {
    text += (i == 0 ? "" : ", ") + number_text(first[i]) + ' ' + std::string(pair.first_unit) + " has " +
            number_text(second[std::min(i, second.size() - 1)]) + ' ' + std::string(pair.second_unit);
  }
  return text;
}

}  // namespace

void PairedLists::slot_read(ConfigurationBuilder& builder, const ListSlot& slot, const std::vector<double>& before,
                            const Location& where) {
  static_assert(kTable.size() == kPairs);
  const std::vector<double>* given = &slot.of(builder);
  for (std::size_t i = 0; i < kPairs; ++i) {
    State& state = states_[i];
    if (given == &kTable[i].second_of(builder)) {
      state.second = where;
      state.changed_from.clear();
    } else if (given == &kTable[i].first_of(builder)) {
      // Within one file the order of the two lists does not matter.
      if (!in_one_file(state.second, where) && state.changed_from.empty()) state.changed_from = before;
      state.first = where;
      if (state.changed_from == *given) state.changed_from.clear();
    }
  }
}

namespace {

// `alone`: the first list was changed without the second.
std::string warning_text(const Pair& pair, const std::vector<double>& first, const std::vector<double>& second,
                         bool alone) {
  const std::string one = ':' + std::string(pair.first), other = ':' + std::string(pair.second);
  const std::string given = alone ? one + " changed without " + other
                                  : std::to_string(second.size()) + " for " + std::to_string(first.size());
  return "expected a value of " + other + " for each of " + one + ", found " + given + "; by position " +
         pairing_text(pair, first, second) + "; give " + other + " with " + text::counted(first.size(), "value") +
         " beside " + one;
}

}  // namespace

std::vector<PairedLists::Warning> PairedLists::warnings(ConfigurationBuilder& builder) const {
  std::vector<Warning> found;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const State& state = states_[i];
    const Pair& pair = kTable[i];
    const auto &first = pair.first_of(builder), &second = pair.second_of(builder);
    const bool alone = !state.changed_from.empty();
    if ((!state.first && !state.second) || second.size() <= 1 || (first.size() == second.size() && !alone)) continue;
    found.push_back({alone || !state.second ? *state.first : *state.second, warning_text(pair, first, second, alone)});
  }
  return found;
}

}  // namespace yars::config
