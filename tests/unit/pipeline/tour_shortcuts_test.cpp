// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tour_shortcuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/horseshoe.hpp"

namespace homeward::pipeline::tour_shortcuts_test {
namespace {

/// The tour that made the horseshoe, without its pictures.
class SweptTour final : public TourSource {
 public:
  SweptTour(const testing::Horseshoe& tour, bool with_sweeps) {
    for (std::size_t i = 0; i < tour.sweeps.size(); ++i) {
      TourImage image{tour.sweeps[i].image, std::nullopt, tour.poses[i]};
      if (with_sweeps) image.sweep = tour.sweeps[i].sweep;
      images_.push_back(std::move(image));
    }
  }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t) const override { return fail(ErrorCode::kIo, "There is none."); }

 private:
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

TEST(TourShortcuts, ComeFromTheSweepsOfTours) {
  testing::Horseshoe made;
  add_shortcuts(made.map, {});
  const SweptTour blind(made, false);
  add_shortcuts(made.map, {&blind});
  EXPECT_TRUE(made.map.shortcuts.empty());
  const SweptTour tour(made, true);
  add_shortcuts(made.map, {&blind, &tour});
  const std::size_t found = made.map.shortcuts.size();
  EXPECT_GT(found, 0U);
  add_shortcuts(made.map, {&tour});
  EXPECT_EQ(std::ranges::count_if(made.map.shortcuts,
                                  [&](const map::Shortcut& one) {
                                    return one.image_a == made.map.shortcuts[0].image_a &&
                                           one.image_b == made.map.shortcuts[0].image_b;
                                  }),
            1);
}

}  // namespace
}  // namespace homeward::pipeline::tour_shortcuts_test
