// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace homeward::driving {

/// People err: one who is asked whether this is the place, and says so, is right 19 times of 20. An answer multiplies
/// the odds of being there by this factor, or divides them by it; it makes no arrival of what is improbable (0.9 takes
/// 0.33 before).
/// Bayes' rule in odds; the number is ours, by judgement.
constexpr double kAnswerOdds = 19.0;

/// The question to people whether this is the destination, which the robot stands beside and is not certain of.
struct Asking {
  std::int64_t number = 0;               // of the latest question; they count on over missions
  std::optional<std::int64_t> since_ms;  // nothing: it asks nothing
  std::optional<bool> answer;            // by the first person who answered
};

/// Asks; a question that was open is void.
void ask(Asking& asking, std::int64_t now_ms);

/// The question is over, however that came about.
void withdraw(Asking& asking);

/// Somebody answers a question. Whether that counts: an answer to another question, or a second one, is void.
bool take_answer(Asking& asking, std::int64_t question, bool here);

}  // namespace homeward::driving
