#include "config/slot_text.hpp"

#include <cmath>

#include "config/value.hpp"

namespace yars::config {
namespace {

// The shortest number of units whose product with the unit is the same SI value; division alone can miss by a bit.
double in_units(double si, double si_per_unit) {
  const double quotient = si / si_per_unit;
  for (const double candidate : {quotient, std::nextafter(quotient, -1e308), std::nextafter(quotient, 1e308)}) {
    if (candidate * si_per_unit == si) return candidate;
  }
  return quotient;
}

std::string list_text(const std::vector<double>& numbers) {
  std::string text = "`( ";
  for (const double number : numbers) text += number_text(number) + " ";
  return text + ")";
}

struct Writer {
  Draft& draft;

  std::string operator()(const NumberSlot& kind) const {
    if (kind.of == nullptr) return {};
    const double value = kind.of(draft);
    return std::isnan(value) ? std::string() : number_text(in_units(value, kind.si_per_unit));
  }
  std::string operator()(const IntegerSlot& kind) const { return kind.of ? std::to_string(kind.of(draft)) : ""; }
  std::string operator()(const CounterSlot& kind) const { return kind.of ? std::to_string(kind.of(draft)) : ""; }
  std::string operator()(const BooleanSlot& kind) const {
    if (kind.of == nullptr) return {};
    return kind.of(draft) ? "true" : "false";
  }
  std::string operator()(const TextSlot& kind) const { return kind.of ? quoted_text(kind.of(draft)) : ""; }
  std::string operator()(const PathSlot& kind) const { return kind.of ? quoted_text(kind.of(draft)) : ""; }
  std::string operator()(const AngleSlot& kind) const {
    return kind.of == nullptr || std::isnan(kind.of(draft)) ? std::string() : number_text(kind.of(draft));
  }
  std::string operator()(const ChoiceSlot& kind) const {
    const int index = kind.get ? kind.get(draft) : -1;
    return index < 0 ? std::string() : std::string(kind.words[static_cast<std::size_t>(index)]);
  }
  std::string operator()(const ListSlot& kind) const { return kind.of ? list_text(kind.of(draft)) : ""; }
  std::string operator()(const FirstSlot& kind) const { return std::to_string(kind.of(draft)); }
  std::string operator()(const PairSlot& kind) const {
    return kind.first ? list_text({kind.first(draft), kind.second(draft)}) : "";
  }
  std::string operator()(const SpanSlot& kind) const {
    return kind.low ? list_text({kind.low(draft), kind.high(draft)}) : "";
  }
  std::string operator()(const SymmetricSlot& kind) const {
    return kind.of ? list_text({-kind.of(draft), kind.of(draft)}) : "";
  }
  std::string operator()(const FormSlot&) const { return {}; }
};

}  // namespace

std::string slot_text(Draft& draft, const SlotSchema& slot) {
  return std::visit(Writer{draft}, slot.binding);
}

}  // namespace yars::config
