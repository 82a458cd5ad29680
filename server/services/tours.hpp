// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/tour.hpp"
#include "db/store.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

/// A picture as it comes in with a PUT.
struct ImageUpload {
  TourId tour;
  std::int64_t number = 0;
  std::string file;  // name within the tour; empty: after its number
  std::optional<TimeUs> t_us;
  std::optional<Pose2> odometry;
  std::span<const std::uint8_t> bytes;
};

struct ImageReceipt {
  std::int64_t number = 0;
  ImageId image;
  std::int64_t bytes = 0;
  bool is_new = false;
};

/// Guided tours on the server: what a person or robot uploads, checked before it is kept.
class TourService {
 public:
  TourService(db::Store& store, const Clock& clock) : store_(store), clock_(clock) {}

  /// `uploader`: db::Tour::uploader.
  Result<wire::TourView> add(const std::string& name, const camera::CameraConfig& camera,
                             const std::optional<std::string>& uploader);
  /// Of one uploader, or all.
  Result<std::vector<wire::TourView>> list(const std::optional<std::string>& uploader);
  /// Whether a tour is this uploader's. Errors: kNotFound, as for one that is not there.
  Status check_uploader(const TourId& id, const std::string& uploader);
  Result<wire::TourView> get(const TourId& id);
  /// Decodes the whole picture before it keeps it. Errors: kNotFound, kConflict, kUnsupportedImage, kTruncatedImage,
  /// kImageTooLarge, kWrongImageSize.
  Result<ImageReceipt> put_image(const ImageUpload& upload);
  /// Errors: kNotFound (tour, picture), kConflict (another sweep is there already, the picture has another name, or the
  /// tour is complete).
  Status put_sweep(const TourId& id, const db::TourSweep& sweep);
  /// Errors: kNotFound, kConflict (complete already), kInvalidInput (a mark on a picture that is not there).
  Status set_marks(const TourId& id, const std::vector<wire::TourMark>& marks);
  /// Errors: kNotFound, kConflict (pictures are missing, or there are fewer than 3).
  Result<wire::TourView> complete(const TourId& id);

 private:
  db::Store& store_;
  const Clock& clock_;
};

/// A complete tour of the store as the pipeline reads it. Image ids are "tour id/file".
Result<std::unique_ptr<TourSource>> stored_tour(db::Store& store, const TourId& id);

/// The camera of a stored tour.
Result<camera::CameraConfig> camera_of(const db::Tour& tour);

}  // namespace homeward::server
