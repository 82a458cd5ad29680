// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_plan.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "linemodel/feature_edges.hpp"
#include "linemodel/read_mesh.hpp"
#include "linemodel/read_svg.hpp"
#include "linemodel/read_vrml.hpp"
#include "linemodel/vrml_lexer.hpp"

namespace homeward::linemodel {
namespace {

constexpr std::array<std::string_view, 5> kMeshes = {"glb", "gltf", "obj", "ply", "stl"};

Result<Plan> with_edges(Result<Plan> plan, const std::string& where) {
  if (!plan || !plan->lines.empty()) return plan;
  plan->lines = feature_edges(plan->vertices_m, plan->triangles);
  if (plan->lines.empty())
    return fail(ErrorCode::kEmptyInput, "The mesh has no straight edge of a quarter of a metre.", where);
  return plan;
}

Result<Plan> scaled(Result<Plan> plan, double factor, const std::string& where) {
  if (!plan || factor == 1.0) return plan;
  const auto scale = static_cast<float>(factor);
  float farthest_m = 0.0F;
  for (PlanLine& line : plan->lines) {
    line.from_m *= scale;
    line.to_m *= scale;
    farthest_m = std::max({farthest_m, line.from_m.cwiseAbs().maxCoeff(), line.to_m.cwiseAbs().maxCoeff()});
  }
  plan->vertices_m *= scale;
  if (plan->vertices_m.rows() > 0) farthest_m = std::max(farthest_m, plan->vertices_m.cwiseAbs().maxCoeff());
  if (!(farthest_m <= static_cast<float>(kFarthest_m)))
    return fail(ErrorCode::kInvalidInput, "With this scale a point lies more than 10 km from the origin.", where);
  return plan;
}

}  // namespace

Result<Plan> read_plan(std::string_view bytes, const std::string& extension, const ReadPlanConfig& config,
                       const std::string& where) {
  std::string format = extension.starts_with('.') ? extension.substr(1) : extension;
  std::ranges::transform(format, format.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (bytes.size() > kMostPlanBytes) return fail(ErrorCode::kTooLarge, "The plan has more than 64 MiB.", where);
  if (config.metres_per_unit && !(*config.metres_per_unit > 0.0 && *config.metres_per_unit < 1e6))
    return fail(ErrorCode::kInvalidInput, "The scale in metres a unit has to be above zero.", where);
  const double scale = config.metres_per_unit.value_or(1.0);
  if (format == "svg") return read_svg(bytes, {config.metres_per_unit, config.wall_height_m}, where);
  if (format == "wrl") {
    auto plan = scaled(read_vrml(bytes, config.up.value_or(PlanUp::kZ), where), scale, where);
    return with_edges(std::move(plan), where);
  }
  if (std::ranges::find(kMeshes, format) != kMeshes.end()) {
    const bool gltf = format == "glb" || format == "gltf";
    return with_edges(read_mesh(bytes, format, scale, config.up.value_or(gltf ? PlanUp::kY : PlanUp::kZ), where),
                      where);
  }
  return fail(
      ErrorCode::kUnsupportedFormat,
      "Plans of the format " + quoted(format) + " are not read: a plan is wrl, svg, glb, gltf, obj, ply or stl.",
      where);
}

}  // namespace homeward::linemodel
