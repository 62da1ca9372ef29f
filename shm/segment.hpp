// A named piece of shared memory, /dev/shm/yars.UID.NAME, that lives as long as somebody takes part in it.
// It is built whole without a name and linked to its own: nobody sees half a segment. Every participant holds
// a read lock on byte 0 of the file (F_OFD_SETLK), which the kernel frees at death; who gets the write lock is alone:
// leaving, it unlinks the file; arriving, it replaces a leftover. The other lock bytes are claims (roles, lanes).
// When somebody else removes the name (systemd-logind's RemoveIPC at a logout), those who take part go on, and who
// comes finds them by /proc and takes part too; has_name() tells. Errors: a full /dev/shm, a file of another user,
// another build's layout (both values are printed).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "lib/failure/error.hpp"
#include "shm/segment_header.hpp"

namespace yars::shm {

class Segment {
 public:
  // Fills the creator's zeroed memory behind the header, before anybody else can see it.
  using Initialize = void (*)(void* memory);

  // Attaches to the segment, or creates it. `name`: letters, digits, '-' and '_'.
  static failure::Expected<Segment> open(const std::string& name, const LayoutIdentity& layout, Initialize initialize);
  // For readers: the mapping cannot be written, no lock is held. A leftover that nobody takes part in is an error.
  static failure::Expected<Segment> open_read_only(const std::string& name, const LayoutIdentity& layout);

  Segment(Segment&&) noexcept;
  Segment& operator=(Segment&&) noexcept;
  ~Segment();  // gives up all locks; who leaves last unlinks

  void* memory();  // only of a writable segment
  const void* memory() const;
  bool writable() const;
  bool created() const;   // this process made it
  bool has_name() const;  // the segment's path leads to this segment

  // A claim on `byte` in [1, kLockBytes): held until unlock, the segment's end or the process's death, also while the
  // process is stopped. Within one Segment a byte can be held once.
  bool try_lock(std::size_t byte);
  void unlock(std::size_t byte);
  bool is_locked(std::size_t byte) const;           // by anybody, this process included
  std::int32_t holder_pid(std::size_t byte) const;  // who locked it last and did not unlock it; 0 = nobody

 private:
  struct Core;
  explicit Segment(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

// Where the segment of a name lies: /dev/shm/yars.UID.NAME.
std::string segment_path(const std::string& name);

}  // namespace yars::shm
