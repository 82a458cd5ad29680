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

Result<std::vector<std::vector<double>>> localise_rows(const PictureRow& tests, const std::vector<PictureRow>& training,
                                                       const Eye& eye, const std::vector<RowMeasure>& measures) {
  const auto test_views = views_of(tests, eye);
  if (!test_views) return pass_on(test_views);
  std::vector<std::vector<double>> scores;
  for (const PictureRow& row : training) {
    const auto views = views_of(row, eye);
    if (!views) return pass_on(views);
    const std::vector<int> nearest = nearest_in_row(tests.along_m, row.along_m);
    std::vector<double>& of_row = scores.emplace_back();
    for (const RowMeasure& measure : measures) {
      of_row.push_back(share_localised(measure.compare(*test_views, *views), nearest));
    }
  }
  return scores;
}

}  // namespace homeward::pipeline
