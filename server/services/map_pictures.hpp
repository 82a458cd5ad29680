// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"
#include "db/store.hpp"
#include "map/topological_map.hpp"
#include "pipeline/eye.hpp"

namespace homeward::server {

/// The pictures behind the images of one map, as far as their tours are kept here.
class MapPictures {
 public:
  /// The arguments outlive this.
  MapPictures(db::Store& store, const map::TopologicalMap& map) : store_(store), map_(map) {}

  /// Errors: kNotFound (not an image of the map, or not kept), those of imageio::decode and Store::image_bytes.
  Result<Image> picture(const ImageId& image) const;
  /// What the map's own camera makes of it. Errors: also those of pipeline::Eye.
  Result<features::Appearance> look_at(const ImageId& image);
  /// As a thumbnail of the map. Errors: the same.
  Result<std::vector<std::uint8_t>> thumbnail(const ImageId& image);

 private:
  Status open_eye();

  db::Store& store_;
  const map::TopologicalMap& map_;
  std::optional<pipeline::Eye> eye_;  // made when it is needed
};

}  // namespace homeward::server
