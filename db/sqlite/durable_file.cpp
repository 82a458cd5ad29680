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

void flush_folder(const std::filesystem::path& folder) { flush(Descriptor(folder, O_RDONLY | O_DIRECTORY), folder); }

}  // namespace

void write_durably(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  std::filesystem::path part = file;
  part += ".part";
  {
    const Descriptor descriptor(part, O_WRONLY | O_CREAT | O_TRUNC);
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor.value(), bytes.data(), bytes.size());
      if (written < 0) {
        if (errno == EINTR) continue;
        throw std::system_error(errno, std::generic_category(), part.string());
      }
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    flush(descriptor, part);
  }
  std::filesystem::rename(part, file);
  flush_folder(file.parent_path());
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
