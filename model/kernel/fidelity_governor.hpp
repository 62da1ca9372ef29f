// Fidelity `automatic`: picks the finest preset that holds a share of a core, from what each scan took. Pure: the shell
// measures, the tick log records what was picked, so a replay follows it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace yars::model::kernel {

class FidelityGovernor {
 public:
  // `core_share` of one core, (0, 1].
  explicit FidelityGovernor(double core_share) : core_share_(core_share) {}

  // From least to most work; "1996" is another picture, not another price.
  static constexpr std::array<std::string_view, 4> kLadder{"draft", "standard", "fine", "reference"};

  std::string_view preset() const { return kLadder[rung_]; }
  // A scan at the present preset took this share of a core.
  void scanned(double load);

 private:
  double expected_load(std::size_t rung, double load) const;

  double core_share_;
  std::size_t rung_ = 1;
  struct Memory {
    double load = 0.0;  // when it was last in force
    int scans_ago = 0;
    bool known = false;
  };
  std::array<Memory, kLadder.size()> memory_{};
};

}  // namespace yars::model::kernel
