// Observer during fault injection: a thread that attaches read-only and reads all records of the segment every 0.5 ms.
// It checks that each record is complete (by a hash, by a checksum of fault_client, or by two equal reads of one
// version) and within its valid ranges. It checks that sim time does not go back within an epoch. If another segment
// takes the session's name, the observer continues with that segment.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/session/session.hpp"

namespace yars::endtoend::fault_injection {

// Counts of the records read so far and of their faults.
struct Verdict {
  std::uint64_t records = 0;       // read and judged
  std::uint64_t witnessed = 0;     // records with a hash or a checksum
  std::uint64_t torn = 0;          // records with parts of different records
  std::uint64_t out_of_range = 0;  // latched or published records with a value out of range
  std::uint64_t time_back = 0;     // sim time went back within an epoch
  std::vector<std::string> first;  // texts of the first faults
};

class Watch {
 public:
  explicit Watch(std::string session);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  Verdict verdict() const;
  // Numbers of records read, over all segments of the session.
  std::uint64_t sweeps() const { return sweeps_; }
  std::uint64_t frames() const { return frames_; }
  std::uint64_t events() const { return events_; }
  std::uint32_t newest_mark() const { return newest_mark_; }  // NUMBER of the last applied `restore` of fault_client
  bool flies() const { return flies_; }                       // radar-model has a fresh ownship
  double latitude_deg() const { return latitude_deg_; }       // of radar-model's latched ownship
  double longitude_deg() const { return longitude_deg_; }

 private:
  struct SegmentState;  // last values of one segment
  void run(const std::string& session);
  void check_all(SegmentState& last);
  void check_values(SegmentState& last);
  void check_rings(SegmentState& last);
  void check_pictures(SegmentState& last);
  void check_clock(SegmentState& last);
  void judge_tick(SegmentState& last, const databuffer::ModelTick& tick);
  void judge_event(const databuffer::AppliedEvent& applied);
  template <class Value, class Memory, class Judge>
  void check_value(const Value& value, Memory& seen, const char* name, const Judge& judge);
  template <class Record>
  void witness(const Record& record, const char* name);
  void note(std::uint64_t Verdict::* counter, const std::string& what);
  void refuse(const databuffer::Refusal& reason, const char* name);

  std::atomic<bool> ending_ = false;
  std::atomic<std::uint64_t> sweeps_ = 0, frames_ = 0, events_ = 0;
  std::atomic<std::uint32_t> newest_mark_ = 0;
  std::atomic<bool> flies_ = false;
  std::atomic<double> latitude_deg_ = 0.0, longitude_deg_ = 0.0;
  mutable std::mutex mutex_;
  Verdict verdict_;
  std::thread thread_;
};

}  // namespace yars::endtoend::fault_injection
