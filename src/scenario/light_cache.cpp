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

bool read_light(const fs::path& file, sim::LitWorld& world, sim::LightPreset preset) {
  const auto bytes = files::read_text(file);
  Head head;
  if (!bytes || bytes->size() < sizeof head) return false;
  std::memcpy(&head, bytes->data(), sizeof head);
  if (head.magic != Head().magic || head.version != kVersion) return false;
  if (head.rows > bytes->size() || bytes->size() != sizeof head + head.rows * 3 * sizeof(float)) return false;
  sim::Irradiance light;
  light.corners.resize(static_cast<Eigen::Index>(head.rows), 3);
  std::memcpy(light.corners.data(), bytes->data() + sizeof head, bytes->size() - sizeof head);
  return light.corners.allFinite() && world.set_irradiance(preset, std::move(light));
}

}  // namespace

void prepare_light(sim::LitWorld& world, sim::LightPreset preset) {
  const fs::path folder = cache_folder();
  const fs::path file = folder / ("light-" + world.light_key(preset));
  if (read_light(file, world, preset)) return;
  const sim::Irradiance& light = world.irradiance(preset);
  Head head;
  head.rows = static_cast<std::uint64_t>(light.corners.rows());
  std::string bytes(sizeof head + head.rows * 3 * sizeof(float), '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  std::memcpy(bytes.data() + sizeof head, light.corners.data(), head.rows * 3 * sizeof(float));
  if (files::make_folder(folder)) static_cast<void>(files::write_file(file, bytes));
}

}  // namespace homeward::scenario
