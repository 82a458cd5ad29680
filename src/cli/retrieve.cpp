// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "features/aggregate.hpp"
#include "files/csv.hpp"
#include "files/read_file.hpp"
#include "matching/rerank.hpp"
#include "matching/retrieval_index.hpp"
#include "pipeline/eye.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

struct RetrieveOptions {
  std::string gallery;
  std::string queries;
  std::string camera;
  int best = 10;
  int rerank = 50;
  std::uint64_t seed = 1;
};

/// The column `filename` of a table.
Result<std::vector<std::string>> names_in(const std::string& file) {
  const auto table = files::read_csv(file);
  if (!table) return pass_on(table);
  const auto column = table->column("filename");
  if (!column) return fail(ErrorCode::kInvalidInput, "The first line must name the column filename.", file);
  if (table->rows.empty()) return fail(ErrorCode::kEmptyInput, "The table names no pictures.", file);
  std::vector<std::string> names;
  for (const std::vector<std::string>& row : table->rows) names.push_back(row[*column]);
  return names;
}

Result<features::FeatureSet> look(const pipeline::Eye& eye, const fs::path& file) {
  const auto picture = files::read_picture(file);
  if (!picture) return pass_on(picture);
  auto appearance = eye.look(*picture);
  if (!appearance) return fail(appearance.error().code, appearance.error().message, file.string());
  return std::move(appearance->sift);
}

/// A lens sees less than a mirror does around it: more and weaker features make up for it, each with its wider
/// surroundings, for a door frame alone is found everywhere in a corridor.
features::FeatureConfig retrieval_config(const camera::Camera& camera) {
  features::FeatureConfig config = pipeline::suited_feature_config(camera);
  config.max_columns = 0;  // not compared
  const auto& model = camera.config().model;
  if (std::holds_alternative<camera::Pinhole>(model) || std::holds_alternative<camera::Fisheye>(model)) {
    config.max_sift = 1200;
    config.sift_contrast_threshold = 0.004;
    config.sift_windows = 3;
  }
  return config;
}

struct Gallery {
  std::vector<std::string> names;
  std::vector<features::FeatureSet> features;
};

Result<Gallery> look_at_all(const pipeline::Eye& eye, const std::string& table) {
  auto names = names_in(table);
  if (!names) return pass_on(names);
  Gallery gallery;
  ProgressBar progress;
  for (const std::string& name : *names) {
    auto seen = look(eye, fs::path(table).parent_path() / name);
    if (!seen) return pass_on(seen);
    gallery.features.push_back(std::move(*seen));
    progress.show("gallery", static_cast<double>(gallery.features.size()) / static_cast<double>(names->size()));
  }
  gallery.names = std::move(*names);
  return gallery;
}

/// A picture of the gallery with how well it answers.
struct Found {
  std::size_t picture = 0;
  double score = 0.0;
};

/// The index of a gallery by numbers as ids; nothing where it is too small or too plain to learn visual words from.
/// Pictures without features are left out: they are like none.
Result<std::optional<matching::RetrievalIndex>> index_of(const Gallery& gallery, const RetrieveOptions& options) {
  std::vector<const features::FeatureSet*> pictures;
  for (const features::FeatureSet& set : gallery.features) pictures.push_back(&set);
  auto vocabulary = features::train_vocabulary(pictures, matching::kRetrievalWords, options.seed);
  if (!vocabulary) {
    if (vocabulary.error().code == ErrorCode::kTooFewFeatures) return std::optional<matching::RetrievalIndex>();
    return fail(vocabulary.error().code, vocabulary.error().message, options.gallery);
  }
  auto index = matching::RetrievalIndex::create(std::move(*vocabulary));
  if (!index) return pass_on(index);
  for (std::size_t i = 0; i < gallery.features.size(); ++i) {
    if (gallery.features[i].size() == 0) continue;
    if (Status added = index->add(std::to_string(i), gallery.features[i]); !added) return pass_on(added);
  }
  return std::optional(std::move(*index));
}

std::vector<Found> best_of(const Gallery& gallery, const std::optional<matching::RetrievalIndex>& index,
                           const features::FeatureSet& query, const RetrieveOptions& options) {
  std::vector<Found> found;
  if (index) {
    const auto wanted = static_cast<std::size_t>(std::max(options.best, options.rerank));
    for (const matching::Candidate& one : index->query(query, wanted)) found.push_back({std::stoul(one.id), one.score});
  } else {
    for (std::size_t i = 0; i < gallery.names.size(); ++i) found.push_back({i, 0.0});
  }
  const auto judged = index ? std::min(found.size(), static_cast<std::size_t>(options.rerank)) : found.size();
  if (judged > 1) {
    std::vector<const features::FeatureSet*> candidates;
    for (std::size_t i = 0; i < judged; ++i) candidates.push_back(&gallery.features[found[i].picture]);
    const auto scores = matching::rerank(query, candidates, {});
    // What was judged by features stands before what was not: features of a picture gain 0 or more.
    for (std::size_t i = 0; i < judged; ++i) found[i].score = scores[i];
    for (std::size_t i = judged; i < found.size(); ++i) found[i].score -= 1.0;
    std::stable_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(judged),
                     [](const Found& a, const Found& b) { return a.score > b.score; });
  }
  found.resize(std::min(found.size(), static_cast<std::size_t>(options.best)));
  return found;
}

Status retrieve(const RetrieveOptions& options) {
  const auto config = files::read_camera(options.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  const features::FeatureConfig suited = retrieval_config(**camera);
  const auto eye = pipeline::Eye::create(*config, suited);
  if (!eye) return pass_on(eye);
  const auto queries = names_in(options.queries);
  if (!queries) return pass_on(queries);
  const auto gallery = look_at_all(*eye, options.gallery);
  if (!gallery) return pass_on(gallery);
  const auto index = index_of(*gallery, options);
  if (!index) return pass_on(index);
  for (const std::string& name : *queries) {
    const auto query = look(*eye, fs::path(options.queries).parent_path() / name);
    if (!query) return pass_on(query);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<Found> found = best_of(*gallery, *index, *query, options);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    nlohmann::json line = {{"query", name}, {"top", nlohmann::json::array()}, {"ms", ms}};
    for (const Found& one : found) {
      line["top"].push_back({{"image", gallery->names[one.picture]}, {"score", one.score}});
    }
    std::cout << line.dump() << "\n";
  }
  return {};
}

}  // namespace

void register_retrieve(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "retrieve", "Which pictures of a gallery show the place of each query: a JSON line per query");
  const auto options = std::make_shared<RetrieveOptions>();
  command->add_option("--gallery", options->gallery, "Table (CSV) with a column filename; paths relative to it")
      ->required();
  command->add_option("--queries", options->queries, "Table (CSV) with a column filename; paths relative to it")
      ->required();
  command->add_option("--camera", options->camera, "camera.json")->required();
  command->add_option("--k", options->best, "How many answers for each query")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--rerank", options->rerank, "How many of the index's best are judged by their features; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000));
  command->add_option("--seed", options->seed, "Seed of everything random");
  run_on(*command, [options] { return retrieve(*options); });
}

}  // namespace homeward::cli
