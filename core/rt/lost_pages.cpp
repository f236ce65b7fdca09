// SPDX-License-Identifier: Apache-2.0
// The list of mappings only grows and its elements are reused, so a handler may walk it at any time.
#include "core/rt/lost_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <utility>

#include "core/rt/fault_handler.h"

namespace indurop::rt {

struct GuardedMapping::Region {
  std::atomic<std::uintptr_t> begin{0};  // 0: free; stored last
  std::atomic<std::uintptr_t> end{0};
  std::atomic<bool> lost{false};
  std::uintptr_t page = 4096;
  bool writable = false;
  char name[64] = {};
  Region* next = nullptr;
};

namespace {

using Region = GuardedMapping::Region;

// A signal handler is given nothing else.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<Region*> g_regions{nullptr};
std::atomic<LossHook> g_hook{nullptr};
std::atomic<void*> g_context{nullptr};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

std::mutex& registration() {
  static std::mutex mutex;
  return mutex;
}

Region* find(std::uintptr_t address) noexcept {
  for (Region* one = g_regions.load(std::memory_order_acquire); one != nullptr; one = one->next) {
    const std::uintptr_t begin = one->begin.load(std::memory_order_acquire);
    if (begin != 0 && begin <= address && address < one->end.load(std::memory_order_relaxed)) {
      return one;
    }
  }
  return nullptr;
}

bool put_zeros(std::uintptr_t from, std::size_t bytes, bool writable) noexcept {
  auto* const at = reinterpret_cast<void*>(from);  // NOLINT(performance-no-int-to-ptr): of a mapping
  constexpr int kKind = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED | MAP_NORESERVE;
  return ::mmap(at, bytes, writable ? PROT_READ | PROT_WRITE : PROT_READ, kKind, -1, 0) != MAP_FAILED;
}

// Requires that registration() is held.
Region& free_region() {
  Region* const first = g_regions.load(std::memory_order_relaxed);
  for (Region* one = first; one != nullptr; one = one->next) {
    if (one->begin.load(std::memory_order_relaxed) == 0) {
      return *one;
    }
  }
  if (first == nullptr) {
    install_fault_handler(SIGBUS);
  }
  auto* const made = new Region;  // NOLINT(cppcoreguidelines-owning-memory): stays, a handler may be reading it
  made->next = first;
  g_regions.store(made, std::memory_order_release);
  return *made;
}

}  // namespace

GuardedMapping::GuardedMapping(void* memory, std::size_t bytes, bool writable, std::string_view name) {
  const std::lock_guard guard(registration());
  region_ = &free_region();  // NOLINT(cppcoreguidelines-prefer-member-initializer): under the lock
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  region_->page = page;
  region_->end.store((begin + bytes + page - 1) / page * page, std::memory_order_relaxed);
  region_->lost.store(false, std::memory_order_relaxed);
  region_->writable = writable;
  std::memset(region_->name, 0, sizeof region_->name);
  std::memcpy(region_->name, name.data(), std::min(name.size(), sizeof region_->name - 1));
  region_->begin.store(begin, std::memory_order_release);
}

GuardedMapping::GuardedMapping(GuardedMapping&& other) noexcept : region_(std::exchange(other.region_, nullptr)) {}
GuardedMapping& GuardedMapping::operator=(GuardedMapping&& other) noexcept {
  std::swap(region_, other.region_);
  return *this;
}
GuardedMapping::~GuardedMapping() {
  if (region_ != nullptr) {
    const std::lock_guard guard(registration());
    region_->begin.store(0, std::memory_order_release);
  }
}

bool GuardedMapping::lost() const noexcept {
  return region_->lost.load(std::memory_order_acquire);
}

void on_lost_page(LossHook hook, void* context) noexcept {
  g_context.store(context, std::memory_order_relaxed);
  g_hook.store(hook, std::memory_order_release);
}

void unblock_fault_signals() noexcept {
  thread_local bool t_done = false;
  if (!t_done) {
    sigset_t bus;
    ::sigemptyset(&bus);
    ::sigaddset(&bus, SIGBUS);
    t_done = ::pthread_sigmask(SIG_UNBLOCK, &bus, nullptr) == 0;
  }
}

bool is_guarded(const void* address) noexcept {
  return find(reinterpret_cast<std::uintptr_t>(address)) != nullptr;
}

bool replace_lost_page(const void* address) noexcept {
  const int error = errno;
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  Region* const region = find(at);
  if (region == nullptr) {
    return false;
  }
  // Everything after a missing page is missing too. A limit of locked memory may allow no more than the page.
  const std::uintptr_t from = at / region->page * region->page;
  region->lost.store(true, std::memory_order_release);
  const bool replaced = put_zeros(from, region->end.load(std::memory_order_relaxed) - from, region->writable) ||
                        put_zeros(from, region->page, region->writable);
  if (const LossHook hook = g_hook.load(std::memory_order_acquire); replaced && hook != nullptr) {
    hook(g_context.load(std::memory_order_relaxed), region->name);
  }
  errno = error;
  return replaced;
}

}  // namespace indurop::rt
