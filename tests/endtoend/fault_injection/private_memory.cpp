#include "tests/endtoend/fault_injection/private_memory.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cstdio>
#include <initializer_list>

namespace yars::endtoend::fault_injection {

PrivateMemory::PrivateMemory()
    : before_(open("/proc/self/ns/mnt", O_RDONLY | O_CLOEXEC)),
      root_before_(open("/", O_PATH | O_DIRECTORY | O_CLOEXEC)),
      here_before_(open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)) {
  if (before_ < 0 || root_before_ < 0 || here_before_ < 0 || unshare(CLONE_NEWNS) != 0) return;
  // Private propagation keeps the mounts of this namespace from the rest of the machine. In a chroot `/` may be no
  // mount point; then /dev/shm must be one.
  if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 &&
      mount("none", "/dev/shm", nullptr, MS_PRIVATE, nullptr) != 0)
    return;
  private_ = mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, "size=96m,mode=1777") == 0;
}

// setns() sets the root and the working folder to the root of the joined namespace, not to that of a chroot. The
// descriptors from the constructor restore both.
PrivateMemory::~PrivateMemory() {
  if (before_ >= 0 && root_before_ >= 0 && here_before_ >= 0 && setns(before_, CLONE_NEWNS) == 0) {
    const bool is_back = fchdir(root_before_) == 0 && chroot(".") == 0 && fchdir(here_before_) == 0;
    if (!is_back) std::perror("cannot restore root and working folder after fault injection");
  }
  for (const int descriptor : {before_, root_before_, here_before_})
    if (descriptor >= 0) close(descriptor);
}

}  // namespace yars::endtoend::fault_injection
