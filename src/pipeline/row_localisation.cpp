// SPDX-License-Identifier: Apache-2.0
#include "pipeline/row_localisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/aggregate.hpp"
#include "matching/retrieval_index.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::pipeline {
namespace {

using Eigen::Index;

Result<std::vector<RowView>> views_of(const PictureRow& row, const Eye& eye) {
  if (row.pictures.empty()) return fail(ErrorCode::kEmptyInput, "A row has no pictures.", row.name);
  std::vector<RowView> views;
  for (std::size_t i = 0; i < row.pictures.size(); ++i) {
    const std::string where = row.name + "/" + std::to_string(i);
    const auto panorama = eye.unwrap(row.pictures[i]);
    if (!panorama) return fail(panorama.error().code, panorama.error().message, where);
    auto whole = features::describe(*panorama);
    if (!whole) return fail(whole.error().code, whole.error().message, where);
    auto appearance = eye.look(row.pictures[i]);
    if (!appearance) return fail(appearance.error().code, appearance.error().message, where);
    views.push_back({std::move(*whole), std::move(*appearance)});
  }
  return views;
}

Eigen::MatrixXd for_each_pair(std::span<const RowView> tests, std::span<const RowView> training,
                              const std::function<double(const RowView&, const RowView&)>& dissimilarity) {
  Eigen::MatrixXd result(std::ssize(tests), std::ssize(training));
  for (Index t = 0; t < result.rows(); ++t) {
    for (Index k = 0; k < result.cols(); ++k) {
      result(t, k) = dissimilarity(tests[static_cast<std::size_t>(t)], training[static_cast<std::size_t>(k)]);
    }
  }
  return result;
}

/// One less the cosine of aggregated descriptors, their words learnt from the training row; infinite where the row has
/// too few features for that.
Eigen::MatrixXd aggregated(std::span<const RowView> tests, std::span<const RowView> training, std::uint64_t seed) {
  std::vector<const features::FeatureSet*> sets;
  for (const RowView& view : training) sets.push_back(&view.appearance.sift);
  const auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, seed);
  if (!vocabulary) {
    return Eigen::MatrixXd::Constant(std::ssize(tests), std::ssize(training), std::numeric_limits<double>::infinity());
  }
  return for_each_pair(tests, training, [&](const RowView& a, const RowView& b) {
    const float cosine =
        features::aggregate(a.appearance.sift, *vocabulary).dot(features::aggregate(b.appearance.sift, *vocabulary));
    return std::max(0.0, 1.0 - static_cast<double>(cosine));  // rounding makes a cosine more than 1
  });
}

/// P(z | x) of one test picture at each place, over that at the likeliest one; all 1 where it says nothing.
Eigen::RowVectorXd likelihoods(const Eigen::RowVectorXd& dissimilarities, double least) {
  double count = 0.0;
  double sum = 0.0;
  for (const double d : dissimilarities) {
    if (!std::isfinite(d)) continue;
    sum += d;
    ++count;
  }
  const double nearest = dissimilarities.minCoeff();
  double variance = 0.0;
  for (const double d : dissimilarities) {
    if (std::isfinite(d)) variance += (d - sum / count) * (d - sum / count) / count;
  }
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Ones(dissimilarities.size());
  const bool all_seen = count == static_cast<double>(dissimilarities.size());
  if (count == 0.0 || (variance <= 0.0 && all_seen)) return result;
  for (Index k = 0; k < result.size(); ++k) {
    const double d = dissimilarities[k];
    if (!std::isfinite(d)) {
      result[k] = least;
    } else if (variance > 0.0) {
      result[k] = std::max(least, std::exp((nearest - d) / variance));
    }
  }
  return result;
}

}  // namespace

std::vector<RowMeasure> row_measures(std::uint64_t seed) {
  std::vector<RowMeasure> measures;
  measures.reserve(features::kGlobalMeasures.size() + 2);
  for (const features::GlobalMeasure measure : features::kGlobalMeasures) {
    measures.push_back({std::string(features::global_measure_name(measure)), [measure](auto tests, auto training) {
                          return for_each_pair(tests, training, [measure](const RowView& a, const RowView& b) {
                            return features::dissimilarity(measure, a.whole, b.whole);
                          });
                        }});
  }
  measures.push_back({"vlad", [seed](auto tests, auto training) { return aggregated(tests, training, seed); }});
  measures.push_back({"features", [seed](auto tests, auto training) {
                        return for_each_pair(tests, training, [seed](const RowView& a, const RowView& b) {
                          return matching::compare(a.appearance, b.appearance, {}, seed).distance;
                        });
                      }});
  return measures;
}

std::vector<int> nearest_in_row(std::span<const double> tests_m, std::span<const double> training_m) {
  std::vector<int> nearest;
  for (const double test_m : tests_m) {
    const auto closer = [&](double a_m, double b_m) { return std::abs(a_m - test_m) < std::abs(b_m - test_m); };
    nearest.push_back(static_cast<int>(std::ranges::min_element(training_m, closer) - training_m.begin()));
  }
  return nearest;
}

double share_localised(const Eigen::MatrixXd& dissimilarities, std::span<const int> nearest) {
  constexpr double kRounding = 1e-12;
  double sum = 0.0;
  for (Index t = 0; t < dissimilarities.rows(); ++t) {
    const Eigen::ArrayXd seen = dissimilarities.row(t).transpose().array();
    const double bound = seen.minCoeff() * (1.0 + kRounding);
    if (seen[nearest[static_cast<std::size_t>(t)]] > bound) continue;
    sum += 1.0 / static_cast<double>((seen <= bound).count());
  }
  return sum / static_cast<double>(dissimilarities.rows());
}

Eigen::MatrixXd row_beliefs(const Eigen::MatrixXd& dissimilarities, const RowFilterConfig& config) {
  const Index places = dissimilarities.cols();
  Eigen::MatrixXd moves(places, places);  // from each line's place to each column's
  for (Index from = 0; from < places; ++from) {
    for (Index to = 0; to < places; ++to) {
      const auto apart = static_cast<double>(std::abs(to - from));
      moves(from, to) = std::exp(-apart / (config.spread_places * config.spread_places));
    }
    moves.row(from) /= moves.row(from).sum();
  }
  Eigen::MatrixXd beliefs(dissimilarities.rows(), places);
  Eigen::RowVectorXd belief = Eigen::RowVectorXd::Constant(places, 1.0 / static_cast<double>(places));
  for (Index t = 0; t < dissimilarities.rows(); ++t) {
    if (t > 0) belief = belief * moves;
    belief = belief.cwiseProduct(likelihoods(dissimilarities.row(t), config.least_likelihood));
    belief /= belief.sum();
    beliefs.row(t) = belief;
  }
  return beliefs;
}

Result<RowFindings> localise_rows(const PictureRow& tests, const std::vector<PictureRow>& training, const Eye& eye,
                                  const std::vector<RowMeasure>& measures) {
  const auto test_views = views_of(tests, eye);
  if (!test_views) return pass_on(test_views);
  RowFindings findings;
  for (const RowMeasure& measure : measures) {
    const Eigen::MatrixXd curve = measure.compare(std::span(*test_views).first(1), *test_views);
    findings.curves.emplace_back(curve.data(), curve.data() + curve.size());
  }
  for (const PictureRow& row : training) {
    const auto views = views_of(row, eye);
    if (!views) return pass_on(views);
    const std::vector<int> nearest = nearest_in_row(tests.along_m, row.along_m);
    std::vector<RowScore>& of_row = findings.scores.emplace_back();
    for (const RowMeasure& measure : measures) {
      const Eigen::MatrixXd dissimilarities = measure.compare(*test_views, *views);
      const Eigen::MatrixXd improbable = (1.0 - row_beliefs(dissimilarities).array()).matrix();
      of_row.push_back({share_localised(dissimilarities, nearest), share_localised(improbable, nearest)});
    }
  }
  return findings;
}

}  // namespace homeward::pipeline
