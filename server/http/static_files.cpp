// SPDX-License-Identifier: Apache-2.0
#include "server/http/static_files.hpp"

#include <fstream>
#include <optional>
#include <sstream>

namespace homeward::server {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::string>& content_types() {
  static const std::map<std::string, std::string> types = {{".html", "text/html; charset=utf-8"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".css", "text/css; charset=utf-8"},
                                                           {".svg", "image/svg+xml"},
                                                           {".png", "image/png"},
                                                           {".jpg", "image/jpeg"},
                                                           {".ico", "image/x-icon"},
                                                           {".json", "application/json"},
                                                           {".woff2", "font/woff2"},
                                                           {".webmanifest", "application/manifest+json"},
                                                           {".txt", "text/plain; charset=utf-8"},
                                                           {".map", "application/json"}};
  return types;
}

// The path below the folder; nothing when it tries to leave it or names a hidden file.
std::optional<fs::path> relative_path(const std::string& path) {
  fs::path relative;
  std::size_t start = 1;
  while (start <= path.size()) {
    const std::size_t end = std::min(path.find('/', start), path.size());
    const auto segment = percent_decoded(std::string_view(path).substr(start, end - start));
    if (!segment || segment->find_first_of("/\\") != std::string::npos) return std::nullopt;
    if (!segment->empty()) {
      if (segment->front() == '.') return std::nullopt;
      relative /= *segment;
    }
    start = end + 1;
  }
  return relative;
}

std::optional<std::string> content_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) return std::nullopt;
  return content.str();
}

// FNV-1a: a change of the file shall show, nobody attacks it.
std::string tag_of(const std::string& content) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  std::ostringstream text;
  text << '"' << std::hex << hash << '"';
  return text.str();
}

}  // namespace

StaticFiles::StaticFiles(fs::path folder) : folder_(std::move(folder)) {}

Response StaticFiles::serve(const Request& request) const {
  const Response missing = problem({ErrorCode::kNotFound, "There is no page " + request.path + ".", request.path});
  if (folder_.empty()) return missing;
  const auto relative = relative_path(request.path);
  if (!relative) return missing;
  fs::path file = relative->empty() ? folder_ / "index.html" : folder_ / *relative;
  auto content = content_of(file);
  if (!content && !relative->has_extension()) {
    file = folder_ / "index.html";
    content = content_of(file);
  }
  if (!content) return missing;
  Response response;
  const auto type = content_types().find(file.extension().string());
  response.headers["content-type"] = type == content_types().end() ? "application/octet-stream" : type->second;
  response.headers["etag"] = tag_of(*content);
  // Files in assets/ carry a hash of their content in their name.
  const bool lasting = !relative->empty() && *relative->begin() == "assets";
  response.headers["cache-control"] = lasting ? "public, max-age=31536000, immutable" : "no-cache";
  if (names_tag(request.header("if-none-match"), response.headers["etag"])) {
    response.status = 304;
    return response;
  }
  response.body = std::move(*content);
  return response;
}

}  // namespace homeward::server
