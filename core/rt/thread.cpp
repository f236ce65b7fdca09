// SPDX-License-Identifier: Apache-2.0
#include "core/rt/thread.h"

#include <link.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/rt/fiber.h"
#include "core/rt/guard.h"

namespace indurop::rt {
namespace {

Error from_errno(int code, const char* where) noexcept {
  switch (code) {
    case EPERM:
    case EACCES:
      return {Errc::PermissionDenied, code, where};
    case ESRCH:
      return {Errc::NotFound, code, where};
    case EINVAL:
      return {Errc::InvalidArgument, code, where};
    case EAGAIN:
    case ENOMEM:
      return {Errc::NoSpace, code, where};
    default:
      return {Errc::System, code, where};
  }
}

Status set_fifo_or_normal(pid_t id, int priority, const char* where) noexcept {
  sched_param parameter{};
  parameter.sched_priority = priority;
  if (::sched_setscheduler(id, priority > 0 ? SCHED_FIFO : SCHED_OTHER, &parameter) != 0) {
    return from_errno(errno, where);
  }
  return {};
}

Status pin(pid_t id, std::span<const int> cores, const char* where) noexcept {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : cores) {
    if (core < 0 || core >= CPU_SETSIZE) {
      return Error{Errc::InvalidArgument, 0, where};
    }
    CPU_SET(static_cast<std::size_t>(core), &set);
  }
  if (::sched_setaffinity(id, sizeof set, &set) != 0) {
    return from_errno(errno, where);
  }
  return {};
}

struct Start {
  ThreadSettings settings;
  std::function<void()> body;
};

std::size_t page_bytes() noexcept {
  return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Thread-local variables of the program and its libraries are at the upper end of each stack, with space that the C
// library reserves for those of libraries loaded later (less than a page). In whole pages.
std::size_t thread_local_bytes() noexcept {
  std::size_t bytes = page_bytes();
  (void)::dl_iterate_phdr(
      [](dl_phdr_info* library, std::size_t /*size*/, void* sum) {
        for (int i = 0; i < library->dlpi_phnum; ++i) {
          const auto& segment = library->dlpi_phdr[i];
          *static_cast<std::size_t*>(sum) += segment.p_type == PT_TLS ? segment.p_memsz + segment.p_align : 0;
        }
        return 0;
      },
      &bytes);
  return (bytes + page_bytes() - 1) / page_bytes() * page_bytes();
}

void* thread_entry(void* argument) {
  const std::unique_ptr<Start> start(static_cast<Start*>(argument));
  ::pthread_setname_np(::pthread_self(), start->settings.name.substr(0, 15).c_str());
  if (start->settings.core >= 0) {
    (void)pin_to_core(start->settings.core);
  }
  // Locking memory clears it at once: 0.2 ms, for which other threads of this priority on this core would have to wait.
  std::optional<HandlerStack> handler_stack;
  if (start->settings.runs_modules) {
    handler_stack.emplace();
  }
  // Inherited settings must not apply: a normal thread started by a real-time one must be normal.
  if (!set_fifo(start->settings.fifo_priority) && start->settings.fifo_priority > 0) {
    (void)set_fifo(0);
  }
  start->body();
  (void)set_fifo(0);
  return nullptr;
}

}  // namespace

std::vector<int> allowed_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof set, &set) == 0) {
    for (int core = 0; core < CPU_SETSIZE; ++core) {
      if (CPU_ISSET(static_cast<std::size_t>(core), &set)) {
        cores.push_back(core);
      }
    }
  }
  return cores;
}

Status set_fifo(int priority) noexcept {
  return set_fifo_or_normal(0, priority, "set SCHED_FIFO priority");
}
Status set_fifo_of(pid_t process, int priority) noexcept {
  return set_fifo_or_normal(process, priority, "set SCHED_FIFO priority of a process");
}

int fifo_priority() noexcept {
  if (::sched_getscheduler(0) != SCHED_FIFO) {
    return 0;
  }
  sched_param parameter{};
  return ::sched_getparam(0, &parameter) == 0 ? parameter.sched_priority : 0;
}

Status pin_to_core(int core) noexcept {
  return pin(0, {&core, 1}, "pin a thread to a core");
}
Status pin_to_cores(const std::vector<int>& cores) noexcept {
  return pin(0, cores, "pin a thread to cores");
}
Status pin_process_to_core(pid_t process, int core) noexcept {
  return pin(process, {&core, 1}, "pin a process to a core");
}

bool StackBounds::overflowed_at(const void* address) const noexcept {
  constexpr std::size_t kAround = std::size_t{64} * 1024;
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  const auto low = reinterpret_cast<std::uintptr_t>(lowest);
  return lowest != nullptr && at < low + 4096 && at + kAround >= low;
}

StackBounds own_stack() noexcept {
  if (const Fiber* fiber = Fiber::current(); fiber != nullptr) {
    return fiber->stack();
  }
  StackBounds bounds;
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) == 0) {
    void* lowest = nullptr;
    ::pthread_attr_getstack(&attributes, &lowest, &bounds.bytes);
    bounds.lowest = static_cast<const char*>(lowest);
    ::pthread_attr_destroy(&attributes);
  }
  return bounds;
}

void request_exact_timers() noexcept {
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
}

// The page below the stack is a guard. The part that a real-time thread may use is touched once, so that no page fault
// happens there later; other threads get pages as they use them.
Stack::Stack(std::size_t bytes, bool touched) noexcept : bytes_(page_bytes() + bytes) {
  void* const memory =
      ::mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) {
    return;
  }
  memory_ = static_cast<std::uint8_t*>(memory);
  (void)::mprotect(lowest(), bytes, PROT_READ | PROT_WRITE);
  for (std::size_t at = 0; touched && at < bytes; at += page_bytes()) {
    static_cast<volatile std::uint8_t*>(lowest())[at] = 0;
  }
}

Stack::Stack(Stack&& other) noexcept : memory_(std::exchange(other.memory_, nullptr)), bytes_(other.bytes_) {}

Stack& Stack::operator=(Stack&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Stack::~Stack() {
  if (memory_ != nullptr) {
    ::munmap(memory_, bytes_);
  }
}

std::uint8_t* Stack::lowest() const noexcept {
  return memory_ + page_bytes();
}

Result<Thread> Thread::start(const ThreadSettings& settings, std::function<void()> body) {
  Thread thread;
  const std::size_t stack_bytes = settings.stack_bytes + thread_local_bytes();
  thread.stack_ = Stack(stack_bytes, settings.fifo_priority > 0);
  if (!thread.stack_.ok()) {
    return from_errno(errno, "create a thread's stack");
  }
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstack(&attributes, thread.stack_.lowest(), stack_bytes);
  auto start = std::make_unique<Start>(Start{settings, std::move(body)});
  const int code = ::pthread_create(&thread.handle_, &attributes, thread_entry, start.get());
  ::pthread_attr_destroy(&attributes);
  if (code != 0) {
    return from_errno(code, "create a thread");
  }
  (void)start.release();  // the thread owns it now
  thread.running_ = true;
  return thread;
}

Thread::Thread(Thread&& other) noexcept
    : stack_(std::move(other.stack_)), handle_(other.handle_), running_(std::exchange(other.running_, false)) {}

Thread& Thread::operator=(Thread&& other) noexcept {
  if (this != &other) {
    join();
    stack_ = std::move(other.stack_);
    handle_ = other.handle_;
    running_ = std::exchange(other.running_, false);
  }
  return *this;
}

Thread::~Thread() {
  join();
}

void Thread::join() noexcept {
  if (std::exchange(running_, false)) {
    ::pthread_join(handle_, nullptr);
    stack_ = {};
  }
}

}  // namespace indurop::rt
