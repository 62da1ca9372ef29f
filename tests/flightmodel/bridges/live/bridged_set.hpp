// Fixture: a set whose flight-model receives the aircraft from an external program by UDP. It reads the ownship that
// radar-model has latched.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "databuffer/session/session.hpp"
#include "lib/text/plain_text.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {

class BridgedSet : public ::testing::Test {
 protected:
  explicit BridgedSet(const std::string& name = "bridge") : set_(name) {}

  // Starts flight-model under the name "bridge" and returns the UDP port on which it listens; 0: none within 20 s.
  std::uint16_t listen(const std::string& source) {
    set_.start("bridge", {"flight-model", "--source", source});
    std::size_t found_at = std::string::npos;
    std::string log;
    const std::string prefix = "on 127.0.0.1:";
    eventually(
        [&] {
          log = set_.log_of("bridge");
          found_at = log.find(prefix);
          return found_at != std::string::npos && log.find('\n', found_at) != std::string::npos;
        },
        20.0);
    EXPECT_NE(found_at, std::string::npos) << log;
    return found_at == std::string::npos ? std::uint16_t{0}
                                         : static_cast<std::uint16_t>(std::stoi(log.substr(found_at + prefix.size())));
  }

  // Starts radar-model, attaches to the session, and waits for the first model status.
  void start_radar(const std::vector<std::string>& options = {}) {
    std::vector<std::string> command{"radar-model"};
    command.insert(command.end(), options.begin(), options.end());
    set_.start("radar-model", command);
    ASSERT_TRUE(eventually([&] { return attach(); }, 20.0)) << set_.log_of("radar-model");
    ASSERT_TRUE(eventually([&] { return layout().model_status.has_value(); }, 60.0)) << set_.log_of("radar-model");
  }

  const databuffer::SessionLayout& layout() const { return std::as_const(*session_).layout(); }

  // Ownship that radar-model has latched; nullopt while no source is fresh.
  std::optional<databuffer::Ownship> latched() const {
    databuffer::ModelStatus status{};
    if (!layout().model_status.read(status) || (status.flags & databuffer::kModelStale) != 0U) return std::nullopt;
    return status.ownship;
  }

  // The latched ownship, if it is of this source.
  // `source`: that of DIS has the geoid behind it, "dis/egm96-5".
  std::optional<databuffer::Ownship> latched_from(const std::string& source) const {
    auto own = latched();
    const std::string_view found = own ? text::text_of(own->source) : std::string_view();
    if (found.substr(0, found.find('/')) != source) own.reset();
    return own;
  }
  bool flown_by(const std::string& source) const { return latched_from(source).has_value(); }

  // Number of notes of this kind in the flight recorder.
  std::uint64_t notes(databuffer::NoteKind kind) const {
    return layout().note_counts[static_cast<std::size_t>(kind)].load();
  }

  ProcessSet set_;
  std::optional<databuffer::Session> session_;

 private:
  bool attach() {
    auto session = databuffer::Session::open_read_only(set_.session());
    if (session) session_.emplace(std::move(*session));
    return session.has_value();
  }
};

}  // namespace yars::endtoend
