// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "core/result.hpp"
#include "core/tour.hpp"
#include "mapping/growth_input.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {

/// Tours as features, without the pictures that could not be read.
struct SeenTours {
  mapping::NewTours tours;
  std::vector<Error> skipped;  // in tour order; each names the picture
};

/// Looks at all pictures of tours, one after the other, through one eye. Pictures that cannot be read are left out.
/// Errors: kEmptyInput (no picture, or none readable: the first one's reason), kInvalidInput (a mark on a picture that
/// the tour does not have or that cannot be read), kCancelled.
Result<SeenTours> look_at_tours(const std::vector<const TourSource*>& tours, const Eye& eye, int threads,
                                const std::function<void(double)>& progress, const std::stop_token& stop);

}  // namespace homeward::pipeline
