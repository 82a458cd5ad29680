// SPDX-License-Identifier: Apache-2.0
#include "server/services/map_pictures.hpp"

#include <algorithm>
#include <utility>

#include "imageio/decode.hpp"
#include "map/lookup.hpp"
#include "pipeline/thumbnail.hpp"

namespace homeward::server {

Result<Image> MapPictures::picture(const ImageId& image) const {
  const std::string where = "images/" + image.str();
  const std::size_t slash = image.str().find('/');
  if (std::ranges::find(map_.images, image, &map::MapImage::id) == map_.images.end() || slash == std::string::npos) {
    return fail(ErrorCode::kNotFound, "The map has no picture " + image.str() + ".", where);
  }
  const auto missing = [&] {
    return fail(ErrorCode::kNotFound, "The picture " + image.str() + " was not kept.", where);
  };
  const TourId tour(image.str().substr(0, slash));
  const auto images = store_.tour_images(tour);
  if (!images) return images.error().code == ErrorCode::kNotFound ? Result<Image>(missing()) : pass_on(images);
  const auto kept = std::ranges::find(*images, image.str().substr(slash + 1), &db::TourImage::file);
  if (kept == images->end()) return missing();
  const auto bytes = store_.image_bytes(tour, kept->number);
  if (!bytes) return pass_on(bytes);
  return imageio::decode(*bytes, image.str());
}

Status MapPictures::open_eye() {
  if (eye_) return {};
  auto eye = pipeline::Eye::create(map_.camera, map_.feature_config);
  if (!eye) return pass_on(eye);
  eye_.emplace(std::move(*eye));
  return {};
}

Result<features::Appearance> MapPictures::look_at(const ImageId& image) {
  const auto seen = picture(image);
  if (!seen) return pass_on(seen);
  if (const Status open = open_eye(); !open) return pass_on(open);
  return eye_->look(*seen);
}

Result<std::vector<std::uint8_t>> MapPictures::thumbnail(const ImageId& image) {
  const auto seen = picture(image);
  if (!seen) return pass_on(seen);
  if (const Status open = open_eye(); !open) return pass_on(open);
  return pipeline::make_thumbnail(*eye_, *seen);
}

}  // namespace homeward::server
