// The functions of yars_client.h over the session's participant: plain types outside, no exception leaves the library.
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/client/yars_client.h"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/participant.hpp"
#include "databuffer/session/picture_pool.hpp"

namespace yars::databuffer {

// What a client has while it is attached.
struct Attached {
  explicit Attached(Participant joined) : me(std::move(joined)), clock_reader(me.read().clock) { me.enter_table(); }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;
  ~Attached() {
    if (traffic) me.write().traffic.clear();
    me.leave_table();
  }

  // The last valid clock; all zero before the first.
  const ClockState& clock() {
    if (clock_reader.refresh() && !validate(clock_reader.value())) last_clock = clock_reader.value();
    return last_clock;
  }

  Participant me;
  std::optional<Claim> ownship, input, traffic;
  std::uint32_t events = 0;  // number of events pushed
  shm::LatestReader<ClockState> clock_reader;
  ClockState last_clock{};
  std::vector<std::uint8_t> pixels;  // of the last frame
};

}  // namespace yars::databuffer

// A handle is never freed, so that a later use finds that nothing is attached.
struct yars_client {
  std::unique_ptr<yars::databuffer::Attached> attached;
};

namespace {

using namespace yars;
using databuffer::Attached;

thread_local std::array<char, 1024> last_error{};

int fail_with(int code, const error::Error& error) {
  std::snprintf(last_error.data(), last_error.size(), "%s", error.message().c_str());
  return code;
}

int fail_argument(std::string subject, std::string expected, std::string found, std::string action = {}) {
  return fail_with(YARS_CLIENT_ARGUMENT,
                   {std::move(subject), std::move(expected), std::move(found), std::move(action)});
}

int fail_null(const char* function, const char* argument) {
  return fail_argument(function, std::string("an address as `") + argument + "`", "NULL");
}

// Code and text of what an Expected has in place of a value.
int fail_by(const error::Error& error) {
  return fail_with(error.bad_usage() ? YARS_CLIENT_ARGUMENT : YARS_CLIENT_FAILED, error);
}

// Result of `work`; a code and a text if it throws, as for want of memory.
template <class Work>
int guarded(const char* function, const Work& work) noexcept {
  try {
    return work();
  } catch (const std::exception& exception) {
    std::snprintf(last_error.data(), last_error.size(), "%s: expected memory and a working system, found: %s", function,
                  exception.what());
  } catch (...) {
    std::snprintf(last_error.data(), last_error.size(), "%s: found an unknown failure", function);
  }
  return YARS_CLIENT_FAILED;
}

// Copies the record of a slot to its structure in C, which has the same bytes (yars_records_check.hpp).
template <class Record, class InC>
int read_record(const shm::LatestValue<Record>& slot, InC* out) {
  static_assert(sizeof(Record) == sizeof(InC));
  Record record{};
  if (!slot.read(record)) return 0;
  std::memcpy(out, &record, sizeof record);
  return 1;
}

template <class Record, class InC>
Record in_cpp(const InC& given) {
  static_assert(sizeof(Record) == sizeof(InC));
  Record record{};
  std::memcpy(&record, &given, sizeof record);
  return record;
}

// Result of work(attached); a failure if the client is NULL or detached, or if `argument` is NULL. `name`: of the
// argument.
template <class Work>
int with(const yars_client* client, const char* function, const void* argument, const char* name,
         const Work& work) noexcept {
  return guarded(function, [&]() -> int {
    if (client == nullptr) return fail_null(function, "client");
    if (!client->attached)
      return fail_argument(function, "a client that is attached", "one that was detached", "call yars_client_attach");
    if (argument == nullptr) return fail_null(function, name);
    return work(*client->attached);
  });
}

template <class Work>
int with(const yars_client* client, const char* function, const Work& work) noexcept {
  return with(client, function, client, "client", work);
}

int fail_unclaimed(const char* function, const char* lane, const char* claim) {
  return fail_argument(function, lane, "none", std::string("call ") + claim + " first");
}

// A handle that stays for as long as the process.
yars_client* new_handle() {
  static std::mutex mutex;
  static auto& handles = *new std::vector<std::unique_ptr<yars_client>>;  // outlives every user
  const std::scoped_lock guard(mutex);
  handles.push_back(std::make_unique<yars_client>());
  return handles.back().get();
}

template <class Record, class InC>
int read_slot(const yars_client* client, const char* function,
              shm::LatestValue<Record> databuffer::SessionLayout::* slot, InC* out, const char* name) {
  return with(client, function, out, name,
              [&](Attached& attached) { return read_record(attached.me.read().*slot, out); });
}

}  // namespace

const char* yars_client_error(void) {
  return last_error.data();
}

int yars_client_attach(const char* session, const char* program, yars_client** client) {
  return guarded("yars_client_attach", [&] {
    if (client == nullptr) return fail_null("yars_client_attach", "client");
    *client = nullptr;
    if (session == nullptr) return fail_null("yars_client_attach", "session");
    if (program == nullptr) return fail_null("yars_client_attach", "program");
    if (auto valid = databuffer::check_session_name(session); !valid) {
      valid.error().action = "give the name that the set was started with";
      return fail_by(valid.error());
    }
    auto segment = shm::Segment::join(session, databuffer::kLayoutIdentity);
    if (!segment) return fail_by(segment.error());
    auto attached = std::make_unique<Attached>(databuffer::Participant(std::move(*segment), program));
    *client = new_handle();
    (*client)->attached = std::move(attached);
    return 0;
  });
}

void yars_client_detach(yars_client* client) {
  guarded("yars_client_detach", [&] {
    if (client != nullptr) client->attached.reset();
    return 0;
  });
}

int yars_client_set_runs(const yars_client* client) {
  return with(client, "yars_client_set_runs",
              [](const Attached& attached) {
                const bool runs = attached.me.is_held(databuffer::Role::radar_model) ||
                                  attached.me.is_held(databuffer::Role::state_machine);
                return runs ? 1 : 0;
              }) == 1
             ? 1
             : 0;
}

int yars_client_heartbeat(yars_client* client) {
  return with(client, "yars_client_heartbeat", [](Attached& attached) {
    attached.me.restore_entry();
    attached.me.beat(databuffer::monotonic_ns());
    return 0;
  });
}

int64_t yars_client_sim_time_ns(yars_client* client) {
  int64_t now_ns = 0;
  with(client, "yars_client_sim_time_ns", [&](Attached& attached) {
    now_ns = databuffer::sim_time_at(attached.clock(), databuffer::monotonic_ns());
    return 0;
  });
  return now_ns;
}

uint32_t yars_client_epoch(yars_client* client) {
  uint32_t epoch = 0;
  with(client, "yars_client_epoch", [&](Attached& attached) {
    epoch = attached.clock().epoch;
    return 0;
  });
  return epoch;
}

int yars_client_claim_ownship(yars_client* client, uint32_t priority) {
  return with(client, "yars_client_claim_ownship", [&](Attached& attached) {
    if (attached.ownship) {
      attached.me.write().ownship_priority[static_cast<std::size_t>(attached.ownship->lane())] = priority;
      return attached.ownship->lane();
    }
    auto claim = attached.me.claim_ownship_lane(priority);
    if (!claim) return fail_by(claim.error());
    attached.ownship = std::move(*claim);
    return attached.ownship->lane();
  });
}

int yars_client_publish_ownship(yars_client* client, const yars_ownship* ownship) {
  constexpr const char* kName = "yars_client_publish_ownship";
  return with(client, kName, ownship, "ownship", [&](Attached& attached) {
    if (!attached.ownship) return fail_unclaimed(kName, "an ownship lane", "yars_client_claim_ownship");
    const auto lane = static_cast<std::size_t>(attached.ownship->lane());
    attached.me.write().ownship[lane].publish(in_cpp<databuffer::Ownship>(*ownship));
    return 0;
  });
}

int yars_client_publish_nav(yars_client* client, const yars_nav* nav) {
  constexpr const char* kName = "yars_client_publish_nav";
  return with(client, kName, nav, "nav", [&](Attached& attached) {
    if (!attached.ownship) return fail_unclaimed(kName, "an ownship lane", "yars_client_claim_ownship");
    const auto lane = static_cast<std::size_t>(attached.ownship->lane());
    attached.me.write().nav[lane].publish(in_cpp<databuffer::Nav>(*nav));
    return 0;
  });
}

int yars_client_claim_traffic(yars_client* client) {
  return with(client, "yars_client_claim_traffic", [](Attached& attached) {
    if (attached.traffic) return 0;
    auto claim = attached.me.claim(databuffer::Role::traffic);
    if (!claim) return fail_by(claim.error());
    attached.me.write().traffic.clear();
    attached.traffic = std::move(*claim);
    return 0;
  });
}

int yars_client_publish_traffic(yars_client* client, const yars_traffic* traffic) {
  constexpr const char* kName = "yars_client_publish_traffic";
  return with(client, kName, traffic, "traffic", [&](Attached& attached) {
    if (!attached.traffic) return fail_unclaimed(kName, "the traffic role", "yars_client_claim_traffic");
    attached.me.write().traffic.publish(in_cpp<databuffer::Traffic>(*traffic));
    return 0;
  });
}

int yars_client_claim_input(yars_client* client, const char* source) {
  return with(client, "yars_client_claim_input", source, "source", [&](Attached& attached) {
    if (!attached.input) {
      auto claim = attached.me.claim_input_lane(source);
      if (!claim) return fail_by(claim.error());
      attached.input = std::move(*claim);
    }
    attached.me.write().input.set_source(static_cast<std::size_t>(attached.input->lane()), source);
    return attached.input->lane();
  });
}

int yars_client_push_event(yars_client* client, const yars_input_event* event) {
  constexpr const char* kName = "yars_client_push_event";
  return with(client, kName, event, "event", [&](Attached& attached) {
    if (!attached.input) return fail_unclaimed(kName, "an input lane", "yars_client_claim_input");
    auto stamped = in_cpp<databuffer::InputEvent>(*event);
    stamped.monotonic_ns = databuffer::monotonic_ns();
    stamped.session_time_ns = databuffer::sim_time_at(attached.clock(), stamped.monotonic_ns);
    stamped.number = attached.events + 1;
    if (!attached.me.write().input.push(static_cast<std::size_t>(attached.input->lane()), stamped))
      return fail_with(YARS_CLIENT_FAILED,
                       {"input lane", "room for an event", "a full lane: the event is dropped and counted",
                        "check with `yars status` that state-machine runs"});
    ++attached.events;
    return 0;
  });
}

int yars_client_read_clock(yars_client* client, yars_clock* clock) {
  return read_slot(client, "yars_client_read_clock", &databuffer::SessionLayout::clock, clock, "clock");
}

int yars_client_read_radar_state(yars_client* client, yars_radar_state* state) {
  return read_slot(client, "yars_client_read_radar_state", &databuffer::SessionLayout::radar_state, state, "state");
}

int yars_client_read_outputs(yars_client* client, yars_outputs* outputs) {
  return read_slot(client, "yars_client_read_outputs", &databuffer::SessionLayout::outputs, outputs, "outputs");
}

int yars_client_read_model_status(yars_client* client, yars_model_status* status) {
  return read_slot(client, "yars_client_read_model_status", &databuffer::SessionLayout::model_status, status, "status");
}

int yars_client_read_caption(yars_client* client, yars_caption* caption) {
  return with(client, "yars_client_read_caption", caption, "caption", [&](Attached& attached) {
    if (!attached.me.is_held(databuffer::Role::tour)) return 0;
    return read_record(attached.me.read().caption, caption);
  });
}

int yars_client_read_frame(yars_client* client, uint64_t after, yars_glass_frame* frame, const unsigned char** pixels) {
  constexpr const char* kName = "yars_client_read_frame";
  return with(client, kName, frame, "frame", [&](Attached& attached) {
    if (pixels == nullptr) return fail_null(kName, "pixels");
    databuffer::GlassFrame found{};
    if (!databuffer::read_newest_frame(attached.me.read(), after, found, attached.pixels)) return 0;
    // Larger than its slot: damage. The pool has copied the part that fits.
    if (found.width > databuffer::kMaxFramePixels || found.height > databuffer::kMaxFramePixels) return 0;
    std::memcpy(frame, &found, sizeof found);
    *pixels = attached.pixels.data();
    return 1;
  });
}

int yars_client_read_sweep(yars_client* client, yars_client_cursor* cursor, yars_sweep* sweep) {
  constexpr const char* kName = "yars_client_read_sweep";
  return with(client, kName, sweep, "sweep", [&](Attached& attached) {
    if (cursor == nullptr) return fail_null(kName, "cursor");
    const auto& ring = attached.me.read().sweeps;
    if (cursor->begun == 0) *cursor = {ring.oldest(), cursor->lost, 1};
    databuffer::Sweep found;
    for (std::size_t skipped = 0; skipped < ring.kDepth; ++skipped) {
      const shm::RingRead read = ring.read(cursor->next, found);
      cursor->lost += read.lost;
      if (!read.delivered && cursor->next >= ring.next()) return 0;
      if (read.delivered && read.words * sizeof(shm::Word) >= offsetof(databuffer::Sweep, video) &&
          found.samples <= radar::kMaxSamples && read.words * sizeof(shm::Word) >= databuffer::used_bytes(found)) {
        std::memcpy(sweep, &found, databuffer::used_bytes(found));
        return 1;
      }
      if (!read.delivered) ++cursor->next;  // a damaged slot, which would hold all later sweeps back
      ++cursor->lost;
    }
    return 0;
  });
}
