#include "databuffer/ownship_receiver.hpp"

#include <cmath>
#include <string_view>

#include "databuffer/records/plain_text.hpp"
#include "databuffer/records/validation.hpp"

namespace yars::databuffer {

namespace {

// A source that gives no nav: the navigators know the truth.
Nav nav_from_truth(const Ownship& ownship) {
  Nav nav{};
  nav.source_time_ns = ownship.source_time_ns;
  nav.mission_latitude_deg = nav.ins_latitude_deg = ownship.latitude_deg;
  nav.mission_longitude_deg = nav.ins_longitude_deg = ownship.longitude_deg;
  nav.velocity_north_mps = ownship.velocity_north_mps;
  nav.velocity_east_mps = ownship.velocity_east_mps;
  nav.velocity_down_mps = ownship.velocity_down_mps;
  nav.magnetic_variation_deg = std::nan("");
  nav.epoch = ownship.epoch;
  return nav;
}

}  // namespace

std::string name_of_source(const Ownship& ownship, std::uint32_t lane) {
  const std::string_view name = text_of(ownship.source);
  return name.empty() ? "unnamed (lane " + std::to_string(lane) + ")" : std::string(name);
}

void OwnshipReceiver::receive(const SessionLayout& layout, std::size_t index) {
  Lane& lane = lanes_[index];
  const auto refuse = [this, index](const char* record, const std::string& reason) {
    ++refused_;
    refusals_.push_back(std::string(record) + " in lane " + std::to_string(index) + ": " + reason);
  };
  // A lane taken away holds nothing of its last writer for the next one.
  if (!layout.ownship[index].has_value()) lane.accepted = 0;
  if (!layout.nav[index].has_value()) lane.has_nav = false;
  if (layout.ownship[index].version() != lane.version) {
    Ownship ownship{};
    if (const auto version = layout.ownship[index].read(ownship)) {
      lane.version = *version;
      if (const auto reason = why_refused(ownship)) {
        refuse("ownship", *reason);
      } else {
        lane.ownship = ownship;
        ++lane.accepted;
      }
    }
  }
  if (layout.nav[index].version() != lane.nav_version) {
    Nav nav{};
    if (const auto version = layout.nav[index].read(nav)) {
      lane.nav_version = *version;
      if (const auto reason = why_refused(nav)) {
        refuse("nav", *reason);
      } else {
        lane.nav = nav;
        lane.has_nav = true;
      }
    }
  }
}

const OwnshipReceiver::Selected& OwnshipReceiver::refresh(const SessionLayout& layout, std::int64_t sim_time_ns,
                                                          std::uint32_t epoch) {
  refusals_.clear();
  std::array<OwnshipLane, kOwnshipLanes> view{};
  for (std::size_t i = 0; i < kOwnshipLanes; ++i) {
    receive(layout, i);
    view[i].present = lanes_[i].accepted > 0 && layout.ownship[i].has_value();
    view[i].priority = layout.ownship_priority[i].load(std::memory_order_relaxed);
    view[i].version = lanes_[i].accepted;
  }
  selection_ = select_ownship(view, sim_time_ns, selection_);
  selected_.valid = selection_.lane.has_value();
  selected_.jump.reset();
  if (!selected_.valid) {
    selected_.lane = kNoLane;
    return selected_;
  }
  const Lane& lane = lanes_[*selection_.lane];
  const std::int64_t received_ns = selection_.memory[*selection_.lane].received_ns.value_or(sim_time_ns);
  const bool lockstep = layout.lockstep.enabled.load(std::memory_order_relaxed) != 0;
  if (!lockstep && !guard_.believes(lane.ownship, received_ns, sim_time_ns, epoch)) {
    if (guard_.is_proven()) {
      selected_.jump = lane.ownship;
      selected_.jump_lane = static_cast<std::uint32_t>(*selection_.lane);
    }
    return selected_;
  }
  selected_.lane = static_cast<std::uint32_t>(*selection_.lane);
  selected_.ownship = lane.ownship;
  selected_.received_ns = received_ns;
  selected_.nav = lane.has_nav ? lane.nav : nav_from_truth(lane.ownship);
  return selected_;
}

}  // namespace yars::databuffer
