// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::agent {

/// Has the calling thread run before every program that does not ask for the same (Linux's SCHED_RR): what steers and
/// watches is then never held up by what else the computer does. Threads that it begins afterwards run as usual.
/// False where the system does not permit it: the thread goes on as it was.
bool run_in_real_time();

}  // namespace homeward::agent
