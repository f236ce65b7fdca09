// SPDX-License-Identifier: Apache-2.0
#include "core/rt/fiber.h"

#include <ucontext.h>

#include <utility>

#include "core/rt/guard.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace indurop::rt {

struct Fiber::Impl {
  Stack stack;
  std::size_t stack_bytes = 0;
  std::function<void()> body;
  ucontext_t here{};
  ucontext_t resumer{};
  Fiber* outer = nullptr;  // the fiber that resumed this one
  Guard* guard = nullptr;  // the thread's guard inside
  bool ended = false;
#if defined(__SANITIZE_ADDRESS__)
  void* fake_stack = nullptr;
  const void* resumer_stack = nullptr;
  std::size_t resumer_bytes = 0;
#endif
#if defined(__SANITIZE_THREAD__)
  void* known = __tsan_create_fiber(0);
  void* known_resumer = nullptr;
  ~Impl() {
    __tsan_destroy_fiber(known);
  }
#endif
};

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): an entry function of makecontext is given ints
thread_local Fiber* t_current = nullptr;

}  // namespace

Fiber* Fiber::current() noexcept {
  return t_current;
}

Fiber::Fiber(std::size_t stack_bytes, std::function<void()> body) : impl_(std::make_unique<Impl>()) {
  impl_->stack = Stack(stack_bytes, false);
  impl_->stack_bytes = stack_bytes;
  impl_->body = std::move(body);
  if (!impl_->stack.ok() || ::getcontext(&impl_->here) != 0) {
    return;
  }
  impl_->here.uc_stack.ss_sp = impl_->stack.lowest();
  impl_->here.uc_stack.ss_size = stack_bytes;
  impl_->here.uc_link = nullptr;
  ::makecontext(
      &impl_->here,
      [] {
        Impl& self = *t_current->impl_;
#if defined(__SANITIZE_ADDRESS__)
        __sanitizer_finish_switch_fiber(nullptr, &self.resumer_stack, &self.resumer_bytes);
#endif
        self.body();
        self.ended = true;
        pause();
      },
      0);
}

Fiber::~Fiber() = default;

bool Fiber::ok() const noexcept {
  return impl_->stack.ok();
}

bool Fiber::ended() const noexcept {
  return impl_->ended;
}

StackBounds Fiber::stack() const noexcept {
  return {reinterpret_cast<const char*>(impl_->stack.lowest()), impl_->stack_bytes};
}

void Fiber::resume() noexcept {
  Impl& self = *impl_;
  self.outer = std::exchange(t_current, this);
  Guard* const outside = Guard::exchange_current(self.guard);
#if defined(__SANITIZE_ADDRESS__)
  void* fake_stack = nullptr;
  __sanitizer_start_switch_fiber(&fake_stack, self.stack.lowest(), self.stack_bytes);
#endif
#if defined(__SANITIZE_THREAD__)
  self.known_resumer = __tsan_get_current_fiber();
  __tsan_switch_to_fiber(self.known, 0);
#endif
  ::swapcontext(&self.resumer, &self.here);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(fake_stack, nullptr, nullptr);
#endif
  self.guard = Guard::exchange_current(outside);
  t_current = self.outer;
}

void Fiber::pause() noexcept {
  Impl& self = *t_current->impl_;
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_start_switch_fiber(self.ended ? nullptr : &self.fake_stack, self.resumer_stack, self.resumer_bytes);
#endif
#if defined(__SANITIZE_THREAD__)
  __tsan_switch_to_fiber(self.known_resumer, 0);
#endif
  ::swapcontext(&self.here, &self.resumer);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(self.fake_stack, &self.resumer_stack, &self.resumer_bytes);
#endif
}

}  // namespace indurop::rt
