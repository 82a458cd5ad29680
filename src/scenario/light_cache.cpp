// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "files/read_file.hpp"
#include "files/write_file.hpp"
#include "scenario/world_folder.hpp"

namespace homeward::scenario {

namespace fs = std::filesystem;

namespace {

// The file: "HWLT", u32 version, u64 rows, then rows x 3 floats, in this machine's byte order.
constexpr std::uint32_t kVersion = 1;
struct Head {
  std::array<char, 4> magic{'H', 'W', 'L', 'T'};
  std::uint32_t version = kVersion;
  std::uint64_t rows = 0;
};

fs::path cache_folder() {
  if (const char* base = std::getenv("XDG_CACHE_HOME"); base != nullptr && *base != '\0')
    return fs::path(base) / "homeward";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "homeward";
  return fs::temp_directory_path() / "homeward-cache";
}

bool read_light(const fs::path& file, sim::LitWorld& world, const sim::Light& light) {
  const auto bytes = files::read_text(file);
  Head head;
  if (!bytes || bytes->size() < sizeof head) return false;
  std::memcpy(&head, bytes->data(), sizeof head);
  if (head.magic != Head().magic || head.version != kVersion) return false;
  if (head.rows > bytes->size() || bytes->size() != sizeof head + head.rows * 3 * sizeof(float)) return false;
  sim::Irradiance known;
  known.corners.resize(static_cast<Eigen::Index>(head.rows), 3);
  std::memcpy(known.corners.data(), bytes->data() + sizeof head, bytes->size() - sizeof head);
  return known.corners.allFinite() && world.set_irradiance(light, std::move(known));
}

}  // namespace

void prepare_light(sim::LitWorld& world, const sim::Light& light) {
  const fs::path folder = cache_folder();
  const fs::path file = folder / ("light-" + world.light_key(light));
  if (read_light(file, world, light)) return;
  const sim::Irradiance& computed = world.irradiance(light);
  Head head;
  head.rows = static_cast<std::uint64_t>(computed.corners.rows());
  std::string bytes(sizeof head + head.rows * 3 * sizeof(float), '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  std::memcpy(bytes.data() + sizeof head, computed.corners.data(), head.rows * 3 * sizeof(float));
  if (files::make_folder(folder)) static_cast<void>(files::write_file(file, bytes));
}

}  // namespace homeward::scenario
