// SPDX-License-Identifier: Apache-2.0
// Real-time capabilities of the machine and what was obtained from it: locked memory, short idle states, kernel.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace indurop::rt {

// Locks the memory of this process: present memory, and later memory page by page at first use. Not locked are code and
// constants of libraries whose path contains one of `except`, and `code`, whole pages of this program. Errors:
// PermissionDenied, NoSpace (the limit is too small).
Status lock_memory(std::span<const std::string_view> except = {}, std::span<const char> code = {}) noexcept;

// Keeps the processors out of deep idle states during its lifetime (/dev/cpu_dma_latency held open at 0): halves the
// wake-up time; cyclictest does the same.
class ShortIdle {
 public:
  ShortIdle() = default;
  static Result<ShortIdle> hold() noexcept;  // Errors: PermissionDenied, Unsupported
  ShortIdle(ShortIdle&& other) noexcept;
  ShortIdle& operator=(ShortIdle&& other) noexcept;
  ShortIdle(const ShortIdle&) = delete;
  ShortIdle& operator=(const ShortIdle&) = delete;
  ~ShortIdle();
  [[nodiscard]] bool held() const noexcept { return file_ >= 0; }

 private:
  int file_ = -1;
};

bool kernel_is_preempt_rt() noexcept;

// The state of CLOCK_REALTIME: synchronized with others (PTP, NTP, chrony) or not, and its maximum error.
struct ClockSync {
  bool synchronised = false;
  std::int64_t max_error_ns = 0;
};
ClockSync clock_sync() noexcept;
// Maximum size of a socket's receive buffer in bytes (net.core.rmem_max); 0 if unknown.
std::size_t largest_receive_buffer() noexcept;
// Share of a core that the kernel allows real-time threads, in 1/1000; 1000 if unlimited or unknown.
int throttle_permille() noexcept;

}  // namespace indurop::rt
