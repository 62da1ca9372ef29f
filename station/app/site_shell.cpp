#include "station/app/site_shell.hpp"

#include <nlohmann/json.hpp>

namespace yars::station {

Text sets_message(const SetsShell& sets) {
  const nlohmann::ordered_json message{{"sets", sets.sets()}};
  return std::make_shared<const std::string>(
      message.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
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
