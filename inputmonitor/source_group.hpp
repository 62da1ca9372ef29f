// Several sources as one: none waits for another. It ends when one of them does, as the keyboard by Escape.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "inputmonitor/event_source.hpp"

namespace yars::inputmonitor {

// [ms] a source that no descriptor can wake, a window, leaves the others unheard no longer: one tick
inline constexpr int kLongestDeaf_ms = 5;

class SourceGroup final : public EventSource {
 public:
  explicit SourceGroup(std::vector<std::unique_ptr<EventSource>> sources) : sources_(std::move(sources)) {}

  void wait(const Moment& moment, int longest_ms) override;
  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override;
  bool follows_sim_time() const override;
  std::vector<News> news() override;
  std::string description() const override;

 private:
  std::vector<std::unique_ptr<EventSource>> sources_;
};

}  // namespace yars::inputmonitor
