#include "station/app/site_shell.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "databuffer/json/status_json.hpp"
#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/key_map.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "display/symbology/overlay_texts.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/imageio/png.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/modes.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::station {

namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::int64_t kFrameInterval_ns = 25 * kNsPerMs;   // most frames a second: 40
constexpr std::int64_t kStateInterval_ns = 250 * kNsPerMs;  // of states without a change of the radar state

}  // namespace

error::Expected<StationFeed> StationFeed::create(databuffer::Session& session) {
  auto lane = runtime::InputLane::claim(session, "station");
  if (!lane) return tl::unexpected(lane.error());
  return StationFeed(session, std::move(*lane));
}

bool StationFeed::refresh() {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  const bool frame = refresh_frame(now_ns);
  const bool state = refresh_state(now_ns);
  return frame || state;
}

bool StationFeed::refresh_frame(std::int64_t now_ns) {
  if (now_ns - frame_ns_ < kFrameInterval_ns) return false;
  databuffer::GlassFrame frame{};  // a copy that failed may hold anything
  if (!databuffer::read_newest_frame(std::as_const(*session_).layout(), frame_id_, frame, pixels_)) return false;
  frame_id_ = frame.id;
  if (const auto reason = databuffer::validate(frame)) {
    session_->note(databuffer::NoteKind::refusal, "station: frame: " + *reason);
    return false;
  }
  frame_ns_ = now_ns;
  frames_.take(frame, pixels_);
  return true;
}

bool StationFeed::refresh_state(std::int64_t now_ns) {
  const auto& layout = std::as_const(*session_).layout();
  const bool changed = state_.refresh(layout.radar_state, *session_, "station: radar state") ||
                       advice_.refresh(layout.advice, *session_, "station: advice");
  if (!changed && now_ns < next_state_ns_) return false;
  next_state_ns_ = now_ns + kStateInterval_ns;
  model_.refresh(layout.model_status, *session_, "station: model status");
  advice_.refresh(layout.advice, *session_, "station: advice");
  input_.state = state_.value();
  input_.model = model_.value();
  input_.advice = advice_.value();
  const auto processes = session_->processes();
  input_.state_machine_alive = runtime::is_alive(processes, databuffer::Role::state_machine, now_ns);
  input_.model_alive = runtime::is_alive(processes, databuffer::Role::radar_model, now_ns);
  state_text_ = std::make_shared<const std::string>(state_message());
  ++state_number_;
  return true;
}

std::string StationFeed::state_message() const {
  nlohmann::ordered_json message;
  message["watch"] = databuffer::watch_json(databuffer::watch_of(*session_));
  auto& buttons = message["buttons"] = nlohmann::ordered_json::array();
  for (int button = 1; button <= radar::kBezelButtons; ++button)
    buttons.push_back(nlohmann::ordered_json{{"key", std::string(databuffer::key_of_button(button))},
                                             {"does", display::words_of_button(input_, button)}});
  message["recorder"] = session_->role_is_held(databuffer::Role::recorder);
  return message.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

namespace terrain = model::terrain;

MapShell::MapShell(std::unique_ptr<terrain::TerrainStore> store)
    : store_(std::move(store)), thread_([this] { serve(); }) {}

MapShell::~MapShell() {
  {
    const std::lock_guard guard(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

bool MapShell::request(const MapTile& tile, Answer answer) {
  std::shared_ptr<const std::string> png;
  {
    const std::lock_guard guard(mutex_);
    if (const auto found = kept_.find(tile); found != kept_.end()) {
      png = found->second;
    } else {
      if (waiting_.size() >= kMaxWaiting) return false;
      waiting_.push_back({tile, std::move(answer)});
    }
  }
  if (png)
    answer(png);
  else
    wake_.notify_one();
  return true;
}

void MapShell::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    // The newest request first: the user has moved the map since the older ones.
    const Request request = std::move(waiting_.back());
    waiting_.pop_back();
    std::shared_ptr<const std::string> png;
    if (const auto found = kept_.find(request.tile); found != kept_.end()) png = found->second;
    lock.unlock();
    if (!png) png = drawn(request.tile);
    request.answer(png);
    lock.lock();
    if (!kept_.emplace(request.tile, png).second) continue;
    order_.push_back(request.tile);
    if (order_.size() <= kKept) continue;
    kept_.erase(order_.front());
    order_.pop_front();
  }
}

std::shared_ptr<const std::string> MapShell::drawn(const MapTile& tile) {
  const terrain::MapFrame frame = frame_of(tile);
  const geo::GeoPoint centre{0.5 * (frame.south_deg + frame.north_deg), 0.5 * (frame.west_deg + frame.east_deg)};
  const double edge_m = (frame.north_deg - frame.south_deg) * geo::kMetresPerDegree;
  const terrain::TerrainRegion region{centre, 0.75 * edge_m, terrain::detail_for(edge_m / kTilePixels)};
  const terrain::TerrainViewPointer view = store_->prepare(region);
  for (const std::string& problem : store_->take_problems()) log::debug("map: " + problem);
  const imageio::Image image = terrain::map_of(*view, frame);
  std::vector<std::uint8_t> rgbx, png;
  rgbx.reserve(image.pixels.size() / 3 * 4);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    rgbx.insert(rgbx.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2], 0});
  imageio::encode_png({rgbx.data(), frame.width, frame.height, 4U * static_cast<std::size_t>(frame.width)}, png);
  return std::make_shared<const std::string>(png.begin(), png.end());
}

Text sets_message(const SetsShell& sets) {
  const nlohmann::ordered_json message{{"sets", sets.sets()}};
  return std::make_shared<const std::string>(
      message.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
}

PagePlace::PagePlace(std::shared_ptr<PlaceCounts> counts, std::vector<std::string> names)
    : counts_(std::move(counts)), names_(std::move(names)) {
  for (const std::string& name : names_) ++(*counts_)[name];
}

PagePlace::~PagePlace() {
  if (counts_ == nullptr) return;
  for (const std::string& name : names_)
    if (--(*counts_)[name] == 0) counts_->erase(name);
}

std::optional<PagePlace> Places::take(Right right, bool is_instructors, const std::string& address) {
  const auto taken = [this](const std::string& name) {
    const auto found = counts_->find(name);
    return found == counts_->end() ? 0 : found->second;
  };
  const std::string of_address = "viewer at " + address;
  const bool may_instruct = right == Right::instructor;
  if (!(may_instruct && is_instructors) && taken("viewer") < kViewers && taken(of_address) < kViewersOfAddress)
    return PagePlace(counts_, {"viewer", of_address});
  if (may_instruct && taken("instructor") < kInstructors) return PagePlace(counts_, {"instructor"});
  return std::nullopt;
}

std::string Places::text() {
  return "at most " + std::to_string(kViewers) + " viewers, " + std::to_string(kViewersOfAddress) +
         " of one address, and " + std::to_string(kInstructors) + " instructors";
}

void Visits::add(const std::shared_ptr<OpenVisit>& visit) {
  std::erase_if(visits_, [](const std::weak_ptr<OpenVisit>& entry) { return entry.expired(); });
  visits_.push_back(visit);
  if (visits_.size() <= kMost) return;
  const auto has_no_right = [](const std::weak_ptr<OpenVisit>& entry) {
    const auto there = entry.lock();
    return !there || !there->has_right();
  };
  auto chosen = std::find_if(visits_.begin(), visits_.end() - 1, has_no_right);
  if (chosen == visits_.end() - 1) chosen = visits_.begin();
  if (const auto there = chosen->lock()) there->close();
  visits_.erase(chosen);
}

error::Expected<std::shared_ptr<SessionFeed>> Site::feed_of(const std::string& session) {
  if (!sets.has_session(session))
    return error::fail("session", "the station's own or one of its sets", session.substr(0, 40));
  if (const auto known = feeds.find(session); known != feeds.end())
    if (auto feed = known->second.lock()) return feed;
  // A session that nobody runs must not come into being by a look at it.
  if (session != own_session)
    if (auto there = databuffer::Session::open_read_only(session); !there) return tl::unexpected(there.error());
  auto opened = databuffer::Session::open(session, "station");
  if (!opened) return tl::unexpected(opened.error());
  auto feed = std::make_shared<SessionFeed>(std::move(*opened), session);
  auto display = StationFeed::create(feed->session);
  if (!display) return tl::unexpected(display.error());
  feed->display = std::make_unique<StationFeed>(std::move(*display));
  feeds[session] = feed;
  return feed;
}

void Site::look() {
  std::erase_if(pages, [](const std::weak_ptr<OpenPage>& page) { return page.expired(); });
  std::erase_if(feeds, [](const auto& entry) { return entry.second.expired(); });
  if (sets.look()) tell_all(sets_message(sets));
  for (const auto& [name, entry] : feeds) {
    const auto feed = entry.lock();
    if (!feed) continue;
    feed->session.heartbeat();
    if (feed->displays + feed->instructors > 0) feed->display->refresh();
    feed->instructor.refresh(feed->instructors > 0);
  }
  for (const std::weak_ptr<OpenPage>& entry : pages)
    if (const auto page = entry.lock()) page->pump();
}

void Site::tell_all(const Text& text) {
  for (const std::weak_ptr<OpenPage>& entry : pages)
    if (const auto page = entry.lock()) page->tell(text);
}

}  // namespace yars::station
