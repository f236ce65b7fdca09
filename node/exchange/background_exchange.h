// SPDX-License-Identifier: Apache-2.0
// The exchange of one thread module in the background: its thread ends after a run, and continues with the new version.

#pragma once

#include <cstdint>

#include "node/exchange/thread_exchange.h"

namespace indurop::node {

class BackgroundExchange : public ThreadExchange {
 public:
  BackgroundExchange(ExchangeContext& context, std::uint32_t module, bool held)
      : ThreadExchange(context, module, held) {}

  void go_on(rt::MonoTime now) override;
  void go_back() override;
  void end() override;

  void enter(std::uint64_t tick) override { tick_ = tick; }
  void settle() override;
  [[nodiscard]] bool is_ready() const noexcept override { return step_ == Step::Ready; }
  [[nodiscard]] bool has_exchanged() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool runs_new() const noexcept override { return runs_new_; }
  [[nodiscard]] bool is_over() const noexcept override { return step_ == Step::Over; }
  [[nodiscard]] bool is_prepared() const noexcept override { return step_ >= Step::Ready; }
  [[nodiscard]] bool is_watched() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool is_open() const noexcept override { return step_ > Step::Ready && step_ < Step::Watched; }

 private:
  enum class Step {
    Preparing,
    Ready,      // it waits for its tick
    Leaving,    // the thread is to end after its run
    Returning,  // the same, for the previous version
    Watched,    // the new version runs; the previous one is ready
    Over,
  };
  void go_on_preparing(rt::MonoTime now);
  void leave(rt::MonoTime now);
  void await_left(rt::MonoTime now);
  void enter_new(rt::MonoTime now);
  void check_health(rt::MonoTime now);
  void go_back(scheduler::Exchange::Reason reason, rt::MonoTime now);
  void return_previous();
  // The other version runs from now on, with what the one before it keeps if it is sound.
  void swap(bool carries);
  void abort(const std::string& why);
  void discard_other();

  Step step_ = Step::Preparing;
  std::uint64_t tick_ = 0;
  bool runs_new_ = false;
  rt::MonoTime deadline_{};                                                 // of this step
  scheduler::Exchange::Reason reason_ = scheduler::Exchange::Reason::None;  // of the way back
};

}  // namespace indurop::node
