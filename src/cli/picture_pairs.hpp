// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "cli/recent.hpp"
#include "core/result.hpp"
#include "files/read_file.hpp"
#include "pipeline/eye.hpp"

namespace homeward::cli {

/// Which pictures a command compares: one pair, or those of a table.
struct PicturePairs {
  std::string camera;
  std::string current;
  std::string target;
  std::string pairs;
};

/// --camera, --current, --target, --pairs.
void add_picture_pairs(CLI::App& command, PicturePairs& pairs);

/// The eye of the camera that is named. Errors: those of the file and of the camera.
Result<pipeline::Eye> eye_of(const PicturePairs& pairs);

/// One pair after another, until one fails. `answer` takes current and target as they are named, and the folder that
/// the names are relative to. Errors: kInvalidInput, neither a pair nor a table, or a table without these columns;
/// those of the table and of `answer`.
using AnswerPair =
    std::function<Status(const std::string& current, const std::string& target, const std::filesystem::path& folder)>;
Status answer_each(const PicturePairs& pairs, const std::string& command, const AnswerPair& answer);

/// What the eye makes of picture files; those asked for last are kept.
template <typename Made>
class Gallery {
 public:
  using Make = std::function<Result<Made>(const pipeline::Eye&, const Image&)>;

  Gallery(pipeline::Eye eye, Make make, std::size_t most) : eye_(std::move(eye)), make_(std::move(make)), seen_(most) {}

  /// Errors: of reading the file, and of what is made of it, with the file's path as where.
  Result<std::shared_ptr<const Made>> look(const std::filesystem::path& file) {
    return seen_.get(file, [&](const std::filesystem::path& path) -> Result<Made> {
      const auto picture = files::read_picture(path);
      if (!picture) return pass_on(picture);
      auto made = make_(eye_, *picture);
      if (made) return made;
      Error error = made.error();
      error.where = path.string();
      return tl::unexpected<Error>(error);
    });
  }

 private:
  pipeline::Eye eye_;
  Make make_;
  Recent<Made> seen_;
};

}  // namespace homeward::cli
