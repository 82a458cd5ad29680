// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#define HOMEWARD_WITH_AVX512
#include "core/vector_targets.hpp"

#include <hwy/targets.h>

namespace homeward::testing {

/// Calls `check` once for each kind of processor that the loops made with Highway are compiled for and that this one
/// can stand for, from one number at a time up, with the name of the kind in the trace of failures.
template <class Check>
void for_each_vector_target(Check check) {
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  SCOPED_TRACE(hwy::TargetName(HWY_TARGETS));  // there is one kind: nothing to choose from
  check();
#else
  for (std::int64_t target : {HWY_SCALAR, HWY_EMU128, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
    if ((target & HWY_TARGETS & hwy::SupportedTargets()) == 0) continue;
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    check();
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
#endif
}

}  // namespace homeward::testing
