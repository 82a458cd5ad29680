// SPDX-License-Identifier: Apache-2.0
#include "agent/repeat/fetch_map.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "agent/link/rest_client.hpp"
#include "db/map_file.hpp"

namespace homeward::agent {
namespace {

/// A new folder that goes with all that is in it.
class TemporaryFolder {
 public:
  static Result<TemporaryFolder> create() {
    std::error_code trouble;
    std::string pattern = (std::filesystem::temp_directory_path(trouble) / "homeward-XXXXXX").string();
    if (trouble || ::mkdtemp(pattern.data()) == nullptr) {
      return fail(ErrorCode::kIo, "No folder can be made for the map.", pattern);
    }
    return TemporaryFolder(pattern);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace

Result<std::shared_ptr<const map::TopologicalMap>> fetch_map(const ServerAddress& server, const std::string& token,
                                                             const MapId& map) {
  RestClient client(server, token);
  const auto folder = TemporaryFolder::create();
  if (!folder) return pass_on(folder);
  const std::filesystem::path file = folder->path() / "path.hwmap";
  const Status fetched = client.download("/api/v1/maps/" + map.str() + "/export", file);
  if (!fetched) return pass_on(fetched);
  auto loaded = db::load_map(file);
  if (!loaded) return pass_on(loaded);
  return std::make_shared<const map::TopologicalMap>(std::move(loaded->map));
}

}  // namespace homeward::agent
