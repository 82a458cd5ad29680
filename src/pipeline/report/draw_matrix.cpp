// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "imageio/decode.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/similarity_picture.hpp"

namespace homeward::pipeline {
namespace {

constexpr int kMostCells = 600;     // pixels of the matrix's side; more images share them
constexpr int kFewestPixels = 500;  // small matrices are enlarged, so that no program smooths their cells
constexpr double kSide = 560.0;     // as drawn
constexpr double kAxis = 44.0;

Image enlarge(const Image& image, int times) {
  Image large(image.width_px * times, image.height_px * times, 3);
  for (int v = 0; v < large.height_px; ++v) {
    for (int u = 0; u < large.width_px; ++u) std::copy_n(image.at(u / times, v / times), 3, large.at(u, v));
  }
  return large;
}

}  // namespace

std::string draw_matrix(const BuiltMap& built) {
  const int images = static_cast<int>(built.map.images.size());
  const int per_pixel = std::max(1, (images + kMostCells - 1) / kMostCells);
  const int cells = (images + per_pixel - 1) / per_pixel;
  // Single pairs so large that they can be seen.
  const Image image = similarity_picture(similarity_of(built), built.map, {per_pixel, 0, 0, cells, cells, cells / 150});
  const int times = std::max(1, (kFewestPixels + cells - 1) / cells);
  const std::string png = data_uri("image/png", imageio::encode_png(enlarge(image, times)));

  std::string svg =
      "<svg class=\"matrix\" viewBox=\"0 0 620 600\" role=\"img\" aria-label=\"How alike all pairs of pictures "
      "are, and which of them make one place\" xmlns=\"http://www.w3.org/2000/svg\">\n"
      "<image x=\"44\" y=\"8\" width=\"560\" height=\"560\" style=\"image-rendering:pixelated\" href=\"" +
      png + "\"/>\n<rect class=\"frame\" x=\"44\" y=\"8\" width=\"560\" height=\"560\"/>\n";
  const int step = round_step(images, 8);
  for (int i = 0; i < images; i += step) {
    const double along = kSide * (i + 0.5) / images;
    const std::string name = std::to_string(i);
    svg.append("<text class=\"axis\" text-anchor=\"middle\" x=\"").append(number(kAxis + along, 1));
    svg.append("\" y=\"584\">").append(name).append("</text>");
    svg.append("<text class=\"axis\" text-anchor=\"end\" x=\"38\" y=\"").append(number(12.0 + along, 1));
    svg.append("\">").append(name).append("</text>");
  }
  return svg + "</svg>\n";
}

}  // namespace homeward::pipeline
