// OpenFlight 14 to 16.5 by number: opcodes, and where fields stand in records, counted from the opcode.
// Source: docs/spec/formats.md#openflight and the OpenFlight Scene Description Database Specification.
#pragma once

#include <cstddef>
#include <cstdint>

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

inline constexpr std::size_t kNameAt = 4, kNameBytes = 8;  // of every node

namespace header {
inline constexpr std::size_t kRevision = 12, kUnits = 62, kFlags = 64, kVertexStorage = 126, kDatabaseOrigin = 128;
inline constexpr std::size_t kSouthLatitude = 188, kWestLongitude = 196, kNorthLatitude = 204, kEastLongitude = 212;
inline constexpr std::size_t kOriginLatitude = 220, kOriginLongitude = 228, kBytes = 324;
inline constexpr std::int32_t kOldestRevision = 1400, kNewestRevision = 1650, kWrittenRevision = 1600;
}  // namespace header

// Of a face; those of a mesh lie 4 bytes further on.
namespace face {
inline constexpr std::size_t kDrawType = 18, kColorName = 20, kMaterial = 30, kSurfaceMaterial = 32, kFeatureId = 34;
inline constexpr std::size_t kTransparency = 40, kFlags = 44, kLightMode = 48, kPackedColor = 56, kColorIndex = 68;
inline constexpr std::size_t kBytes = 80, kMeshShift = 4;
inline constexpr std::uint32_t kNoColor = 1U << 30, kPacked = 1U << 28, kHidden = 1U << 26;
inline constexpr std::uint8_t kSolidOneSided = 0, kSolidTwoSided = 1, kWireClosed = 2, kWireOpen = 3, kSurround = 4;
inline constexpr std::uint8_t kLitFaceColor = 2;
}  // namespace face

namespace vertex {
inline constexpr std::size_t kFlags = 6, kX = 8, kY = 16, kZ = 24, kNormal = 32;
inline constexpr std::size_t kColorNormalBytes = 56;
inline constexpr std::uint16_t kNoColor = 1U << 13;
}  // namespace vertex

// Bits of a local vertex pool: what each of its vertices has, in this order.
namespace pool {
inline constexpr std::uint32_t kPosition = 1U << 31, kColorIndex = 1U << 30, kColor = 1U << 29, kNormal = 1U << 28;
inline constexpr std::uint32_t kFirstTexture = 1U << 27;
inline constexpr int kTextures = 8;
}  // namespace pool

namespace palette {
inline constexpr std::size_t kFirstColor = 132, kColors = 1024, kBytes = kFirstColor + 4 * kColors;
inline constexpr int kIntensities = 128;  // an index is 128 times the colour plus its intensity
}  // namespace palette

}  // namespace yars::model::scene::openflight
