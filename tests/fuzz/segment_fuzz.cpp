// A file of any length, with any bytes at its beginning, in place of a session's segment. shm::Segment and yars.h
// attach if and only if the header's identity is that of this build and the file is long enough. Session attaches only
// then. Input: length in KiB (two bytes), mode (one byte), then bytes of the header. Bits of mode: 1 starts from a good
// header, else zeros; 2 sets a length near that of a segment; 4 places the bytes at an offset (two bytes), else at 0.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"
#include "lib/error/error.hpp"
#include "shm/segment.hpp"
#include "tests/fuzz/attaching_client.h"
#include "tests/shm/segment_path.hpp"

using namespace yars;

namespace {

constexpr std::size_t kFront = 2048;  // [bytes] header, lockstep and clock, which a program reads to attach

const std::string& name() {
  static const std::string text = "fuzz-" + std::to_string(getpid());
  return text;
}

// The first bytes of a new session.
const std::vector<std::byte>& good_front() {
  static const std::vector<std::byte> front = [] {
    auto session = *databuffer::Session::open(name() + "-good", "fuzz");
    std::vector<std::byte> bytes(kFront);
    std::memcpy(bytes.data(), &session.layout(), bytes.size());
    return bytes;
  }();
  return front;
}

// A file at the segment's name, with the lock of a participant. Without the lock, an opening program would replace it.
class PlantedFile {
 public:
  PlantedFile(const std::vector<std::byte>& front, std::size_t bytes) : path_(test::segment_path(name())) {
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    YARS_REQUIRE(descriptor_, >=, 0);
    YARS_REQUIRE(ftruncate(descriptor_, static_cast<off_t>(bytes)), ==, 0);
    const std::size_t length = std::min(front.size(), bytes);
    YARS_REQUIRE(pwrite(descriptor_, front.data(), length, 0), ==, static_cast<ssize_t>(length));
    struct flock lock{};
    lock.l_type = F_RDLCK;
    lock.l_whence = SEEK_SET;
    lock.l_len = 1;
    YARS_REQUIRE(fcntl(descriptor_, F_OFD_SETLK, &lock), ==, 0);
  }
  PlantedFile(const PlantedFile&) = delete;
  PlantedFile& operator=(const PlantedFile&) = delete;
  ~PlantedFile() {
    close(descriptor_);
    unlink(path_.c_str());
  }

 private:
  std::string path_;
  int descriptor_;
};

bool matches(const std::vector<std::byte>& front, std::size_t bytes) {
  constexpr std::size_t kIdentity = 28;  // magic, size, hash, version
  return bytes >= sizeof(databuffer::SessionLayout) && std::memcmp(front.data(), good_front().data(), kIdentity) == 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  std::size_t bytes = (data[0] * 256U + data[1]) * std::size_t{1024} + data[2];
  std::vector<std::byte> front((data[2] & 1U) != 0 ? good_front() : std::vector<std::byte>(kFront));
  if ((data[2] & 2U) != 0) bytes = sizeof(databuffer::SessionLayout) + data[1] - std::min<std::size_t>(data[0], 2);
  bytes = std::min(bytes, databuffer::kMaxSegment_bytes);
  if ((data[2] & 4U) != 0 && size >= 5) {
    const std::size_t offset = (data[3] * 256U + data[4]) % kFront;
    std::memcpy(front.data() + offset, data + 5, std::min(size - 5, kFront - offset));
  } else {
    std::memcpy(front.data(), data + 3, std::min(size - 3, kFront));
  }
  const PlantedFile planted(front, bytes);
  const bool good = matches(front, bytes);

  const auto segment = shm::Segment::open_read_only(name(), databuffer::kLayoutIdentity);
  YARS_REQUIRE(segment.has_value(), ==, good);
  const auto reader = databuffer::Session::open_read_only(name());
  if (reader) YARS_REQUIRE(good, ==, true);
  if (reader) YARS_REQUIRE(reader->sim_time_ns(), >=, 0);
  const auto writer = databuffer::Session::open(name(), "fuzz");
  if (writer) YARS_REQUIRE(good, ==, true);
  if (writer) YARS_REQUIRE(std::as_const(*writer).layout().spare.back().load(), ==, 0U);
  YARS_REQUIRE(attach_as_a_client(name().c_str()) != 0, ==, good);
  return 0;
}
