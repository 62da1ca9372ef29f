// A recording: a file of `yars record`, read as records with their fields.
// Inputs: a path; kinds of records by name; a range of ticks, both ends included. Outputs: bytes of records in the
// order of recording, with name, type, offset and unit of each field; video of sweeps; pictures of patch maps. Units:
// as RecordField::unit says; ticks are 5 ms. Errors: ErrorCode::failed for a file that is no recording,
// ErrorCode::argument for an unknown kind. Damaged parts are left out, with a warning that names the missing ticks.
// Threads: one call at a time.
// Source: docs/recordings.md, docs/shared_memory.md.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "yars/call.hpp"
#include "yars/error.hpp"

namespace yars {

// Ticks to read, both ends included. nullopt: no limit.
struct TickRange {
  std::optional<std::int64_t> first{}, last{};
  bool contains(std::int64_t tick) const { return (!first || tick >= *first) && (!last || tick <= *last); }
};

// A field of a kind of records. `fields`: of a record within the record; empty: a number or a text.
struct RecordedField {
  std::string name;
  std::string type;  // "double", "uint32", "char[8]", or the name of a record; "[n]" behind it for each axis
  std::size_t offset = 0, bytes = 0;  // within the record that has the field
  std::string unit;                   // empty: none
  std::vector<RecordedField> fields{};
};

// Records of one kind, one after the other, as they lie in memory (little endian).
struct Records {
  std::size_t record_bytes = 0;
  std::vector<std::byte> bytes;
  // Of sweeps and maps: the video or the pixels of each record, one after the other, and the bytes of each.
  std::vector<std::byte> tails;
  std::vector<std::size_t> tail_bytes;

  std::size_t count() const { return record_bytes == 0 ? 0 : bytes.size() / record_bytes; }
};

class YARS_EXPORT Recording {
 public:
  // A file that was cut short is read to its last whole block, with a warning.
  static Expected<Recording> open(const std::string& path, const Call& call = {});
  // Names of all kinds, and the fields of one. Errors: an unknown kind.
  static std::vector<std::string> all_kinds();
  static Expected<std::vector<RecordedField>> fields_of(const std::string& kind);

  const std::string& configuration() const;        // GUF text of the radar
  const std::string& terrain() const;              // folder of the elevation
  std::vector<std::string> kinds() const;          // that the file has, in the order of their numbers
  std::optional<std::int64_t> first_tick() const;  // nullopt: no block
  std::optional<std::int64_t> last_tick() const;
  bool cut_short() const;

  // Records of a kind. `with_tails`: with the video of "Sweep" or the pixels of "PatchMap".
  Expected<Records> records(const std::string& kind, const TickRange& ticks = {}, bool with_tails = false,
                            const Call& call = {});

  struct Parts;  // used by the library
  explicit Recording(std::unique_ptr<Parts> parts);
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;
  ~Recording();

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace yars
