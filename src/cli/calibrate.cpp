// SPDX-License-Identifier: Apache-2.0
#include "camera/calibrate.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "camera/mirror_ring.hpp"
#include "cli/command.hpp"
#include "cli/residual_picture.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "wire/camera_json.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateOptions {
  std::string images;
  std::string board;
  double square_m = 0.0;
  std::string model;
  bool mirror = false;
  std::string out;
  std::string residuals;
  bool json = false;
};

/// Camera axes of one that looks forward: x right, y down, z forward.
const Eigen::Quaterniond kLooksForward(0.5, -0.5, 0.5, -0.5);
/// A mirror above a camera that looks up, forward at the top of the picture: x left, y forward, z down.
const Eigen::Quaterniond kMirrorAbove(0.0, std::sqrt(0.5), std::sqrt(0.5), 0.0);

struct Pictures {
  std::vector<std::string> names;
  std::vector<Image> images;
};

/// All pictures of a folder that can be read and have the size of the first; the others are told and skipped.
Result<Pictures> read_all(const std::string& folder) {
  const auto files = files::pictures_in(folder);
  if (!files) return pass_on(files);
  Pictures pictures;
  for (const fs::path& file : *files) {
    auto image = files::read_picture(file);
    if (!image) {
      tell({image.error().code, "Skipped: " + image.error().message, image.error().where});
      continue;
    }
    const Image* first = pictures.images.empty() ? nullptr : &pictures.images.front();
    if (first != nullptr && (image->width_px != first->width_px || image->height_px != first->height_px)) {
      tell({ErrorCode::kWrongImageSize, "Skipped: It has not the size of the pictures before it.", file.string()});
      continue;
    }
    pictures.names.push_back(file.filename().string());
    pictures.images.push_back(std::move(*image));
  }
  if (pictures.images.empty()) return fail(ErrorCode::kEmptyInput, "There is no picture that can be read.", folder);
  return pictures;
}

Result<camera::BoardGeometry> board_of(const CalibrateOptions& options) {
  camera::BoardGeometry board;
  board.square_m = options.square_m;
  const char* end = options.board.data() + options.board.size();
  const auto cols = std::from_chars(options.board.data(), end, board.cols);
  const bool crossed = cols.ec == std::errc() && cols.ptr != end && *cols.ptr == 'x';
  const auto rows = crossed ? std::from_chars(cols.ptr + 1, end, board.rows) : cols;
  if (!crossed || rows.ec != std::errc() || rows.ptr != end) {
    return fail(ErrorCode::kInvalidInput, "A board is given by its inner corners, as 8x6.", "--board");
  }
  const std::vector<std::string> wrong = camera::problems(board);
  if (!wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front(), "--board, --square-m");
  return board;
}

Result<camera::CalibratedModel> model_of(const CalibrateOptions& options) {
  if (options.model == "mei") return camera::CalibratedModel::kMei;
  if (options.model == "fisheye") return camera::CalibratedModel::kFisheye;
  if (options.model == "pinhole") return camera::CalibratedModel::kPinhole;
  return fail(ErrorCode::kInvalidInput,
              "The model '" + options.model + "' is not known; there are mei, fisheye and pinhole.", "--model");
}

/// The part of the picture that shows the world, about the principal point instead of the rim's centre.
void mark_ring(const camera::MirrorRing& ring, camera::Mei& mei) {
  const double apart_px = (ring.centre_px - Eigen::Vector2d(mei.intrinsics.cx_px, mei.intrinsics.cy_px)).norm();
  mei.valid.radius_min_px = ring.radius_min_px > 0.0 ? ring.radius_min_px + apart_px : 0.0;
  mei.valid.radius_max_px = ring.radius_max_px - apart_px;
}

nlohmann::json to_json(const camera::CalibrationResult& result, const std::vector<camera::BoardView>& views) {
  nlohmann::json used = nlohmann::json::array();
  for (const camera::UsedView& view : result.used) {
    used.push_back({{"image", views[view.view].name}, {"rms_px", view.rms_px}});
  }
  nlohmann::json left_out = nlohmann::json::array();
  for (const camera::LeftOutView& view : result.left_out) {
    left_out.push_back({{"image", views[view.view].name}, {"reason", view.reason}});
  }
  nlohmann::json parameters = nlohmann::json::object();
  for (const camera::ParameterDeviation& one : result.parameters) {
    parameters[one.name] = {{"value", one.value}, {"deviation", nullptr}};
    if (std::isfinite(one.deviation)) parameters[one.name]["deviation"] = one.deviation;
  }
  return {{"rms_px", result.rms_px},     {"used", used},
          {"left_out", left_out},        {"parameters", parameters},
          {"warnings", result.warnings}, {"camera", wire::camera_to_json(result.config)}};
}

void print(const camera::CalibrationResult& result, const std::vector<camera::BoardView>& views) {
  for (const camera::UsedView& view : result.used) {
    std::printf("%-32s %6.2f px\n", views[view.view].name.c_str(), view.rms_px);
  }
  std::printf("%-32s %6.2f px\n", "RMS", result.rms_px);
  for (const camera::ParameterDeviation& one : result.parameters) {
    std::printf("%-6s %12.5g +- %.2g\n", one.name.c_str(), one.value, one.deviation);
  }
  std::fflush(stdout);
}

std::vector<camera::BoardView> find_boards(const Pictures& pictures, const camera::BoardGeometry& board) {
  std::vector<camera::BoardView> views;
  std::vector<Error> skipped;
  auto progress = std::make_unique<ProgressBar>();
  for (std::size_t i = 0; i < pictures.images.size(); ++i) {
    progress->show("boards", static_cast<double>(i) / static_cast<double>(pictures.images.size()));
    auto corners = camera::find_board(pictures.images[i], board.cols, board.rows);
    if (!corners) {
      skipped.push_back({corners.error().code, "Skipped: " + corners.error().message, pictures.names[i]});
      continue;
    }
    views.push_back({pictures.names[i], std::move(*corners)});
  }
  progress.reset();  // told below the bar, not in it
  for (const Error& error : skipped) tell(error);
  return views;
}

Status calibrate(const CalibrateOptions& options) {
  for (const auto& [name, given] : {std::pair("--images", !options.images.empty()),
                                    {"--board", !options.board.empty()},
                                    {"--square-m", options.square_m != 0.0},
                                    {"--model", !options.model.empty()},
                                    {"--out", !options.out.empty()}}) {
    if (!given) return fail(ErrorCode::kInvalidInput, std::string(name) + " is required.", "calibrate");
  }
  const auto board = board_of(options);
  if (!board) return pass_on(board);
  const auto model = model_of(options);
  if (!model) return pass_on(model);
  if (options.mirror && *model != camera::CalibratedModel::kMei) {
    return fail(ErrorCode::kInvalidInput, "Of the models, only mei is one of a mirror.", "--mirror");
  }
  const auto pictures = read_all(options.images);
  if (!pictures) return pass_on(pictures);
  const std::vector<camera::BoardView> views = find_boards(*pictures, *board);
  camera::CalibrationInput input;
  input.model = *model;
  input.mirror = options.mirror;
  input.board = *board;
  input.camera.width_px = pictures->images.front().width_px;
  input.camera.height_px = pictures->images.front().height_px;
  input.camera.robot_from_camera_rotation = options.mirror ? kMirrorAbove : kLooksForward;
  auto result = camera::calibrate(input, views);
  if (!result) {
    const std::string where = result.error().where.empty() ? options.images : result.error().where;
    return fail(result.error().code, result.error().message, where);
  }
  if (options.mirror) {
    const auto ring = camera::find_mirror_ring(pictures->images);
    if (ring) {
      mark_ring(*ring, std::get<camera::Mei>(result->config.model));
    } else {
      result->warnings.push_back("The mirror's rim was not found, so valid_radius_px is left out: " +
                                 ring.error().message);
    }
  }
  for (const camera::LeftOutView& view : result->left_out) {
    tell({ErrorCode::kInvalidInput, "Left out: " + view.reason, views[view.view].name});
  }
  for (const std::string& warning : result->warnings) {
    tell({ErrorCode::kInvalidInput, "Warning: " + warning, options.images});
  }
  if (!options.residuals.empty()) {
    const std::vector<std::uint8_t> png =
        imageio::encode_png(residual_picture(pictures->images.front(), views, *result));
    const std::string bytes(png.begin(), png.end());
    if (const Status drawn = files::write_file(options.residuals, bytes); !drawn) return drawn;
  }
  const Status written = files::write_file(options.out, wire::camera_to_json(result->config).dump(2) + "\n");
  if (!written) return written;
  if (options.json) {
    std::cout << to_json(*result, views).dump() << "\n";
  } else {
    print(*result, views);
  }
  return {};
}

Status find_mirror(const CalibrateOptions& options) {
  const auto pictures = read_all(options.images);
  if (!pictures) return pass_on(pictures);
  const auto ring = camera::find_mirror_ring(pictures->images);
  if (!ring) return fail(ring.error().code, ring.error().message, options.images);
  if (options.json) {
    const nlohmann::json line{{"centre_px", {ring->centre_px.x(), ring->centre_px.y()}},
                              {"valid_radius_px", {ring->radius_min_px, ring->radius_max_px}},
                              {"spread_px", ring->spread_px},
                              {"centre_deviation_px", ring->centre_deviation_px},
                              {"rim_share", ring->rim_share},
                              {"middle_share", ring->middle_share},
                              {"pictures", pictures->images.size()}};
    std::cout << line.dump() << "\n";
    return {};
  }
  std::printf("centre  %.2f %.2f px (+- %.2f)\n", ring->centre_px.x(), ring->centre_px.y(), ring->centre_deviation_px);
  std::printf("rim     %.1f px, seen in %.0f %% of its directions, edge within %.2f px\n", ring->radius_max_px,
              100.0 * ring->rim_share, ring->spread_px);
  if (ring->radius_min_px > 0.0) {
    std::printf("middle  %.1f px, seen in %.0f %% of its directions\n", ring->radius_min_px,
                100.0 * ring->middle_share);
  } else {
    std::puts("middle  not found");
  }
  std::fflush(stdout);
  return {};
}

}  // namespace

void register_calibrate(CLI::App& program) {
  CLI::App* command = program.add_subcommand("calibrate", "A camera.json from pictures of a chessboard");
  const auto options = std::make_shared<CalibrateOptions>();
  command->add_option("--images", options->images, "Folder of pictures, the board in another place in each");
  command->add_option("--board", options->board, "Inner corners of the board, COLSxROWS, as 8x6");
  command->add_option("--square-m", options->square_m, "Side of a square in metres");
  command->add_option("--model", options->model, "mei (mirrors and wide lenses), fisheye or pinhole");
  command->add_flag("--mirror", options->mirror, "With mei: the camera looks into a mirror");
  command->add_option("--out", options->out, "camera.json to write");
  command->add_option("--residuals", options->residuals, "Picture (PNG) of what the corners are off, to write");
  command->add_flag("--json", options->json, "The result as a JSON line");
  CLI::App* mirror = command->add_subcommand("mirror", "The mirror's centre and ring, without a board");
  const auto mirror_options = std::make_shared<CalibrateOptions>();
  mirror->add_option("--images", mirror_options->images, "Folder of pictures of one camera")->required();
  mirror->add_flag("--json", mirror_options->json, "The result as a JSON line");
  run_on(*command, [command, options]() -> Status {
    // CLI11 runs a command's own callback for its subcommands too.
    if (!command->get_subcommands().empty()) return {};
    return calibrate(*options);
  });
  run_on(*mirror, [mirror_options] { return find_mirror(*mirror_options); });
}

}  // namespace homeward::cli
