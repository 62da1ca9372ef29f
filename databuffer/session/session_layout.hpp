// Identity by which a program recognizes the layout of a session's segment. lib/values/segment.idl has its containers.
// Errors: a segment with another identity is refused by every program (shm/segment.hpp).
// Threads: the container of each field states its writers and readers.
// Source: docs/shared_memory.md; lib/values/layout.tsv lists every offset.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "databuffer/session/session_containers.hpp"
#include "shm/segment.hpp"

namespace yars::databuffer {

// A change of the order of SessionLayout, or of a size, requires a higher version.
inline constexpr std::uint32_t kLayoutVersion = 3;

// Identity that a segment must have: layout version, size, and a hash over name, version and size of each record.
// A record that changes its meaning at the same size needs a higher version here.
// New fields in SessionLayout::spare or in reserved words of a record do not change the identity. Zeros there can mean
// that an older build made the segment or the record.
inline constexpr std::array kRecordIdentities = {
    shm::RecordIdentity{"SegmentHeader", 1, sizeof(shm::SegmentHeader)},
    shm::RecordIdentity{"Lockstep", 1, sizeof(Lockstep)},
    shm::RecordIdentity{"ClockState", 1, sizeof(ClockState)},
    shm::RecordIdentity{"Ownship", 1, sizeof(Ownship)},
    shm::RecordIdentity{"Nav", 1, sizeof(Nav)},
    shm::RecordIdentity{"RadarState", 2, sizeof(RadarState)},
    shm::RecordIdentity{"ModelStatus", 2, sizeof(ModelStatus)},
    shm::RecordIdentity{"Outputs", 1, sizeof(Outputs)},
    shm::RecordIdentity{"RecorderStatus", 1, sizeof(RecorderStatus)},
    shm::RecordIdentity{"ModelTick", 1, sizeof(ModelTick)},
    shm::RecordIdentity{"AppliedEvent", 1, sizeof(AppliedEvent)},
    shm::RecordIdentity{"Sweep", 1, sizeof(Sweep)},
    shm::RecordIdentity{"InputEvent", 1, sizeof(InputEvent)},
    shm::RecordIdentity{"ProcessEntry", 1, sizeof(ProcessEntry)},
    shm::RecordIdentity{"Note", 1, sizeof(Note)},
    shm::RecordIdentity{"PatchSlot", 1, sizeof(PatchSlot)},
    shm::RecordIdentity{"Traffic", 1, sizeof(Traffic)},
    shm::RecordIdentity{"FrameSlot", 1, sizeof(FrameSlot)},
    shm::RecordIdentity{"SessionLayout", kLayoutVersion, sizeof(SessionLayout)},
};

inline constexpr shm::LayoutIdentity kLayoutIdentity{kLayoutVersion, sizeof(SessionLayout),
                                                     shm::layout_hash(kRecordIdentities)};

// [bytes] Maximum size of a segment. A /dev/shm of the default size has room for it.
inline constexpr std::size_t kMaxSegment_bytes = std::size_t{64} << 20;
static_assert(sizeof(SessionLayout) <= kMaxSegment_bytes && std::is_standard_layout_v<SessionLayout>);

}  // namespace yars::databuffer
