// SPDX-License-Identifier: Apache-2.0
// A mapped file can be cut by whoever may write it; every access beyond its new end is a SIGBUS. Mappings announced
// here survive that: zeros take the place of what is missing, and the mapping is marked as lost.

#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

namespace indurop::rt {

class GuardedMapping {
 public:
  // `memory`, page aligned, stays mapped until this object ends. `name` is for whoever has to say what was lost; 63
  // characters of it are kept. Installs the process's handler for SIGBUS, which passes on what is not its business.
  // Not real-time safe.
  GuardedMapping(void* memory, std::size_t bytes, bool writable, std::string_view name);
  GuardedMapping(GuardedMapping&& other) noexcept;
  GuardedMapping& operator=(GuardedMapping&& other) noexcept;
  GuardedMapping(const GuardedMapping&) = delete;
  GuardedMapping& operator=(const GuardedMapping&) = delete;
  ~GuardedMapping();

  // A page was missing when somebody needed it: what is read since then may be zeros. Real-time safe.
  [[nodiscard]] bool lost() const noexcept;

  struct Region;

 private:
  Region* region_;
};

// What this process does at once when a page is missing, in the thread that needed it, inside of the signal handler:
// only what is safe there. The zeros are in place already. Before there are threads, or none.
using LossHook = void (*)(void* context, const char* name);
void on_lost_page(LossHook hook, void* context) noexcept;

// For threads that others made with all signals blocked: the kernel kills a process whose thread blocks a fault of its
// own. Costs a system call the first time.
void let_lost_pages_in() noexcept;

// The address lies in a guarded mapping. Safe in a signal handler.
bool is_guarded(const void* address) noexcept;
// For handlers of SIGBUS: true if the address lies in a guarded mapping and may be accessed now.
bool replace_lost_page(const void* address) noexcept;

}  // namespace indurop::rt
