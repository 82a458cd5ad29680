// SPDX-License-Identifier: Apache-2.0
#include "pipeline/look_at_tours.hpp"

#include <algorithm>
#include <utility>

#include "mapping/parallel.hpp"

namespace homeward::pipeline {
namespace {

struct Where {
  int tour = 0;
  std::size_t index = 0;
};

/// The file name within the tour.
std::string file_name(const ImageId& image) {
  const std::string& id = image.str();
  return id.substr(id.rfind('/') + 1);
}

Status add_marks(const TourSource& tour, int number, SeenTours& seen) {
  for (const TourMark& mark : tour.marks()) {
    const auto found =
        std::ranges::find_if(tour.images(), [&](const TourImage& image) { return file_name(image.id) == mark.image; });
    const bool exists = found != tour.images().end();
    int index = -1;
    for (std::size_t i = 0; exists && i < seen.tours.images.size(); ++i) {
      if (seen.tours.tour_of[i] == number && seen.tours.images[i].id == found->id) index = static_cast<int>(i);
    }
    if (index < 0) {
      return fail(ErrorCode::kInvalidInput,
                  "The tour marks the image " + mark.image + " as " + mark.label +
                      (exists ? ", but it cannot be read." : ", but has no such image."),
                  mark.image);
    }
    seen.tours.marks.push_back({index, mark.label});
  }
  return {};
}

}  // namespace

Result<SeenTours> look_at_tours(const std::vector<const TourSource*>& tours, const Eye& eye, int threads,
                                const std::function<void(double)>& progress, const std::stop_token& stop) {
  std::vector<Where> where;
  for (std::size_t t = 0; t < tours.size(); ++t) {
    for (std::size_t i = 0; i < tours[t]->images().size(); ++i) where.push_back({static_cast<int>(t), i});
  }
  if (where.empty()) return fail(ErrorCode::kEmptyInput, "The tour has no pictures.");
  const auto source = [&](const Where& w) -> const TourSource& { return *tours[static_cast<std::size_t>(w.tour)]; };
  std::vector<Result<features::Appearance>> looked(where.size());
  const auto look = [&](std::size_t i) {
    const auto picture = source(where[i]).read(where[i].index);
    if (picture) {
      looked[i] = eye.look(*picture);
    } else {
      looked[i] = pass_on(picture);
    }
  };
  const auto report = [&](std::size_t done) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(where.size()));
  };
  if (!mapping::parallel_for(where.size(), threads, look, report, stop)) {
    return fail(ErrorCode::kCancelled, "The work was cancelled.");
  }
  SeenTours seen;
  for (std::size_t i = 0; i < where.size(); ++i) {
    const TourImage& image = source(where[i]).images()[where[i].index];
    if (!looked[i]) {
      Error error = looked[i].error();
      if (error.where.empty()) error.where = image.id.str();
      seen.skipped.push_back(std::move(error));
      continue;
    }
    seen.tours.images.push_back({image.id, image.t_us, image.odometry});
    seen.tours.tour_of.push_back(where[i].tour);
    seen.tours.sweeps.push_back(image.sweep ? &*image.sweep : nullptr);
    seen.tours.appearances.push_back(std::move(*looked[i]));
  }
  if (seen.tours.images.empty()) return tl::unexpected<Error>(seen.skipped.front());
  for (std::size_t t = 0; t < tours.size(); ++t) {
    if (Status marked = add_marks(*tours[t], static_cast<int>(t), seen); !marked) return pass_on(marked);
  }
  return seen;
}

}  // namespace homeward::pipeline
