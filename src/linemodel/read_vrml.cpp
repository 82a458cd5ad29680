// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_vrml.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "linemodel/polygon.hpp"
#include "linemodel/vrml_lexer.hpp"
#include "linemodel/vrml_tree.hpp"

namespace homeward::linemodel {
namespace {

/// Indices that are looked at, each time that DEF and USE lead there; a node counts as ten.
constexpr std::size_t kMostSteps = 30'000'000;
constexpr std::size_t kStepsOfNode = 10;

constexpr std::array<std::string_view, 5> kGroups = {"Group", "Transform", "Anchor", "Billboard", "Collision"};
constexpr std::array<std::string_view, 36> kWithoutEdges = {"Appearance",
                                                            "AudioClip",
                                                            "Background",
                                                            "Color",
                                                            "ColorInterpolator",
                                                            "CoordinateInterpolator",
                                                            "CylinderSensor",
                                                            "DirectionalLight",
                                                            "Fog",
                                                            "FontStyle",
                                                            "ImageTexture",
                                                            "Material",
                                                            "MovieTexture",
                                                            "NavigationInfo",
                                                            "Normal",
                                                            "NormalInterpolator",
                                                            "OrientationInterpolator",
                                                            "PixelTexture",
                                                            "PlaneSensor",
                                                            "PointLight",
                                                            "PointSet",
                                                            "PositionInterpolator",
                                                            "ProximitySensor",
                                                            "ScalarInterpolator",
                                                            "Script",
                                                            "Sound",
                                                            "SphereSensor",
                                                            "SpotLight",
                                                            "Text",
                                                            "TextureCoordinate",
                                                            "TextureTransform",
                                                            "TimeSensor",
                                                            "TouchSensor",
                                                            "Viewpoint",
                                                            "VisibilitySensor",
                                                            "WorldInfo"};

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

class PlanOfTree {
 public:
  PlanOfTree(const VrmlTree& tree, PlanUp up, const std::string& where) : tree_(tree), up_(up), where_(where) {}

  Result<Plan> take() {
    for (const std::size_t root : tree_.roots) {
      if (const Status added = add_node(root, Eigen::Affine3d::Identity()); !added) return pass_on(added);
    }
    return builder_.take(where_);
  }

 private:
  [[nodiscard]] std::string where_of(const VrmlNode& node) const { return where_ + ":" + std::to_string(node.line); }

  static const VrmlField& field_of(const VrmlNode& node, std::string_view name) {
    static const VrmlField kNothing;
    const auto found = node.fields.find(name);
    return found == node.fields.end() ? kNothing : found->second;
  }

  Status count_steps(std::size_t steps, const VrmlNode& node) {
    steps_ += steps;
    if (steps_ <= kMostSteps) return {};
    return fail(ErrorCode::kTooLarge, "Nodes are used over and over: the plan is too large.", where_of(node));
  }

  Status add_node(std::size_t index, const Eigen::Affine3d& world_from_parent) {
    const VrmlNode& node = tree_.nodes[index];
    if (const Status counted = count_steps(kStepsOfNode, node); !counted) return counted;
    if (is_one_of(kGroups, node.type)) return add_group(node, world_from_parent);
    if (node.type == "Switch") return add_choice(node, world_from_parent);
    if (node.type == "LOD") {
      const VrmlField& levels = field_of(node, "level");
      return levels.nodes.empty() ? Status{} : add_node(levels.nodes.front(), world_from_parent);
    }
    if (node.type == "Shape") {
      for (const std::size_t geometry : field_of(node, "geometry").nodes) {
        if (const Status added = add_geometry(tree_.nodes[geometry], world_from_parent); !added) return added;
      }
      return {};
    }
    if (is_one_of(kWithoutEdges, node.type)) return {};
    return refuse(node);
  }

  [[nodiscard]] Status refuse(const VrmlNode& node) const {
    return fail(ErrorCode::kUnsupportedFormat,
                "The node " + quoted(node.type) +
                    " is not read: a plan is made of IndexedLineSet, IndexedFaceSet and Box, in this one file.",
                where_of(node));
  }

  Status add_group(const VrmlNode& node, const Eigen::Affine3d& world_from_parent) {
    Eigen::Affine3d world_from_node = world_from_parent;
    if (node.type == "Transform") {
      const auto parent_from_node = transform_of(node);
      if (!parent_from_node) return pass_on(parent_from_node);
      world_from_node = world_from_parent * *parent_from_node;
    }
    for (const std::size_t child : field_of(node, "children").nodes) {
      if (const Status added = add_node(child, world_from_node); !added) return added;
    }
    return {};
  }

  Status add_choice(const VrmlNode& node, const Eigen::Affine3d& world_from_parent) {
    const VrmlField& which = field_of(node, "whichChoice");
    const VrmlField& choices = field_of(node, "choice");
    const double choice = which.numbers.empty() ? -1.0 : which.numbers.front();
    if (!(choice >= 0.0 && choice < static_cast<double>(choices.nodes.size()))) return {};
    return add_node(choices.nodes[static_cast<std::size_t>(choice)], world_from_parent);
  }

  Result<Eigen::VectorXd> numbers_of(const VrmlNode& node, std::string_view name, const Eigen::VectorXd& usual) const {
    const VrmlField& field = field_of(node, name);
    if (!node.fields.contains(name)) return usual;
    if (field.numbers.size() != static_cast<std::size_t>(usual.size())) {
      return fail(ErrorCode::kInvalidInput,
                  "The field " + quoted(name) + " has to have " + std::to_string(usual.size()) + " numbers.",
                  where_of(node));
    }
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(field.numbers.data(), usual.size()));
  }

  static Eigen::Quaterniond turn_of(const Eigen::VectorXd& axis_and_angle) {
    const Eigen::Vector3d axis = axis_and_angle.head<3>();
    if (!(axis.norm() > 1e-12)) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(axis_and_angle(3), axis.normalized()));
  }

  /// ISO/IEC 14772-1:1997, 6.52: T C R SR S -SR -C.
  [[nodiscard]] Result<Eigen::Affine3d> transform_of(const VrmlNode& node) const {
    const Eigen::VectorXd no_turn = Eigen::Vector4d(0.0, 0.0, 1.0, 0.0);
    const auto translation = numbers_of(node, "translation", Eigen::Vector3d::Zero());
    if (!translation) return pass_on(translation);
    const auto centre = numbers_of(node, "center", Eigen::Vector3d::Zero());
    if (!centre) return pass_on(centre);
    const auto scale = numbers_of(node, "scale", Eigen::Vector3d::Ones());
    if (!scale) return pass_on(scale);
    const auto rotation = numbers_of(node, "rotation", no_turn);
    if (!rotation) return pass_on(rotation);
    const auto orientation = numbers_of(node, "scaleOrientation", no_turn);
    if (!orientation) return pass_on(orientation);
    const Eigen::Quaterniond scaled_along = turn_of(*orientation);
    const Eigen::Vector3d at = *translation;
    const Eigen::Vector3d middle = *centre;
    const Eigen::Vector3d factors = *scale;
    return Eigen::Affine3d(Eigen::Translation3d(at + middle) * turn_of(*rotation) * scaled_along *
                           Eigen::Scaling(factors) * scaled_along.conjugate() * Eigen::Translation3d(-middle));
  }

  Status add_geometry(const VrmlNode& node, const Eigen::Affine3d& world_from_node) {
    if (node.type == "IndexedLineSet" || node.type == "IndexedFaceSet") return add_indexed(node, world_from_node);
    if (node.type == "Box") return add_box(node, world_from_node);
    if (is_one_of(kWithoutEdges, node.type)) return {};
    return refuse(node);
  }

  /// The points of a line or face set, three numbers each.
  [[nodiscard]] Result<std::span<const double>> points_of(const VrmlNode& node) const {
    const VrmlField& coord = field_of(node, "coord");
    if (coord.nodes.empty()) return std::span<const double>();
    const VrmlNode& points = tree_.nodes[coord.nodes.front()];
    if (points.type != "Coordinate")
      return fail(ErrorCode::kInvalidInput, "The field \"coord\" has to hold a Coordinate node.", where_of(points));
    const std::vector<double>& numbers = field_of(points, "point").numbers;
    if (numbers.size() % 3 != 0)
      return fail(ErrorCode::kInvalidInput, "The field \"point\" has to have three numbers a point.", where_of(points));
    return std::span<const double>(numbers);
  }

  Status add_indexed(const VrmlNode& node, const Eigen::Affine3d& world_from_node) {
    const auto points = points_of(node);
    if (!points) return pass_on(points);
    const std::vector<double>& indices = field_of(node, "coordIndex").numbers;
    if (const Status counted = count_steps(indices.size(), node); !counted) return counted;
    const bool faces = node.type == "IndexedFaceSet";
    std::vector<Eigen::Vector3d> corners_m;
    for (std::size_t i = 0; i <= indices.size(); ++i) {
      if (i == indices.size() || indices[i] == -1.0) {
        const Status added = faces ? add_face(corners_m, node) : add_polyline(corners_m, node);
        if (!added) return added;
        corners_m.clear();
        continue;
      }
      const double index = indices[i];
      const std::size_t count = points->size() / 3;
      if (!(index >= 0.0 && index < static_cast<double>(count)) || index != std::floor(index)) {
        return fail(ErrorCode::kInvalidInput,
                    "The field \"coordIndex\" names a point that is not there (entry " + std::to_string(i) + " of " +
                        std::to_string(indices.size()) + "; there are " + std::to_string(points->size() / 3) +
                        " points).",
                    where_of(node));
      }
      const double* point = points->data() + 3 * static_cast<std::size_t>(index);
      corners_m.push_back(upright_m(world_from_node * Eigen::Vector3d(point[0], point[1], point[2]), up_));
    }
    return {};
  }

  Status add_polyline(const std::vector<Eigen::Vector3d>& corners_m, const VrmlNode& node) {
    for (std::size_t i = 1; i < corners_m.size(); ++i) {
      const Status added = builder_.add_line(corners_m[i - 1], corners_m[i], where_of(node));
      if (!added) return added;
    }
    return {};
  }

  Status add_face(const std::vector<Eigen::Vector3d>& corners_m, const VrmlNode& node) {
    const auto triangles = triangles_of_polygon(corners_m);
    if (!triangles) {
      return fail(ErrorCode::kInvalidInput,
                  "A face that is not convex has more than 100 corners; it has to be written in parts.",
                  where_of(node));
    }
    for (const auto& [a, b, c] : *triangles) {
      const Status added = builder_.add_triangle({corners_m[a], corners_m[b], corners_m[c]}, where_of(node));
      if (!added) return added;
    }
    return {};
  }

  Status add_box(const VrmlNode& node, const Eigen::Affine3d& world_from_node) {
    const auto size = numbers_of(node, "size", Eigen::Vector3d::Constant(2.0));
    if (!size) return pass_on(size);
    // Bit k of a corner's number: on which side it lies along axis k.
    const auto corner_m = [&](int number) {
      const Eigen::Vector3d sides(number & 1 ? 0.5 : -0.5, number & 2 ? 0.5 : -0.5, number & 4 ? 0.5 : -0.5);
      return upright_m(world_from_node * Eigen::Vector3d(sides.cwiseProduct(Eigen::Vector3d(*size))), up_);
    };
    for (int corner = 0; corner < 8; ++corner) {
      for (const int axis : {1, 2, 4}) {
        if ((corner & axis) != 0) continue;
        const Status added = builder_.add_line(corner_m(corner), corner_m(corner | axis), where_of(node));
        if (!added) return added;
      }
    }
    constexpr std::array<std::array<int, 4>, 6> kFaces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& face : kFaces) {
      std::vector<Eigen::Vector3d> corners_m;
      for (const int corner : face) corners_m.push_back(corner_m(corner));
      if (const Status added = add_face(corners_m, node); !added) return added;
    }
    return {};
  }

  const VrmlTree& tree_;
  PlanUp up_;
  const std::string& where_;
  PlanBuilder builder_;
  std::size_t steps_ = 0;
};

}  // namespace

Result<Plan> read_vrml(std::string_view text, PlanUp up, const std::string& where) {
  if (text.size() > kMostPlanBytes) return fail(ErrorCode::kTooLarge, "The plan has more than 64 MiB.", where);
  const auto tree = parse_vrml_tree(text, where);
  if (!tree) return pass_on(tree);
  return PlanOfTree(*tree, up, where).take();
}

}  // namespace homeward::linemodel
