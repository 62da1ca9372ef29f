#include "station/app/site_shell.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace yars::station {

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
