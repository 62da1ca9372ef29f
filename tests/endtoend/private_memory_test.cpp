// The private /dev/shm of fault injection restores namespace, root and folder of the process, also in a chroot.
// scripts/check_fresh runs in a chroot.
#include "tests/endtoend/fault_injection/private_memory.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

namespace yars::endtoend::fault_injection {
namespace {

constexpr int kNotPermitted = 77;  // exit code: this user may not mount or change the root

// Identity of a folder.
struct Place {
  dev_t device;
  ino_t file;
  bool operator==(const Place&) const = default;
};

Place place_of(const char* path) {
  struct stat status{};
  return stat(path, &status) == 0 ? Place{status.st_dev, status.st_ino} : Place{};
}

// Enters a chroot and makes and destroys a PrivateMemory there. Needs a process of its own, which may lose its root.
// 0: root, working folder and /dev/shm are restored; kNotPermitted; else the number of the failed check.
int restore_in_a_chroot(const std::filesystem::path& folder) {
  if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return kNotPermitted;
  if (mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=1m") != 0) return kNotPermitted;
  std::filesystem::create_directories(folder / "proc");
  std::filesystem::create_directories(folder / "dev" / "shm");
  std::filesystem::create_directories(folder / "work");
  if (mount("/proc", (folder / "proc").c_str(), nullptr, MS_BIND | MS_REC, nullptr) != 0 ||
      mount("tmpfs", (folder / "dev/shm").c_str(), "tmpfs", 0, "size=1m") != 0)
    return kNotPermitted;
  if (chroot(folder.c_str()) != 0 || chdir("/work") != 0) return kNotPermitted;
  const Place root = place_of("/");
  const Place here = place_of(".");
  const Place shared = place_of("/dev/shm");
  {
    PrivateMemory memory;
    if (!memory.is_private() || place_of("/dev/shm") == shared) return 1;
  }
  if (!(place_of("/") == root)) return 2;
  if (!(place_of(".") == here)) return 3;
  return place_of("/dev/shm") == shared ? 0 : 4;
}

TEST(PrivateMemory, RestoresRootAndWorkingFolderInAChroot) {
  std::string name = std::filesystem::temp_directory_path() / "yars-chroot-XXXXXX";
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const pid_t child = fork();
  if (child == 0) {
    try {
      _exit(restore_in_a_chroot(name));
    } catch (...) {
      _exit(5);
    }
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  std::filesystem::remove(name);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNotPermitted) GTEST_SKIP() << "needs root";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace yars::endtoend::fault_injection
