// SPDX-License-Identifier: Apache-2.0
// Does the retrieval index bring up the place that comparing with every picture of a tour would find?
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>

#include "matching/retrieval_index.hpp"
#include "matching/visual_distance.hpp"
#include "truth.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kSamePlaceM = 1.0;

struct Seen {
  std::string file;
  Pose pose{};
  features::Appearance appearance;
};

double distance_m(const Seen& a, const Seen& b) { return distance_m(a.pose, b.pose); }

std::vector<Seen> read_tour(const fs::path& folder) {
  const camera::CameraConfig config = or_die(files::read_camera(folder / "camera.json"));
  const auto eye = or_die(pipeline::Eye::create(config, usual_features(config)));
  std::vector<Seen> tour;
  for (const auto& [file, pose] : read_poses(folder / "poses.csv")) {
    tour.push_back({file, pose, or_die(eye.look(or_die(files::read_picture(folder / file))))});
  }
  return tour;
}

/// For each query the gallery picture with the most verified matches, of all. Kept in a file, as it takes long.
std::vector<int> best_of_all(const std::vector<Seen>& queries, const std::vector<Seen>& gallery, const fs::path& kept) {
  std::vector<int> best;
  std::ifstream known(kept);
  for (int at = 0; known >> at;) best.push_back(at);
  if (best.size() == queries.size()) return best;
  best.clear();
  std::ofstream out(kept);
  for (const Seen& query : queries) {
    int most = -1;
    int at = 0;
    for (std::size_t i = 0; i < gallery.size(); ++i) {
      const int verified = matching::compare(query.appearance, gallery[i].appearance, {}, 1).verified;
      if (verified > most) {
        most = verified;
        at = static_cast<int>(i);
      }
    }
    best.push_back(at);
    out << at << "\n" << std::flush;
  }
  return best;
}

struct Hits {
  int true_place[2] = {0, 0};  // within the first 1, 10: a picture of the query's place
  int best[2] = {0, 0};        // ... the best of all pictures, or one of its place
};

void report(const std::vector<Seen>& gallery, const std::vector<Seen>& queries, const std::vector<int>& best,
            const std::string& name, int words, int code_length, std::uint64_t seed) {
  std::vector<const features::FeatureSet*> sets;
  sets.reserve(gallery.size());
  for (const Seen& seen : gallery) sets.push_back(&seen.appearance.sift);
  const auto start = Clock::now();
  auto index =
      or_die(matching::RetrievalIndex::create(or_die(features::train_vocabulary(sets, words, seed)), {code_length}));
  const auto trained = Clock::now();
  for (std::size_t i = 0; i < gallery.size(); ++i) {
    const Status added = index.add(std::to_string(i), gallery[i].appearance.sift);
    if (!added) throw std::runtime_error(added.error().message);
  }
  const auto built = Clock::now();
  Hits hits;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto found = index.query(queries[q].appearance.sift, 10);
    const Seen& best_seen = gallery[static_cast<std::size_t>(best[q])];
    for (int n = 0; n < 2; ++n) {
      bool true_place = false;
      bool best_found = false;
      for (std::size_t c = 0; c < std::min<std::size_t>(found.size(), n == 0 ? 1 : 10); ++c) {
        const Seen& seen = gallery[std::stoul(found[c].id)];
        true_place = true_place || distance_m(seen, queries[q]) <= kSamePlaceM;
        best_found = best_found || distance_m(seen, best_seen) <= kSamePlaceM;
      }
      hits.true_place[n] += true_place ? 1 : 0;
      hits.best[n] += best_found ? 1 : 0;
    }
  }
  const auto asked = Clock::now();
  const auto ms = [](auto from, auto to) { return std::chrono::duration<double, std::milli>(to - from).count(); };
  const auto share = [&](int count) { return static_cast<double>(count) / static_cast<double>(queries.size()); };
  std::cout << name << "," << words << "," << code_length << "," << seed << "," << share(hits.true_place[0]) << ","
            << share(hits.true_place[1]) << "," << share(hits.best[0]) << "," << share(hits.best[1]) << ","
            << index.bytes_per_place() << "," << ms(start, trained) << ","
            << ms(trained, built) / static_cast<double>(gallery.size()) << ","
            << ms(built, asked) / static_cast<double>(queries.size()) << "\n"
            << std::flush;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App program("Recall of the retrieval index beside comparing with every picture, as CSV");
  std::string gallery_folder;
  std::vector<std::string> query_folders;
  std::vector<int> word_counts{8, 16, 24, 32};
  std::vector<int> code_lengths{256, 512, 1024};
  std::vector<std::uint64_t> seeds{1, 2, 3, 4, 5};
  std::string kept = ".";
  program.add_option("--gallery", gallery_folder, "Tour with camera.json and poses.csv")->required();
  program.add_option("--queries", query_folders, "Such tours")->required();
  program.add_option("--words", word_counts, "Sizes of the vocabulary");
  program.add_option("--lengths", code_lengths, "Lengths of a place's code");
  program.add_option("--seeds", seeds, "Seeds of the vocabulary, a line for each");
  program.add_option("--keep", kept, "Folder for the answers of comparing with every picture");
  CLI11_PARSE(program, argc, argv);
  try {
    const auto gallery = homeward::read_tour(gallery_folder);
    std::cout << "queries,words,code_length,seed,place_at_1,place_at_10,best_at_1,best_at_10,bytes_per_place,"
                 "train_ms,add_ms,query_ms\n";
    for (const std::string& folder : query_folders) {
      const auto queries = homeward::read_tour(folder);
      const std::string name = std::filesystem::path(folder).filename();
      const auto best =
          homeward::best_of_all(queries, gallery, std::filesystem::path(kept) / ("best_" + name + ".txt"));
      std::size_t right = 0;
      for (std::size_t q = 0; q < queries.size(); ++q) {
        const auto& found = gallery[static_cast<std::size_t>(best[q])];
        right += homeward::distance_m(queries[q].pose, found.pose) <= homeward::kSamePlaceM ? 1 : 0;
      }
      std::cout << "# " << name << ": the best of all is of the query's place for " << right << " of " << queries.size()
                << "\n";
      for (const int words : word_counts) {
        for (const int length : code_lengths) {
          for (const auto seed : seeds) homeward::report(gallery, queries, best, name, words, length, seed);
        }
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
