// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace homeward::files {

/// A folder that one program has for itself, as long as this lives; the system gives it back when the program ends,
/// however that comes.
class FolderLock {
 public:
  /// `whose` says for people what the folder is, as in "folder of explorations". Errors: kConflict (another program has
  /// it), kIo; both name the folder or the lock's file in it, homeward.lock.
  static Result<FolderLock> take(const std::filesystem::path& folder, const std::string& whose);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace homeward::files
