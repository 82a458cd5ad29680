// SPDX-License-Identifier: Apache-2.0
#include "agent/files/write_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace homeward::agent {
namespace {

Status trouble(const std::filesystem::path& file, const char* what) {
  return fail(ErrorCode::kIo, std::string(what) + ": " + std::strerror(errno) + ".", file.string());
}

Status write_all(int descriptor, std::string_view bytes, const std::filesystem::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return trouble(file, "The file cannot be written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(descriptor) != 0) return trouble(file, "The file cannot be brought to disk");
  return {};
}

}  // namespace

Status write_file(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path unfinished = file.string() + ".unfinished-" + std::to_string(::getpid());
  const int descriptor = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return trouble(file, "The file cannot be made");
  Status status = write_all(descriptor, bytes, file);
  ::close(descriptor);
  if (status && ::rename(unfinished.c_str(), file.c_str()) != 0)
    status = trouble(file, "The file cannot be put in place");
  if (!status) ::unlink(unfinished.c_str());
  return status;
}

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorCode::kIo, "The folder cannot be made: " + error.message() + ".", folder.string());
  return {};
}

}  // namespace homeward::agent
