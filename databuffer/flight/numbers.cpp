#include "databuffer/flight/numbers.hpp"

namespace yars::databuffer::flight {

failure::Expected<std::vector<double>> parse_numbers(const std::string& subject,
                                                     const std::vector<std::string_view>& texts,
                                                     const std::vector<NumberField>& fields,
                                                     std::string_view separator) {
  if (texts.size() != fields.size()) {
    std::string names;
    for (const NumberField& field : fields)
      names += (names.empty() ? "" : std::string(separator)) + std::string(field.name);
    return failure::fail(subject, names, std::to_string(texts.size()) + " fields");
  }
  std::vector<double> values;
  for (std::size_t index = 0; index < fields.size(); ++index) {
    const NumberField& field = fields[index];
    const auto value = finite_number(texts[index]);
    if (!value || *value < field.least || *value > field.most)
      return failure::fail(
          subject,
          std::string(field.name) + " in [" + text_of_number(field.least) + ", " + text_of_number(field.most) + ']',
          '"' + std::string(texts[index]) + '"');
    values.push_back(*value);
  }
  return values;
}

std::string place_in_file(std::string_view file, int line) {
  return std::string(file) + ':' + std::to_string(line);
}

}  // namespace yars::databuffer::flight
