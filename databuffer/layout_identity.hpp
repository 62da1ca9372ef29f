// What a segment must be for this build to use it: layout version, size, and the hash over (record, version, sizeof).
// A record that changes its meaning without changing its size gets a higher version here.
// What moves into SessionLayout::spare, or into a record's reserved words, stays out of this: zeros say that a creator
// of an older build knows nothing of it.
#pragma once

#include <array>

#include "databuffer/session_layout.hpp"

namespace yars::databuffer {

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

inline constexpr std::size_t kLargestSegment = std::size_t{64} << 20;  // [bytes] what a default /dev/shm spares
static_assert(sizeof(SessionLayout) <= kLargestSegment && std::is_standard_layout_v<SessionLayout>);

}  // namespace yars::databuffer
