// Runs a test on all sets of vector instructions of this machine, and on the scalar version.
#pragma once

#include <hwy/targets.h>

namespace yars::test {

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
