// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/durable_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace homeward::db {
namespace {

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : value_(::open(file.c_str(), flags | O_CLOEXEC, 0600)) {
    if (value_ < 0) throw std::system_error(errno, std::generic_category(), file.string());
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(value_); }
  [[nodiscard]] int value() const { return value_; }

 private:
  int value_;
};

void flush(const Descriptor& descriptor, const std::filesystem::path& file) {
  if (::fsync(descriptor.value()) != 0) throw std::system_error(errno, std::generic_category(), file.string());
}

/// FILE.part until it is whole; what does not become whole does not stay.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& file)
      : file_(file), part_(file.string() + ".part"), descriptor_(part_, O_WRONLY | O_CREAT | O_TRUNC) {}
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile() {
    if (!in_place_) ::unlink(part_.c_str());
  }
  void write(std::span<const std::uint8_t> bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_.value(), bytes.data(), bytes.size());
      if (written < 0) {
        if (errno == EINTR) continue;
        throw std::system_error(errno, std::generic_category(), part_.string());
      }
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    flush(descriptor_, part_);
  }
  void put_in_place() {
    std::filesystem::rename(part_, file_);
    in_place_ = true;
    flush_folder(file_.parent_path());
  }

 private:
  std::filesystem::path file_;
  std::filesystem::path part_;
  Descriptor descriptor_;
  bool in_place_ = false;
};

}  // namespace

void flush_folder(const std::filesystem::path& folder) { flush(Descriptor(folder, O_RDONLY | O_DIRECTORY), folder); }

bool is_disk_full(const std::error_code& failure) {
  return failure == std::errc::no_space_on_device ||
         (failure.category() == std::generic_category() && failure.value() == EDQUOT);
}

Error disk_full(const std::string& where) {
  return {ErrorCode::kDiskFull, "The disk is full; what is on it already is kept. Make room on it, and try again.",
          where};
}

void write_durably(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  UnfinishedFile part(file);
  part.write(bytes);
  part.put_in_place();
}

void make_folder_durably(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    throw std::system_error(errno, std::generic_category(), folder.string());
  }
  flush_folder(folder.parent_path());
}

std::vector<std::uint8_t> read_whole(const std::filesystem::path& file) {
  const Descriptor descriptor(file, O_RDONLY);
  std::vector<std::uint8_t> bytes(std::filesystem::file_size(file));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(descriptor.value(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw std::system_error(errno, std::generic_category(), file.string());
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace homeward::db
