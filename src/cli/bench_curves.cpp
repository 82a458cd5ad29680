// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/bench.hpp"

namespace homeward::cli {
namespace {

constexpr int kColumns = 5;  // of panels
constexpr double kPanelWidth_px = 220.0;
constexpr double kPanelHeight_px = 170.0;
constexpr double kMargin_px = 36.0;

template <class... Values>
std::string printed(const char* format, Values... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

double largest_finite(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  return largest;
}

/// One measure's curve with its axes; pieces between infinite values are drawn apart.
std::string panel(const std::string& measure, const std::vector<double>& along_m, const std::vector<double>& values,
                  double left_px, double top_px) {
  const double width_px = kPanelWidth_px - 1.5 * kMargin_px;
  const double height_px = kPanelHeight_px - 2.0 * kMargin_px;
  const double bottom_px = top_px + kMargin_px + height_px;
  const double x0_px = left_px + kMargin_px;
  const double most_m = std::max(along_m.back(), 1e-9);
  const double most = std::max(largest_finite(values), 1e-12);
  std::string text = printed("<text x=\"%.1f\" y=\"%.1f\" font-weight=\"bold\">%s</text>\n", x0_px,
                             top_px + kMargin_px - 10.0, measure.c_str());
  text += printed("<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>\n", x0_px, top_px + kMargin_px, bottom_px,
                  x0_px + width_px);
  text += printed("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%.1f m</text>\n", x0_px + width_px, bottom_px + 14.0,
                  along_m.back());
  text += printed("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%.3g</text>\n", x0_px - 4.0,
                  top_px + kMargin_px + 4.0, most);
  std::string path;
  bool drawing = false;
  for (std::size_t i = 0; i < along_m.size(); ++i) {
    if (!std::isfinite(values[i])) {
      drawing = false;
      continue;
    }
    path += printed("%c%.1f %.1f", drawing ? 'L' : 'M', x0_px + width_px * along_m[i] / most_m,
                    bottom_px - height_px * values[i] / most);
    drawing = true;
  }
  return text + "<path class=\"curve\" d=\"" + path + "\"/>\n";
}

}  // namespace

std::string curves_csv(const BenchTables& tables) {
  std::string text = "along_m";
  for (const std::string& measure : tables.measures) text += "," + measure;
  text += "\n";
  for (std::size_t i = 0; i < tables.curves.along_m.size(); ++i) {
    text += printed("%.2f", tables.curves.along_m[i]);
    for (const auto& values : tables.curves.dissimilarities) {
      text += std::isfinite(values[i]) ? printed(",%.9g", values[i]) : ",";
    }
    text += "\n";
  }
  return text;
}

std::string curves_svg(const BenchTables& tables) {
  const int panels = static_cast<int>(tables.measures.size());
  const int rows = (panels + kColumns - 1) / kColumns;
  std::string text =
      printed("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" ",
              kColumns * kPanelWidth_px, rows * kPanelHeight_px) +
      "font-size=\"11\">\n<title>How different the first picture is from each picture of its row</title>\n"
      "<style>.axis{fill:none;stroke:#888}.curve{fill:none;stroke:#1f6fb2;stroke-width:2}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  if (!tables.curves.along_m.empty()) {
    for (int m = 0; m < panels; ++m) {
      const auto of = static_cast<std::size_t>(m);
      text += panel(tables.measures[of], tables.curves.along_m, tables.curves.dissimilarities[of],
                    (m % kColumns) * kPanelWidth_px, (m / kColumns) * kPanelHeight_px);
    }
  }
  return text + "</svg>\n";
}

}  // namespace homeward::cli
