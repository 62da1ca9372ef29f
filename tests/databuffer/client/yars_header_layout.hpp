// Compares the offsets and sizes of databuffer/client/yars.h with the layout in C++, at compile time. A failed
// assertion means that the layout has changed and the C headers have not. `lib/values/generate.py --write`
// makes yars_records.h again.
#pragma once

#include "databuffer/client/yars.h"
#include "databuffer/client/yars_records_check.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

static_assert(YARS_MAGIC == shm::kSegmentMagic && YARS_LAYOUT_VERSION == kLayoutVersion);
static_assert(YARS_LAYOUT_SIZE == kLayoutIdentity.size);
static_assert(YARS_LAYOUT_HASH == kLayoutIdentity.hash);
static_assert(YARS_AT_CLOCK == offsetof(SessionLayout, clock));
static_assert(YARS_AT_OWNSHIP_PRIORITY == offsetof(SessionLayout, ownship_priority));
static_assert(YARS_AT_OWNSHIP == offsetof(SessionLayout, ownship));
static_assert(YARS_AT_NAV == offsetof(SessionLayout, nav));
static_assert(YARS_AT_RADAR_STATE == offsetof(SessionLayout, radar_state));
static_assert(YARS_AT_MODEL_STATUS == offsetof(SessionLayout, model_status));
static_assert(YARS_AT_OUTPUTS == offsetof(SessionLayout, outputs));
static_assert(YARS_AT_INPUT == offsetof(SessionLayout, input));
static_assert(YARS_AT_PROCESSES == offsetof(SessionLayout, processes));
static_assert(YARS_AT_TRAFFIC == offsetof(SessionLayout, traffic) && YARS_AT_FRAMES == offsetof(SessionLayout, frames));
static_assert(YARS_FRAMES == kFrameSlots && YARS_FRAME_STRIDE == sizeof(FrameSlot) && offsetof(FrameSlot, id) == 0);
static_assert(YARS_FRAME_WORDS == offsetof(FrameSlot, frame) && YARS_FRAME_PIXELS == offsetof(FrameSlot, pixels));
static_assert(YARS_MOST_FRAME_BYTES == sizeof(FrameSlot::pixels));
static_assert(YARS_TRAFFIC_BYTE == static_cast<int>(Role::traffic));
static_assert(offsetof(shm::SegmentHeader, magic) == 0 && offsetof(shm::SegmentHeader, size) == 8);
static_assert(offsetof(shm::SegmentHeader, hash) == 16 && offsetof(shm::SegmentHeader, layout_version) == 24);
static_assert(offsetof(shm::SegmentHeader, holder_pid) == 32);
static_assert(offsetof(ProcessEntry, heartbeat_ns) == 0 && offsetof(ProcessEntry, pid) == 8);
static_assert(offsetof(ProcessEntry, name) == 16 && sizeof(ProcessEntry) == 40);

static_assert(YARS_FIRST_OWNSHIP_BYTE == kFirstOwnshipByte && YARS_OWNSHIP_LANES == kOwnshipLanes);
static_assert(YARS_FIRST_INPUT_BYTE == kFirstInputByte && YARS_INPUT_LANES == kInputLanes);
static_assert(YARS_FIRST_PROCESS_BYTE == kFirstProcessByte && YARS_PROCESSES == kProcesses);

template <class Record>
constexpr bool kValueMatches =
    shm::LatestValue<Record>::state_offset() == 0 && shm::LatestValue<Record>::slots_offset() == YARS_LINE &&
    shm::LatestValue<Record>::slot_stride() == YARS_SLOT_STRIDE(sizeof(Record)) &&
    shm::LatestValue<Record>::kSlots == YARS_SLOTS &&
    sizeof(shm::LatestValue<Record>) == YARS_VALUE_SIZE(sizeof(Record));
static_assert(kValueMatches<ClockState> && kValueMatches<Ownship> && kValueMatches<Nav>);
static_assert(kValueMatches<RadarState> && kValueMatches<ModelStatus> && kValueMatches<Outputs> &&
              kValueMatches<Traffic>);

using Input = decltype(SessionLayout::input);
static_assert(Input::lane_stride() == YARS_INPUT_STRIDE && Input::kDepth == YARS_INPUT_DEPTH);
static_assert(Input::pushed_offset() == 0 && Input::dropped_offset() == YARS_INPUT_DROPPED);
static_assert(Input::source_offset() == YARS_INPUT_SOURCE && Input::popped_offset() == YARS_INPUT_POPPED);
static_assert(Input::records_offset() == YARS_INPUT_RECORDS);

// The fields of the records are compared in databuffer/client/yars_records_check.hpp.
static_assert(YARS_LATEST_PICTURE_ID == kLatestPictureId && YARS_LATEST_CLOCK_BASE_NS == kLatestClockBase_ns);
static_assert(YARS_AT_SWEEPS == offsetof(SessionLayout, sweeps));
static_assert(YARS_LINE == decltype(SessionLayout::sweeps)::slots_offset());
static_assert(YARS_SWEEPS == decltype(SessionLayout::sweeps)::kDepth);
static_assert(YARS_SWEEP_STRIDE == decltype(SessionLayout::sweeps)::slot_stride());
static_assert(YARS_MOST_SAMPLES == radar::kMaxSamples);
static_assert(YARS_RADAR_MODEL_BYTE == static_cast<int>(Role::radar_model));
static_assert(YARS_STATE_MACHINE_BYTE == static_cast<int>(Role::state_machine));

}  // namespace yars::databuffer
