// SPDX-License-Identifier: Apache-2.0
// A mapped file can be truncated by any process that may write it; then every access beyond its new end is a SIGBUS.
// Mappings registered here survive that: missing pages are replaced by zeros, and the mapping is marked as lost.

#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

namespace indurop::rt {

class GuardedMapping {
 public:
  // `memory`, page aligned, must stay mapped until this object ends. `name` is used in reports of a loss; 63 characters
  // of it are kept. Installs the process's handler for SIGBUS, which passes on signals of other addresses. Not
  // real-time safe.
  GuardedMapping(void* memory, std::size_t bytes, bool writable, std::string_view name);
  GuardedMapping(GuardedMapping&& other) noexcept;
  GuardedMapping& operator=(GuardedMapping&& other) noexcept;
  GuardedMapping(const GuardedMapping&) = delete;
  GuardedMapping& operator=(const GuardedMapping&) = delete;
  ~GuardedMapping();

  // Returns true after an access to a missing page: values read since then may be zeros. Real-time safe.
  [[nodiscard]] bool lost() const noexcept;

  struct Region;

 private:
  Region* region_;
};

// Called at once when a page is missing, in the thread that accessed it, inside the signal handler: may do only what is
// safe there. The zeros are already in place. Set before there are threads; null: no hook.
using LossHook = void (*)(void* context, const char* name);
void on_lost_page(LossHook hook, void* context) noexcept;

// For threads created elsewhere with all signals blocked: the kernel kills a process if a thread blocks a fault signal
// of its own. Costs a system call the first time.
void unblock_fault_signals() noexcept;

// Returns true if the address is in a guarded mapping. Safe in a signal handler.
bool is_guarded(const void* address) noexcept;
// For handlers of SIGBUS: returns true if the address is in a guarded mapping and may be accessed now.
bool replace_lost_page(const void* address) noexcept;

}  // namespace indurop::rt
