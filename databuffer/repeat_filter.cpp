#include "databuffer/repeat_filter.hpp"

#include <algorithm>

namespace yars::databuffer {

namespace {

std::string key_of(std::string_view line) {
  std::string key;
  for (const char letter : line.substr(0, line.find(", found"))) {
    const bool digit = letter >= '0' && letter <= '9';
    if (!digit)
      key += letter;
    else if (key.empty() || key.back() != '#')
      key += '#';
  }
  return key;
}

}  // namespace

RepeatFilter::Kind& RepeatFilter::kind_of(std::string_view line, std::int64_t now_ns) {
  std::erase_if(
      kinds_, [now_ns](const Kind& kind) { return now_ns - kind.begin_ns >= kWindow_ns && kind.left_out.count == 0; });
  std::string key = key_of(line);
  // The last place is for all that found none.
  if (kinds_.size() + 1 >= kMostKinds) key = "many kinds";
  const auto found = std::ranges::find(kinds_, key, &Kind::key);
  if (found != kinds_.end()) return *found;
  return kinds_.emplace_back(Kind{std::move(key), now_ns, 0, {}});
}

bool RepeatFilter::passes(std::string_view line, std::int64_t now_ns) {
  if (now_ns - window_ns_ >= kWindow_ns) {
    window_ns_ = now_ns;
    passed_ = 0;
  }
  Kind& kind = kind_of(line, now_ns);
  if (kind.passed < most_of_a_kind_ && passed_ < most_of_all_) {
    ++kind.passed;
    ++passed_;
    return true;
  }
  kind.left_out.line = line;
  ++kind.left_out.count;
  return false;
}

std::vector<RepeatFilter::LeftOut> RepeatFilter::take_left_out(std::int64_t now_ns, bool all) {
  std::vector<LeftOut> taken;
  std::erase_if(kinds_, [&](Kind& kind) {
    const bool over = all || now_ns - kind.begin_ns >= kWindow_ns;
    if (over && kind.left_out.count > 0) taken.push_back(std::move(kind.left_out));
    return over;
  });
  return taken;
}

}  // namespace yars::databuffer
