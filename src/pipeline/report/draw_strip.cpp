// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/index.hpp"
#include "core/markup.hpp"
#include "map/lookup.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"

namespace homeward::pipeline {
namespace {

constexpr double kLeft = 70.0;  // room for the names of the rows
constexpr double kRight = 990.0;
constexpr double kArcs = 150.0;  // height of the arcs
constexpr double kRow = 20.0;
constexpr double kBetween = 6.0;

/// Colours far apart: the hue goes on by the golden angle.
std::string colour_of(int number_of_it) {
  constexpr double kGoldenAngle_deg = 137.508;
  const double hue_deg = std::fmod(kGoldenAngle_deg * number_of_it, 360.0);
  return "hsl(" + number(hue_deg, 0) + ",55%,55%)";
}

/// The horizontal axis: images in tour order.
class Axis {
 public:
  explicit Axis(std::size_t images) : step_((kRight - kLeft) / static_cast<double>(std::max<std::size_t>(images, 1))) {}
  [[nodiscard]] double begin(int image) const { return kLeft + step_ * image; }
  [[nodiscard]] double middle(int image) const { return begin(image) + step_ / 2.0; }
  [[nodiscard]] double length(int images) const { return step_ * images; }

 private:
  double step_;
};

std::string block(const Axis& axis, int first, int last, double top, double height, const std::string& fill) {
  return "<rect x=\"" + number(axis.begin(first), 2) + "\" y=\"" + number(top, 1) + "\" width=\"" +
         number(axis.length(last - first + 1), 2) + "\" height=\"" + number(height, 1) + "\" fill=\"" + fill + "\"/>";
}

std::string words(double x, double y, const char* anchor, const std::string& escaped) {
  return "<text class=\"axis\" text-anchor=\"" + std::string(anchor) + "\" x=\"" + number(x, 1) + "\" y=\"" +
         number(y, 1) + "\">" + escaped + "</text>";
}

/// A row of values along the tour: equal neighbours are one block; a value that occurs in one block only is grey.
std::string row(const Axis& axis, const std::vector<int>& values, double top) {
  struct Block {
    int value, first, last;
  };
  std::vector<Block> blocks;
  std::vector<int> blocks_of;
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    const int value = values[at(i)];
    if (!blocks.empty() && blocks.back().value == value) {
      blocks.back().last = i;
      continue;
    }
    blocks.push_back({value, i, i});
    if (value < 0) continue;
    if (at(value) >= blocks_of.size()) blocks_of.resize(at(value) + 1, 0);
    ++blocks_of[at(value)];
  }
  std::string svg;
  bool darker = false;  // so that one grey block is told from the next
  for (const Block& one : blocks) {
    darker = !darker;
    const bool again = one.value >= 0 && blocks_of[at(one.value)] > 1;
    const std::string fill =
        one.value < 0 ? "#ffffff" : (again ? colour_of(one.value) : (darker ? "#d5d9de" : "#e6e9ec"));
    svg += block(axis, one.first, one.last, top, kRow, fill);
  }
  return svg + "\n";
}

std::string arcs(const map::TopologicalMap& map, const Axis& axis) {
  const auto images = map::image_indices(map);
  const double widest = axis.length(static_cast<int>(map.images.size())) / 2.0;
  std::string svg;
  for (const map::Decision wanted : {map::Decision::kRejected, map::Decision::kUndecided, map::Decision::kAccepted}) {
    const char* kind = wanted == map::Decision::kAccepted    ? "arc accepted"
                       : wanted == map::Decision::kUndecided ? "arc undecided"
                                                             : "arc rejected";
    std::string path;
    for (const map::Hypothesis& hypothesis : map.hypotheses) {
      const auto a = images.find(hypothesis.prototype_a);
      const auto b = images.find(hypothesis.prototype_b);
      if (hypothesis.decision != wanted || a == images.end() || b == images.end()) continue;
      const double left = axis.middle(std::min(a->second, b->second));
      const double right = axis.middle(std::max(a->second, b->second));
      const double half = std::max((right - left) / 2.0, 0.5);
      path += "M" + number(left, 1) + " " + number(kArcs, 0) + "A" + number(half, 1) + " " +
              number((kArcs - 4.0) * std::sqrt(std::min(1.0, half / widest)), 1) + " 0 0 1 " + number(right, 1) + " " +
              number(kArcs, 0);
    }
    if (!path.empty()) svg += "<path class=\"" + std::string(kind) + "\" d=\"" + path + "\"/>\n";
  }
  return svg;
}

/// Numbers of pictures at round steps.
std::string scale(const Axis& axis, std::size_t images, double top) {
  const int step = round_step(static_cast<int>(images), 12);
  std::string svg;
  for (int i = 0; i < static_cast<int>(images); i += step) {
    svg += "<line class=\"tick\" x1=\"" + number(axis.middle(i), 1) + "\" y1=\"" + number(top, 1) + "\" x2=\"" +
           number(axis.middle(i), 1) + "\" y2=\"" + number(top + 5.0, 1) + "\"/>";
    svg += words(axis.middle(i), top + 18.0, "middle", std::to_string(i));
  }
  return svg + "\n";
}

/// Names of destinations below their pictures, each in the first line where it has room.
std::string names(const map::TopologicalMap& map, const Axis& axis, double top, double& height) {
  constexpr double kLetter = 7.0;  // width of a letter, about
  constexpr double kLine = 15.0;
  const auto images = map::image_indices(map);
  std::vector<std::pair<int, std::string>> marks;
  for (const map::Destination& destination : map.destinations) {
    const auto image = images.find(destination.image);
    if (image != images.end()) marks.emplace_back(image->second, destination.label);
  }
  std::ranges::sort(marks);
  std::vector<double> ends;  // of the text in each line
  std::string svg;
  for (const auto& [image, label] : marks) {
    const double width = kLetter * static_cast<double>(label.size());
    const double left = std::max(kLeft, std::min(axis.middle(image) - 3.0, kRight - width));
    auto line = std::ranges::find_if(ends, [&](double end) { return end < left; });
    if (line == ends.end()) line = ends.insert(ends.end(), 0.0);
    *line = left + width + kLetter;
    const double y = top + kLine * static_cast<double>(line - ends.begin() + 1);
    svg += "<line class=\"lead\" x1=\"" + number(axis.middle(image), 1) + "\" y1=\"" + number(top - 4.0, 1) +
           "\" x2=\"" + number(axis.middle(image), 1) + "\" y2=\"" + number(y - 10.0, 1) + "\"/>";
    svg += words(left, y, "start", escape_html(label));
  }
  height = kLine * static_cast<double>(ends.size());
  return svg + "\n";
}

}  // namespace

int round_step(int range, int most_steps) {
  for (int power = 1;; power *= 10) {
    for (const int step : {power, 2 * power, 5 * power}) {
      if (static_cast<std::int64_t>(step) * most_steps >= range) return step;
    }
  }
}

std::string draw_strip(const BuiltMap& built, const ReportFacts& facts) {
  const map::TopologicalMap& map = built.map;
  const Axis axis(map.images.size());
  double top = kArcs;
  std::string svg = arcs(map, axis);
  const auto add_row = [&](const char* name, const std::vector<int>& values) {
    top += kBetween;
    svg += words(kLeft - 8.0, top + kRow - 6.0, "end", name) + row(axis, values, top);
    top += kRow;
  };
  if (built.notes.mapping.cluster_of.size() == map.images.size()) add_row("clusters", built.notes.mapping.cluster_of);
  add_row("places", facts.place_of);
  top += kBetween;
  svg += words(kLeft - 8.0, top + 10.0, "end", "weak");
  svg += "<line class=\"tick\" x1=\"70\" y1=\"" + number(top + 6.0, 1) + "\" x2=\"990\" y2=\"" + number(top + 6.0, 1) +
         "\"/>";
  for (const WeakStretch& stretch : facts.weak) {
    svg += block(axis, stretch.first, stretch.last, top, 12.0, "#b3261e");
  }
  top += 12.0 + kBetween;
  for (std::size_t i = 1; i < built.notes.tour_of.size(); ++i) {  // where one tour ends and the next begins
    if (built.notes.tour_of[i] == built.notes.tour_of[i - 1]) continue;
    const double x = axis.begin(static_cast<int>(i));
    svg += "<line class=\"seam\" x1=\"" + number(x, 1) + "\" y1=\"" + number(kArcs, 0) + "\" x2=\"" + number(x, 1) +
           "\" y2=\"" + number(top, 1) + "\"/>";
  }
  svg += scale(axis, map.images.size(), top);
  top += 26.0;
  double height = 0.0;
  svg += names(map, axis, top, height);
  return "<svg class=\"wide\" viewBox=\"0 0 1000 " + number(top + height + 8.0, 0) +
         "\" role=\"img\" aria-label=\"The tour from its first picture to its last: which pictures belong to one "
         "cluster and "
         "one place, which loops were closed, and where edges are weak\" xmlns=\"http://www.w3.org/2000/svg\">\n" +
         svg + "</svg>\n";
}

std::string draw_masses(const map::Masses& masses, const std::string& words) {
  const std::string label = words + ": for " + number(masses.is_true, 2) + ", unknown " + number(masses.unknown, 2) +
                            ", against " + number(masses.is_false, 2);
  const double yes = 200.0 * std::clamp(masses.is_true, 0.0, 1.0);
  const double no = 200.0 * std::clamp(masses.is_false, 0.0, 1.0);
  return "<svg class=\"masses\" viewBox=\"0 0 200 12\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" +
         label +
         "\" xmlns=\"http://www.w3.org/2000/svg\"><rect class=\"unknown\" width=\"200\" height=\"12\"/>"
         "<rect class=\"for\" width=\"" +
         number(yes, 1) + "\" height=\"12\"/><rect class=\"against\" x=\"" + number(200.0 - no, 1) + "\" width=\"" +
         number(no, 1) + "\" height=\"12\"/></svg>";
}

std::string draw_visits(const ReportFacts& facts) {
  constexpr int kMost = 6;  // the last bar: so often or more
  constexpr double kBar = 24.0;
  std::vector<int> places(kMost, 0);
  for (const int visits : facts.visits_of) {
    if (visits > 0) ++places[at(std::min(visits, kMost) - 1)];
  }
  while (places.size() > 1 && places.back() == 0) places.pop_back();
  const int most = std::max(1, *std::ranges::max_element(places));
  std::string label;
  std::string svg;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    const std::string often = i == 0 ? "once" : std::to_string(i + 1) + (i + 1 == kMost ? " times or more" : " times");
    const double top = kBar * i;
    label += (i == 0 ? "" : ", ") + std::to_string(places[at(i)]) + " " + often;
    svg += words(118.0, top + 16.0, "end", often) + "<rect class=\"bar\" x=\"126\" y=\"" + number(top + 4.0, 0) +
           "\" width=\"" + number(320.0 * places[at(i)] / most, 1) + "\" height=\"16\"/>" +
           words(132.0 + 320.0 * places[at(i)] / most, top + 16.0, "start", std::to_string(places[at(i)]));
  }
  return "<svg class=\"bars\" viewBox=\"0 0 500 " + number(kBar * static_cast<double>(places.size()), 0) +
         "\" role=\"img\" aria-label=\"Places by number of visits: " + label +
         "\" xmlns=\"http://www.w3.org/2000/svg\">" + svg + "</svg>\n";
}

}  // namespace homeward::pipeline
