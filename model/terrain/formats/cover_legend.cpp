#include "model/terrain/formats/cover_legend.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>

#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/culture.hpp"

namespace yars::model::terrain {

namespace {
constexpr std::array<std::string_view, 4> kColumns{"class", "name", "material", "source"};

// Where each column stands in a line.
using Places = std::array<std::size_t, kColumns.size()>;

std::optional<Places> places_of(std::string_view heading) {
  const auto names = text::fields_of(heading, ',');
  Places places{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), kColumns[i]);
    if (found == names.end()) return std::nullopt;
    places[i] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

std::string materials() {
  std::string all;
  for (std::uint8_t code = 0; !material_name(code).empty(); ++code) all += std::string(material_name(code)) + ", ";
  return all + "or a code up to " + std::to_string(kMaxMaterial);
}
}  // namespace

error::Expected<CoverLegend> read_cover_legend(const std::string& path) {
  const auto text = file::read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto lines = text::numbered_lines(*text);
  const auto places = lines.empty() ? std::nullopt : places_of(lines.front().text);
  if (!places)
    return error::fail(path, "the columns class, name, material and source",
                       lines.empty() ? "no line" : text::shortened(lines.front().text),
                       "name the columns in the first line");
  CoverLegend legend;
  std::set<std::uint16_t> known;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string where = file::line_location(path, lines[i].number);
    const auto fields = text::fields_of(lines[i].text, ',');
    if (fields.size() <= *std::max_element(places->begin(), places->end()))
      return error::fail(where, "a field for each column", text::shortened(lines[i].text));
    CoverClass row;
    row.name = fields[(*places)[1]];
    for (const std::string_view word : text::words_of(fields[(*places)[0]])) {
      const auto value = text::whole_number<std::uint16_t>(word);
      if (!value) return error::fail(where, "classes from 0 to 65535", text::shortened(word));
      if (!known.insert(*value).second)
        return error::fail(where, "each class once", "class " + std::to_string(*value) + " again");
      row.values.push_back(*value);
    }
    if (row.values.empty()) return error::fail(where, "at least one class", "none");
    const std::string_view material = fields[(*places)[2]];
    const auto code = material_of(material);
    if (!code) return error::fail(where, "a material: " + materials(), text::shortened(material));
    row.material = *code;
    legend.push_back(std::move(row));
  }
  if (legend.empty()) return error::fail(path, "at least one class", "no line below the heading");
  return legend;
}

}  // namespace yars::model::terrain
