// SPDX-License-Identifier: Apache-2.0
#include "server/services/tours.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "imageio/decode.hpp"
#include "wire/camera_json.hpp"

namespace homeward::server {
namespace {

constexpr std::int64_t kFewestImages = 3;

std::string image_name(const TourId& tour, std::int64_t number) {
  return "tours/" + tour.str() + "/images/" + std::to_string(number);
}

Result<wire::TourView> view_of(const db::Tour& tour) {
  auto camera = camera_of(tour);
  if (!camera) return pass_on(camera);
  return wire::TourView{tour.id, tour.name, tour.complete, tour.images, *camera, tour.created_us, tour.missing};
}

Status check_file_name(const std::string& file) {
  if (file.empty()) return {};
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-' || c == ' ' || (static_cast<unsigned char>(c) >= 0x80);
  };
  if (file.size() > 300 || file.front() == '.' || !std::all_of(file.begin(), file.end(), plain)) {
    return fail(ErrorCode::kInvalidInput,
                "A file name has letters, digits, '.', '_', '-' and spaces, and does not begin with a dot.",
                "X-Homeward-Filename");
  }
  return {};
}

class StoredTour : public TourSource {
 public:
  StoredTour(db::Store& store, TourId id, std::vector<db::TourImage> stored, std::map<std::int64_t, RangeSweep> sweeps,
             const std::vector<wire::TourMark>& marks)
      : store_(store), id_(std::move(id)), stored_(std::move(stored)) {
    for (const db::TourImage& image : stored_) {
      images_.push_back({ImageId(id_.str() + "/" + image.file), image.t_us, image.odometry});
      if (const auto sweep = sweeps.find(image.number); sweep != sweeps.end())
        images_.back().sweep = std::move(sweep->second);
    }
    for (const wire::TourMark& mark : marks) marks_.push_back({mark.image, mark.label});
  }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override {
    const auto bytes = store_.image_bytes(id_, stored_.at(index).number);
    if (!bytes) return pass_on(bytes);
    return imageio::decode(*bytes, images_[index].id.str());
  }

 private:
  db::Store& store_;
  TourId id_;
  std::vector<db::TourImage> stored_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

}  // namespace

Result<camera::CameraConfig> camera_of(const db::Tour& tour) {
  return wire::parse_camera(tour.camera, "tours/" + tour.id.str() + "/camera");
}

Result<wire::TourView> TourService::add(const std::string& name, const camera::CameraConfig& camera,
                                        const std::optional<std::string>& uploader) {
  db::Tour tour;
  tour.uploader = uploader;
  tour.name = name;
  tour.camera = wire::camera_to_json(camera).dump();
  tour.created_us = clock_.wall_us();
  const auto added = store_.add_tour(tour);
  if (!added) return pass_on(added);
  return view_of(*added);
}

Result<std::vector<wire::TourView>> TourService::list(const std::optional<std::string>& uploader) {
  const auto tours = store_.tours();
  if (!tours) return pass_on(tours);
  std::vector<wire::TourView> views;
  for (const db::Tour& tour : *tours) {
    if (uploader && tour.uploader != uploader) continue;
    auto view = view_of(tour);
    if (!view) return pass_on(view);
    views.push_back(std::move(*view));
  }
  return views;
}

Status TourService::check_uploader(const TourId& id, const std::string& uploader) {
  const auto tour = store_.tour(id);
  if (!tour) return pass_on(tour);
  if (tour->uploader == uploader) return {};
  return fail(ErrorCode::kNotFound, "There is no tour with this id.", "tours/" + id.str());
}

Result<wire::TourView> TourService::get(const TourId& id) {
  const auto tour = store_.tour(id);
  if (!tour) return pass_on(tour);
  return view_of(*tour);
}

Result<ImageReceipt> TourService::put_image(const ImageUpload& upload) {
  const std::string where = image_name(upload.tour, upload.number);
  if (const Status status = check_file_name(upload.file); !status) return pass_on(status);
  const auto tour = store_.tour(upload.tour);
  if (!tour) return pass_on(tour);
  const auto camera = camera_of(*tour);
  if (!camera) return pass_on(camera);
  auto header = imageio::read_header(upload.bytes);
  if (!header) return fail(header.error().code, header.error().message, where);
  if (header->width_px != camera->width_px || header->height_px != camera->height_px) {
    return fail(ErrorCode::kWrongImageSize,
                "The picture has " + std::to_string(header->width_px) + " x " + std::to_string(header->height_px) +
                    " pixels, the tour's camera " + std::to_string(camera->width_px) + " x " +
                    std::to_string(camera->height_px) + ".",
                where);
  }
  if (const auto decoded = imageio::decode(upload.bytes, where); !decoded) return pass_on(decoded);
  db::TourImage image;
  image.number = upload.number;
  image.file = upload.file;
  image.type = header->format == imageio::ImageFormat::kPng ? db::ImageType::kPng : db::ImageType::kJpeg;
  image.t_us = upload.t_us;
  image.odometry = upload.odometry;
  const auto put = store_.put_image(upload.tour, image, upload.bytes);
  if (!put) return pass_on(put);
  if (*put == db::PutImage::kConflict) {
    return fail(ErrorCode::kConflict,
                "Picture " + std::to_string(upload.number) + " is there already with other bytes.", where);
  }
  std::string file = upload.file;
  if (file.empty() || *put == db::PutImage::kSame) {
    const auto images = store_.tour_images(upload.tour);
    if (!images) return pass_on(images);
    for (const db::TourImage& kept : *images) {
      if (kept.number == upload.number) file = kept.file;
    }
  }
  return ImageReceipt{upload.number, ImageId(upload.tour.str() + "/" + file),
                      static_cast<std::int64_t>(upload.bytes.size()), *put == db::PutImage::kNew};
}

Status TourService::put_sweep(const TourId& id, const db::TourSweep& sweep) {
  const auto put = store_.put_sweep(id, sweep);
  if (!put) return pass_on(put);
  if (*put == db::PutImage::kConflict) {
    return fail(ErrorCode::kConflict, "Picture " + std::to_string(sweep.number) + " has another sweep already.",
                image_name(id, sweep.number) + "/sweep");
  }
  return {};
}

Status TourService::set_marks(const TourId& id, const std::vector<wire::TourMark>& marks) {
  const auto tour = store_.tour(id);
  if (!tour) return pass_on(tour);
  if (tour->complete) {
    return fail(ErrorCode::kConflict, "The tour is complete; its marks cannot be changed any more.",
                "tours/" + id.str());
  }
  const auto images = store_.tour_images(id);
  if (!images) return pass_on(images);
  std::set<std::string> files;
  for (const db::TourImage& image : *images) files.insert(image.file);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!files.contains(marks[i].image)) {
      return fail(ErrorCode::kInvalidInput, "The tour has no picture " + marks[i].image + ".",
                  "body/marks/" + std::to_string(i) + "/image");
    }
  }
  return store_.set_marks(id, marks);
}

Result<wire::TourView> TourService::complete(const TourId& id) {
  const auto tour = store_.tour(id);
  if (!tour) return pass_on(tour);
  const std::string where = "tours/" + id.str();
  if (!tour->missing.empty()) {
    return fail(ErrorCode::kConflict,
                "Pictures are missing, the first is number " + std::to_string(tour->missing.front()) + ".", where);
  }
  if (tour->images < kFewestImages) {
    return fail(ErrorCode::kConflict,
                "The tour has " + std::to_string(tour->images) + " pictures; a map needs at least 3.", where);
  }
  if (const Status status = store_.complete_tour(id); !status) return pass_on(status);
  return get(id);
}

Result<std::unique_ptr<TourSource>> stored_tour(db::Store& store, const TourId& id) {
  auto images = store.tour_images(id);
  if (!images) return pass_on(images);
  auto sweeps = store.sweeps(id);
  if (!sweeps) return pass_on(sweeps);
  const auto marks = store.marks(id);
  if (!marks) return pass_on(marks);
  return std::make_unique<StoredTour>(store, id, std::move(*images), std::move(*sweeps), *marks);
}

}  // namespace homeward::server
