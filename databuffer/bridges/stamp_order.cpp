#include "databuffer/bridges/stamp_order.hpp"

#include <cmath>

#include "databuffer/records/plain_text.hpp"

namespace yars::databuffer::bridges {

// The way from one stamp to another, the shorter one where stamps run in a circle.
geo::Duration StampOrder::since(geo::Duration before, geo::Duration stamp) const {
  const double way_s = (stamp - before).seconds();
  return geo::Duration::seconds(period_ ? std::remainder(way_s, period_->seconds()) : way_s);
}

std::optional<std::string> StampOrder::why_not_news(geo::Duration stamp) {
  const auto take = [&] {
    last_ = stamp;
    restarted_.reset();
    return std::nullopt;
  };
  if (!last_) return take();
  const geo::Duration ahead = since(*last_, stamp);
  if (ahead > geo::Duration()) return take();
  const std::string found = "stamp " + text_of_number(stamp.seconds()) + " s ";
  if (ahead == geo::Duration()) return found + "for the second time";
  const std::string after = "after " + text_of_number(last_->seconds()) + " s";
  if (ahead >= -kLongestDelay) return found + after;
  if (restarted_) {
    const geo::Duration on = since(*restarted_, stamp);
    if (on > geo::Duration() && on <= kLongestDelay) return take();
  }
  restarted_ = stamp;
  return found + after + ", a first of a sender that began again";
}

}  // namespace yars::databuffer::bridges
