// SPDX-License-Identifier: Apache-2.0
#include "files/read_file.hpp"

#include <fstream>
#include <span>

#include "imageio/decode.hpp"
#include "wire/camera_json.hpp"

namespace homeward::files {

namespace fs = std::filesystem;

Result<std::string> read_text(const fs::path& file) {
  constexpr std::uintmax_t kMaxBytes = 256ULL * 1024 * 1024;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return fail(ErrorCode::kNotFound, "There is no such file.", file.string());
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return fail(ErrorCode::kIo, "The file cannot be read: " + error.message() + ".", file.string());
  if (size > kMaxBytes) return fail(ErrorCode::kTooLarge, "The file is larger than 256 MiB.", file.string());
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size))) {
    return fail(ErrorCode::kIo, "The file cannot be read.", file.string());
  }
  return text;
}

Result<Image> read_picture(const fs::path& file) {
  const auto bytes = read_text(file);
  if (!bytes) return pass_on(bytes);
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes->data());
  return imageio::decode(std::span(first, bytes->size()), file.string());
}

Result<camera::CameraConfig> read_camera(const fs::path& file) {
  const auto text = read_text(file);
  if (!text) return pass_on(text);
  return wire::parse_camera(*text, file.string());
}

}  // namespace homeward::files
