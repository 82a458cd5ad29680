// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program under test, this makes the disk below one folder (HOMEWARD_FAILING_FOLDER) full, or one of
// the calls that change it fail. What it is to do stands in the file named by HOMEWARD_FAILING_DISK, as `Orders`; a
// test writes there while the program runs.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

struct Orders {
  std::atomic<std::int64_t> full;      // 1: no file may grow
  std::atomic<std::int64_t> fails_at;  // the call of this number fails; 0: none
  std::atomic<std::int64_t> calls;     // those that were counted
};

Orders* orders() {
  static Orders* const kOrders = []() -> Orders* {
    const char* name = std::getenv("HOMEWARD_FAILING_DISK");
    static const auto kOpen = reinterpret_cast<int (*)(const char*, int, ...)>(dlsym(RTLD_NEXT, "open"));
    const int file = name != nullptr ? kOpen(name, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0) return nullptr;
    void* found = mmap(nullptr, sizeof(Orders), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    return found == MAP_FAILED ? nullptr : static_cast<Orders*>(found);
  }();
  return kOrders;
}

bool below(std::string_view path) {
  static const std::string kFolder = [] {
    const char* name = std::getenv("HOMEWARD_FAILING_FOLDER");
    return std::string(name != nullptr ? name : "/nowhere") + "/";
  }();
  return path.starts_with(kFolder);
}

bool below(int file) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = readlink(link.c_str(), path.data(), path.size());
  return length > 0 && below(std::string_view(path.data(), static_cast<std::size_t>(length)));
}

/// Counts a call that changes the disk; whether it is the one to fail.
bool fails() {
  Orders* const now = orders();
  if (now == nullptr || now->fails_at == 0) return false;
  return ++now->calls == now->fails_at;
}

bool would_grow(int file, off_t end) {
  struct stat about {};
  return fstat(file, &about) == 0 && S_ISREG(about.st_mode) && end > about.st_size;
}

/// 0, or the error that a write up to `end` meets.
int error_of_write(int file, off_t end) {
  const int before = errno;
  if (orders() == nullptr || !below(file)) return 0;
  if (orders()->full == 1 && would_grow(file, end)) return ENOSPC;
  errno = before;
  return fails() ? EIO : 0;
}

template <class Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(dlsym(RTLD_NEXT, name));
}

int failed(int error) {
  errno = error;
  return -1;
}

}  // namespace

// The names are those of the C library, whose calls these replace.
extern "C" {

#define HOMEWARD_VISIBLE __attribute__((visibility("default")))

HOMEWARD_VISIBLE ssize_t write(int file, const void* bytes, std::size_t count) {
  static const auto kNext = next<ssize_t (*)(int, const void*, std::size_t)>("write");
  if (const int error = error_of_write(file, lseek(file, 0, SEEK_CUR) + static_cast<off_t>(count)); error != 0) {
    return failed(error);
  }
  return kNext(file, bytes, count);
}

HOMEWARD_VISIBLE ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t at) {
  static const auto kNext = next<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64");
  if (const int error = error_of_write(file, at + static_cast<off_t>(count)); error != 0) return failed(error);
  return kNext(file, bytes, count, at);
}

HOMEWARD_VISIBLE ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t at) {
  return pwrite64(file, bytes, count, at);
}

HOMEWARD_VISIBLE int fsync(int file) {
  static const auto kNext = next<int (*)(int)>("fsync");
  return below(file) && fails() ? failed(EIO) : kNext(file);
}

HOMEWARD_VISIBLE int fdatasync(int file) {
  static const auto kNext = next<int (*)(int)>("fdatasync");
  return below(file) && fails() ? failed(EIO) : kNext(file);
}

HOMEWARD_VISIBLE int rename(const char* from, const char* to) noexcept {
  static const auto kNext = next<int (*)(const char*, const char*)>("rename");
  return below(to) && fails() ? failed(EIO) : kNext(from, to);
}

HOMEWARD_VISIBLE int open64(const char* path, int flags, ...) {
  static const auto kNext = next<int (*)(const char*, int, ...)>("open64");
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
  }
  if ((flags & (O_WRONLY | O_RDWR)) != 0 && below(path) && fails()) return failed(EIO);
  return kNext(path, flags, mode);
}

HOMEWARD_VISIBLE int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
  }
  return open64(path, flags, mode);
}

HOMEWARD_VISIBLE int statvfs64(const char* path, struct statvfs64* about) noexcept {
  static const auto kNext = next<int (*)(const char*, struct statvfs64*)>("statvfs64");
  const int result = kNext(path, about);
  if (result == 0 && orders() != nullptr && orders()->full == 1) about->f_bavail = 0;
  return result;
}

HOMEWARD_VISIBLE int statvfs(const char* path, struct statvfs* about) noexcept {
  static const auto kNext = next<int (*)(const char*, struct statvfs*)>("statvfs");
  const int result = kNext(path, about);
  if (result == 0 && orders() != nullptr && orders()->full == 1) about->f_bavail = 0;
  return result;
}
}
