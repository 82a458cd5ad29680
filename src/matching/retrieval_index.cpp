// SPDX-License-Identifier: Apache-2.0
#include "matching/retrieval_index.hpp"

// Distances are our own; and the prefetching that comes with theirs reads past the end of lists of links.
#define NO_MANUAL_VECTORIZATION
#include <hnswlib/hnswlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "core/bytes.hpp"
#include "matching/dot.hpp"
#include "matching/place_code.hpp"

namespace homeward::matching {
namespace {

constexpr char kMagic[4] = {'H', 'W', 'R', 'I'};
constexpr std::uint16_t kVersion = 1;
constexpr std::uint32_t kMaxWords = 4096;
constexpr std::uint32_t kMaxDescriptorLength = 1024;
constexpr std::uint32_t kMaxCodeLength = 65'536;
constexpr std::size_t kMaxIdLength = 1000;

constexpr std::size_t kGraphNeighbours = 16;
constexpr std::size_t kGraphWidthAdding = 100;  // candidates kept while adding
constexpr std::size_t kGraphWidthAsking = 128;  // ... while asking
constexpr std::size_t kGraphSeed = 1;
constexpr std::size_t kRecordsPerBlock = 1024;

/// One place's code and, before it, the inverse of its length: how far away is another one?
struct Record {
  const std::uint8_t* bytes;

  [[nodiscard]] float inverse_norm() const {
    float value = 0.0F;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
  }
  [[nodiscard]] const std::int8_t* code() const { return reinterpret_cast<const std::int8_t*>(bytes + sizeof(float)); }
};

float cosine(Record a, Record b, std::size_t length) {
  return static_cast<float>(dot(a.code(), b.code(), length)) * a.inverse_norm() * b.inverse_norm();
}

std::vector<std::uint8_t> make_record(const std::int8_t* code, std::size_t length) {
  std::vector<std::uint8_t> record(sizeof(float) + length);
  const std::int32_t squares = dot(code, code, length);
  const float inverse_norm = squares > 0 ? 1.0F / std::sqrt(static_cast<float>(squares)) : 0.0F;
  std::memcpy(record.data(), &inverse_norm, sizeof(inverse_norm));
  std::memcpy(record.data() + sizeof(float), code, length);
  return record;
}

/// Tells the graph how far records are apart. The graph holds pointers to records, not the records.
class RecordSpace : public hnswlib::SpaceInterface<float> {
 public:
  explicit RecordSpace(std::size_t code_length) : code_length_(code_length) {}
  std::size_t get_data_size() override { return sizeof(Record); }
  hnswlib::DISTFUNC<float> get_dist_func() override {
    return [](const void* a, const void* b, const void* length) {
      return 1.0F - cosine(read(a), read(b), *static_cast<const std::size_t*>(length));
    };
  }
  void* get_dist_func_param() override { return &code_length_; }

 private:
  /// The graph keeps what it holds where it likes: not aligned.
  static Record read(const void* held) {
    Record record{};
    std::memcpy(&record, held, sizeof(record));
    return record;
  }

  std::size_t code_length_;
};

using Graph = hnswlib::HierarchicalNSW<float>;

void sort_and_cut(std::vector<Candidate>& candidates, std::size_t k) {
  const auto better = [](const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : a.id < b.id;
  };
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(std::min(k, candidates.size()));
  std::partial_sort(candidates.begin(), end, candidates.end(), better);
  candidates.erase(end, candidates.end());
}

}  // namespace

/// Places lie in slots: records in blocks that never move, so that the graph can point at them. Removed slots stay
/// until they are as many as the others.
struct RetrievalIndex::Parts {
  features::Vocabulary vocabulary;
  RetrievalConfig config;
  PlaceCoder coder;
  std::vector<std::vector<std::uint8_t>> blocks;
  std::vector<std::string> id_of;  // per slot; empty where removed
  std::unordered_map<std::string, std::size_t> slot_of;
  std::unique_ptr<RecordSpace> space;
  std::unique_ptr<Graph> graph;  // none while there are few

  Parts(features::Vocabulary words, const RetrievalConfig& settings)
      : vocabulary(std::move(words)),
        config(settings),
        coder(vocabulary.aggregate_length(), settings.code_length),
        space(std::make_unique<RecordSpace>(coder.code_length())) {}

  [[nodiscard]] std::size_t record_size() const { return sizeof(float) + coder.code_length(); }
  [[nodiscard]] Record record(std::size_t slot) const {
    return {blocks[slot / kRecordsPerBlock].data() + slot % kRecordsPerBlock * record_size()};
  }
  [[nodiscard]] std::vector<std::int8_t> code(const features::FeatureSet& set) const {
    return coder.encode(features::aggregate(set, vocabulary));
  }

  void add_to_graph(std::size_t slot) {
    if (graph->cur_element_count == graph->max_elements_) graph->resizeIndex(2 * graph->max_elements_);
    const Record added = record(slot);
    graph->addPoint(&added, slot);
  }

  void make_graph() {
    graph.reset();
    if (slot_of.size() < config.graph_from) return;
    const std::size_t room = std::max<std::size_t>(64, id_of.size() + id_of.size() / 2);
    graph = std::make_unique<Graph>(space.get(), room, kGraphNeighbours, kGraphWidthAdding, kGraphSeed);
    graph->setEf(kGraphWidthAsking);
    for (std::size_t slot = 0; slot < id_of.size(); ++slot) {
      if (!id_of[slot].empty()) add_to_graph(slot);
    }
  }

  /// Into a new slot; leaves the graph alone.
  void append(std::string id, const std::int8_t* code) {
    const std::size_t slot = id_of.size();
    if (slot % kRecordsPerBlock == 0) blocks.emplace_back(kRecordsPerBlock * record_size());
    const std::vector<std::uint8_t> made = make_record(code, coder.code_length());
    std::copy(made.begin(), made.end(),
              blocks.back().begin() + static_cast<std::ptrdiff_t>(slot % kRecordsPerBlock * record_size()));
    slot_of.emplace(id, slot);
    id_of.push_back(std::move(id));
  }

  void close_gaps() {
    const auto old_blocks = std::move(blocks);
    const auto old_ids = std::move(id_of);
    blocks.clear();
    id_of.clear();
    slot_of.clear();
    for (std::size_t slot = 0; slot < old_ids.size(); ++slot) {
      if (old_ids[slot].empty()) continue;
      const auto& block = old_blocks[slot / kRecordsPerBlock];
      append(old_ids[slot], Record{block.data() + slot % kRecordsPerBlock * record_size()}.code());
    }
    make_graph();
  }
};

RetrievalIndex::RetrievalIndex(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
RetrievalIndex::~RetrievalIndex() = default;
RetrievalIndex::RetrievalIndex(RetrievalIndex&&) noexcept = default;
RetrievalIndex& RetrievalIndex::operator=(RetrievalIndex&&) noexcept = default;

Result<RetrievalIndex> RetrievalIndex::create(features::Vocabulary vocabulary, const RetrievalConfig& config) {
  const auto& words = vocabulary.words;
  if (words.size() == 0 || words.rows() > kMaxWords || words.cols() > kMaxDescriptorLength) {
    return fail(ErrorCode::kInvalidInput, "The vocabulary has no words, or more or longer ones than the limit.");
  }
  const bool whole =
      (words.array() == words.array().round()).all() && words.minCoeff() >= -128.0F && words.maxCoeff() <= 127.0F;
  if (!whole) return fail(ErrorCode::kInvalidInput, "A word's numbers are not whole or not within -128 to 127.");
  if (config.code_length < 1 || config.code_length > static_cast<int>(kMaxCodeLength)) {
    return fail(ErrorCode::kInvalidInput, "A code has 1 to " + std::to_string(kMaxCodeLength) + " numbers.");
  }
  return RetrievalIndex(std::make_unique<Parts>(std::move(vocabulary), config));
}

Status RetrievalIndex::add(std::string id, const features::FeatureSet& set) {
  if (id.empty() || id.size() > kMaxIdLength) {
    return fail(ErrorCode::kInvalidInput, "An id has 1 to " + std::to_string(kMaxIdLength) + " bytes.", id);
  }
  if (contains(id)) return fail(ErrorCode::kConflict, "The index has a place of this id already.", id);
  if (set.descriptors.rows() == 0) return fail(ErrorCode::kTooFewFeatures, "The picture has no features.", id);
  if (set.descriptors.cols() != parts_->vocabulary.words.cols()) {
    return fail(ErrorCode::kInvalidInput, "The picture's descriptors do not have the length of the vocabulary's.", id);
  }
  parts_->append(std::move(id), parts_->code(set).data());
  if (parts_->graph) {
    parts_->add_to_graph(parts_->id_of.size() - 1);
  } else if (size() >= parts_->config.graph_from) {
    parts_->make_graph();
  }
  return {};
}

Status RetrievalIndex::remove(const std::string& id) {
  const auto known = parts_->slot_of.find(id);
  if (known == parts_->slot_of.end()) return fail(ErrorCode::kNotFound, "The index has no place of this id.", id);
  const std::size_t slot = known->second;
  if (parts_->graph) parts_->graph->markDelete(slot);
  parts_->id_of[slot].clear();
  parts_->slot_of.erase(known);
  if (parts_->id_of.size() > 2 * size()) parts_->close_gaps();
  return {};
}

std::vector<Candidate> RetrievalIndex::query(const features::FeatureSet& set, std::size_t k) const {
  std::vector<Candidate> candidates;
  if (k == 0 || size() == 0 || set.descriptors.rows() == 0) return candidates;
  if (set.descriptors.cols() != parts_->vocabulary.words.cols()) return candidates;
  const std::vector<std::uint8_t> asked = make_record(parts_->code(set).data(), parts_->coder.code_length());
  const Record query{asked.data()};
  if (parts_->graph) {
    auto found = parts_->graph->searchKnn(&query, std::min(k, size()));
    for (; !found.empty(); found.pop()) {
      candidates.push_back({parts_->id_of[found.top().second], 1.0 - static_cast<double>(found.top().first)});
    }
    sort_and_cut(candidates, k);
    return candidates;
  }
  std::vector<std::pair<float, std::size_t>> scores;
  for (std::size_t slot = 0; slot < parts_->id_of.size(); ++slot) {
    if (parts_->id_of[slot].empty()) continue;
    scores.emplace_back(cosine(query, parts_->record(slot), parts_->coder.code_length()), slot);
  }
  const auto better = [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : parts_->id_of[a.second] < parts_->id_of[b.second];
  };
  const auto end = scores.begin() + static_cast<std::ptrdiff_t>(std::min(k, scores.size()));
  std::partial_sort(scores.begin(), end, scores.end(), better);
  for (auto it = scores.begin(); it != end; ++it) {
    candidates.push_back({parts_->id_of[it->second], static_cast<double>(it->first)});
  }
  return candidates;
}

std::size_t RetrievalIndex::size() const { return parts_->slot_of.size(); }

bool RetrievalIndex::contains(const std::string& id) const { return parts_->slot_of.contains(id); }

std::size_t RetrievalIndex::bytes_per_place() const {
  std::size_t bytes = parts_->record_size();
  if (parts_->graph) {
    // Links of the lowest level, pointer and label; the few higher levels add a fifteenth of the links.
    bytes += parts_->graph->size_data_per_element_ + parts_->graph->size_links_per_element_ / (kGraphNeighbours - 1);
  }
  return bytes;
}

const features::Vocabulary& RetrievalIndex::vocabulary() const { return parts_->vocabulary; }

std::vector<std::uint8_t> RetrievalIndex::serialise() const {
  ByteWriter writer;
  const auto& words = parts_->vocabulary.words;
  writer.put(kMagic, 4);
  writer.put(kVersion);
  writer.put(std::uint16_t{0});
  writer.put(static_cast<std::uint32_t>(words.rows()));
  writer.put(static_cast<std::uint32_t>(words.cols()));
  writer.put(static_cast<std::uint32_t>(parts_->coder.code_length()));
  writer.put(static_cast<std::uint32_t>(parts_->config.graph_from));
  for (Eigen::Index i = 0; i < words.size(); ++i) writer.put(static_cast<std::int8_t>(words.data()[i]));
  writer.put(static_cast<std::uint32_t>(size()));
  for (std::size_t slot = 0; slot < parts_->id_of.size(); ++slot) {
    const std::string& id = parts_->id_of[slot];
    if (id.empty()) continue;
    writer.put(static_cast<std::uint16_t>(id.size()));
    writer.put(id.data(), id.size());
    writer.put(parts_->record(slot).code(), parts_->coder.code_length());
  }
  return writer.take();
}

Result<RetrievalIndex> RetrievalIndex::deserialise(std::span<const std::uint8_t> bytes, const std::string& where) {
  const auto corrupt = [&](const char* message) { return fail(ErrorCode::kCorruptFile, message, where); };
  constexpr const char* kTooShort = "The index ends too early.";
  ByteReader reader(bytes);
  char magic[4] = {};
  if (!reader.get(magic, 4) || std::memcmp(magic, kMagic, 4) != 0) {
    return fail(ErrorCode::kUnsupportedFormat, "These bytes are not a retrieval index.", where);
  }
  std::uint16_t version = 0;
  std::uint16_t zero = 0;
  if (!reader.get(&version) || !reader.get(&zero)) return corrupt(kTooShort);
  if (version != kVersion) {
    return fail(ErrorCode::kUnsupportedFormat,
                "The index has version " + std::to_string(version) + "; this program reads version " +
                    std::to_string(kVersion) + ". Make it again from the map.",
                where);
  }
  std::array<std::uint32_t, 4> counts{};
  if (!reader.get(counts.data(), counts.size())) return corrupt(kTooShort);
  const auto [words, length, code_length, graph_from] = counts;
  if (words == 0 || words > kMaxWords || length == 0 || length > kMaxDescriptorLength || code_length == 0 ||
      code_length > kMaxCodeLength || code_length > features::kElevationBands * words * length || zero != 0) {
    return corrupt("The index claims words or codes of sizes over the limit.");
  }
  std::vector<std::int8_t> numbers(std::size_t{words} * length);
  std::uint32_t places = 0;
  if (!reader.get(numbers.data(), numbers.size()) || !reader.get(&places)) return corrupt(kTooShort);
  features::Vocabulary vocabulary;
  vocabulary.words.resize(words, length);
  std::copy(numbers.begin(), numbers.end(), vocabulary.words.data());
  auto index = create(std::move(vocabulary), {static_cast<int>(code_length), graph_from});
  if (!index) return pass_on(index);
  std::vector<std::int8_t> code(code_length);
  std::string id;
  for (std::uint32_t i = 0; i < places; ++i) {
    std::uint16_t id_length = 0;
    if (!reader.get(&id_length)) return corrupt(kTooShort);
    if (id_length == 0 || id_length > kMaxIdLength) return corrupt("An id of the index is empty or too long.");
    id.resize(id_length);
    if (!reader.get(id.data(), id.size()) || !reader.get(code.data(), code.size())) return corrupt(kTooShort);
    if (index->contains(id)) return corrupt("The index has an id twice.");
    index->parts_->append(id, code.data());
  }
  if (reader.left() != 0) return corrupt("The index has bytes after its end.");
  index->parts_->make_graph();
  return index;
}

}  // namespace homeward::matching
