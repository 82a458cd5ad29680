// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/tour.hpp"
#include "imageio/decode.hpp"

namespace homeward::scenario {

/// A tour kept in memory as JPEGs, as a camera would have delivered it.
class KeptTour final : public TourSource {
 public:
  void add(std::vector<std::uint8_t> jpeg, const Pose2& odometry, RangeSweep sweep) {
    const std::string name = std::to_string(100000 + jpegs_.size()).substr(1) + ".jpg";
    images_.push_back({ImageId("tour/" + name), std::nullopt, odometry, std::move(sweep)});
    jpegs_.push_back(std::move(jpeg));
  }
  [[nodiscard]] std::string file_name(std::size_t index) const { return images_[index].id.str().substr(5); }
  [[nodiscard]] const std::vector<std::uint8_t>& jpeg(std::size_t index) const { return jpegs_[index]; }
  [[nodiscard]] const ImageId& last() const { return images_.back().id; }
  void mark(std::size_t index, const std::string& label) { marks_.push_back({file_name(index), label}); }
  void mark_last(const std::string& label) { mark(images_.size() - 1, label); }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override {
    return imageio::decode(jpegs_[index], images_[index].id.str());
  }

 private:
  std::vector<std::vector<std::uint8_t>> jpegs_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

}  // namespace homeward::scenario
