// SPDX-License-Identifier: Apache-2.0
#include "driving/asking.hpp"

namespace homeward::driving {

void ask(Asking& asking, std::int64_t now_ms) {
  ++asking.number;
  asking.since_ms = now_ms;
  asking.answer.reset();
}

void withdraw(Asking& asking) {
  asking.since_ms.reset();
  asking.answer.reset();
}

bool take_answer(Asking& asking, std::int64_t question, bool here) {
  if (!asking.since_ms || asking.answer || question != asking.number) return false;
  asking.answer = here;
  return true;
}

}  // namespace homeward::driving
