// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program under test, this moves its wall clock by the seconds that stand, as a 64-bit integer, in the
// file named by HOMEWARD_MOVING_CLOCK; a test writes there while the program runs. Steady clocks are left alone.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

std::int64_t moved_s() {
  static const auto* const kSeconds = []() -> const std::atomic<std::int64_t>* {
    const char* name = std::getenv("HOMEWARD_MOVING_CLOCK");
    const int file = name != nullptr ? open(name, O_RDONLY | O_CLOEXEC) : -1;
    if (file < 0) return nullptr;
    void* seconds = mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, file, 0);
    close(file);
    return seconds == MAP_FAILED ? nullptr : static_cast<const std::atomic<std::int64_t>*>(seconds);
  }();
  return kSeconds != nullptr ? kSeconds->load(std::memory_order_relaxed) : 0;
}

}  // namespace

// The names are those of the C library, whose calls these replace.
extern "C" {

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const long failed = syscall(SYS_clock_gettime, clock, now);
  if (failed != 0) return static_cast<int>(failed);
  if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) now->tv_sec += moved_s();
  return 0;
}

__attribute__((visibility("default"))) int gettimeofday(timeval* now, void* /*zone*/) noexcept {
  timespec exact{};
  clock_gettime(CLOCK_REALTIME, &exact);
  *now = {exact.tv_sec, exact.tv_nsec / 1000};
  return 0;
}

__attribute__((visibility("default"))) time_t time(time_t* result) noexcept {
  timespec exact{};
  clock_gettime(CLOCK_REALTIME, &exact);
  if (result != nullptr) *result = exact.tv_sec;
  return exact.tv_sec;
}
}
