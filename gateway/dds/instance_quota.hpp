// Limit of the instances (keys) that the writers of one topic may have in a reader.
// Inputs: instance and writer of each sample, as numbers that DDS gives them; the ends of instances.
// Outputs: whether a sample may enter; numbers of samples that did not, and of ends of instances that are not counted.
// Use: Cyclone DDS keeps an instance, about 450 bytes, as long as its writer lives. Its own resource limits are no
//   remedy: a reliable sample beyond them blocks the thread that receives all topics (Cyclone DDS 0.10.2).
// Threads: any.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <unordered_map>

namespace yars::gateway::dds {

class InstanceQuota {
 public:
  // Maximum number of instances of one writer, and of all.
  InstanceQuota(std::size_t of_writer, std::size_t of_all) : of_writer_(of_writer), of_all_(of_all) {}

  // True if the instance is known, or its writer may have one more.
  bool admits(std::uint64_t instance, std::uint64_t writer) {
    const std::lock_guard guard(mutex_);
    if (writers_.contains(instance)) return true;
    std::size_t& count = counts_[writer];
    if (count >= of_writer_ || writers_.size() >= of_all_) {
      ++refused_;
      if (count == 0) counts_.erase(writer);
      return false;
    }
    ++count;
    writers_.emplace(instance, writer);
    return true;
  }
  // The instance has ended.
  void end(std::uint64_t instance) {
    const std::lock_guard guard(mutex_);
    const auto found = writers_.find(instance);
    if (found == writers_.end()) return void(++strays_);
    if (--counts_[found->second] == 0) counts_.erase(found->second);
    writers_.erase(found);
  }
  // All instances have ended.
  void clear() {
    const std::lock_guard guard(mutex_);
    writers_.clear();
    counts_.clear();
    strays_ = 0;
  }
  std::size_t size() const {
    const std::lock_guard guard(mutex_);
    return writers_.size();
  }
  std::size_t of_writer() const { return of_writer_; }
  std::uint64_t refused() const { return refused_; }
  // Ends of instances that never had a sample. Their writer may hold them.
  std::uint64_t strays() const { return strays_; }

 private:
  mutable std::mutex mutex_;
  std::size_t of_writer_, of_all_;
  std::atomic<std::uint64_t> refused_ = 0, strays_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> writers_;  // by instance
  std::unordered_map<std::uint64_t, std::size_t> counts_;     // by writer
};

}  // namespace yars::gateway::dds
