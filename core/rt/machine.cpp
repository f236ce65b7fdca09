// SPDX-License-Identifier: Apache-2.0
#include "core/rt/machine.h"

#include <fcntl.h>
#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/timex.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace indurop::rt {
namespace {

long read_number(const char* path, long fallback) noexcept {
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return fallback;
  }
  char text[32] = {};
  const ssize_t n = ::read(file, text, sizeof text - 1);
  ::close(file);
  long value = fallback;
  if (n > 0) {
    std::from_chars(text, text + n, value);
  }
  return value;
}

// Releases pages of code and constants; they are read from their file again when used.
void release_pages(std::uintptr_t begin, std::uintptr_t end) noexcept {
  auto* const memory = reinterpret_cast<void*>(begin);  // NOLINT(performance-no-int-to-ptr): the loader gives numbers
  (void)::munlock(memory, end - begin);
  (void)::madvise(memory, end - begin, MADV_DONTNEED);
}

int release_library(dl_phdr_info* library, std::size_t /*size*/, void* names) {
  const std::string_view path = library->dlpi_name;
  const auto& except = *static_cast<const std::span<const std::string_view>*>(names);
  if (std::none_of(except.begin(), except.end(),
                   [path](std::string_view name) { return path.find(name) != std::string_view::npos; })) {
    return 0;
  }
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  for (int i = 0; i < library->dlpi_phnum; ++i) {
    const auto& segment = library->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) != 0) {
      continue;
    }
    const std::uintptr_t begin = (library->dlpi_addr + segment.p_vaddr) / page * page;
    release_pages(begin, library->dlpi_addr + segment.p_vaddr + segment.p_memsz);
  }
  return 0;
}

struct Range {
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;
};

// From the first to the last of its mappings: after a fork it may consist of several.
Range heap() noexcept {
  Range found;
  std::FILE* const maps = std::fopen("/proc/self/maps", "re");
  if (maps == nullptr) {
    return found;
  }
  char line[512];
  while (std::fgets(line, sizeof line, maps) != nullptr) {
    if (std::strstr(line, "[heap]") != nullptr) {
      char* rest = nullptr;
      const std::uintptr_t begin = std::strtoull(line, &rest, 16);
      found.begin = found.end == 0 ? begin : found.begin;
      found.end = *rest == '-' ? std::strtoull(rest + 1, nullptr, 16) : found.end;
    }
  }
  std::fclose(maps);
  return found;
}

// Startup frees tens of megabytes between memory that stays. mlockall() backs all of it with memory, so the free pages
// can only be released afterwards; those in use remain locked, the others are locked again when they are allocated.
void release_free_heap() noexcept {
  const Range range = heap();
  auto* const memory = reinterpret_cast<void*>(range.begin);  // NOLINT(performance-no-int-to-ptr): read as text
  if (range.end > range.begin && ::munlock(memory, range.end - range.begin) == 0) {
    ::malloc_trim(0);
    const Range rest = heap();  // its end may have been released too
    (void)::mlock2(memory, rest.end - range.begin, MLOCK_ONFAULT);
  }
}

}  // namespace

Status lock_memory(std::span<const std::string_view> except, std::span<const char> code) noexcept {
  // A separate heap for each new thread would take 64 MB of the limit of locked memory, and stay.
  ::mallopt(M_ARENA_MAX, 1);
  // Later memory is locked from its first use on: otherwise memory that is allocated and never touched would be locked
  // too.
  if (::mlockall(MCL_CURRENT) == 0 && ::mlockall(MCL_FUTURE | MCL_ONFAULT) == 0) {
    release_free_heap();
    ::dl_iterate_phdr(&release_library, &except);
    if (!code.empty()) {
      const auto begin = reinterpret_cast<std::uintptr_t>(code.data());
      release_pages(begin, begin + code.size());
    }
    return {};
  }
  return Error{errno == EPERM ? Errc::PermissionDenied : Errc::NoSpace, errno, "lock memory (mlockall)"};
}

Result<ShortIdle> ShortIdle::hold() noexcept {
  const int file = ::open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC);
  if (file < 0) {
    return Error{errno == ENOENT ? Errc::Unsupported : Errc::PermissionDenied, errno, "hold /dev/cpu_dma_latency"};
  }
  const std::int32_t zero = 0;
  if (::write(file, &zero, sizeof zero) != static_cast<ssize_t>(sizeof zero)) {
    const int code = errno;
    ::close(file);
    return Error{Errc::Unsupported, code, "hold /dev/cpu_dma_latency"};
  }
  ShortIdle idle;
  idle.file_ = file;
  return idle;
}

ShortIdle::ShortIdle(ShortIdle&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
ShortIdle& ShortIdle::operator=(ShortIdle&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}
ShortIdle::~ShortIdle() {
  if (file_ >= 0) {
    ::close(file_);
  }
}

ClockSync clock_sync() noexcept {
  timex state{};
  const int result = ::adjtimex(&state);
  return {result >= 0 && result != TIME_ERROR && (state.status & STA_UNSYNC) == 0,
          static_cast<std::int64_t>(state.maxerror) * 1000};
}

bool kernel_is_preempt_rt() noexcept {
  if (read_number("/sys/kernel/realtime", 0) == 1) {
    return true;
  }
  utsname name{};
  return ::uname(&name) == 0 && std::strstr(name.version, "PREEMPT_RT") != nullptr;
}

std::size_t largest_receive_buffer() noexcept {
  return static_cast<std::size_t>(std::max(0L, read_number("/proc/sys/net/core/rmem_max", 0)));
}

int throttle_permille() noexcept {
  constexpr long kDefaultPeriodUs = 1'000'000;
  const long runtime = read_number("/proc/sys/kernel/sched_rt_runtime_us", -1);
  const long period = read_number("/proc/sys/kernel/sched_rt_period_us", kDefaultPeriodUs);
  return runtime < 0 || period <= 0 ? 1000 : static_cast<int>(runtime * 1000 / period);
}

}  // namespace indurop::rt
