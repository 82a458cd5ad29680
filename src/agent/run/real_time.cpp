// SPDX-License-Identifier: Apache-2.0
#include "agent/run/real_time.hpp"

#include <pthread.h>
#include <sched.h>

namespace homeward::agent {

bool run_in_real_time() {
  sched_param parameters{};
  parameters.sched_priority = 10;  // of 1 to 99: before what asks for nothing, behind the kernel's own threads
  return ::pthread_setschedparam(::pthread_self(), SCHED_RR | SCHED_RESET_ON_FORK, &parameters) == 0;
}

}  // namespace homeward::agent
