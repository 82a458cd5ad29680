// SPDX-License-Identifier: Apache-2.0
#include "wire/similarity_blob.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/bytes.hpp"

namespace homeward::wire {
namespace {

constexpr std::array<char, 4> kMagic = {'H', 'W', 'S', 'M'};
constexpr std::uint16_t kVersion = 1;
constexpr std::size_t kPairBytes = 2 * sizeof(std::uint32_t) + 1;

bool get_images(ByteReader& reader, std::uint32_t count, std::vector<ImageId>& images) {
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint16_t length = 0;
    if (!reader.get(&length)) return false;
    std::string id(length, '\0');
    if (!reader.get(id.data(), length)) return false;
    images.emplace_back(std::move(id));
  }
  return true;
}

bool get_pairs(ByteReader& reader, map::SimilarityMatrix& matrix) {
  std::uint64_t count = 0;
  if (!reader.get(&count) || count > reader.left() / kPairBytes) return false;
  matrix.pairs.resize(static_cast<std::size_t>(count));
  for (map::AlikePair& pair : matrix.pairs) {
    if (!reader.get(&pair.a) || !reader.get(&pair.b) || !reader.get(&pair.likeness)) return false;
    if (pair.a >= pair.b || pair.b >= matrix.images.size()) return false;
  }
  const auto order = [](const map::AlikePair& pair) { return std::tie(pair.b, pair.a); };
  return std::ranges::adjacent_find(matrix.pairs, std::ranges::greater_equal{}, order) == matrix.pairs.end();
}

}  // namespace

std::vector<std::uint8_t> encode_similarity(const map::SimilarityMatrix& matrix) {
  ByteWriter writer;
  writer.put(kMagic.data(), kMagic.size());
  writer.put(kVersion);
  writer.put(std::uint16_t{0});
  writer.put(static_cast<std::uint32_t>(matrix.images.size()));
  for (const ImageId& image : matrix.images) {
    writer.put(static_cast<std::uint16_t>(image.str().size()));
    writer.put(image.str().data(), image.str().size());
  }
  writer.put(static_cast<std::uint64_t>(matrix.pairs.size()));
  for (const map::AlikePair& pair : matrix.pairs) {
    writer.put(pair.a);
    writer.put(pair.b);
    writer.put(pair.likeness);
  }
  return writer.take();
}

Result<map::SimilarityMatrix> decode_similarity(std::span<const std::uint8_t> bytes, const std::string& where) {
  ByteReader reader(bytes);
  std::array<char, 4> magic{};
  std::uint16_t version = 0;
  std::uint16_t zero = 0;
  std::uint32_t count = 0;
  if (!reader.get(magic.data(), magic.size()) || magic != kMagic || !reader.get(&version) || version != kVersion) {
    return fail(ErrorCode::kUnsupportedFormat, "This is no similarity matrix that this version reads.", where);
  }
  map::SimilarityMatrix matrix;
  const bool whole = reader.get(&zero) && reader.get(&count) && count <= kMaxBlobImages &&
                     get_images(reader, count, matrix.images) && get_pairs(reader, matrix) && reader.left() == 0;
  if (!whole) return fail(ErrorCode::kCorruptFile, "The similarity matrix is damaged.", where);
  return matrix;
}

}  // namespace homeward::wire
