// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::driving {

/// How much of one picture is recognised where a hypothesis says that the robot is.
struct Recognition {
  double log_share = 0.0;      // of the features, as it would be at a view itself
  double variance = 1.0;       // of it, by the number of features that it is of
  double log_agreement = 0.0;  // logarithm of how well views are seen where they lie by the hypothesis
};

/// What all pictures since a hypothesis was begun say of it, to be compared with another one's.
struct RecognitionRecord {
  double log_share = 0.0;  // summed over independent pictures
  double variance = 0.0;   // of the pictures, summed likewise
  double pictures = 0.0;   // independent ones
  double pending = 0.0;    // of the logarithm of the odds, what has not been made a probability yet
};

struct TwinEvidenceConfig {
  double lasting_variance = 2.0;  // what misleads on a stretch of the way, over what does in one picture by chance
  double lasting_pictures = 8.0;  // independent ones on such a stretch
  double outlier = 0.05;          // probability that the first picture misleads by more than any spread explains;
  double outlier_pictures = 2.0;  // it falls by 1 / e with so many independent ones
};

/// One more picture; `news` of it, of 0 to 1, is not in those before.
void take(RecognitionRecord& record, const Recognition& seen, double news);

/// How many times as probable what `record` is of is as what `best` is of, if one of the two is right and both were as
/// probable before. Of two places that look alike one is recognised somewhat better, now this, now that one: the sum of
/// the differences wanders without end, and only a sum beyond its own spread tells them apart. (Ours: the probability
/// that a drift is positive whose sum with noise is seen, Phi(z) to Phi(-z). The noise of a picture is that of counting
/// the features of the better one, that of a stretch is fitted to walks beside twins in generated hospitals, by day and
/// night; so is that a few pictures mislead beyond it, whatever they say, which is an outlier's share of a mixture:
/// docs/experiments/telling_twins_apart.md.) A record that is younger than the other counts from where it began, when
/// it was as good as the best. `rivals`: how many there are beside the best, one at least; where a few pictures misled,
/// which of them is right is open, so that they share that probability.
double odds_to_best(const RecognitionRecord& record, const RecognitionRecord& best, const TwinEvidenceConfig& config,
                    int rivals = 1);

}  // namespace homeward::driving
