// SPDX-License-Identifier: Apache-2.0
#include "exploration/view_classifier.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward::exploration {

using features::GlobalDescriptor;
using features::GlobalMeasure;

double view_dissimilarity(ViewMeasure measure, const GlobalDescriptor& a, const GlobalDescriptor& b) {
  switch (measure) {
    case ViewMeasure::kGreyHistogram:
      return kThesisPixels * features::dissimilarity(GlobalMeasure::kJeffrey, a, b);
    case ViewMeasure::kColourHistogram:
      return kThesisPixels * features::dissimilarity(GlobalMeasure::kColourJeffrey, a, b);
    case ViewMeasure::kRowFourier:
      return features::dissimilarity(GlobalMeasure::kRowFourier, a, b);
  }
  return 0.0;
}

Result<std::vector<double>> view_dissimilarities(const GlobalDescriptor& view, std::span<const GlobalDescriptor> nodes,
                                                 ViewMeasure measure) {
  std::vector<double> dissimilarities;
  dissimilarities.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].colour_histogram.size() != view.colour_histogram.size() ||
        nodes[i].row_fourier.size() != view.row_fourier.size()) {
      return fail(ErrorCode::kFeatureConfigMismatch, "The view and the node were not described in the same way.",
                  "node " + std::to_string(i));
    }
    dissimilarities.push_back(view_dissimilarity(measure, view, nodes[i]));
  }
  return dissimilarities;
}

Result<std::optional<KnownView>> known_view(const GlobalDescriptor& view, std::span<const GlobalDescriptor> nodes,
                                            const ViewClassifierConfig& config) {
  if (!(config.hist_threshold > 0.0) || !std::isfinite(config.hist_threshold)) {
    return fail(ErrorCode::kInvalidInput, "The threshold of known views is a positive number.", "hist_threshold");
  }
  const auto dissimilarities = view_dissimilarities(view, nodes, config.measure);
  if (!dissimilarities) return pass_on(dissimilarities);
  const auto least = std::ranges::min_element(*dissimilarities);
  if (least == dissimilarities->end() || *least > config.hist_threshold) return std::optional<KnownView>();
  return std::optional(KnownView{static_cast<int>(least - dissimilarities->begin()), *least});
}

}  // namespace homeward::exploration
