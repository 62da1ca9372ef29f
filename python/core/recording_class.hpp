// Class Recording of the Python module: a file of `yars record`, read as arrays.
// Inputs: a path; kinds of records by name; a range of ticks, both ends included. Outputs: structured arrays with the
// fields of records.idl, video and pictures.
// Units: as units() says for each field; ticks are 5 ms.
// Errors: yars.Error for a file that is no recording, ValueError for an unknown kind. Damaged parts are left out, with
// a warning for each that names the missing ticks. Threads: one call at a time; a lock makes others wait. The
// interpreter's lock is released while a file is read.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/core/calls.hpp"
#include "python/core/support.hpp"
#include "tools/recording/recording_reader.hpp"

namespace yars::python {

// Ticks to read, both ends included. nullopt: no limit.
struct TickRange {
  std::optional<std::int64_t> first, last;
  bool contains(std::int64_t tick) const { return (!first || tick >= *first) && (!last || tick <= *last); }
};

class Recording {
 public:
  explicit Recording(const std::string& path);

  py::dict header() const;
  py::list kinds() const;  // names of the kinds that the file has, in the order of their numbers
  std::optional<std::int64_t> first_tick() const { return first_tick_; }  // nullopt: no block
  std::optional<std::int64_t> last_tick() const { return last_tick_; }    // nullopt: no block
  bool cut_short() const { return cut_short_; }

  py::array records(const std::string& kind, const TickRange& ticks);
  static py::dict units(const std::string& kind);
  // Headers, and video of shape (sweeps, largest number of samples); 0 beyond the samples of a sweep.
  py::tuple sweeps(const TickRange& ticks);
  // Headers, and a list of pictures of shape (size, size).
  py::tuple maps(const TickRange& ticks);

 private:
  // Bytes of the records of one kind, one after the other, and of their tails.
  struct Collected {
    std::vector<std::byte> fixed, tails;
    std::vector<std::size_t> tail_bytes;
  };
  Collected collect(const tools::recording::RecordedKind& kind, const TickRange& ticks, bool with_tails);
  void show_damage();
  // Opens the file if this process has not yet. Call it with lock_ taken, or alone. Throws CommandFailed.

  std::string path_;
  tools::recording::RecordingReader& reader() const { return **reader_; }
  void open();

  // On the heap, so that a child of fork() can leave a reader that is half changed.
  using Reader = std::optional<tools::recording::RecordingReader>;
  std::unique_ptr<Reader> reader_ = std::make_unique<Reader>();
  ObjectLock lock_{[this] { static_cast<void>(reader_.release()), reader_ = std::make_unique<Reader>(); }};
  int process_ = 0;  // that has opened the file: the place in it is shared with a parent
  // What the file's head and index say.
  bool cut_short_ = false;
  tools::recording::RecordingHeader header_;
  std::uint64_t kind_bits_ = 0;
  std::optional<std::int64_t> first_tick_, last_tick_;
  std::size_t shown_ = 0;  // damaged blocks that were warned of
};

void add_recording(py::module_& module);

}  // namespace yars::python
