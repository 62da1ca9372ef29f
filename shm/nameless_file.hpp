// Files that processes of this user hold open though their name is gone from /dev/shm: somebody else removed it, as
// systemd-logind does at a user's logout (RemoveIPC=yes). What is mapped goes on; this finds the way back in.
#pragma once

#include <string>
#include <vector>

namespace yars::shm {

// Paths /proc/PID/fd/N that open files which had the name `path`, or the name under which a creator built it
// (path.NUMBER.tmp), and have none now; regular files of this user alone. Looks at every process that this user may
// look into; a few milliseconds.
std::vector<std::string> nameless_files(const std::string& path);

}  // namespace yars::shm
