// Fixture: opens sessions of a unique name, and reads the last note of their flight recorder.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/session/session.hpp"
#include "tests/databuffer/session/session_name.hpp"

namespace yars::databuffer::testing {

class OpenSessionTest : public SessionTest {
 protected:
  Session open(std::string_view process = "tester") const {
    auto session = Session::open(name_, process);
    if (!session) throw std::runtime_error(session.error().message());
    return std::move(*session);
  }
  static std::string last_note(const Session& session) {
    const auto& notes = session.layout().notes;
    Note note{};
    return notes.total() > 0 && notes.read(notes.total() - 1, note) ? note.text : "";
  }
};

}  // namespace yars::databuffer::testing
