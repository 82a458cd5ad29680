// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "features/global.hpp"

namespace homeward::exploration {

/// By what a view counts as known.
enum class ViewMeasure {
  kGreyHistogram,    // Jeffrey divergence of grey histograms: what the thesis drove with (Ferdaus 2008, eq. 3.1)
  kColourHistogram,  // the same of histograms of all three bands: proposed there against mistaken views (§5.2.3)
  kRowFourier,       // magnitudes of every row's lowest frequencies (eq. 3.4): proposed beside it
};

struct ViewClassifierConfig {
  ViewMeasure measure = ViewMeasure::kGreyHistogram;
  /// The thesis's `hist_threshold`: 600, 500 or 400 in its runs (§5.2), in counts of pixels for both histograms
  /// (`view_dissimilarity`). Of row_fourier it printed none, and its values have another scale.
  double hist_threshold = 500.0;
};

/// A node whose picture is like the present view.
struct KnownView {
  int node = 0;  // its index among the nodes
  double dissimilarity = 0.0;
};

/// Pixels of the thesis's panorama, by its size in memory: "approximately 20 KB" of grey (§3.3.1).
inline constexpr double kThesisPixels = 20000.0;

/// How different two views are. Histograms in counts, as the thesis's thresholds are: 20 000 times the divergence of
/// histograms that sum to 1 each. Jeffrey divergence grows as the counts do, so that this is what a panorama of 20 000
/// pixels would give, whatever the size of the one at hand. Row magnitudes as `features::dissimilarity` gives them.
/// Precondition: panoramas of as many rows.
double view_dissimilarity(ViewMeasure measure, const features::GlobalDescriptor& a,
                          const features::GlobalDescriptor& b);

/// How different the view is from that of each node, in the nodes' order (the thesis's table 5.5). Errors:
/// kFeatureConfigMismatch when pictures were described in different ways.
Result<std::vector<double>> view_dissimilarities(const features::GlobalDescriptor& view,
                                                 std::span<const features::GlobalDescriptor> nodes,
                                                 ViewMeasure measure);

/// The node whose view is most like the present one, the first of equals, if it is no more different than the threshold
/// says; nothing when the view is new (§4.1, §5.2.1). Errors: kInvalidInput for a threshold that is not positive;
/// kFeatureConfigMismatch when pictures were described in different ways.
Result<std::optional<KnownView>> known_view(const features::GlobalDescriptor& view,
                                            std::span<const features::GlobalDescriptor> nodes,
                                            const ViewClassifierConfig& config = {});

}  // namespace homeward::exploration
