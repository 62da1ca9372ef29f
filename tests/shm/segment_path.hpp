// Path of a segment's file, computed independently of shm/segment.cpp. Source: docs/shared_memory.md.
#pragma once

#include <unistd.h>

#include <string>

namespace yars::test {

inline std::string segment_path(const std::string& name) {
  return "/dev/shm/yars." + std::to_string(geteuid()) + "." + name;
}

}  // namespace yars::test
