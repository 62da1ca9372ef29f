// Runs a test once on each vector target (instruction set) that the build contains and this machine supports.
#pragma once

#include <hwy/targets.h>

namespace yars::test {

// Calls action(name of the target) with each target selected, then selects all targets again.
template <class Action>
void for_each_vector_target(const Action& action) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    action(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace yars::test
