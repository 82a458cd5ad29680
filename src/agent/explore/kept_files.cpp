// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/kept_files.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "files/read_file.hpp"
#include "files/tour_tables.hpp"
#include "files/write_file.hpp"
#include "wire/camera_json.hpp"
#include "wire/json_reader.hpp"

namespace homeward::agent {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string numbered(std::size_t index, const char* extension) {
  char name[40];
  std::snprintf(name, sizeof name, "%05zu%s", index, extension);
  return name;
}

Result<json> read_json(const fs::path& file) {
  const auto text = files::read_text(file);
  if (!text) return pass_on(text);
  return wire::parse_json(*text, file.string());
}

/// With the file in place of the message's own name for it.
Error in_file(Error error, const fs::path& file) {
  error.where = file.string() + (error.where.empty() ? "" : ": " + error.where);
  return error;
}

}  // namespace

fs::path KeptFiles::picture(std::size_t index) const { return tour_folder() / numbered(index, ".jpg"); }

fs::path KeptFiles::view_file(std::size_t index) const { return folder_ / "views" / numbered(index, ".json"); }

Result<KeptFiles> KeptFiles::create(const fs::path& root, const wire::KeptExploration& kept,
                                    const camera::CameraConfig& camera) {
  if (!wire::can_name_folder(kept.id))
    return fail(ErrorCode::kInvalidInput, "The id of an exploration must be of letters, digits, '_' and '-'.", "id");
  KeptFiles files(root / kept.id.str(), kept);
  std::error_code error;
  if (fs::exists(files.folder_ / "exploration.json", error)) {
    return fail(ErrorCode::kConflict, "There is an exploration of this id already.", files.folder_.string());
  }
  for (const fs::path& folder : {files.tour_folder(), files.folder_ / "views"}) {
    if (const Status made = files::make_folder(folder); !made) return pass_on(made);
  }
  if (const Status written =
          files::write_file(files.folder_ / "camera.json", wire::camera_to_json(camera).dump(2) + "\n");
      !written) {
    return pass_on(written);
  }
  if (const Status written = files.keep(kept); !written) return pass_on(written);
  return files;
}

Result<KeptFiles> KeptFiles::open(const fs::path& folder) {
  const fs::path file = folder / "exploration.json";
  const auto value = read_json(file);
  if (!value) return pass_on(value);
  auto kept = wire::kept_exploration_from_json(*value);
  if (!kept) return tl::unexpected<Error>(in_file(kept.error(), file));
  KeptFiles files(folder, std::move(*kept));
  // A picture is written before its view.
  std::error_code error;
  while (fs::exists(files.view_file(files.size_), error) && fs::exists(files.picture(files.size_), error))
    ++files.size_;
  return files;
}

std::vector<KeptFiles> KeptFiles::not_uploaded(const fs::path& root, std::vector<Error>& unread) {
  std::vector<KeptFiles> found;
  std::error_code error;
  for (fs::directory_iterator at(root, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    std::error_code none;
    if (!fs::exists(at->path() / "exploration.json", none)) continue;
    auto files = open(at->path());
    if (!files) {
      unread.push_back(files.error());
    } else if (!files->kept_.tour) {
      found.push_back(std::move(*files));
    }
  }
  std::ranges::sort(found, {}, [](const KeptFiles& files) { return std::pair(files.kept_.begun_us, files.kept_.id); });
  return found;
}

Status KeptFiles::add(std::span<const std::uint8_t> jpeg, const wire::KeptView& view) {
  const std::string_view bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
  if (Status written = files::write_file(picture(size_), bytes); !written) return written;
  if (Status written = files::write_file(view_file(size_), wire::kept_view_to_json(view).dump() + "\n"); !written) {
    std::error_code ignored;
    fs::remove(picture(size_), ignored);
    return written;
  }
  ++size_;
  return {};
}

Status KeptFiles::keep(const wire::KeptExploration& kept) {
  const std::string text = wire::kept_exploration_to_json(kept).dump(2) + "\n";
  if (Status written = files::write_file(folder_ / "exploration.json", text); !written) return written;
  kept_ = kept;
  return {};
}

Result<wire::KeptView> KeptFiles::view(std::size_t index) const {
  const fs::path file = view_file(index);
  const auto value = read_json(file);
  if (!value) return pass_on(value);
  auto view = wire::kept_view_from_json(*value);
  if (!view) return tl::unexpected<Error>(in_file(view.error(), file));
  return view;
}

Status KeptFiles::forget_from(std::size_t size) {
  // The last first: a kill in between leaves no gap that later ones would be counted behind.
  for (; size_ > size; --size_) {
    std::error_code error;
    fs::remove(view_file(size_ - 1), error);
    if (error)
      return fail(ErrorCode::kIo, "The file cannot be removed: " + error.message() + ".",
                  view_file(size_ - 1).string());
  }
  return {};
}

Status KeptFiles::remove() const {
  std::error_code error;
  fs::remove_all(folder_, error);
  if (error) return fail(ErrorCode::kIo, "The folder cannot be removed: " + error.message() + ".", folder_.string());
  return {};
}

Result<std::vector<RangeSweep>> KeptFiles::sweeps() const {
  std::vector<RangeSweep> sweeps;
  for (std::size_t i = 0; i < size_; ++i) {
    auto kept_view = view(i);
    if (!kept_view) return pass_on(kept_view);
    sweeps.push_back(std::move(kept_view->sweep));
  }
  return sweeps;
}

Status KeptFiles::write_tables(std::span<const Pose2> poses) const {
  const auto camera = files::read_camera(folder_ / "camera.json");
  if (!camera) return pass_on(camera);
  std::error_code none;
  for (std::size_t half = size_; fs::remove(picture(half), none); ++half) {
  }
  files::TourTables tables;
  for (std::size_t i = 0; i < std::min(size_, poses.size()); ++i) {
    const auto kept_view = view(i);
    if (!kept_view) return pass_on(kept_view);
    tables.add(numbered(i, ".jpg"), kept_view->t_us, poses[i], std::nullopt);
  }
  return tables.write(tour_folder(), *camera);
}

}  // namespace homeward::agent
