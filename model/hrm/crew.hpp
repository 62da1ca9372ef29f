// Hands that share a piece of work. What they make is the same however many they are.
#pragma once

#include <cstddef>
#include <functional>

namespace yars::model::hrm {

// Runs job(0), ..., job(threads - 1) at the same time and waits for all.
struct Crew {
  std::size_t threads = 1;
  std::function<void(const std::function<void(std::size_t)>&)> run = [](const auto& job) { job(0); };
};

// job(first, behind the last, thread) on runs of `count` things, one a thread, in order.
template <class Job>
void share_out(const Crew& crew, int count, const Job& job) {
  const auto threads = static_cast<int>(crew.threads);
  crew.run([&](std::size_t thread) {
    const auto number = static_cast<int>(thread);
    job(number * count / threads, (number + 1) * count / threads, thread);
  });
}

}  // namespace yars::model::hrm
