#include "tests/endtoend/storm/private_memory.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>

namespace yars::endtoend::storm {

PrivateMemory::PrivateMemory() : before_(open("/proc/self/ns/mnt", O_RDONLY | O_CLOEXEC)) {
  if (before_ < 0 || unshare(CLONE_NEWNS) != 0) return;
  // Nothing that is mounted here reaches the machine.
  if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return;
  private_ = mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, "size=96m,mode=1777") == 0;
}

PrivateMemory::~PrivateMemory() {
  if (before_ < 0) return;
  // Joining a namespace moves the working folder to its root.
  const auto here = std::filesystem::current_path();
  if (setns(before_, CLONE_NEWNS) == 0) std::filesystem::current_path(here);
  close(before_);
}

}  // namespace yars::endtoend::storm
