// SPDX-License-Identifier: Apache-2.0
// What does each source of evidence add to a map? Tours with true poses, once with all of it and then without each
// source in turn, as CSV. What was seen and compared is kept in --cache, so that only the first run takes its time.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <set>

#include "files/tour_folder.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/map_builder.hpp"
#include "mapping/parallel.hpp"
#include "truth.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;

/// A tour as the builder sees it, and the truth that it does not see.
struct SeenTour {
  std::vector<map::MapImage> images;
  std::vector<int> tour_of;
  std::vector<features::Appearance> appearances;
  std::vector<Pose> truth;
  std::vector<std::string> rooms;  // empty where they are not known
  mapping::PairTable pairs{0};
};

template <typename T>
void put(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
T get(std::istream& in) {
  T value{};
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

void keep(const fs::path& file, const SeenTour& tour) {
  std::ofstream out(file, std::ios::binary);
  for (const features::Appearance& appearance : tour.appearances) {
    const std::vector<std::uint8_t> blob = wire::encode_appearance(appearance);
    put(out, blob.size());
    out.write(reinterpret_cast<const char*>(blob.data()), static_cast<std::streamsize>(blob.size()));
  }
  for (int b = 0; b < tour.pairs.images(); ++b) {
    for (const int a : tour.pairs.partners(b)) {
      if (a > b) break;
      put(out, a);
      put(out, b);
      put(out, tour.pairs.relation(a, b));
    }
  }
}

/// False where the file is not there.
bool known_already(const fs::path& file, SeenTour& tour) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return false;
  for (features::Appearance& appearance : tour.appearances) {
    std::vector<std::uint8_t> blob(get<std::size_t>(in));
    in.read(reinterpret_cast<char*>(blob.data()), static_cast<std::streamsize>(blob.size()));
    appearance = or_die(wire::decode_appearance(blob, file.string()));
  }
  while (in.peek() != std::ifstream::traits_type::eof()) {
    const auto a = get<int>(in);
    const auto b = get<int>(in);
    tour.pairs.set(a, b, get<mapping::PairRelation>(in));
  }
  return true;
}

SeenTour see(const fs::path& folder, const fs::path& cache, int threads) {
  const files::TourFolder source = or_die(files::TourFolder::open(folder));
  const std::map<std::string, Pose> poses = read_poses(folder / "poses.csv");
  const files::CsvTable table = or_die(files::read_csv(folder / "poses.csv"));
  std::map<std::string, std::string> room_of;
  if (const auto column = table.column("room")) {
    for (const auto& row : table.rows) room_of[row[table.column("filename").value()]] = row[*column];
  }
  SeenTour tour;
  for (const TourImage& image : source.images()) {
    const std::string& id = image.id.str();
    const std::string name = id.substr(id.rfind('/') + 1);
    tour.images.push_back({image.id, image.t_us, image.odometry});
    tour.truth.push_back(poses.at(name));
    if (!room_of.empty()) tour.rooms.push_back(room_of[name]);
  }
  const std::size_t count = tour.images.size();
  tour.tour_of.assign(count, 0);
  tour.appearances.resize(count);
  tour.pairs = mapping::PairTable(static_cast<int>(count));
  const fs::path file = cache / (folder.filename().string() + ".seen");
  if (!cache.empty() && known_already(file, tour)) return tour;
  const camera::CameraConfig config = or_die(files::read_camera(folder / "camera.json"));
  const auto eye = or_die(pipeline::Eye::create(config, usual_features(config)));
  const auto look = [&](std::size_t i) { tour.appearances[i] = or_die(eye.look(or_die(source.read(i)))); };
  mapping::parallel_for(count, threads, look, [](std::size_t) {}, {});
  constexpr std::uint64_t kSeed = 1;
  tour.pairs = or_die(mapping::compare_all(tour.appearances, tour.tour_of, {}, kSeed, threads, {}, {}));
  if (!cache.empty()) keep(file, tour);
  return tour;
}

/// The images of a tour by these indices, which need not be in the tour's order: a copy may follow another. Images of
/// different copies have nothing in common.
SeenTour chosen(const SeenTour& tour, const std::vector<std::vector<int>>& copies) {
  SeenTour result;
  std::size_t count = 0;
  for (const auto& copy : copies) count += copy.size();
  result.pairs = mapping::PairTable(static_cast<int>(count));
  for (std::size_t c = 0; c < copies.size(); ++c) {
    const int first = static_cast<int>(result.images.size());
    std::vector<int> place_of(tour.images.size(), -1);
    for (const int image : copies[c]) {
      const auto from = static_cast<std::size_t>(image);
      const int to = static_cast<int>(result.images.size());
      place_of[from] = to;
      map::MapImage kept = tour.images[from];
      if (c > 0) kept.id = ImageId(kept.id.str() + "-" + std::to_string(c));
      result.images.push_back(std::move(kept));
      result.truth.push_back(tour.truth[from]);
      result.truth.back().x_m += 1000.0 * static_cast<double>(c);
      if (!tour.rooms.empty()) result.rooms.push_back(tour.rooms[from]);
      result.tour_of.push_back(0);
      result.appearances.push_back(tour.appearances[from]);
      for (const int partner : tour.pairs.partners(image)) {
        const int earlier = place_of[static_cast<std::size_t>(partner)];
        if (earlier >= first && earlier < to) result.pairs.set(earlier, to, tour.pairs.relation(partner, image));
      }
    }
  }
  return result;
}

/// With this share of the images left out, and as often as is asked for, one after the other.
SeenTour changed(const SeenTour& tour, double left_out, int copies) {
  std::mt19937 random(1);
  std::vector<std::vector<int>> kept(static_cast<std::size_t>(copies));
  for (auto& copy : kept) {
    for (int i = 0; i < static_cast<int>(tour.images.size()); ++i) {
      if (static_cast<double>(random() % 1000) >= 1000.0 * left_out) copy.push_back(i);
    }
  }
  return chosen(tour, kept);
}

/// As the developers' judge of maps counts them: a false merge is a place wider than 4 m, a revisit a pair of images
/// less than 1 m and more than 15 images apart; it is found where both lie in one place or in neighbours.
struct Judgement {
  int images = 0;
  int places = 0;
  int false_merges = 0;
  int mixed_rooms = 0;    // places of two rooms, a corridor and its doorways aside
  double spread_p95 = 0;  // metres
  double accepted_right = 1;
  int accepted = 0;
  int taken_back = 0;
  int revisits = 0;
  double loop_recall = 0;
};

std::vector<int> places_of(const SeenTour& tour, const map::TopologicalMap& map) {
  std::unordered_map<ImageId, int> place_of;
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    for (const ImageId& member : map.places[p].members) place_of[member] = static_cast<int>(p);
  }
  std::vector<int> result;
  for (const map::MapImage& image : tour.images) result.push_back(place_of.at(image.id));
  return result;
}

template <typename Visit>
void each_revisit(const SeenTour& tour, const Visit& visit) {
  constexpr std::size_t kApart = 15;
  constexpr double kSame_m = 1.0;
  for (std::size_t i = 0; i < tour.truth.size(); ++i) {
    for (std::size_t j = i + kApart + 1; j < tour.truth.size(); ++j) {
      if (distance_m(tour.truth[i], tour.truth[j]) < kSame_m) visit(i, j);
    }
  }
}

Judgement judge(const SeenTour& tour, const map::TopologicalMap& map) {
  Judgement result;
  result.images = static_cast<int>(tour.images.size());
  result.places = static_cast<int>(map.places.size());
  const std::vector<int> place_of = places_of(tour, map);
  std::vector<std::vector<std::size_t>> members(map.places.size());
  for (std::size_t i = 0; i < place_of.size(); ++i) members[static_cast<std::size_t>(place_of[i])].push_back(i);
  std::vector<double> spreads;
  for (const auto& place : members) {
    double spread = 0.0;
    std::set<std::string> rooms;
    for (const std::size_t i : place) {
      for (const std::size_t j : place) spread = std::max(spread, distance_m(tour.truth[i], tour.truth[j]));
      if (!tour.rooms.empty() && !tour.rooms[i].empty() && tour.rooms[i] != "corridor") rooms.insert(tour.rooms[i]);
    }
    spreads.push_back(spread);
    result.false_merges += spread > 4.0 ? 1 : 0;
    result.mixed_rooms += rooms.size() > 1 ? 1 : 0;
  }
  std::ranges::sort(spreads);
  result.spread_p95 = spreads[static_cast<std::size_t>(0.95 * static_cast<double>(spreads.size() - 1))];
  std::map<ImageId, std::size_t> index;
  for (std::size_t i = 0; i < tour.images.size(); ++i) index[tour.images[i].id] = i;
  std::map<PlaceId, int> place_index;
  for (std::size_t p = 0; p < map.places.size(); ++p) place_index[map.places[p].id] = static_cast<int>(p);
  std::set<std::pair<int, int>> neighbours;
  for (const map::Edge& edge : map.edges) {
    neighbours.insert({place_index.at(edge.from), place_index.at(edge.to)});
    neighbours.insert({place_index.at(edge.to), place_index.at(edge.from)});
  }
  int found = 0;
  each_revisit(tour, [&](std::size_t i, std::size_t j) {
    ++result.revisits;
    found += place_of[i] == place_of[j] || neighbours.contains({place_of[i], place_of[j]}) ? 1 : 0;
  });
  result.loop_recall = result.revisits == 0 ? 1.0 : static_cast<double>(found) / result.revisits;
  int right = 0;
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    if (hypothesis.decision != map::Decision::kAccepted) continue;
    ++result.accepted;
    right +=
        distance_m(tour.truth[index.at(hypothesis.prototype_a)], tour.truth[index.at(hypothesis.prototype_b)]) <= 3.0
            ? 1
            : 0;
  }
  if (result.accepted > 0) result.accepted_right = static_cast<double>(right) / result.accepted;
  return result;
}

/// Everything about a map that tells why it became so, as tables.
void explain(const fs::path& folder, const SeenTour& tour, const mapping::NotedMap& made) {
  fs::create_directories(folder);
  const std::vector<int> place_of = places_of(tour, made.map);
  std::map<ImageId, std::size_t> index;
  std::ofstream images(folder / "images.csv");
  images << "image,cluster,place,room,x_m,y_m,theta_rad\n";
  for (std::size_t i = 0; i < tour.images.size(); ++i) {
    index[tour.images[i].id] = i;
    images << i << ',' << made.notes.cluster_of[i] << ',' << place_of[i] << ','
           << (tour.rooms.empty() ? "" : tour.rooms[i]) << ',' << tour.truth[i].x_m << ',' << tour.truth[i].y_m << ','
           << tour.truth[i].theta_rad << '\n';
  }
  std::ofstream pairs(folder / "pairs.csv");
  pairs << "a,b,true_m,distance,inliers,turn_rad,direction_rad,parallax_rad,confidence,way,way_distance,way_sigma,"
           "way_turn_rad\n";
  const mapping::MappingConfig config;
  const bool metric = tour.images.front().odometry.has_value();
  const mapping::TourTrack track(tour.images, tour.tour_of, tour.pairs, metric,
                                 metric ? config.place_extent_m : config.place_extent_images, config.track);
  for (int b = 0; b < tour.pairs.images(); ++b) {
    for (const int a : tour.pairs.partners(b)) {
      if (a > b) break;
      const mapping::PairRelation relation = tour.pairs.relation(a, b);
      pairs << a << ',' << b << ','
            << distance_m(tour.truth[static_cast<std::size_t>(a)], tour.truth[static_cast<std::size_t>(b)]) << ','
            << relation.distance << ',' << relation.inliers << ',' << relation.turn_rad << ',' << relation.direction_rad
            << ',' << relation.parallax_rad << ',' << relation.confidence << ','
            << static_cast<int>(track.judge(a, b).verdict) << ',' << track.predict(a, b).distance << ','
            << track.predict(a, b).distance_sigma << ',' << track.predict(a, b).turn_rad << '\n';
    }
  }
  std::ofstream hypotheses(folder / "hypotheses.csv");
  hypotheses << "a,b,way,true_m,similarity,before_true,before_false,after_true,after_false,decision,by\n";
  for (std::size_t i = 0; i < made.map.hypotheses.size(); ++i) {
    const map::Hypothesis& h = made.map.hypotheses[i];
    const std::size_t a = index.at(h.prototype_a);
    const std::size_t b = index.at(h.prototype_b);
    hypotheses << a << ',' << b << ',' << static_cast<int>(made.notes.way[i]) << ','
               << distance_m(tour.truth[a], tour.truth[b]) << ',' << h.similarity << ',' << h.masses_before.is_true
               << ',' << h.masses_before.is_false << ',' << h.masses_after.is_true << ',' << h.masses_after.is_false
               << ',' << static_cast<int>(h.decision) << ',' << map::kDeciderNames.name(h.by) << '\n';
  }
}

struct Variant {
  std::string name;
  mapping::MappingConfig config;
};

std::vector<Variant> variants(bool ablation) {
  std::vector<Variant> result{{"all", {}}};
  if (!ablation) return result;
  const auto without = [&](const char* name, bool mapping::EvidenceSources::*source) {
    Variant variant{name, {}};
    variant.config.sources.*source = false;
    result.push_back(variant);
  };
  without("no neighbours", &mapping::EvidenceSources::neighbours);
  without("no way", &mapping::EvidenceSources::way);
  without("not against the place beside", &mapping::EvidenceSources::beside);
  without("not across clusters", &mapping::EvidenceSources::across);
  without("no closed way", &mapping::EvidenceSources::closed_way);
  without("nothing taken back", &mapping::EvidenceSources::take_back);
  Variant trusting{"looks trusted everywhere", {}};
  trusting.config.hypotheses.least_reliability = 0.0;
  result.push_back(trusting);
  trusting.name += " and nothing taken back";
  trusting.config.sources.take_back = false;
  result.push_back(trusting);
  Variant assumed{"accuracy of the way assumed", {}};
  assumed.config.track.least_length_sigma = assumed.config.track.picture_length_sigma;
  result.push_back(assumed);
  assumed.name += " and no closed way";
  assumed.config.sources.closed_way = false;
  result.push_back(assumed);
  return result;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App program("Maps of tours with known poses, with and without each source of evidence, as CSV");
  std::vector<std::string> folders;
  std::string cache;
  std::string notes;
  int threads = 2;
  bool ablation = false;
  bool without_odometry = false;
  program.add_option("--tour", folders, "Tours with camera.json and poses.csv")->required();
  program.add_option("--cache", cache, "Folder for what was seen and compared; to be emptied when features change");
  program.add_option("--notes", notes, "Folder for tables of images, pairs and hypotheses of the first variant");
  program.add_option("--threads", threads, "How many threads");
  program.add_flag("--ablation", ablation, "Without each source of evidence in turn, too");
  program.add_flag("--without-odometry", without_odometry, "Leave it out where a tour has it");
  double left_out = 0.0;
  int copies = 1;
  program.add_option("--leave-out", left_out, "Share of the images to leave out: steps that differ in length")
      ->check(CLI::Range(0.0, 0.9));
  program.add_option("--copies", copies, "The tour so often, one after the other, to measure time")
      ->check(CLI::Range(1, 1000));
  CLI11_PARSE(program, argc, argv);
  using namespace homeward;
  try {
    if (!cache.empty()) fs::create_directories(cache);
    std::cout << "tour,evidence,images,places,false_merges,mixed_rooms,spread_p95,accepted,accepted_right,taken_back,"
                 "revisits,loop_recall,seconds\n";
    for (const std::string& folder : folders) {
      SeenTour tour = see(folder, cache, threads);
      if (left_out > 0.0 || copies > 1) tour = changed(tour, left_out, copies);
      if (without_odometry) {
        for (map::MapImage& image : tour.images) image.odometry.reset();
      }
      const std::string name = fs::path(folder).filename().string();
      bool first = true;
      for (const Variant& variant : variants(ablation)) {
        const auto begin = std::chrono::steady_clock::now();
        const mapping::NotedMap made = mapping::make_noted_map(
            {tour.images, tour.tour_of, tour.appearances, {}, &tour.pairs}, variant.config, nullptr);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        Judgement j = judge(tour, made.map);
        j.taken_back = static_cast<int>(std::ranges::count(made.notes.taken_back, 1));
        std::cout << name << ',' << variant.name << ',' << j.images << ',' << j.places << ',' << j.false_merges << ','
                  << j.mixed_rooms << ',' << j.spread_p95 << ',' << j.accepted << ',' << j.accepted_right << ','
                  << j.taken_back << ',' << j.revisits << ',' << j.loop_recall << ',' << took.count() << '\n'
                  << std::flush;
        if (first && !notes.empty()) explain(fs::path(notes) / name, tour, made);
        first = false;
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
