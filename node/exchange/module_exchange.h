// SPDX-License-Identifier: Apache-2.0
// The exchange of one thread module of the schedule: from one run to the next, its new version is entered.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "node/exchange/thread_exchange.h"

namespace indurop::node {

class ModuleExchange : public ThreadExchange {
 public:
  ModuleExchange(ExchangeContext& context, std::uint32_t module, bool held) : ThreadExchange(context, module, held) {}

  // Begins an exchange with the previous version.
  void begin_back(scheduler::Exchange::Reason reason);
  void go_on(rt::MonoTime now) override;
  void go_back() override;
  void end() override;

  void enter(std::uint64_t tick) override { watch(tick); }
  void settle() override;
  [[nodiscard]] bool is_ready() const noexcept override { return step_ == Step::Ready; }
  [[nodiscard]] bool has_exchanged() const noexcept override { return step_ == Step::Watched && !back_; }
  [[nodiscard]] bool runs_new() const noexcept override { return exchanged_ != back_; }
  [[nodiscard]] bool is_over() const noexcept override { return step_ == Step::Over; }
  [[nodiscard]] bool is_prepared() const noexcept override { return step_ >= Step::Ready; }
  [[nodiscard]] bool is_watched() const noexcept override { return step_ == Step::Watched; }
  [[nodiscard]] bool is_open() const noexcept override;

 private:
  enum class Step {
    Preparing,
    Ready,    // held: waits for its tick
    Waiting,  // for the run that is the first of the other version
    Watched,  // it runs; the previous version is ready
    Leaving,  // the run that may still ask the exchange is in progress
    Over,
  };

  void go_on_preparing(rt::MonoTime now);
  void prepared();
  void replace_closed();
  void watch(std::uint64_t tick);
  void wait_for_exchange();
  void offer_copy();
  void note_exchanged();
  void check_health();
  void save_for_return();
  void note_returned();
  void return_closed();
  void leave();
  void has_left();
  void abort(const std::string& why);
  void discard_other();

  Step step_ = Step::Preparing;
  bool back_ = false;             // to the previous version
  rt::MonoTime deadline_{};       // of this step, in the node's time
  std::vector<std::byte> saved_;  // what the running version kept in a gap, if a normal thread copies
  std::size_t saved_bytes_ = 0;
  std::unique_ptr<scheduler::Exchange> exchange_;
  std::uint64_t skipped_before_ = 0;
  std::uint64_t overruns_before_ = 0;
  bool exchanged_ = false;  // `other_` is the previous version
  std::optional<scheduler::Exchange::Reason> then_back_;
  scheduler::Exchange::Reason reason_ = scheduler::Exchange::Reason::Command;  // of `back_`
};

}  // namespace indurop::node
