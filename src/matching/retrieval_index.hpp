// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "features/aggregate.hpp"

namespace homeward::matching {

/// How many words a vocabulary for an index best has.
inline constexpr int kRetrievalWords = 16;

struct RetrievalConfig {
  int code_length = 1024;  // bytes kept of each place, at most
  // Places from which on the graph is made. Below, looking at all of them is exact and quick (100,000 in 7 ms of a
  // processor), and nothing is to be built: docs/experiments/retrieval_index.md.
  std::size_t graph_from = 200'000;
};

/// A place that looks like the query.
struct Candidate {
  std::string id;
  double score = 0.0;  // cosine of the two codes, 1 for the same picture
};

/// Finds the few of very many pictures that look most like another one, without comparing their features pair by pair:
/// those few are then to be compared feature by feature. Each picture's descriptors are aggregated
/// (features::aggregate), turned by a fixed random rotation and cut to `code_length` numbers of 8 bits (a fast
/// Johnson-Lindenstrauss transform: Ailon & Chazelle 2009). Few codes are all compared; many are searched along a graph
/// of neighbours (HNSW: Malkov & Yashunin 2018), which finds nearly always the same. Deterministic: the same calls
/// give the same answers. Several threads may ask at once while none changes it.
class RetrievalIndex {
 public:
  /// Errors: kInvalidInput (a vocabulary without words, a code length below 1).
  static Result<RetrievalIndex> create(features::Vocabulary vocabulary, const RetrievalConfig& config = {});
  ~RetrievalIndex();
  RetrievalIndex(RetrievalIndex&&) noexcept;
  RetrievalIndex& operator=(RetrievalIndex&&) noexcept;

  /// Errors: kConflict (the id is there), kInvalidInput (descriptors of another length than the words; an id longer
  /// than 1000 bytes), kTooFewFeatures (no descriptor at all).
  Status add(std::string id, const features::FeatureSet& set);
  /// Errors: kNotFound.
  Status remove(const std::string& id);
  /// At most `k` places, the most similar first, equals by id. A picture without features, or with
  /// descriptors of another length than the words, is like none.
  [[nodiscard]] std::vector<Candidate> query(const features::FeatureSet& set, std::size_t k) const;

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool contains(const std::string& id) const;
  /// Memory of each place, ids not counted.
  [[nodiscard]] std::size_t bytes_per_place() const;
  [[nodiscard]] const features::Vocabulary& vocabulary() const;

  /// Little endian, version 1: "HWRI" u16 version, u16 zero, u32 words W, u32 descriptor length D, u32 code length L,
  /// u32 graph_from, i8[W][D] words, u32 places, then for each u16 length of id, id, i8[L] code. The graph is made
  /// again on reading.
  [[nodiscard]] std::vector<std::uint8_t> serialise() const;
  /// `where` names the bytes in errors.
  /// Errors: kUnsupportedFormat (no index of ours, another version), kCorruptFile (too short, too long, counts over the
  /// limit, an id twice).
  static Result<RetrievalIndex> deserialise(std::span<const std::uint8_t> bytes, const std::string& where);

 private:
  struct Parts;
  explicit RetrievalIndex(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace homeward::matching
