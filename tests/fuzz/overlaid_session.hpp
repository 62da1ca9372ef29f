// A well-formed session that the fuzzer's input modifies, as another program of the same user could.
// The input consists of pieces of (what, offset in two bytes, length, bytes):
//   what < kRaw              overwrites a part of the segment, including version numbers and cursors
//   kRaw <= what < kPublished  modifies a well-formed record and publishes it, so that the readers validate it
//   what >= kPublished       runs the programs under test (a beat)
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"

namespace yars::fuzz {

class OverlaidSession {
 public:
  explicit OverlaidSession(const std::string& name);

  // Applies the input. Calls `beat`, which runs the programs under test, once at least and kMaxBeats times at most.
  template <class Beat>
  void play(std::span<const std::uint8_t> input, Beat beat);
  // Restores the segment as it was before play(). Also removes what the programs under test have published.
  void put_back();

  const std::string& name() const { return name_; }
  databuffer::SessionLayout& layout() { return session_.layout(); }

 private:
  static constexpr std::uint8_t kRaw = 120, kPublished = 240;
  static constexpr int kMaxBeats = 6;

  struct Part {
    std::size_t offset, size;  // [bytes] in the layout
  };
  struct Records {
    databuffer::ClockState clock;
    std::array<databuffer::Ownship, databuffer::kOwnshipLanes> ownship;
    std::array<databuffer::Nav, databuffer::kOwnshipLanes> nav;
    databuffer::RadarState state;
    databuffer::ModelStatus status;
    databuffer::Outputs outputs;
    databuffer::RecorderStatus recorder;
    databuffer::ModelTick tick;
    databuffer::AppliedEvent applied;
    databuffer::Sweep sweep;
    databuffer::InputEvent event;
    databuffer::Traffic traffic;
    databuffer::WorldState world;
    databuffer::PatchMap map;
    databuffer::GlassFrame frame;
    databuffer::Note note;
    databuffer::Caption caption;
  };
  static Records well_formed();
  std::byte* memory() { return reinterpret_cast<std::byte*>(&session_.layout()); }
  void lay_raw(std::size_t what, std::size_t offset, std::span<const std::uint8_t> bytes);
  void publish(std::size_t what, std::size_t offset, std::span<const std::uint8_t> bytes);
  void remember(std::size_t offset, std::size_t size) { touched_.push_back({offset, size}); }
  void remember_rings();
  std::vector<Part> parts();

  std::string name_;
  databuffer::Session session_;
  std::vector<Part> parts_;
  Records sound_, records_;
  std::vector<std::byte> before_;  // copy of the well-formed segment
  std::vector<Part> touched_;
  std::array<std::uint64_t, 4> next_{};  // next record numbers of the rings at the first beat
};

template <class Beat>
void OverlaidSession::play(std::span<const std::uint8_t> input, Beat beat) {
  records_ = sound_;
  int beats = 0;
  while (input.size() >= 4 && beats < kMaxBeats) {
    const std::size_t what = input[0], offset = input[1] * 256U + input[2];
    const std::size_t length = std::min<std::size_t>(input[3], input.size() - 4);
    const auto bytes = input.subspan(4, length);
    if (what < kRaw) {
      lay_raw(what, offset, bytes);
    } else if (what < kPublished) {
      publish(what - kRaw, offset, bytes);
    } else {
      if (beats++ == 0) remember_rings();
      beat();
    }
    input = input.subspan(4 + length);
  }
  if (beats == 0) {
    remember_rings();
    beat();
  }
}

}  // namespace yars::fuzz
