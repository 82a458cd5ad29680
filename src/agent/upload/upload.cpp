// SPDX-License-Identifier: Apache-2.0
#include "agent/upload/upload.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "wire/camera_json.hpp"
#include "wire/error_table.hpp"
#include "wire/scans_json.hpp"

namespace homeward::agent {
namespace {

using nlohmann::json;

/// What the server says against it, in its own words.
Error refusal(const RestAnswer& answer, const std::string& what) {
  const json problem = json::parse(answer.body, nullptr, false);
  Error error{ErrorCode::kIo, what + ": the server answered " + std::to_string(answer.status) + ".", what};
  if (!problem.is_object()) return error;
  if (const auto* row = wire::error_row(std::string_view(problem.value("code", std::string())))) error.code = row->code;
  const std::string detail = problem.value("detail", problem.value("title", std::string()));
  if (!detail.empty()) error.message = what + ": " + detail;
  return error;
}

Result<json> call(RestClient& server, const std::string& method, const std::string& path, const json* body) {
  const auto answer =
      server.call(method, path, body != nullptr ? body->dump() : "", {{"Content-Type", "application/json"}});
  if (!answer) return pass_on(answer);
  if (answer->status < 200 || answer->status >= 300)
    return tl::unexpected<Error>(refusal(*answer, method + " " + path));
  json value = json::parse(answer->body, nullptr, false);
  if (value.is_discarded()) return fail(ErrorCode::kIo, "The server's answer is no JSON.", path);
  return value;
}

/// Is it the picture that is wrong, and not the way to the server?
bool unreadable(const Error& error) {
  return error.code == ErrorCode::kUnsupportedImage || error.code == ErrorCode::kTruncatedImage ||
         error.code == ErrorCode::kImageTooLarge;
}

struct FoundTour {
  std::string id;
  bool complete = false;
};

/// A tour of this name to carry on with, or a new one; a complete one where the name is its own.
Result<FoundTour> find_tour(RestClient& server, const UploadOptions& options, const camera::CameraConfig& camera) {
  const auto known = call(server, "GET", "/api/v1/tours", nullptr);
  if (!known) return pass_on(known);
  for (const json& tour : known->value("tours", json::array())) {
    if (tour.value("name", std::string()) != options.name) continue;
    const FoundTour found{tour.value("id", std::string()), tour.value("state", std::string()) == "complete"};
    if (!found.complete || options.own_name) return found;
  }
  const json request = {{"name", options.name}, {"camera", wire::camera_to_json(camera)}};
  const auto made = call(server, "POST", "/api/v1/tours", &request);
  if (!made) return pass_on(made);
  return FoundTour{made->value("id", std::string()), false};
}

std::string file_name(const TourImage& image) {
  const std::string& id = image.id.str();
  return id.substr(id.find('/') + 1);
}

Status put_picture(RestClient& server, const std::string& tour, std::size_t number, const std::filesystem::path& file,
                   const TourImage& image) {
  const auto bytes = files::read_text(file);
  if (!bytes) return pass_on(bytes);
  const bool png = file.extension() == ".png" || file.extension() == ".PNG";
  std::map<std::string, std::string> headers = {{"Content-Type", png ? "image/png" : "image/jpeg"},
                                                {"X-Homeward-Filename", file_name(image)}};
  if (image.t_us) headers["X-Homeward-T-Us"] = std::to_string(*image.t_us);
  if (image.odometry) {
    char text[100];
    std::snprintf(text, sizeof text, "%.6f,%.6f,%.6f", image.odometry->x_m, image.odometry->y_m,
                  image.odometry->theta_rad);
    headers["X-Homeward-Odometry"] = text;
  }
  const auto answer =
      server.call("PUT", "/api/v1/tours/" + tour + "/images/" + std::to_string(number), *bytes, headers);
  if (!answer) return pass_on(answer);
  if (answer->status != 200 && answer->status != 201) return tl::unexpected<Error>(refusal(*answer, file.string()));
  return {};
}

Status put_sweep(RestClient& server, const std::string& tour, std::size_t number, const std::filesystem::path& folder,
                 const TourImage& image) {
  if (!image.sweep) return {};
  const std::string path = "/api/v1/tours/" + tour + "/images/" + std::to_string(number) + "/sweep";
  const auto answer = server.call("PUT", path, wire::sweep_to_json(*image.sweep).dump(),
                                  {{"Content-Type", "application/json"}, {"X-Homeward-Filename", file_name(image)}});
  if (!answer) return pass_on(answer);
  if (answer->status == 204) return {};
  Error error = refusal(*answer, "The sweep of " + file_name(image));
  error.where = (folder / "scans.csv").string();
  const json problem = json::parse(answer->body, nullptr, false);
  const std::string where = problem.is_object() ? problem.value("where", std::string()) : std::string();
  if (!where.empty()) error.where += " (" + where + ")";
  return tl::unexpected<Error>(error);
}

}  // namespace

Result<UploadedTour> upload_tour(RestClient& server, const UploadOptions& options,
                                 const std::function<bool(double)>& progress) {
  const auto tour = files::TourFolder::open(options.folder);
  if (!tour) return pass_on(tour);
  const std::filesystem::path folder(options.folder);
  const auto camera =
      files::read_camera(options.camera.empty() ? folder / "camera.json" : std::filesystem::path(options.camera));
  if (!camera) return pass_on(camera);
  const auto found = find_tour(server, options, *camera);
  if (!found) return pass_on(found);
  const std::string& id = found->id;
  if (found->complete) return UploadedTour{id, {}};
  const auto files = files::pictures_in(options.folder);
  if (!files) return pass_on(files);
  UploadedTour uploaded{id, {}};
  std::size_t kept = 0;  // the server numbers without gaps
  for (std::size_t i = 0; i < files->size(); ++i) {
    TourImage image = tour->images()[i];
    if (i < options.sweeps.size()) image.sweep = options.sweeps[i];
    const Status put = put_picture(server, id, kept, (*files)[i], image);
    if (put) {
      if (const Status sent = put_sweep(server, id, kept, folder, image); !sent) return pass_on(sent);
      ++kept;
    } else if (unreadable(put.error())) {
      uploaded.skipped.push_back(put.error());
    } else {
      return pass_on(put);
    }
    if (!progress(static_cast<double>(i + 1) / static_cast<double>(files->size())))
      return fail(ErrorCode::kConflict, "The upload was ended; it can be carried on with.", id);
  }
  if (kept == 0) return tl::unexpected<Error>(uploaded.skipped.front());
  json marks = {{"marks", json::array()}};
  for (const TourMark& mark : tour->marks()) {
    const auto error = std::ranges::find(uploaded.skipped, (folder / mark.image).string(), &Error::where);
    if (error == uploaded.skipped.end()) {
      marks["marks"].push_back({{"image", mark.image}, {"label", mark.label}});
    } else {
      error->message += " Its destination \"" + mark.label + "\" is left out with it.";
    }
  }
  if (const auto put = call(server, "PUT", "/api/v1/tours/" + id + "/marks", &marks); !put) return pass_on(put);
  const json nothing = json::object();
  if (const auto done = call(server, "POST", "/api/v1/tours/" + id + "/complete", &nothing); !done)
    return pass_on(done);
  return uploaded;
}

}  // namespace homeward::agent
