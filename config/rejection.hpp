// How the parts of config/ leave a text that is wrong: thrown inside, caught where a public function returns Expected.
#pragma once

#include <string>

#include "config/value.hpp"
#include "lib/failure/error.hpp"

namespace yars::config {

struct Rejection {
  failure::Error error;
};

[[noreturn]] inline void reject(const Location& where, std::string expected, std::string found,
                                std::string action = {}) {
  throw Rejection{failure::fail(text_of(where), std::move(expected), std::move(found), std::move(action)).value()};
}

}  // namespace yars::config
