#include "tools/trade/fields.hpp"

#include <charconv>
#include <cmath>

namespace yars::tools::trade {

namespace {
template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}
}  // namespace

std::vector<std::string_view> fields_of(std::string_view list) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = list.find(','); comma != std::string_view::npos; comma = list.find(',')) {
    fields.push_back(list.substr(0, comma));
    list.remove_prefix(comma + 1);
  }
  fields.push_back(list);
  return fields;
}

std::optional<int> whole_number_of(std::string_view text) {
  return parse<int>(text);
}

std::optional<double> number_of(std::string_view text) {
  const auto value = parse<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace yars::tools::trade
