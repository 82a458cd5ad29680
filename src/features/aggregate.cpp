// SPDX-License-Identifier: Apache-2.0
#include "features/aggregate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace homeward::features {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t kMostSamples = 20'000;
constexpr int kMostWords = 4096;
constexpr int kRounds = 10;
constexpr float kCentre = 128.0F;
constexpr float kHorizonHalfHeight = 0.1F;  // sine of an elevation

/// A number from 0 to below 1, the same with every standard library.
double chance(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

/// Which of `count` to take: one drawn from each of kMostSamples equal stretches, or all.
std::vector<std::size_t> sample(std::size_t count, std::mt19937_64& random) {
  std::vector<std::size_t> taken(std::min(count, kMostSamples));
  const double stretch = static_cast<double>(count) / static_cast<double>(taken.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const double at = count <= kMostSamples ? 0.0 : chance(random);
    taken[i] = std::min(count - 1, static_cast<std::size_t>((static_cast<double>(i) + at) * stretch));
  }
  return taken;
}

Rows gather(std::span<const FeatureSet* const> sets, std::size_t count, Eigen::Index length, std::mt19937_64& random) {
  const std::vector<std::size_t> taken = sample(count, random);
  Rows rows(static_cast<Eigen::Index>(taken.size()), length);
  std::size_t first = 0;  // of the current set, among all
  std::size_t next = 0;
  for (const FeatureSet* set : sets) {
    const auto end = first + static_cast<std::size_t>(set->descriptors.rows());
    for (; next < taken.size() && taken[next] < end; ++next) {
      const auto row = set->descriptors.row(static_cast<Eigen::Index>(taken[next] - first));
      rows.row(static_cast<Eigen::Index>(next)) = row.cast<float>().array() - kCentre;
    }
    first = end;
  }
  return rows;
}

/// Each word far from those before it: drawn with chances as the squared distances to the nearest of them.
std::vector<Eigen::Index> far_apart(const Rows& samples, int words, std::mt19937_64& random) {
  std::vector<Eigen::Index> chosen;
  Eigen::VectorXf nearest = Eigen::VectorXf::Constant(samples.rows(), std::numeric_limits<float>::max());
  auto at = static_cast<Eigen::Index>(chance(random) * static_cast<double>(samples.rows()));
  for (int w = 0; w < words; ++w) {
    chosen.push_back(at);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
      nearest[i] = std::min(nearest[i], (samples.row(i) - samples.row(at)).squaredNorm());
    }
    double left = chance(random) * nearest.cast<double>().sum();
    for (at = 0; at + 1 < samples.rows(); ++at) {
      left -= static_cast<double>(nearest[at]);
      if (left < 0.0) break;
    }
  }
  return chosen;
}

/// The nearest word of each descriptor: the one with the largest 2 d.w - |w|^2. Among equals the first.
std::vector<Eigen::Index> nearest_words(const Rows& descriptors, const Rows& words) {
  const Rows products = descriptors * words.transpose();
  const Eigen::RowVectorXf half_norms = 0.5F * words.rowwise().squaredNorm().transpose();
  std::vector<Eigen::Index> nearest(static_cast<std::size_t>(descriptors.rows()));
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    (products.row(i) - half_norms).maxCoeff(&nearest[static_cast<std::size_t>(i)]);
  }
  return nearest;
}

/// Below, about and above the horizon (0.1 is 6 degrees): where a feature stays while the robot turns and mostly while
/// it drives.
Eigen::Index band_of(float upward) { return upward < -kHorizonHalfHeight ? 0 : upward < kHorizonHalfHeight ? 1 : 2; }

struct Sums {
  Rows sums;                   // per word, of its descriptors
  std::vector<float> members;  // ... how many
};

Sums sum_by_word(const Rows& descriptors, const std::vector<Eigen::Index>& word_of, Eigen::Index words) {
  Sums all{Rows::Zero(words, descriptors.cols()), std::vector<float>(static_cast<std::size_t>(words), 0.0F)};
  for (std::size_t i = 0; i < word_of.size(); ++i) {
    all.sums.row(word_of[i]) += descriptors.row(static_cast<Eigen::Index>(i));
    all.members[static_cast<std::size_t>(word_of[i])] += 1.0F;
  }
  return all;
}

}  // namespace

Result<Vocabulary> train_vocabulary(std::span<const FeatureSet* const> sets, int words, std::uint64_t seed) {
  if (words < 1 || words > kMostWords) {
    return fail(ErrorCode::kInvalidInput, "A vocabulary has 1 to " + std::to_string(kMostWords) + " words.");
  }
  std::size_t count = 0;
  Eigen::Index length = 0;
  for (const FeatureSet* set : sets) {
    if (set->descriptors.rows() == 0) continue;
    if (length != 0 && set->descriptors.cols() != length) {
      return fail(ErrorCode::kInvalidInput, "The descriptors of a vocabulary have different lengths.");
    }
    length = set->descriptors.cols();
    count += static_cast<std::size_t>(set->descriptors.rows());
  }
  if (count < static_cast<std::size_t>(words) || length == 0) {
    return fail(ErrorCode::kTooFewFeatures, "A vocabulary of " + std::to_string(words) +
                                                " words needs at least as many descriptors; there are " +
                                                std::to_string(count) + ".");
  }
  std::mt19937_64 random(seed);
  const Rows samples = gather(sets, count, length, random);
  Vocabulary vocabulary{Rows(words, length)};
  Eigen::Index word = 0;
  for (const Eigen::Index start : far_apart(samples, words, random)) vocabulary.words.row(word++) = samples.row(start);
  for (int round = 0; round < kRounds; ++round) {
    const Sums all = sum_by_word(samples, nearest_words(samples, vocabulary.words), vocabulary.words.rows());
    for (Eigen::Index w = 0; w < vocabulary.words.rows(); ++w) {
      const float members = all.members[static_cast<std::size_t>(w)];
      if (members > 0.0F) vocabulary.words.row(w) = (all.sums.row(w) / members).array().round();
    }
  }
  return vocabulary;
}

Eigen::VectorXf aggregate(const FeatureSet& set, const Vocabulary& vocabulary) {
  Eigen::VectorXf vector = Eigen::VectorXf::Zero(vocabulary.aggregate_length());
  const Eigen::Index count = set.descriptors.rows();
  const Eigen::Index length = vocabulary.words.cols();
  if (count == 0 || set.descriptors.cols() != length || set.bearings.rows() != count) return vector;
  const Rows descriptors = set.descriptors.cast<float>().array() - kCentre;
  const Eigen::Index words = vocabulary.words.rows();
  std::vector<Eigen::Index> block_of = nearest_words(descriptors, vocabulary.words);
  for (Eigen::Index i = 0; i < count; ++i) block_of[static_cast<std::size_t>(i)] += words * band_of(set.bearings(i, 2));
  const Sums all = sum_by_word(descriptors, block_of, kElevationBands * words);
  for (Eigen::Index b = 0; b < all.sums.rows(); ++b) {
    const float members = all.members[static_cast<std::size_t>(b)];
    const Eigen::RowVectorXf residual = all.sums.row(b) - members * vocabulary.words.row(b % words);
    const Eigen::RowVectorXf rooted = residual.array().sign() * residual.array().abs().sqrt();
    const float norm = rooted.norm();
    if (norm > 0.0F) vector.segment(b * length, length) = (rooted / norm).transpose();
  }
  const float norm = vector.norm();
  if (norm > 0.0F) vector /= norm;
  return vector;
}

}  // namespace homeward::features
