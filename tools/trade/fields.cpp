#include "tools/trade/fields.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace yars::tools::trade {

namespace {
template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

tl::unexpected<failure::Error> refuse(std::string_view subject, std::string expected, std::string_view found) {
  return tl::unexpected<failure::Error>(
      failure::Error{std::string(subject), std::move(expected), std::string("'").append(found).append("'"), "", true});
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

failure::Expected<std::vector<double>> numbers_of(std::string_view list, std::span<const Bounds> bounds,
                                                  std::string_view subject, std::string_view form) {
  const auto fields = fields_of(list);
  if (fields.size() != bounds.size())
    return refuse(subject, std::to_string(bounds.size()).append(" numbers ").append(form), list);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto value = number_of(fields[i]);
    if (!value || *value < bounds[i].least || *value > bounds[i].most)
      return refuse(subject,
                    std::string(bounds[i].name) + " from " + short_number(bounds[i].least) + " to " +
                        short_number(bounds[i].most),
                    fields[i]);
    numbers.push_back(*value);
  }
  return numbers;
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace yars::tools::trade
