// Records of an OpenFlight file: opcodes, offsets of fields, and a stream that reads the records.
// Format: big-endian; u16 opcode, u16 length of the record, fields. Offsets count from the opcode, in bytes.
// Errors: a record shorter than 4 bytes, a record that extends beyond the end of the file, a record that is longer than
// 256 MiB with its continuations. Nothing is read outside the given bytes.
// Source: docs/spec/formats.md#openflight; OpenFlight Scene Description Database Specification, revisions 14 to 16.7.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::model::scene::openflight {

enum Opcode : std::uint16_t {
  kHeader = 1,
  kGroup = 2,
  kObject = 4,
  kFace = 5,
  kPushLevel = 10,
  kPopLevel = 11,
  kDegreeOfFreedom = 14,
  kPushSubface = 19,
  kPopSubface = 20,
  kPushExtension = 21,
  kPopExtension = 22,
  kContinuation = 23,
  kColorPalette = 32,
  kLongId = 33,
  kMatrix = 49,
  kBinarySeparatingPlane = 55,
  kReplicate = 60,
  kInstanceReference = 61,
  kInstanceDefinition = 62,
  kExternalReference = 63,
  kVertexPalette = 67,
  kVertexColor = 68,
  kVertexColorNormal = 69,
  kVertexColorNormalTexture = 70,
  kVertexColorTexture = 71,
  kVertexList = 72,
  kLevelOfDetail = 73,
  kMesh = 84,
  kLocalVertexPool = 85,
  kMeshPrimitive = 86,
  kRoadSegment = 87,
  kSound = 91,
  kPath = 92,
  kText = 95,
  kSwitch = 96,
  kClipRegion = 98,
  kExtension = 100,
  kLightSource = 101,
  kLightPoint = 111,
  kMaterial = 113,
  kContinuouslyAdaptive = 115,
  kPushAttribute = 122,
  kPopAttribute = 123,
  kCurve = 126,
  kRoadConstruction = 127,
  kIndexedLightPoint = 130,
  kLightPointSystem = 131,
};

inline constexpr std::size_t kNameAt = 4, kNameBytes = 8;  // name field of node records

namespace header {
inline constexpr std::size_t kRevision = 12, kUnits = 62, kFlags = 64, kVertexStorage = 126, kDatabaseOrigin = 128;
inline constexpr std::size_t kSouthLatitude = 188, kWestLongitude = 196, kNorthLatitude = 204, kEastLongitude = 212;
inline constexpr std::size_t kOriginLatitude = 220, kOriginLongitude = 228;
inline constexpr std::size_t kBytes = 324;  // length in revision 16.0; others have 308 to 328 bytes and more
inline constexpr std::int32_t kOldestRevision = 1400, kNewestRevision = 1670;
}  // namespace header

// Offsets in a face record, and values of its fields. In a mesh record the fields lie kMeshShift bytes further.
namespace face {
inline constexpr std::size_t kDrawType = 18, kColorName = 20, kMaterial = 30, kSurfaceMaterial = 32, kFeatureId = 34;
inline constexpr std::size_t kFlags = 44, kLightMode = 48, kPackedColor = 56, kColorIndex = 68;
inline constexpr std::size_t kBytes = 80, kMeshShift = 4;
inline constexpr std::uint32_t kNoColor = 1U << 30, kPacked = 1U << 28, kHidden = 1U << 26;
inline constexpr std::uint8_t kSolidOneSided = 0, kSolidTwoSided = 1, kSurround = 4;
inline constexpr std::uint8_t kLitFaceColor = 2;
}  // namespace face

// Viewing distances from the centre between which a level of detail is drawn.
namespace level_of_detail {
inline constexpr std::size_t kSwitchIn = 16, kSwitchOut = 24, kFlags = 36, kCentre = 40;
inline constexpr std::uint32_t kCentreOfPrevious = 1U << 31;  // the centre is that of the level before
}  // namespace level_of_detail

// Local axes of a degree of freedom, and the current values of its translation, rotation and scale along them.
namespace degree_of_freedom {
inline constexpr std::size_t kOrigin = 16, kPointOnX = 40, kPointInXY = 64;
inline constexpr std::size_t kX = 168, kY = 136, kZ = 104, kPitch = 200, kRoll = 232, kYaw = 264;
inline constexpr std::size_t kScaleX = 360, kScaleY = 328, kScaleZ = 296;
}  // namespace degree_of_freedom

namespace vertex {
inline constexpr std::size_t kFlags = 6, kX = 8, kY = 16, kZ = 24, kNormal = 32;
inline constexpr std::size_t kColorNormalBytes = 56;
inline constexpr std::uint16_t kNoColor = 1U << 13;
}  // namespace vertex

// Mask bits of a local vertex pool. A set bit means that each vertex has this field. The fields are in the order of the
// bits, highest bit first.
namespace pool {
inline constexpr std::uint32_t kPosition = 1U << 31, kColorIndex = 1U << 30, kColor = 1U << 29, kNormal = 1U << 28;
inline constexpr std::uint32_t kFirstTexture = 1U << 27;
inline constexpr int kTextures = 8;
}  // namespace pool

namespace palette {
inline constexpr std::size_t kFirstColor = 132, kColors = 1024, kBytes = kFirstColor + 4 * kColors;
inline constexpr int kIntensities = 128;  // colour index = 128 * colour + intensity
}  // namespace palette

}  // namespace yars::model::scene::openflight

namespace yars::model::scene {

// One record. Offsets count from the record's opcode. A field beyond the end of a record is absent, because older
// revisions have shorter records.
class Record {
 public:
  Record() = default;
  Record(std::size_t start, std::uint16_t opcode, std::span<const std::byte> bytes)
      : start_(start), opcode_(opcode), bytes_(bytes) {}

  std::size_t start() const { return start_; }  // offset of the opcode in the file
  std::uint16_t opcode() const { return opcode_; }
  std::size_t size() const { return bytes_.size(); }
  bool has(std::size_t offset, std::size_t bytes) const {
    return offset <= bytes_.size() && bytes <= bytes_.size() - offset;
  }

  template <class Number>
  std::optional<Number> number(std::size_t offset) const {
    static_assert(std::is_arithmetic_v<Number>);
    if (!has(offset, sizeof(Number))) return std::nullopt;
    return memory::big_endian<Number>(bytes_.data() + offset);
  }
  template <class Number>
  Number number_or(std::size_t offset, Number absent) const {
    return has(offset, sizeof(Number)) ? memory::big_endian<Number>(bytes_.data() + offset) : absent;
  }
  // Text up to a zero byte, `max_length` characters or the record's end. Characters outside printable ASCII become '?'.
  std::string text(std::size_t offset, std::size_t max_length) const;
  // The same with all characters as they are: for names of files.
  std::string raw_text(std::size_t offset, std::size_t max_length) const;

 private:
  std::size_t start_ = 0;
  std::uint16_t opcode_ = 0;
  std::span<const std::byte> bytes_;
};

// Stream of records. Continuation records (23) are joined to their predecessor.
class RecordStream {
 public:
  RecordStream(std::span<const std::byte> bytes, std::string subject) : bytes_(bytes), subject_(std::move(subject)) {}

  // The next record, valid until the next call; nullopt at the end of the file.
  error::Expected<std::optional<Record>> next();
  // The bytes from the end of the last whole record on.
  std::span<const std::byte> rest() const { return bytes_.subspan(at_); }

 private:
  error::Expected<std::optional<Record>> single();

  std::span<const std::byte> bytes_;
  std::string subject_;
  std::size_t at_ = 0;
  std::vector<std::byte> joined_;
};

// The record at the offset `start`; nullopt if `bytes` contain no whole record there.
std::optional<Record> record_at(std::span<const std::byte> bytes, std::size_t start);

}  // namespace yars::model::scene
