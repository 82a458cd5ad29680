// SPDX-License-Identifier: Apache-2.0
#include "files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace homeward::files {

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder, const std::string& whose) {
  const std::filesystem::path file = folder / "homeward.lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor < 0) {
    return fail(ErrorCode::kIo, "The lock file cannot be opened: " + std::generic_category().message(errno) + ".",
                file.string());
  }
  FolderLock lock(descriptor);
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno == EWOULDBLOCK) {
      return fail(ErrorCode::kConflict, "Another program uses this " + whose + "; each needs one of its own.",
                  folder.string());
    }
    return fail(ErrorCode::kIo, "The folder cannot be locked: " + std::generic_category().message(errno) + ".",
                file.string());
  }
  return lock;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace homeward::files
