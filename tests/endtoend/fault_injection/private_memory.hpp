// Private /dev/shm of 96 MiB for this process and its children, so that a test may fill it: a tmpfs in a mount
// namespace. This needs root. Without root, is_private() is false and nothing is changed.
#pragma once

#include <cstdint>

namespace yars::endtoend::fault_injection {

class PrivateMemory {
 public:
  PrivateMemory();
  ~PrivateMemory();  // restores namespace, root and working folder; all children must have ended
  PrivateMemory(const PrivateMemory&) = delete;
  PrivateMemory& operator=(const PrivateMemory&) = delete;

  bool is_private() const { return private_; }

 private:
  int before_;                     // descriptor of the original mount namespace
  int root_before_, here_before_;  // descriptors of the original root and working folder
  bool private_ = false;
};

}  // namespace yars::endtoend::fault_injection
