// A recording of what the radar model latched: enough to make every sweep again. One file: a header, then chunks
// (u32 kind, u32 payload bytes, payload), native byte order. A file cut short reads up to its last whole chunk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <variant>

#include "databuffer/records/model_records.hpp"
#include "lib/failure/error.hpp"

namespace yars::tools::recording {

// With what the model ran; replay needs the same.
struct TickLogHeader {
  std::string configuration;  // path of the GUF file; empty = built-in
  std::string terrain;        // directory; empty = the configuration's
};

// What identifies a sweep, without its video.
struct SweepMark {
  std::int64_t tick;
  std::uint64_t hash;
  std::uint32_t epoch;
  std::uint32_t number;
  std::uint32_t flags;  // kSweep...
  std::uint32_t reserved;
};

// The model's status before the first tick of the log: a replay starts from it when the log begins mid-run.
struct StartingPoint {
  databuffer::ModelStatus status;
};

// The radar state after a change; state.tick says when.
struct StateChange {
  databuffer::RadarState state;
};

// Records that the recorder was too slow for.
struct Gap {
  std::uint64_t ticks;
  std::uint64_t events;
  std::uint64_t sweeps;
};

using TickLogEntry =
    std::variant<databuffer::ModelTick, databuffer::AppliedEvent, SweepMark, StartingPoint, StateChange, Gap>;

class TickLogWriter {
 public:
  static failure::Expected<TickLogWriter> create(const std::filesystem::path& path, const TickLogHeader& header);
  // Ownship and command are written only when they differ from the tick before.
  void write(const databuffer::ModelTick& tick);
  void write(const databuffer::AppliedEvent& event);
  void write(const SweepMark& mark);
  void write(const StartingPoint& start);
  void write(const StateChange& change);
  void write(const Gap& gap);
  // False once the disk refused something: the file then reads up to its last whole chunk.
  bool flush();
  std::uint64_t bytes() const { return bytes_; }

 private:
  void chunk(std::uint32_t kind, const void* payload, std::size_t size);

  std::ofstream file_;
  databuffer::ModelTick last_{};
  bool first_ = true;
  std::uint64_t bytes_ = 0;
};

class TickLogReader {
 public:
  static failure::Expected<TickLogReader> open(const std::filesystem::path& path);
  const TickLogHeader& header() const { return header_; }
  // nullopt at the end of the file, or where it was cut short.
  std::optional<TickLogEntry> next();
  bool cut_short() const { return cut_short_; }

 private:
  std::optional<TickLogEntry> tick_from(const std::string& payload);

  std::ifstream file_;
  TickLogHeader header_;
  databuffer::ModelTick last_{};
  bool cut_short_ = false;
};

}  // namespace yars::tools::recording
