// SPDX-License-Identifier: Apache-2.0
#include "files/write_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace homeward::files {
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

/// One name for all who write this file: what a killed program left is taken over and not added to. The lock makes
/// writers wait for each other; a file system without locks does without.
void wait_for_lock(int descriptor) {
  while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
  }
}

/// False when the one who had the lock before has renamed or removed the file meanwhile.
bool is_named(int descriptor, const std::filesystem::path& path) {
  struct stat held {};
  struct stat named {};
  return ::fstat(descriptor, &held) == 0 && ::stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

}  // namespace

Status write_file(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path unfinished = file.string() + ".unfinished";
  int descriptor = -1;
  do {
    if (descriptor >= 0) ::close(descriptor);
    descriptor = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor < 0) return trouble(file, "The file cannot be made");
    wait_for_lock(descriptor);
  } while (!is_named(descriptor, unfinished));
  Status status;
  if (::ftruncate(descriptor, 0) != 0) status = trouble(file, "The file cannot be written");
  if (status) status = write_all(descriptor, bytes, file);
  if (status && ::rename(unfinished.c_str(), file.c_str()) != 0)
    status = trouble(file, "The file cannot be put in place");
  if (!status) ::unlink(unfinished.c_str());
  ::close(descriptor);
  return status;
}

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorCode::kIo, "The folder cannot be made: " + error.message() + ".", folder.string());
  return {};
}

}  // namespace homeward::files
