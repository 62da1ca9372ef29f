// Class Recording of the Python module: that of the library (yars/recording.hpp) with structured arrays.
// Inputs: a path; kinds of records by name; a range of ticks, both ends included. Outputs: structured arrays with the
// fields of records.idl, video and pictures.
// Errors: yars.Error for a file that is no recording, ValueError for an unknown kind.
// Threads: one call at a time; a lock makes others wait. The interpreter's lock is released while a file is read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "python/core/calls.hpp"
#include "python/core/support.hpp"
#include "yars/recording.hpp"

namespace yars::python {

class Recording {
 public:
  explicit Recording(const std::string& path);

  py::dict header() const;
  const yars::Recording& recording() const { return *recording_; }

  py::array records(const std::string& kind, const TickRange& ticks);
  static py::dict units(const std::string& kind);
  // Headers, and video of shape (sweeps, largest number of samples); 0 beyond the samples of a sweep.
  py::tuple sweeps(const TickRange& ticks);
  // Headers, and a list of pictures of shape (size, size).
  py::tuple maps(const TickRange& ticks);

 private:
  Records read(const std::string& kind, const TickRange& ticks, bool with_tails);
  void open(Warnings& warnings, const parallel::GoesOn& goes_on);

  std::string path_;
  // A child of fork() leaves the reader that its parent may have half changed, and opens the file again: the place in
  // it is shared with the parent.
  std::unique_ptr<yars::Recording> recording_;
  ObjectLock lock_{[] {}};
  int process_ = 0;  // that has opened the file
};

void add_recording(py::module_& module);

}  // namespace yars::python
