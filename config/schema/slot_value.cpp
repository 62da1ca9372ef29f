#include "config/schema/slot_value.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "lib/error/error.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/view.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {

constexpr const char* kManual = "`yars config print --defaults` explains every slot";

// Validates one value and writes it into the field of its slot. One operator() for each kind of slot.
class Reader {
 public:
  Reader(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value)
      : builder_(builder), slot_(slot), value_(value) {}

  void operator()(const NumberSlot& kind) const {
    const double number = in_range(value_);
    if (kind.of) kind.of(builder_) = number * kind.si_per_unit;
  }
  void operator()(const IntegerSlot& kind) const {
    const double number = whole(value_);
    if (kind.of) kind.of(builder_) = static_cast<int>(number);
  }
  void operator()(const CounterSlot& kind) const {
    const double number = whole(value_);
    if (kind.of) kind.of(builder_) = static_cast<std::uint64_t>(number);
  }
  void operator()(const BooleanSlot& kind) const {
    const auto* flag = std::get_if<bool>(&value_.data);
    if (flag == nullptr) wrong(value_);
    if (kind.of) kind.of(builder_) = *flag;
  }
  void operator()(const TextSlot& kind) const {
    const std::string& text = string();
    if (kind.of) kind.of(builder_) = text;
  }
  void operator()(const PathSlot& kind) const {
    const std::filesystem::path path = string();
    if (kind.of == nullptr) return;
    const bool unchanged = path.empty() || path.is_absolute();
    const auto folder = value_.where.file ? std::filesystem::path(*value_.where.file).parent_path() : path;
    kind.of(builder_) = (unchanged ? path : (folder / path).lexically_normal()).string();
  }
  void operator()(const AngleSlot& kind) const {
    const double degrees = in_range(value_);
    if (kind.of) kind.of(builder_) = degrees;
  }
  void operator()(const ChoiceSlot& kind) const {
    const std::string word = chosen_word();
    const auto found = std::find(kind.words.begin(), kind.words.end(), word);
    if (found == kind.words.end()) wrong(value_);
    if (kind.set) kind.set(builder_, static_cast<int>(found - kind.words.begin()));
  }
  void operator()(const ListSlot& kind) const {
    std::vector<double> numbers = list(kind.min_count, kind.max_count);
    const bool descending = kind.order == Order::descending;
    for (std::size_t i = 1; i < numbers.size() && kind.order != Order::any; ++i) {
      if (descending ? numbers[i] >= numbers[i - 1] : numbers[i] <= numbers[i - 1]) {
        const Value& item = std::get<List>(value_.data).items[i];
        wrong(item, number_text(numbers[i]) + " after " + number_text(numbers[i - 1]));
      }
    }
    if (kind.of) kind.of(builder_) = std::move(numbers);
  }
  void operator()(const WordsSlot& kind) const {
    const auto* items = std::get_if<List>(&value_.data);
    std::vector<std::string> words;
    if (items == nullptr) {
      words.push_back(word(value_));
    } else {
      for (const Value& item : items->items) words.push_back(word(item));
    }
    if (words.size() < kind.min_count || words.size() > kind.max_count) wrong(value_);
    if (kind.of) kind.of(builder_) = std::move(words);
  }
  void operator()(const FirstSlot& kind) const {
    constexpr std::size_t kMaxItems = 16;
    const auto* items = std::get_if<List>(&value_.data);
    if (items == nullptr) {
      kind.of(builder_) = static_cast<int>(whole(value_));
      return;
    }
    if (items->items.empty() || items->items.size() > kMaxItems) wrong(value_);
    for (const Value& item : items->items) whole(item);
    kind.of(builder_) = static_cast<int>(whole(items->items.front()));
  }
  void operator()(const PairSlot& kind) const {
    const auto numbers = list(2, 2);
    if (kind.first == nullptr) return;
    kind.first(builder_) = numbers[0];
    kind.second(builder_) = numbers[1];
  }
  void operator()(const SpanSlot& kind) const {
    const auto [low, high] = span(kind.centred);
    if (low >= high) wrong(value_, number_text(low) + " and " + number_text(high));
    if (kind.low == nullptr) return;
    kind.low(builder_) = low;
    kind.high(builder_) = high;
  }
  void operator()(const SymmetricSlot& kind) const {
    const auto* items = std::get_if<List>(&value_.data);
    if (items == nullptr || items->items.size() != 2) wrong(value_);
    const double low = number(items->items[0]);
    const double high = in_range(items->items[1]);
    if (low != -high) wrong(items->items[0], number_text(low) + " and " + number_text(high));
    if (kind.of) kind.of(builder_) = high;
  }
  void operator()(const FormSlot&) const {
    error::requirement_broken("a slot of forms is read by FormReader", slot_.name, __FILE__, __LINE__);
  }

 private:
  [[noreturn]] void wrong(const Value& value, std::string found = {}) const {
    if (found.empty()) found = description(value);
    reject_value(value.where, slot_, std::move(found), kManual);
  }

  double number(const Value& value) const {
    const auto* number = std::get_if<double>(&value.data);
    if (number == nullptr) wrong(value);
    return *number;
  }

  double in_range(const Value& value) const {
    const double found = number(value);
    if (!(found >= slot_.lowest && found <= slot_.highest)) wrong(value);
    return found;
  }

  double whole(const Value& value) const {
    const double found = in_range(value);
    if (found != std::floor(found)) wrong(value);
    return found;
  }

  const std::string& string() const {
    const auto* text = std::get_if<std::string>(&value_.data);
    if (text == nullptr) wrong(value_);
    return *text;
  }

  const std::string& word(const Value& value) const {
    if (const auto* identifier = std::get_if<Identifier>(&value.data)) return identifier->name;
    const auto* text = std::get_if<std::string>(&value.data);
    if (text == nullptr) wrong(value);
    return *text;
  }

  // The text of a choice, which can be written as a number, an identifier or a string: `1996`, `draft`, "draft".
  std::string chosen_word() const {
    if (const auto* identifier = std::get_if<Identifier>(&value_.data)) return identifier->name;
    if (const auto* number = std::get_if<double>(&value_.data)) return number_text(*number);
    return string();
  }

  std::vector<double> list(std::size_t min_count, std::size_t max_count) const {
    const auto* items = std::get_if<List>(&value_.data);
    if (items == nullptr || items->items.size() < min_count || items->items.size() > max_count) wrong(value_);
    std::vector<double> numbers;
    for (const Value& item : items->items) numbers.push_back(in_range(item));
    return numbers;
  }

  std::pair<double, double> span(bool centred) const {
    if (std::holds_alternative<double>(value_.data)) {
      const double whole_span = in_range(value_);
      return centred ? std::pair(-whole_span / 2, whole_span / 2) : std::pair(0.0, whole_span);
    }
    const auto numbers = list(2, 2);
    return {numbers[0], numbers[1]};
  }

  ConfigurationBuilder& builder_;
  const SlotSchema& slot_;
  const Value& value_;
};

}  // namespace

void reject_value(const Location& where, const SlotSchema& slot, std::string found, std::string action) {
  Fault fault{.where = where,
              .slot = std::string(slot.name),
              .error = {{}, value_kind(slot), std::move(found), std::move(action)}};
  if (std::isfinite(slot.lowest)) fault.error.low = slot.lowest;
  if (std::isfinite(slot.highest)) fault.error.high = slot.highest;
  reject(std::move(fault));
}

void read_simple(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value) {
  std::visit(Reader(builder, slot, value), slot.binding);
}

void read_sexagesimal(ConfigurationBuilder& builder, const SlotSchema& slot, const Location& where) {
  const auto& kind = std::get<AngleSlot>(slot.binding);
  const SexagesimalAngle& angle = builder.angle;
  const bool north_south = angle.direction < 2;
  if (north_south != kind.latitude) {
    reject(where, kind.latitude ? "N or S for a latitude" : "E or W for a longitude",
           north_south ? "N or S" : "E or W");
  }
  const double size_deg = angle.degrees + angle.minutes / 60.0 + angle.seconds / 3600.0;
  const bool negative = angle.direction % 2 == 1;
  read_simple(builder, slot, {where, negative ? -size_deg : size_deg});
}

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
