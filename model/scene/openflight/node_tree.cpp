#include "model/scene/openflight/node_tree.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>

#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

using namespace openflight;

void WarningList::add(std::string warning) {
  if (std::ranges::find(texts_, warning) != texts_.end()) return;
  if (texts_.size() < kMaxWarnings)
    texts_.push_back(std::move(warning));
  else
    ++further_;
}

std::vector<std::string> WarningList::take() {
  if (further_ > 0) texts_.push_back("further sentences like these: " + std::to_string(further_));
  return std::move(texts_);
}

bool shows(const Node& node, std::uint32_t position) {
  if (node.kind != NodeKind::switch_node || node.switch_mask.empty()) return true;
  return position / 32 < node.switch_mask.size() && (node.switch_mask[position / 32] >> position % 32 & 1U) != 0;
}

namespace {

// Relative rounding of switch distances, which some programs store as float before they write them.
constexpr double kSwitchRounding = 1e-6;
constexpr std::size_t kMaxLevelPairs = 256'000'000;  // compared in one file; bounds the time to some seconds

// Marks those of `siblings`, which are levels of detail, that a finer one replaces. Adds to `pairs` the compared ones.
void mark_coarser_siblings(NodeTree& tree, std::vector<std::uint32_t>& siblings, std::size_t& pairs) {
  const auto level_of = [&](std::uint32_t node) -> const LevelOfDetail& { return tree.levels[tree.nodes[node].level]; };
  const auto end_m = [&](std::uint32_t node) { return level_of(node).switch_in_m; };
  std::ranges::stable_sort(siblings, {}, end_m);
  for (const std::uint32_t coarse : siblings) {
    const LevelOfDetail& level = level_of(coarse);
    bool& is_coarser = tree.nodes[coarse].is_coarser;
    // Backwards: the next finer level of the object ends where this one begins.
    auto fine = std::ranges::upper_bound(siblings, level.switch_out_m * (1.0 + kSwitchRounding), {}, end_m);
    while (fine != siblings.begin() && !is_coarser && pairs++ < kMaxLevelPairs) {
      --fine;
      is_coarser = *fine != coarse && length(level_of(*fine).centre - level.centre) < level.switch_out_m;
    }
  }
}

}  // namespace

error::Expected<void> mark_coarser_levels(NodeTree& tree, const std::string& subject) {
  std::vector<std::uint32_t> siblings;
  std::size_t pairs = 0;
  for (const Node& node : tree.nodes) {
    if (node.first_child_only) continue;
    siblings.clear();
    std::uint32_t position = 0;
    for (std::uint32_t child = node.first_child; child != kNone; child = tree.nodes[child].next_sibling, ++position)
      if (tree.nodes[child].level != kNone && shows(node, position)) siblings.push_back(child);
    mark_coarser_siblings(tree, siblings, pairs);
    if (pairs > kMaxLevelPairs)
      return error::fail(subject, "at most " + std::to_string(kMaxLevelPairs) + " pairs of levels of detail to compare",
                         "more", "put the levels of each object into a group of their own");
  }
  return {};
}

namespace {
constexpr std::size_t kMaxKinds = 65'536;
std::tuple<std::uint8_t, std::uint16_t, std::uint32_t> key_of(const SurfaceKind& kind) {
  return {kind.material, kind.feature_id, kind.color_rgb};
}
}  // namespace

std::uint16_t KindTable::number_of(const SurfaceKind& kind) {
  if (kinds_.size() < kMaxKinds && numbers_.emplace(key_of(kind), static_cast<std::uint16_t>(kinds_.size())).second)
    kinds_.push_back(kind);
  return known_number_of(kind);
}

std::uint16_t KindTable::known_number_of(const SurfaceKind& kind) const {
  if (const auto known = numbers_.find(key_of(kind)); known != numbers_.end()) return known->second;
  const auto alike = std::find_if(kinds_.begin(), kinds_.end(),
                                  [&](const SurfaceKind& other) { return other.material == kind.material; });
  return alike == kinds_.end() ? std::uint16_t{0} : static_cast<std::uint16_t>(alike - kinds_.begin());
}

namespace {

constexpr std::size_t kNamesListed = 6;    // number of similar names in an error
constexpr std::size_t kMaxSeen = 100'000;  // maximum number of names recorded for suggestions

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

// True if `name` matches `pattern`, in which `*` and `?` are wildcards. Both texts must be in lower case. The search
// backtracks only to the last star, so its time is at most proportional to the product of the lengths.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, from = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      from = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++from;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

// Levenshtein distance: the minimum number of characters to change, insert or remove in a to get b. 0 if b contains a.
std::size_t distance(std::string_view a, std::string_view b) {
  if (!a.empty() && b.find(a) != std::string_view::npos) return 0;
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = corner + (a[i] == b[j] ? 0 : 1);
      corner = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, corner + 1});
    }
  }
  return row.back();
}

std::string closest_names(const std::string& wanted, const std::set<std::string>& seen) {
  std::vector<std::pair<std::size_t, std::string>> names;
  names.reserve(seen.size());
  const std::string lower_case = lower(wanted);
  for (const std::string& name : seen) names.emplace_back(distance(lower_case, lower(name)), name);
  const std::size_t listed = std::min(kNamesListed, names.size());
  std::partial_sort(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(listed), names.end());
  std::string text;
  for (std::size_t i = 0; i < listed; ++i) {
    text += i == 0 ? "'" : ", '";
    text += names[i].second;
    text += "'";
  }
  return text;
}

}  // namespace

NameFilter::NameFilter(std::string_view names) {
  while (!names.empty()) {
    const std::size_t comma = std::min(names.find(','), names.size());
    std::string_view name = names.substr(0, comma);
    names.remove_prefix(std::min(comma + 1, names.size()));
    const std::size_t first = name.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    name = name.substr(first, name.find_last_not_of(" \t") - first + 1);
    excluded_.push_back({std::string(name)});
  }
}

bool NameFilter::leaves_out(const std::string& name) {
  if (excluded_.empty() || name.empty()) return false;
  if (seen_.size() < kMaxSeen) seen_.insert(name);
  bool out = false;
  const std::string lower_case = lower(name);
  for (Excluded& wanted : excluded_) {
    if (!matches(lower(wanted.name), lower_case)) continue;
    wanted.matched = true;
    out = true;
  }
  return out;
}

std::vector<std::string> NameFilter::unmatched_names() const {
  std::vector<std::string> names;
  for (const Excluded& wanted : excluded_)
    if (!wanted.matched) names.push_back(wanted.name);
  return names;
}

std::optional<error::Error> NameFilter::unmatched_error(const std::string& subject) const {
  const std::vector<std::string> names = unmatched_names();
  if (names.empty()) return std::nullopt;
  return error::Error{subject, "a part to leave out with the name '" + names.front() + "'", "none",
                      seen_.empty() ? "no part has a name"
                                    : std::to_string(seen_.size()) + " names exist; the most similar are " +
                                          closest_names(names.front(), seen_)};
}

}  // namespace yars::model::scene
