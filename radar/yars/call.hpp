// How a long call tells of problems and progress, and how it is ended early.
// Threads: all functions are called on the thread that has made the call.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace yars {

// Each function may be empty. None of them may throw.
struct Call {
  // Takes a problem of a single file, such as a damaged cell: one sentence. The call goes on without the file.
  std::function<void(const std::string& problem)> warn{};
  // Is called after each step with the step's name and the share of the work that is done, 0 to 1.
  std::function<void(std::string_view step, double share)> progress{};
  // Is asked between steps whether the call goes on. False: it ends with ErrorCode::cancelled, and what it has used
  // stays usable.
  std::function<bool()> goes_on{};
};

}  // namespace yars
