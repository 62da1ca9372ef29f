#include "tools/play_recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <utility>

#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "lib/radar/limits.hpp"
#include "tools/replay_session.hpp"

namespace yars::tools {

namespace {

constexpr long kLookPause_ns = 5'000'000;  // between looks: a tick at rate 1

double seconds_of(std::int64_t tick) {
  return static_cast<double>(tick) * radar::kTickSeconds;
}

std::string text_of_seconds(std::int64_t tick) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", seconds_of(tick));
  return text;
}

failure::Expected<std::int64_t> first_tick(const recording::RecordingReader& reader, const PlayOptions& options) {
  const auto blocks = reader.blocks();
  if (!options.seek_s) return blocks.front().first_tick;
  const auto least = std::ranges::min_element(blocks, {}, &recording::IndexEntry::first_tick)->first_tick;
  const auto most = std::ranges::max_element(blocks, {}, &recording::IndexEntry::last_tick)->last_tick;
  const double tick = std::round(*options.seek_s / radar::kTickSeconds);  // NaN lies in no recording
  if (tick >= static_cast<double>(least) && tick <= static_cast<double>(most)) return static_cast<std::int64_t>(tick);
  return tl::unexpected(databuffer::usage_error(
      "--seek", "a time of " + options.file + ", " + text_of_seconds(least) + " to " + text_of_seconds(most) + " s",
      std::to_string(*options.seek_s)));
}

failure::Expected<void> seek(ReplaySession& session, recording::Player& player, std::int64_t tick) {
  const recording::Played played = player.seek(tick);
  if (auto jumped = session.jump_to(tick); !jumped) return jumped;
  session.publish_key_frame(played);
  return {};
}

// One look: true while there is more to come.
failure::Expected<bool> look(ReplaySession& session, recording::Player& player, std::int64_t begin) {
  session.heartbeat();
  session.drop_events();
  if (session.was_reset()) {
    if (auto sought = seek(session, player, std::max(session.tick(), begin)); !sought)
      return tl::unexpected(sought.error());
    return true;
  }
  const std::int64_t now = session.tick();
  const recording::Played played = player.play_to(now);
  session.publish(played);
  if (played.cut_to_tick) {
    databuffer::log_info("at " + text_of_seconds(player.tick()) + " s the recording goes on at " +
                         text_of_seconds(*played.cut_to_tick) + " s");
    if (auto jumped = session.jump_to(*played.cut_to_tick); !jumped) return tl::unexpected(jumped.error());
    return true;
  }
  // With the clock held, the last picture stands.
  return !played.ended || now <= player.tick();
}

}  // namespace

failure::Expected<void> play_recording(recording::RecordingReader& reader, std::optional<recording::PlayerWorld> world,
                                       const PlayOptions& options) {
  if (std::isnan(options.rate)) return tl::unexpected(databuffer::usage_error("--rate", "0 to 10", "not a number"));
  const auto begin = first_tick(reader, options);
  if (!begin) return tl::unexpected(begin.error());
  auto session = ReplaySession::create(options.session);
  if (!session) return tl::unexpected(session.error());
  recording::Player player(reader, std::move(world));
  const recording::Played key_frame = player.seek(*begin);
  if (auto started = session->start(*begin, options.rate); !started) return started;
  session->publish_key_frame(key_frame);
  databuffer::log_info("plays " + options.file + " in session " + options.session + " from " + text_of_seconds(*begin) +
                       " s");
  while (!databuffer::stop_requested()) {
    const auto more = look(*session, player, reader.blocks().front().first_tick);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    const timespec pause{0, kLookPause_ns};
    nanosleep(&pause, nullptr);
  }
  std::printf("%s: played from %s to %s s of sim time\n", options.file.c_str(), text_of_seconds(*begin).c_str(),
              text_of_seconds(player.tick()).c_str());
  if (player.different() > 0)
    databuffer::log_warning(std::to_string(player.different()) +
                            " sweeps are not those that were recorded; replay with the same terrain and configuration");
  return {};
}

}  // namespace yars::tools
