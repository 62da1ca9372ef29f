// Made-up recordings for tests: items of all kinds, the bytes of their files, and comparison of items.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "radar/recording/recording_io.hpp"

namespace yars::test {

using recording::RecordingItem;

// File name in the temporary folder. The destructor removes the file.
class TemporaryFile {
 public:
  TemporaryFile() {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("yars_recording_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path path_;
};

// A record whose bytes are all random.
template <class T>
T noise_record(std::mt19937_64& random) {
  T record{};
  std::vector<std::uint64_t> words(sizeof record / 8 + 1);
  for (auto& word : words) word = random();
  std::memcpy(&record, words.data(), sizeof record);
  return record;
}

// A tick of an aircraft that moves smoothly.
inline databuffer::ModelTick tick_at(std::int64_t tick) {
  databuffer::ModelTick record{};
  record.tick = tick;
  record.sim_time_ns = tick * radar::kTickNanoseconds;
  record.ownship.latitude_deg = 37.0 + 1e-5 * static_cast<double>(tick);
  record.ownship.longitude_deg = -122.0 + 2e-5 * std::sin(1e-3 * static_cast<double>(tick));
  record.ownship.radar_altitude_m = std::nan("");
  record.epoch = 1;
  return record;
}

inline databuffer::Sweep sweep_at(std::int64_t tick, std::uint32_t samples, std::mt19937_64& random) {
  databuffer::Sweep sweep{};
  sweep.tick = tick;
  sweep.samples = samples;
  sweep.hash = random();
  for (std::uint32_t i = 0; i < samples; ++i) sweep.video[i] = static_cast<std::uint8_t>(random());
  return sweep;
}

inline recording::Patch patch_at(std::int64_t tick, std::uint32_t size, std::mt19937_64& random) {
  recording::Patch patch{};
  patch.map.id = static_cast<std::uint64_t>(tick);
  patch.map.end_tick = tick;
  patch.map.size = size;
  patch.pixels.resize(std::size_t{size} * size);
  for (auto& pixel : patch.pixels) pixel = static_cast<std::uint8_t>(random());
  return patch;
}

// Items of all kinds, from tick 100 on: `ticks` ticks at intervals of `step`, with other records between them. Some
// records consist of random bytes.
inline std::vector<RecordingItem> items_of_every_kind(int ticks, int step = 1) {
  using namespace recording;
  std::mt19937_64 random(20261122);
  std::vector<RecordingItem> items{StartingPoint{noise_record<databuffer::ModelStatus>(random)}};
  std::get<StartingPoint>(items[0]).status.tick = 99;
  for (int i = 0; i < ticks; ++i) {
    const std::int64_t tick = 100 + std::int64_t{i} * step;
    items.emplace_back(tick_at(tick));
    items.emplace_back(SweepDigest{tick, random(), 1, static_cast<std::uint32_t>(i), 0, 0});
    if (i % 3 == 0) items.emplace_back(sweep_at(tick, static_cast<std::uint32_t>(i % 40), random));
    if (i % 7 == 2) {
      auto event = noise_record<databuffer::AppliedEvent>(random);
      event.tick = tick;
      items.emplace_back(event);
    }
    if (i % 5 == 1) {
      StateChange change{};
      change.state.tick = tick;
      change.state.range_nm = 10.0 * (1 + i % 4);
      items.emplace_back(change);
    }
    if (i % 11 == 4) items.emplace_back(patch_at(tick, static_cast<std::uint32_t>(i % 13), random));
    if (i % 13 == 5) items.emplace_back(noise_record<databuffer::Nav>(random));
    if (i % 17 == 6) items.emplace_back(noise_record<databuffer::Ownship>(random));
    if (i % 23 == 8) {
      databuffer::Outputs outputs{};
      outputs.tick = tick;
      outputs.slant_range_m = 1e4 + i;
      items.emplace_back(outputs);
    }
    if (i % 29 == 9) {
      databuffer::RecorderStatus status{};
      status.tick = tick;
      status.bytes = random();
      items.emplace_back(status);
    }
    if (i % 19 == 7) items.emplace_back(Gap{random(), 2, 3});
    if (i % 5 == 3) {
      StatusReport report{};
      report.status.tick = tick;
      report.status.load = 1e-3 * i;
      items.emplace_back(report);
    }
  }
  return items;
}

// True if two items have the same kind and the same bytes.
inline bool same(const RecordingItem& a, const RecordingItem& b) {
  if (a.index() != b.index()) return false;
  const auto bytes_of = [](const RecordingItem& item) {
    return std::visit(
        [](const auto& record) {
          const auto parts = recording::parts_of(record);
          std::vector<std::byte> bytes(parts.fixed.begin(), parts.fixed.end());
          bytes.insert(bytes.end(), parts.tail.begin(), parts.tail.end());
          return bytes;
        },
        item);
  };
  return bytes_of(a) == bytes_of(b);
}

// Bytes of the file of a closed recording.
inline std::string recorded(const std::vector<RecordingItem>& items) {
  const TemporaryFile file;
  auto writer =
      recording::RecordingWriter::create(file.path(), {"made.guf", "hills"}, recording::Existing::overwritten);
  for (const auto& item : items) std::visit([&](const auto& record) { (void)writer->append(record); }, item);
  (void)writer->close();
  return file.bytes();
}

inline error::Expected<recording::RecordingReader> reader_of(const std::string& bytes) {
  return recording::RecordingReader::read(std::make_unique<std::istringstream>(bytes), "made");
}

inline std::vector<recording::IndexEntry> blocks_of(const std::string& bytes) {
  const auto reader = reader_of(bytes);
  return {reader->blocks().begin(), reader->blocks().end()};
}

// The items from the reader's position to the end.
inline std::vector<RecordingItem> rest_of(recording::RecordingReader& reader) {
  std::vector<RecordingItem> items;
  while (auto item = reader.next()) items.push_back(std::move(*item));
  return items;
}

inline void expect_same(const std::vector<RecordingItem>& found, const std::vector<RecordingItem>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_TRUE(same(found[i], expected[i])) << "item " << i;
}

inline bool is_begin_of(const std::vector<RecordingItem>& found, const std::vector<RecordingItem>& whole) {
  return found.size() <= whole.size() && std::equal(found.begin(), found.end(), whole.begin(), same);
}

}  // namespace yars::test
