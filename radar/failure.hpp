// Errors inside the library: fail() throws a Failure, and guarded() turns it into the error of a public function.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::radar {

struct Failure {
  Error error;
};

[[noreturn]] inline void fail(Error error) {
  throw Failure{std::move(error)};
}

// Returns the result of call(), or the error that it has thrown.
template <class Function>
auto guarded(const Function& call) -> Expected<std::invoke_result_t<Function>> {
  const text::DecimalPoint numbers;  // in GUF, messages and names, whatever the caller's locale has
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Function>>) {
      call();
      return {};
    } else {
      return call();
    }
  } catch (const Failure& failure) {
    return tl::unexpected(failure.error);
  } catch (const parallel::Stopped&) {
    return tl::unexpected(Error{"", "a call that goes on", "one that was ended", "", ErrorCode::cancelled, {}, {}});
  }
}

}  // namespace yars::radar
