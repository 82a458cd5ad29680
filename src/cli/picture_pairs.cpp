// SPDX-License-Identifier: Apache-2.0
#include "cli/picture_pairs.hpp"

#include <vector>

#include "files/csv.hpp"

namespace homeward::cli {

void add_picture_pairs(CLI::App& command, PicturePairs& pairs) {
  command.add_option("--camera", pairs.camera, "camera.json")->required();
  command.add_option("--current", pairs.current, "Picture taken here");
  command.add_option("--target", pairs.target, "Picture taken there");
  command.add_option("--pairs", pairs.pairs, "Table (CSV) with columns current and target; paths relative to it");
}

Result<pipeline::Eye> eye_of(const PicturePairs& pairs) {
  const auto config = files::read_camera(pairs.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  return pipeline::Eye::create(*config, pipeline::suited_feature_config(**camera));
}

Status answer_each(const PicturePairs& pairs, const std::string& command, const AnswerPair& answer) {
  const bool one_pair = !pairs.current.empty() && !pairs.target.empty();
  if (one_pair == !pairs.pairs.empty()) {
    return fail(ErrorCode::kInvalidInput, "Give either --current and --target, or --pairs.", command);
  }
  if (one_pair) return answer(pairs.current, pairs.target, {});
  const auto table = files::read_csv(pairs.pairs);
  if (!table) return pass_on(table);
  const auto current = table->column("current");
  const auto target = table->column("target");
  if (!current || !target) {
    return fail(ErrorCode::kInvalidInput, "The first line must name the columns current and target.", pairs.pairs);
  }
  const std::filesystem::path folder = std::filesystem::path(pairs.pairs).parent_path();
  for (const std::vector<std::string>& row : table->rows) {
    if (const Status answered = answer(row[*current], row[*target], folder); !answered) return answered;
  }
  return {};
}

}  // namespace homeward::cli
