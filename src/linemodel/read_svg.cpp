// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_svg.hpp"

#include <expat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "linemodel/extrude_walls.hpp"
#include "linemodel/plan_builder.hpp"
#include "linemodel/svg_numbers.hpp"
#include "linemodel/vrml_lexer.hpp"

namespace homeward::linemodel {
namespace {

constexpr std::size_t kMostWalls = 200'000;
constexpr std::size_t kMostElementDepth = 1000;

constexpr std::array<std::string_view, 6> kNotDrawnHere = {"defs", "symbol", "clipPath", "marker", "mask", "pattern"};

/// The name behind a prefix: svg:line is line.
std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class SvgWalls {
 public:
  SvgWalls(const SvgPlanConfig& config, std::string where)
      : config_(config), where_(std::move(where)), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) {
          static_cast<SvgWalls*>(self)->begin(local_name(name), attributes);
        },
        [](void* self, const char*) { static_cast<SvgWalls*>(self)->end(); });
  }

  Result<std::vector<Wall>> read(std::string_view text) {
    const XML_Status parsed = XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), 1);
    if (error_) return tl::unexpected<Error>(*error_);
    if (parsed != XML_STATUS_OK) {
      const XML_Error code = XML_GetErrorCode(parser_.get());
      return fail(ErrorCode::kInvalidInput, std::string("The SVG is no XML: ") + XML_ErrorString(code) + ".",
                  where_of_line());
    }
    return std::move(walls_);
  }

 private:
  [[nodiscard]] std::string where_of_line() const {
    return where_ + ":" + std::to_string(XML_GetCurrentLineNumber(parser_.get()));
  }

  void refuse(ErrorCode code, std::string message) {
    if (error_) return;
    error_ = Error{code, std::move(message), where_of_line()};
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  void begin(std::string_view name, const char** attributes) {
    if (error_) return;
    if (stack_.size() >= kMostElementDepth)
      return refuse(ErrorCode::kInvalidInput, "Elements lie more than 1000 deep in one another.");
    if (stack_.empty() && name != "svg") return refuse(ErrorCode::kUnsupportedFormat, "The file is XML, but no SVG.");
    const bool is_root = stack_.empty();
    Element element = is_root ? Element{} : stack_.back();
    element.drawn =
        element.drawn && std::ranges::find(kNotDrawnHere, name) == kNotDrawnHere.end() && !is_hidden(attributes);
    if (is_root) set_frame(element, attributes);
    if (const char* transform = attribute(attributes, "transform"); transform != nullptr && element.drawn) {
      const auto moved = svg_transform(transform);
      if (!moved) return refuse(ErrorCode::kInvalidInput, "The transform " + quoted(transform) + " cannot be read.");
      element.plan_from_units = element.plan_from_units * *moved;
    }
    stack_.push_back(element);
    if (element.drawn && !error_) add_shape(name, attributes);
  }

  void end() {
    if (!stack_.empty()) stack_.pop_back();
  }

  struct Element {
    Eigen::Affine2d plan_from_units = Eigen::Affine2d::Identity();  // metres
    bool drawn = true;
  };

  static const char* attribute(const char** attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2) {
      if (local_name(*attributes) == name) return attributes[1];
    }
    return nullptr;
  }

  static bool is_hidden(const char** attributes) {
    const char* display = attribute(attributes, "display");
    const char* style = attribute(attributes, "style");
    return (display != nullptr && std::strcmp(display, "none") == 0) ||
           (style != nullptr && std::strstr(style, "display:none") != nullptr);
  }

  /// Scale and origin, of the outermost element.
  void set_frame(Element& element, const char** attributes) {
    std::vector<double> box;
    if (const char* text = attribute(attributes, "viewBox")) {
      const auto numbers = svg_number_list(text);
      if (!numbers || numbers->size() != 4 || !((*numbers)[2] > 0.0) || !((*numbers)[3] > 0.0))
        return refuse(ErrorCode::kInvalidInput, "The viewBox " + quoted(text) + " cannot be read.");
      box = *numbers;
    }
    double scale_m = config_.metres_per_unit.value_or(0.0);
    if (!config_.metres_per_unit) {
      const char* width = attribute(attributes, "width");
      const auto width_m = width != nullptr ? svg_length_m(width) : std::nullopt;
      if (!width_m || box.empty()) {
        return refuse(ErrorCode::kInvalidInput,
                      "The drawing does not say how large it is (a width in mm, cm or m, and a viewBox); its scale in "
                      "metres a unit has to be given.");
      }
      scale_m = *width_m / box[2];
    }
    if (!(scale_m > 0.0 && scale_m < 1e6))
      return refuse(ErrorCode::kInvalidInput, "The scale in metres a unit has to be above zero.");
    const Eigen::Vector2d origin = box.empty() ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(box[0], box[1] + box[3]);
    element.plan_from_units = Eigen::Scaling(scale_m, -scale_m) * Eigen::Translation2d(-origin);
  }

  void add_shape(std::string_view name, const char** attributes) {
    if (name == "use") {
      return refuse(ErrorCode::kUnsupportedFormat,
                    "The element \"use\" is not read; clones have to be turned into shapes of their own.");
    }
    if (name == "line") return add_line(attributes);
    if (name == "rect") return add_rect(attributes);
    if (name == "polyline" || name == "polygon") return add_points(name == "polygon", attributes);
    const char* path = name == "path" ? attribute(attributes, "d") : nullptr;
    if (path == nullptr) return;
    const auto parts = svg_straight_parts(path);
    if (!parts) return refuse(ErrorCode::kInvalidInput, "The path " + quoted(path) + " cannot be read.");
    for (const auto& [from, to] : *parts) add_wall(from, to);
  }

  double number(const char** attributes, const char* name) {
    const char* text = attribute(attributes, name);
    if (text == nullptr) return 0.0;
    SvgNumbers rest(text);
    const auto value = rest.number();
    if (value && (rest.at_end() || std::string_view(text).ends_with("px"))) return *value;
    refuse(ErrorCode::kInvalidInput,
           "The attribute " + quoted(name) + " has to be a number of the drawing's own units.");
    return 0.0;
  }

  void add_line(const char** attributes) {
    add_wall({number(attributes, "x1"), number(attributes, "y1")},
             {number(attributes, "x2"), number(attributes, "y2")});
  }

  void add_rect(const char** attributes) {
    const char* width = attribute(attributes, "width");
    if (width != nullptr && std::string_view(width).ends_with('%')) return;  // a background
    const Eigen::Vector2d at(number(attributes, "x"), number(attributes, "y"));
    const Eigen::Vector2d across(number(attributes, "width"), 0.0);
    const Eigen::Vector2d down(0.0, number(attributes, "height"));
    add_wall(at, at + across);
    add_wall(at + across, at + across + down);
    add_wall(at + across + down, at + down);
    add_wall(at + down, at);
  }

  void add_points(bool closed, const char** attributes) {
    const char* text = attribute(attributes, "points");
    const auto numbers = svg_number_list(text == nullptr ? "" : text);
    if (!numbers || numbers->size() % 2 != 0)
      return refuse(ErrorCode::kInvalidInput, "The points " + quoted(text) + " are no pairs of numbers.");
    const std::size_t count = numbers->size() / 2;
    const auto point = [&](std::size_t i) { return Eigen::Vector2d((*numbers)[2 * i], (*numbers)[2 * i + 1]); };
    for (std::size_t i = 1; i < count; ++i) add_wall(point(i - 1), point(i));
    if (closed && count > 2) add_wall(point(count - 1), point(0));
  }

  void add_wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    if (error_) return;
    if (walls_.size() >= kMostWalls)
      return refuse(ErrorCode::kTooLarge, "The floor plan has more than 200,000 straight lines.");
    const Eigen::Affine2d& plan_from_units = stack_.back().plan_from_units;
    walls_.push_back({plan_from_units * from, plan_from_units * to});
  }

  const SvgPlanConfig& config_;
  std::string where_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser_;
  std::vector<Element> stack_;
  std::vector<Wall> walls_;
  std::optional<Error> error_;
};

}  // namespace

Result<Plan> read_svg(std::string_view text, const SvgPlanConfig& config, const std::string& where) {
  if (text.size() > kMostPlanBytes) return fail(ErrorCode::kTooLarge, "The plan has more than 64 MiB.", where);
  const auto walls = SvgWalls(config, where).read(text);
  if (!walls) return pass_on(walls);
  return extrude_walls(*walls, config.wall_height_m, where);
}

}  // namespace homeward::linemodel
