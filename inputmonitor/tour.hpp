// Tour: a script with captions. It plays by itself, or it waits at each step until the pilot has done the events.
// Inputs: text of a tour; the time of each call (Moment); events that the state machine has applied (SeenEvent).
// Outputs: input events; the caption of the current step.
// Errors: parse_tour() reports file name and line.
// Source: docs/tour.md#tour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/messages/caption.hpp"
#include "databuffer/messages/input_event.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// A caption begins a step. The events up to the next caption belong to the step.
struct TourItem {
  std::int64_t time_ns = 0;
  bool is_caption = false;
  std::vector<std::string> lines;  // caption: its text, at most kCaptionLines; empty takes the caption off
  databuffer::InputEvent event{};  // event
  bool automatic = false;          // event: the tour sends it also when it waits for the pilot
};

// Lines of a tour, besides those of a script (event_source.hpp):
//   title TEXT             name of the tour
//   [TIME_S] caption TEXT  a step; `|` separates up to 3 lines of up to 47 characters. Without TEXT: no caption
//   TIME_S auto EVENT      an event that the pilot need not do
// All times count from the moment when the tour starts. The last line is `end`.
struct Tour {
  std::string title;
  std::vector<TourItem> items;  // sorted by time, ascending
  std::int64_t end_ns = 0;
};

// `name`: file name for error messages.
error::Expected<Tour> parse_tour(std::string_view text, std::string_view name);

// Plays a tour by simulation time. When sim time goes back (a reset), the tour begins again.
// With `for_pilot` the tour's clock stops at the first event of a step that the pilot has to do, until he has done all
// of them with effect. It then goes on from the time of the last one. After `next` the tour sends what is missing.
// While nothing is left to do before the next caption, `next` goes to that caption.
class TourSource final : public EventSource {
 public:
  TourSource(Tour tour, std::string name, bool for_pilot);

  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  // Releases the TDC, if the tour has left it deflected.
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override { return ended_; }
  bool follows_sim_time() const override { return true; }
  bool has_captions() const override { return true; }
  const databuffer::Caption* caption() const override { return caption_ ? &*caption_ : nullptr; }
  void observe(const std::vector<SeenEvent>& seen) override;
  std::string description() const override;

 private:
  void begin(std::int64_t sim_time_ns);
  void begin_step(const TourItem& item, std::int64_t sim_time_ns);
  void send(const databuffer::InputEvent& event, std::vector<databuffer::InputEvent>& due);
  bool waits_at(const TourItem& item);
  void go_on(std::int64_t sim_time_ns);
  void set_waiting(bool waiting);
  std::int64_t time_ns(std::int64_t sim_time_ns) const { return sim_time_ns - origin_ns_; }

  Tour tour_;
  std::string name_;
  bool for_pilot_;
  std::optional<std::int64_t> last_sim_time_ns_;  // nullopt: not started
  std::int64_t origin_ns_ = 0;                    // simulation time at time 0 of the tour; later after each wait
  std::size_t next_ = 0;                          // item that comes next
  std::optional<databuffer::Caption> caption_;
  std::uint32_t step_ = 0;   // number of the current caption, from 1
  std::uint32_t steps_ = 0;  // number of captions
  bool ended_ = false;
  databuffer::InputEvent tdc_{};  // last deflection sent

  // -- With for_pilot_.
  std::vector<databuffer::InputEvent> wanted_;  // events of the step that the pilot has not done yet
  std::int64_t last_wanted_ns_ = 0;             // time of the step's last event for the pilot
  std::optional<std::int64_t> stopped_ns_;      // time of the tour at which its clock stands; nullopt: it runs
  bool sends_missing_ = false;                  // `next` came: the tour sends the events of this step itself
  bool next_asked_ = false;                     // `next` came since the last take()
  std::vector<databuffer::InputEvent> echoes_;  // events sent that the state machine has not applied yet
};

}  // namespace yars::inputmonitor
