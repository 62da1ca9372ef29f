#include "inputmonitor/tour.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::inputmonitor {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using error::Expected;
using error::fail;

constexpr std::array<std::string_view, 2> kTimeless{"title", "caption"};
constexpr std::string_view kForms =
    "TIME_S EVENT, TIME_S auto EVENT, [TIME_S] caption TEXT, title TEXT or [TIME_S] end (TIME_S may be +DT_S)";
constexpr std::size_t kMaxEchoes = 256;  // more events than that are never under way

// The rest of the line after the word that begins it; nullopt if another word begins it.
std::optional<std::string_view> after(std::string_view what, std::string_view word) {
  if (what == word) return std::string_view();
  if (!what.starts_with(word) || what[word.size()] != ' ') return std::nullopt;
  return text::trimmed(what.substr(word.size()));
}

bool is_printable(std::string_view text) {
  return std::ranges::all_of(text, [](char letter) { return letter >= ' ' && letter <= '~'; });
}

Expected<std::vector<std::string>> caption_lines(std::string_view text, const std::string& location) {
  std::vector<std::string> lines;
  if (text.empty()) return lines;
  for (const std::string_view line : text::fields_of(text, '|')) {
    if (line.size() > databuffer::kCaptionLength || !is_printable(line))
      return fail(location, "lines of at most " + std::to_string(databuffer::kCaptionLength) + " ASCII characters",
                  '"' + std::string(line) + '"', "divide the text by |");
    lines.emplace_back(line);
  }
  if (lines.size() > databuffer::kCaptionLines)
    return fail(location, "at most " + std::to_string(databuffer::kCaptionLines) + " lines",
                std::to_string(lines.size()), "begin another caption");
  return lines;
}

Expected<TourItem> item_of(const ScriptLine& line) {
  TourItem item{.time_ns = line.time_ns, .lines = {}};
  if (const auto text = after(line.what, "caption")) {
    auto lines = caption_lines(*text, line.location);
    if (!lines) return tl::unexpected(lines.error());
    item.is_caption = true;
    item.lines = std::move(*lines);
    return item;
  }
  const auto automatic = after(line.what, "auto");
  item.automatic = automatic.has_value();
  const auto event = databuffer::event_from_text(automatic.value_or(line.what));
  if (!event)
    return fail(line.location, event.error().expected + ", or caption TEXT, or auto EVENT", event.error().found,
                event.error().action);
  item.event = *event;
  return item;
}

Expected<void> take_line(const ScriptLine& line, Tour& tour) {
  if (const auto title = after(line.what, "title")) {
    if (title->empty() || title->size() > databuffer::kCaptionLength || !is_printable(*title))
      return fail(line.location, "a title of 1 to " + std::to_string(databuffer::kCaptionLength) + " ASCII characters",
                  '"' + std::string(*title) + '"');
    tour.title = *title;
    return {};
  }
  auto item = item_of(line);
  if (!item) return tl::unexpected(item.error());
  tour.items.push_back(std::move(*item));
  return {};
}

std::uint32_t captions_in(const Tour& tour) {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(tour.items, [](const TourItem& item) { return item.is_caption && !item.lines.empty(); }));
}

bool is_kind(const InputEvent& event, EventKind kind) {
  return event.kind == static_cast<std::uint16_t>(kind);
}

bool same_event(const InputEvent& one, const InputEvent& other) {
  return one.kind == other.kind && one.argument == other.argument && one.x == other.x && one.y == other.y &&
         std::memcmp(one.text, other.text, sizeof one.text) == 0;
}

bool is_elevation(const InputEvent& event) {
  return is_kind(event, EventKind::elevation) || is_kind(event, EventKind::elevation_step);
}

// True if the pilot's event does what the tour asks for. Any deflection of the TDC and any change of the antenna's
// elevation will do, because keys cannot give exact values.
bool satisfies(const InputEvent& done, const InputEvent& wanted) {
  if (is_elevation(wanted)) return is_elevation(done);
  if (is_kind(wanted, EventKind::tdc) && is_kind(done, EventKind::tdc)) {
    const auto is_deflected = [](const InputEvent& event) { return event.x != 0.0 || event.y != 0.0; };
    return is_deflected(done) == is_deflected(wanted);
  }
  return same_event(done, wanted);
}

}  // namespace

Expected<Tour> parse_tour(std::string_view text, std::string_view name) {
  Tour tour;
  const auto times =
      read_script_lines(text, name, kForms, kTimeless, [&](const ScriptLine& line) { return take_line(line, tour); });
  if (!times) return tl::unexpected(times.error());
  if (!times->end_ns) return fail(std::string(name), "a last line `end`", "none", "add [TIME_S] end");
  if (captions_in(tour) > databuffer::kMaxCaptions)
    return fail(std::string(name), "at most " + std::to_string(databuffer::kMaxCaptions) + " captions",
                std::to_string(captions_in(tour)));
  tour.end_ns = *times->end_ns;
  return tour;
}

TourSource::TourSource(Tour tour, std::string name, bool for_pilot)
    : tour_(std::move(tour)), name_(std::move(name)), for_pilot_(for_pilot), steps_(captions_in(tour_)) {}

void TourSource::begin(std::int64_t sim_time_ns) {
  origin_ns_ = sim_time_ns;
  next_ = 0;
  step_ = 0;
  caption_.reset();
  wanted_.clear();
  stopped_ns_.reset();
  sends_missing_ = next_asked_ = false;
}

void TourSource::begin_step(const TourItem& item, std::int64_t sim_time_ns) {
  caption_.reset();
  sends_missing_ = false;
  wanted_.clear();
  for (std::size_t i = next_ + 1; for_pilot_ && i < tour_.items.size() && !tour_.items[i].is_caption; ++i) {
    if (tour_.items[i].automatic) continue;
    wanted_.push_back(tour_.items[i].event);
    last_wanted_ns_ = tour_.items[i].time_ns;
  }
  if (item.lines.empty()) return;
  databuffer::Caption caption{};
  caption.sim_time_ns = sim_time_ns;
  caption.step = ++step_;
  caption.steps = steps_;
  text::put_text(caption.title, tour_.title);
  for (std::size_t i = 0; i < item.lines.size(); ++i) text::put_text(caption.lines[i].text, item.lines[i]);
  caption_ = caption;
}

void TourSource::set_waiting(bool waiting) {
  if (caption_) caption_->waiting = waiting ? 1 : 0;
}

void TourSource::send(const InputEvent& event, std::vector<InputEvent>& due) {
  due.push_back(event);
  if (is_kind(event, EventKind::tdc)) tdc_ = event;
  if (!for_pilot_) return;
  if (echoes_.size() >= kMaxEchoes) echoes_.erase(echoes_.begin());
  echoes_.push_back(event);
}

// True if the tour has to wait for the pilot before this event of his.
bool TourSource::waits_at(const TourItem& item) {
  if (wanted_.empty() || sends_missing_) return false;
  stopped_ns_ = item.time_ns;
  set_waiting(true);
  return true;
}

// Lets the clock run again, if the pilot has done everything or asked to go on.
void TourSource::go_on(std::int64_t sim_time_ns) {
  const bool asked = std::exchange(next_asked_, false);
  if (stopped_ns_) {
    std::int64_t from_ns = *stopped_ns_;
    if (wanted_.empty())
      from_ns = last_wanted_ns_;
    else if (asked)
      sends_missing_ = true;
    if (wanted_.empty() || asked) {
      stopped_ns_.reset();
      set_waiting(false);
    }
    origin_ns_ = sim_time_ns - from_ns;
    return;
  }
  const std::int64_t next_ns = next_ < tour_.items.size() ? tour_.items[next_].time_ns : tour_.end_ns;
  const bool nothing_before = next_ == tour_.items.size() || tour_.items[next_].is_caption;
  if (asked && nothing_before && wanted_.empty() && time_ns(sim_time_ns) < next_ns) origin_ns_ = sim_time_ns - next_ns;
}

std::vector<InputEvent> TourSource::take(const Moment& moment) {
  if (!last_sim_time_ns_ || moment.sim_time_ns < *last_sim_time_ns_) begin(moment.sim_time_ns);
  last_sim_time_ns_ = moment.sim_time_ns;
  if (for_pilot_) go_on(moment.sim_time_ns);
  std::vector<InputEvent> due;
  const std::int64_t now_ns = time_ns(moment.sim_time_ns);
  for (; !stopped_ns_ && next_ < tour_.items.size() && tour_.items[next_].time_ns <= now_ns; ++next_) {
    const TourItem& item = tour_.items[next_];
    if (item.is_caption) {
      begin_step(item, moment.sim_time_ns);
      continue;
    }
    if (item.automatic || !for_pilot_) {
      send(item.event, due);
      continue;
    }
    if (waits_at(item)) break;
    const auto missing =
        std::ranges::find_if(wanted_, [&](const InputEvent& one) { return same_event(one, item.event); });
    if (missing == wanted_.end()) continue;
    wanted_.erase(missing);
    send(item.event, due);
  }
  ended_ = !stopped_ns_ && next_ == tour_.items.size() && now_ns >= tour_.end_ns;
  if (ended_) caption_.reset();
  return due;
}

std::vector<InputEvent> TourSource::release() {
  if (tdc_.x == 0.0 && tdc_.y == 0.0) return {};
  tdc_.x = tdc_.y = 0.0;
  return {tdc_};
}

void TourSource::observe(const std::vector<SeenEvent>& seen) {
  if (!for_pilot_) return;
  for (const SeenEvent& one : seen) {
    if (one.own) {
      // The sources of one program share a lane. What the tour itself has sent comes back first.
      const auto echo =
          std::ranges::find_if(echoes_, [&](const InputEvent& sent) { return same_event(sent, one.event); });
      if (echo != echoes_.end()) {
        echoes_.erase(echo);
        continue;
      }
    }
    if (is_kind(one.event, EventKind::next)) next_asked_ = true;
    if (!one.done) continue;
    const auto wanted =
        std::ranges::find_if(wanted_, [&](const InputEvent& event) { return satisfies(one.event, event); });
    if (wanted != wanted_.end()) wanted_.erase(wanted);
  }
}

std::string TourSource::description() const {
  return "tour " + name_ + ", " + text::counted(steps_, "caption") + (for_pilot_ ? ", waits for the pilot" : "");
}

}  // namespace yars::inputmonitor
