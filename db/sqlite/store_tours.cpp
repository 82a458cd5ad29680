// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "db/secrets.hpp"
#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

constexpr std::size_t kMostMissing = 100;

std::string extension(ImageType type) { return type == ImageType::kPng ? "png" : "jpg"; }

std::string numbered_name(std::int64_t number, ImageType type) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%06lld", static_cast<long long>(number));
  return std::string(digits.data()) + "." + extension(type);
}

void count_images(SQLite::Database& database, Tour& tour) {
  SQLite::Statement row = prepared(database, "SELECT number FROM tour_images WHERE tour = ? ORDER BY number", tour.id);
  std::int64_t next = 0;
  tour.images = 0;
  while (row.executeStep()) {
    const std::int64_t number = integer(row, 0);
    while (next < number && tour.missing.size() < kMostMissing) tour.missing.push_back(next++);
    next = number + 1;
    ++tour.images;
  }
}

Tour tour_of(SQLite::Statement& row) {
  return {TourId(text(row, 0)), text(row, 1), text(row, 2), integer(row, 3) != 0, integer(row, 4), 0, {},
          optional_text(row, 5)};
}

Tour need_tour(SQLite::Database& database, const TourId& id) {
  SQLite::Statement row =
      prepared(database, "SELECT id, name, camera, complete, created_us, uploader FROM tours WHERE id = ?", id);
  if (!row.executeStep()) refuse(ErrorCode::kNotFound, "There is no tour with this id.", "tours/" + id.str());
  return tour_of(row);
}

TourImage image_of(SQLite::Statement& row) {
  TourImage image;
  image.number = integer(row, 0);
  image.file = text(row, 1);
  image.type = text(row, 2) == "png" ? ImageType::kPng : ImageType::kJpeg;
  image.t_us = optional_integer(row, 3);
  if (!row.isColumnNull(4)) image.odometry = Pose2{real(row, 4), real(row, 5), real(row, 6)};
  image.sha256 = text(row, 7);
  image.size = integer(row, 8);
  return image;
}

constexpr const char* kImagesOfTour =
    "SELECT number, file, type, t_us, odometry_x_m, odometry_y_m, odometry_theta_rad, sha256, size "
    "FROM tour_images WHERE tour = ? ORDER BY number";
constexpr const char* kOneImage =
    "SELECT number, file, type, t_us, odometry_x_m, odometry_y_m, odometry_theta_rad, sha256, size "
    "FROM tour_images WHERE tour = ? AND number = ?";

void check_new_image(SQLite::Database& database, const Tour& tour, const TourImage& image) {
  const std::string where = "tours/" + tour.id.str() + "/images/" + std::to_string(image.number);
  if (image.number < 0) refuse(ErrorCode::kInvalidInput, "The number of an image is 0 or more.", where);
  if (image.file.find('/') != std::string::npos || image.file.find('\0') != std::string::npos) {
    refuse(ErrorCode::kInvalidInput, "The file name of an image is a name without folders.", where);
  }
  if (tour.complete) refuse(ErrorCode::kConflict, "The tour is complete; it takes no more images.", where);
  SQLite::Statement row =
      prepared(database, "SELECT number FROM tour_images WHERE tour = ? AND file = ?", tour.id, image.file);
  if (row.executeStep()) {
    refuse(ErrorCode::kConflict,
           "Image " + std::to_string(integer(row, 0)) + " of the tour is already called '" + image.file + "'.", where);
  }
}

/// Whether a file is there and is what was uploaded.
bool holds(const std::filesystem::path& file, const std::string& sha256) {
  return std::filesystem::is_regular_file(file) && sha256_hex(read_whole(file)) == sha256;
}

void insert_image(SQLite::Database& database, const TourId& tour, const TourImage& image) {
  const auto part = [&](double Pose2::*value) {
    return image.odometry ? std::optional((*image.odometry).*value) : std::nullopt;
  };
  execute(database,
          "INSERT INTO tour_images (tour, number, file, type, t_us, odometry_x_m, odometry_y_m, odometry_theta_rad, "
          "sha256, size) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          tour, image.number, image.file, extension(image.type), image.t_us, part(&Pose2::x_m), part(&Pose2::y_m),
          part(&Pose2::theta_rad), image.sha256, image.size);
}

}  // namespace

std::filesystem::path SqliteStore::image_file(const TourId& tour, std::int64_t number, ImageType type) const {
  return folder_ / "tours" / tour.str() / (std::to_string(number) + "." + extension(type));
}

Result<Tour> SqliteStore::add_tour(Tour tour) {
  return database_.work([&](SQLite::Database& database) {
    if (tour.id.empty()) tour.id = TourId(random_id());
    execute(database, "INSERT INTO tours (id, name, camera, complete, created_us, uploader) VALUES (?, ?, ?, ?, ?, ?)",
            tour.id, tour.name, tour.camera, tour.complete, tour.created_us, tour.uploader);
    make_folder_durably(folder_ / "tours" / tour.id.str());
    return tour;
  });
}

Result<std::vector<Tour>> SqliteStore::tours() {
  return database_.read([&](SQLite::Database& database) {
    std::vector<Tour> found;
    SQLite::Statement row = prepared(
        database, "SELECT id, name, camera, complete, created_us, uploader FROM tours ORDER BY created_us, rowid");
    while (row.executeStep()) {
      found.push_back(tour_of(row));
      count_images(database, found.back());
    }
    return found;
  });
}

Result<Tour> SqliteStore::tour(const TourId& id) {
  return database_.read([&](SQLite::Database& database) {
    Tour found = need_tour(database, id);
    count_images(database, found);
    return found;
  });
}

Result<PutImage> SqliteStore::put_image(const TourId& tour, TourImage image, std::span<const std::uint8_t> bytes) {
  image.sha256 = sha256_hex(bytes);
  image.size = static_cast<std::int64_t>(bytes.size());
  if (image.file.empty()) image.file = numbered_name(image.number, image.type);
  // One at a time writes the file of a picture; others, and all who read, do not wait for the disk meanwhile.
  const KeyedMutex::Hold alone(picture_locks_, tour.str() + "/" + std::to_string(image.number));
  const auto before = database_.read([&](SQLite::Database& database) {
    const Tour found = need_tour(database, tour);
    SQLite::Statement row = prepared(database, kOneImage, tour, image.number);
    if (row.executeStep()) return std::optional(image_of(row));
    check_new_image(database, found, image);
    return std::optional<TourImage>();
  });
  if (!before) return pass_on(before);
  if (*before && (*before)->sha256 != image.sha256) return PutImage::kConflict;
  // First the file, then the row: a row always has its file.
  const std::filesystem::path file = image_file(tour, image.number, *before ? (*before)->type : image.type);
  try {
    if (!*before || !holds(file, image.sha256)) write_durably(file, bytes);
  } catch (...) {
    return tl::unexpected<Error>(StoreDatabase::present_error(file.string()));
  }
  if (*before) return PutImage::kSame;
  const Status added = database_.work([&](SQLite::Database& database) {
    check_new_image(database, need_tour(database, tour), image);
    insert_image(database, tour, image);
  });
  if (added) return PutImage::kNew;
  forget_file_after(added.error(), file);
  return pass_on(added);
}

Result<std::vector<TourImage>> SqliteStore::tour_images(const TourId& tour) {
  return database_.read([&](SQLite::Database& database) {
    need_tour(database, tour);
    std::vector<TourImage> found;
    SQLite::Statement row = prepared(database, kImagesOfTour, tour);
    while (row.executeStep()) found.push_back(image_of(row));
    return found;
  });
}

Result<std::vector<std::uint8_t>> SqliteStore::image_bytes(const TourId& tour, std::int64_t number) {
  const std::string where = "tours/" + tour.str() + "/images/" + std::to_string(number);
  const Result<TourImage> image = database_.read([&](SQLite::Database& database) {
    SQLite::Statement row = prepared(database, kOneImage, tour, number);
    if (!row.executeStep()) refuse(ErrorCode::kNotFound, "There is no such image.", where);
    return image_of(row);
  });
  if (!image) return pass_on(image);
  try {
    std::vector<std::uint8_t> bytes = read_whole(image_file(tour, number, image->type));
    if (sha256_hex(bytes) != image->sha256) {
      return fail(ErrorCode::kCorruptFile, "The kept image is not the one that was uploaded.", where);
    }
    return bytes;
  } catch (...) {
    return tl::unexpected<Error>(StoreDatabase::present_error(where));
  }
}

Status SqliteStore::set_marks(const TourId& tour, const std::vector<wire::TourMark>& marks) {
  return database_.work([&](SQLite::Database& database) {
    need_tour(database, tour);
    execute(database, "DELETE FROM tour_marks WHERE tour = ?", tour);
    std::int64_t position = 0;
    for (const wire::TourMark& mark : marks) {
      execute(database, "INSERT INTO tour_marks (tour, position, image, label) VALUES (?, ?, ?, ?)", tour, position++,
              mark.image, mark.label);
    }
  });
}

Result<std::vector<wire::TourMark>> SqliteStore::marks(const TourId& tour) {
  return database_.read([&](SQLite::Database& database) {
    need_tour(database, tour);
    std::vector<wire::TourMark> found;
    SQLite::Statement row =
        prepared(database, "SELECT image, label FROM tour_marks WHERE tour = ? ORDER BY position", tour);
    while (row.executeStep()) found.push_back({text(row, 0), text(row, 1)});
    return found;
  });
}

Status SqliteStore::complete_tour(const TourId& id) {
  return database_.work([&](SQLite::Database& database) {
    need_tour(database, id);
    execute(database, "UPDATE tours SET complete = 1 WHERE id = ?", id);
  });
}

Status SqliteStore::remove_tour(const TourId& id) {
  const std::filesystem::path folder = folder_ / "tours" / id.str();
  bool renamed = false;
  const Status removed = database_.work([&](SQLite::Database& database) {
    need_tour(database, id);
    SQLite::Statement row = prepared(database, "SELECT map FROM map_tours WHERE tour = ?", id);
    if (row.executeStep()) {
      refuse(ErrorCode::kConflict, "The map " + text(row, 0) + " is built from this tour.", "tours/" + id.str());
    }
    execute(database, "DELETE FROM tours WHERE id = ?", id);
    std::error_code failure;
    std::filesystem::rename(folder, removed_name(folder), failure);
    renamed = !failure;
    flush_folder(folder_ / "tours");
  });
  std::error_code failure;
  if (!removed) {
    if (renamed) std::filesystem::rename(removed_name(folder), folder, failure);
    return removed;
  }
  need_no_longer(folder);
  std::filesystem::remove_all(removed_name(folder), failure);  // what is left of it goes at the next start
  return {};
}

}  // namespace homeward::db
