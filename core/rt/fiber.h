// SPDX-License-Identifier: Apache-2.0
// A function with a stack of its own that runs on the calling thread until it pauses: many threads of a program, one
// after the other, on one thread of the system. Only the caller of resume() decides when it runs.

#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "core/rt/thread.h"

namespace indurop::rt {

class Fiber {
 public:
  // Does not start it yet. Not real-time safe. ok() is false if there is no memory for the stack.
  Fiber(std::size_t stack_bytes, std::function<void()> body);
  // A fiber that has not ended is abandoned: destructors of objects on its stack do not run.
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;
  [[nodiscard]] bool ok() const noexcept;

  // Runs it until it pauses or ends. A guard entered in it is the thread's guard only during this call.
  void resume() noexcept;
  [[nodiscard]] bool ended() const noexcept;

  // Inside a fiber: returns the thread to the caller of resume().
  static void pause() noexcept;
  // The fiber the calling thread runs, null if none.
  static Fiber* current() noexcept;
  [[nodiscard]] StackBounds stack() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::rt
