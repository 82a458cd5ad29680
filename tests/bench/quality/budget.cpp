// SPDX-License-Identifier: Apache-2.0
// What an appearance may cost: home vectors and the places that pictures are taken for, by how many features are kept
// of each picture and in how many bytes. A CSV line for each answer; budget.py makes tables of them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <span>

#include "features/colour.hpp"
#include "features/descriptor_code.hpp"
#include "features/extract.hpp"
#include "geometry/planar_solver.hpp"
#include "matching/verify.hpp"
#include "truth.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;
using Numbers = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How many features are kept, and as what.
struct Variant {
  int sift = 0;
  int columns = 0;
  int sift_floats = 0;         // of a descriptor: 128, fewer (coefficients), or 0 for the bytes in use
  bool column_floats = false;  // instead of bytes
};

/// As what SIFT features and columns are kept.
std::string code_of(const Variant& variant) {
  const std::string sift = variant.sift_floats > 0 ? std::to_string(variant.sift_floats) + " floats" : "bytes";
  const std::string columns = variant.column_floats ? "floats" : "bytes";
  return (variant.sift > 0 ? sift : "none") + "/" + (variant.columns > 0 ? columns : "none");
}

/// A picture with all features that any variant keeps.
struct Whole {
  features::Appearance appearance;
  features::Unrounded unrounded;
};

/// A picture as one variant keeps it.
struct Kept {
  features::Appearance appearance;
  Numbers sift;                     // instead of bytes; empty where they are used
  matching::ScaledColumns columns;  // likewise
  std::size_t bytes = 0;
};

/// Features come round by round, the strongest of each sector first: the first `count` are those that a budget of
/// `count` keeps.
features::FeatureSet first_of(const features::FeatureSet& all, int count) {
  const int rows = std::min(count, all.size());
  return {all.bearings.topRows(rows),
          all.scales_rad.head(rows),
          all.descriptors.topRows(rows),
          all.colours.topRows(rows),
          {}};
}

Numbers sift_numbers(const Numbers& descriptors, int length) {
  if (length >= descriptors.cols()) return descriptors;
  Numbers numbers(descriptors.rows(), length);
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    features::sift_coefficients(std::span<const float, 128>(descriptors.row(i).data(), 128),
                                std::span(numbers.row(i).data(), static_cast<std::size_t>(length)));
  }
  return numbers;
}

/// As match_columns makes them of bytes: without colour the first rows are 0 and say nothing.
matching::ScaledColumns scaled(const features::UnroundedColumns& invariants, bool with_colour) {
  matching::ScaledColumns all(features::kColumnInvariants, invariants.rows());
  for (Eigen::Index k = 0; k < features::kColumnInvariants; ++k) {
    const bool counts = with_colour || k >= features::kColumnColours;
    all.row(k) =
        invariants.col(k).transpose() / features::kColumnSpread[static_cast<std::size_t>(k)] * (counts ? 1.0F : 0.0F);
  }
  return all;
}

Kept keep(const Whole& whole, const Variant& variant) {
  Kept kept;
  kept.appearance.sift = first_of(whole.appearance.sift, variant.sift);
  kept.appearance.columns = first_of(whole.appearance.columns, variant.columns);
  kept.appearance.colour_moments = whole.appearance.colour_moments;
  kept.bytes = wire::encode_appearance(kept.appearance).size();
  if (variant.sift_floats > 0) {
    const Eigen::Index rows = kept.appearance.sift.size();
    kept.sift = sift_numbers(whole.unrounded.sift.topRows(rows), variant.sift_floats);
    kept.bytes += static_cast<std::size_t>(kept.sift.size()) * sizeof(float);
    kept.bytes -= static_cast<std::size_t>(kept.appearance.sift.descriptors.size());
  }
  if (variant.column_floats) {
    const features::FeatureSet& columns = kept.appearance.columns;
    const bool colour = columns.size() > 0 && columns.colours(0, 0) != features::kNoColour;
    kept.columns = scaled(whole.unrounded.columns.topRows(columns.size()), colour);
    kept.bytes += static_cast<std::size_t>(kept.columns.size()) * (sizeof(float) - 1);
  }
  return kept;
}

/// Two nearest of each by squared distance, in parts of 2^-26: finer than single precision tells distances apart.
matching::NearestNeighbours nearest_of(const Numbers& current, const Numbers& target) {
  constexpr float kParts = 67'108'864.0F;  // 2^26
  constexpr auto kNone = matching::NearestNeighbours::kNone;
  Numbers distances = -2.0F * current * target.transpose();
  distances.colwise() += current.rowwise().squaredNorm();
  distances.rowwise() += target.rowwise().squaredNorm().transpose();
  matching::NearestNeighbours nearest(current.rows(), target.rows());
  std::vector<std::int32_t> to_target(static_cast<std::size_t>(target.rows()), kNone);
  for (Eigen::Index i = 0; i < current.rows(); ++i) {
    std::int32_t at = 0;
    std::int32_t best = kNone;
    std::int32_t second = kNone;
    const float* row = distances.row(i).data();
    for (std::size_t j = 0; j < to_target.size(); ++j) {
      const auto distance = static_cast<std::int32_t>(std::max(0.0F, row[j]) * kParts);
      if (distance < best) {
        second = best;
        best = distance;
        at = static_cast<std::int32_t>(j);
      } else if (distance < second) {
        second = distance;
      }
      if (distance < to_target[j]) {
        to_target[j] = distance;
        nearest.of_target[j] = static_cast<std::int32_t>(i);
      }
    }
    const auto row_of = static_cast<std::size_t>(i);
    nearest.of_current[row_of] = at;
    nearest.distance[row_of] = best;
    nearest.second_distance[row_of] = second;
  }
  return nearest;
}

std::vector<geometry::Correspondence> alike(const Kept& a, const Kept& b, const Variant& variant) {
  const features::FeatureSet& sift_a = a.appearance.sift;
  const features::FeatureSet& sift_b = b.appearance.sift;
  std::vector<matching::Match> matches;
  if (variant.sift_floats == 0) {
    matches = matching::match(sift_a, sift_b, {});
  } else if (sift_a.size() > 0 && sift_b.size() > 0) {
    matches = matching::match_nearest(nearest_of(a.sift, b.sift), sift_a, sift_b, {});
  }
  const auto of_columns =
      variant.column_floats
          ? matching::match_columns(a.appearance.columns, b.appearance.columns, a.columns, b.columns, {})
          : matching::match_columns(a.appearance.columns, b.appearance.columns, {});
  matches.insert(matches.end(), of_columns.begin(), of_columns.end());
  return matching::correspondences(a.appearance, b.appearance, matches);
}

/// What verification answers; nothing where it gives no answer.
std::optional<geometry::PlanarEstimate> verified(std::span<const geometry::Correspondence> matches,
                                                 std::uint64_t seed) {
  const matching::VerifyConfig config;
  auto estimate = geometry::estimate_planar_motion(matches, config.ransac, seed);
  if (!estimate || static_cast<int>(estimate->inliers.size()) < config.min_inliers ||
      estimate->evidence < config.min_evidence) {
    return std::nullopt;
  }
  return std::move(*estimate);
}

class Camera {
 public:
  Camera(const fs::path& file, const std::vector<Variant>& variants) {
    const camera::CameraConfig config = or_die(files::read_camera(file));
    features_ = usual_features(config);
    features_.max_sift = 0;
    features_.max_columns = 0;
    for (const Variant& variant : variants) {
      features_.max_sift = std::max(features_.max_sift, variant.sift);
      features_.max_columns = std::max(features_.max_columns, variant.columns);
      floats_ = floats_ || variant.sift_floats > 0 || variant.column_floats;
    }
    eye_.emplace(or_die(pipeline::Eye::create(config, features_)));
  }

  [[nodiscard]] Whole look(const fs::path& file) const {
    const auto panorama = or_die(eye_->unwrap(or_die(files::read_picture(file))));
    Whole whole;
    whole.appearance = features::extract(panorama, features_, floats_ ? &whole.unrounded : nullptr);
    return whole;
  }

 private:
  features::FeatureConfig features_;
  bool floats_ = false;
  std::optional<pipeline::Eye> eye_;
};

/// The columns that all lines begin with.
void begin_line(const char* measure, const Variant& variant, std::size_t bytes) {
  std::cout << measure << ',' << variant.sift << ',' << variant.columns << ',' << code_of(variant) << ',' << bytes;
}

/// A line for each pair of one place and each seed: distance, error of the answer, matches, and how many of these agree
/// with the true motion.
void measure_bearings(const Camera& camera, const fs::path& list, const fs::path& poses, double same_m,
                      const std::vector<Variant>& variants, int seeds) {
  std::vector<KnownPair> pairs = read_pairs(list, poses, same_m);
  std::erase_if(pairs, [](const KnownPair& pair) { return !pair.same; });
  std::map<std::string, Whole> pictures;
  for (const KnownPair& pair : pairs) {
    for (const std::string& name : {pair.current, pair.target}) {
      if (!pictures.contains(name)) pictures[name] = camera.look(list.parent_path() / name);
    }
  }
  for (const Variant& variant : variants) {
    std::map<std::string, Kept> kept;
    for (const auto& [name, whole] : pictures) kept[name] = keep(whole, variant);
    for (const KnownPair& pair : pairs) {
      const Kept& target = kept.at(pair.target);
      const auto matches = alike(kept.at(pair.current), target, variant);
      const geometry::PlanarMotion truth{pair.bearing_rad, pair.turn_rad};
      const auto right = std::ranges::count_if(matches, [&](const geometry::Correspondence& match) {
        return std::abs(geometry::epipolar_error_rad(truth, match)) < matching::VerifyConfig().ransac.max_error_rad;
      });
      for (int seed = 1; seed <= seeds; ++seed) {
        const auto estimate = verified(matches, static_cast<std::uint64_t>(seed));
        begin_line("bearing", variant, target.bytes);
        std::cout << ',' << pair.distance_m << ',';
        if (estimate) {
          std::cout << degrees(std::abs(wrap_angle(estimate->motion.direction_rad - pair.bearing_rad)));
        }
        std::cout << ',' << matches.size() << ',';
        if (!std::isnan(pair.turn_rad)) std::cout << right;
        std::cout << '\n';
      }
    }
  }
}

struct Tour {
  std::vector<Pose> poses;
  std::vector<Whole> pictures;

  Tour(const Camera& camera, const fs::path& folder, int every) {
    int at = 0;
    for (const auto& [name, pose] : read_poses(folder / "poses.csv")) {
      if (at++ % every != 0) continue;
      poses.push_back(pose);
      pictures.push_back(camera.look(folder / name));
    }
  }
};

std::vector<Kept> keep_all(const std::vector<Whole>& pictures, const Variant& variant) {
  std::vector<Kept> kept;
  kept.reserve(pictures.size());
  for (const Whole& whole : pictures) kept.push_back(keep(whole, variant));
  return kept;
}

/// A line for each query: how far the nearest picture of the gallery is, and how far the one that most verified matches
/// speak for. Verified are the `shortlist` with the most matches.
void measure_recall(const Tour& gallery, const Tour& queries, const std::vector<Variant>& variants,
                    std::size_t shortlist) {
  struct Place {
    double apart_m;
    std::vector<geometry::Correspondence> matches;
  };
  for (const Variant& variant : variants) {
    const std::vector<Kept> kept = keep_all(gallery.pictures, variant);
    const std::vector<Kept> asked = keep_all(queries.pictures, variant);
    for (std::size_t q = 0; q < asked.size(); ++q) {
      std::vector<Place> places;
      for (std::size_t p = 0; p < kept.size(); ++p) {
        places.push_back({distance_m(queries.poses[q], gallery.poses[p]), alike(asked[q], kept[p], variant)});
      }
      const double nearest_m = std::ranges::min(places, {}, &Place::apart_m).apart_m;
      if (places.size() > shortlist) {
        std::ranges::stable_sort(places, std::greater<>(), [](const Place& place) { return place.matches.size(); });
        places.resize(shortlist);
      }
      double found_m = std::numeric_limits<double>::infinity();
      std::size_t most = 0;
      for (const Place& place : places) {
        const auto estimate = verified(place.matches, 1);
        if (!estimate || estimate->inliers.size() <= most) continue;
        most = estimate->inliers.size();
        found_m = place.apart_m;
      }
      begin_line("place", variant, asked[q].bytes);
      std::cout << ',' << nearest_m << ',' << found_m << ',' << most << ",\n";
    }
  }
}

std::vector<Variant> code_variants(int sift, int columns) {
  return {{sift, 0, 128, false},  {sift, 0, 32, false},      {sift, 0, 0, false},      {0, columns, 0, true},
          {0, columns, 0, false}, {sift, columns, 32, true}, {sift, columns, 0, false}};
}

std::vector<Variant> curve_variants(const std::vector<int>& sift, const std::vector<int>& columns) {
  std::vector<Variant> variants;
  for (const int s : sift) {
    for (const int c : columns) variants.push_back({s, c});
  }
  return variants;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App program("What the bytes of an appearance are worth, as CSV: a line for each answer");
  program.require_subcommand(1);
  std::string camera;
  std::string pairs;
  std::string poses;
  std::string gallery;
  std::string queries;
  double same_m = 12.0;
  int seeds = 3;
  int every_place = 1;
  int every_query = 1;
  std::size_t shortlist = std::numeric_limits<std::size_t>::max();
  std::vector<int> sift{homeward::features::FeatureConfig().max_sift};
  std::vector<int> columns{homeward::features::FeatureConfig().max_columns};
  const auto add_inputs = [&](CLI::App* command) {
    command->add_option("--camera", camera, "camera.json")->required();
    command->add_option("--pairs", pairs,
                        "Table with columns current, target and, without poses, bearing_rad and same");
    command->add_option("--poses", poses, "Table with columns filename, x_m, y_m, theta_rad");
    command->add_option("--same-m", same_m, "Pictures further apart than this are of different places");
    command->add_option("--seeds", seeds, "Answers for each pair")->check(CLI::PositiveNumber);
    command->add_option("--gallery", gallery, "Folder of pictures with poses.csv to find places in");
    command->add_option("--queries", queries, "Such a folder with pictures to be placed");
    command->add_option("--every-place", every_place, "Of the gallery only each so many")->check(CLI::PositiveNumber);
    command->add_option("--every-query", every_query, "Of the queries only each so many")->check(CLI::PositiveNumber);
    command->add_option("--shortlist", shortlist, "Verify only so many places, those with the most matches")
        ->check(CLI::PositiveNumber);
    command->add_option("--sift", sift, "SIFT features kept")->check(CLI::PositiveNumber)->delimiter(',');
    command->add_option("--columns", columns, "Columns kept")->check(CLI::NonNegativeNumber)->delimiter(',');
  };
  add_inputs(program.add_subcommand("curve", "By how many features are kept: all pairs of --sift and --columns"));
  CLI::App* codes = program.add_subcommand("codes", "By what a feature is kept as: the first of --sift and --columns");
  add_inputs(codes);
  CLI11_PARSE(program, argc, argv);
  try {
    const auto variants = codes->parsed() ? homeward::code_variants(sift.front(), columns.front())
                                          : homeward::curve_variants(sift, columns);
    const homeward::Camera eye(camera, variants);
    std::cout << "measure,sift,columns,code,bytes,distance_m,answer,matches,right\n";
    if (!pairs.empty()) homeward::measure_bearings(eye, pairs, poses, same_m, variants, seeds);
    if (!gallery.empty() && !queries.empty()) {
      homeward::measure_recall({eye, gallery, every_place}, {eye, queries, every_query}, variants, shortlist);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
