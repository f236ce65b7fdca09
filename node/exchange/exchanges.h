// SPDX-License-Identifier: Apache-2.0
// Exchanges of modules while the node runs: accepts commands, about one module at a time or several at once. Called by
// the thread that supervises the node.

#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "config/check/check.h"
#include "node/exchange/exchange_set.h"
#include "node/exchange/version_exchange.h"

namespace indurop::node {

class Exchanges {
 public:
  using Parts = ExchangeParts;
  // `check`: as the node starts. `phases`: their faults have no effect on the plant.
  Exchanges(const Parts& parts, const config::CheckResult& check, const Phases& phases);
  Exchanges(const Exchanges&) = delete;
  Exchanges& operator=(const Exchanges&) = delete;
  ~Exchanges() = default;

  // Connects them with changes of the schedule, before any command is accepted. `schedule` is borrowed.
  void connect(ScheduleChange& schedule) noexcept { context_.schedule = &schedule; }
  // Accepts commands and continues the exchanges in progress.
  void poll(rt::MonoTime now);
  // Called when the schedule has ended.
  void end();
  // Returns true while it is not settled which version of the module runs.
  [[nodiscard]] bool is_open(std::uint32_t module) const noexcept;
  // A module was added, as the next one of the run block. `access`: what it may read and write; `configured`: what it
  // uses by the configuration.
  void add(const AllowedAccess& access, ConfiguredUses configured);
  // Returns "module press is being exchanged"; empty: none is.
  [[nodiscard]] std::string activity() const;

 private:
  void begin_version(std::uint32_t module);
  void accept(std::uint32_t module, scheduler::ModuleCommand command);
  void accept_back(std::uint32_t module);
  void go_on(rt::MonoTime now);
  // Returns true while a module is exchanged alone.
  [[nodiscard]] bool is_under_way() const noexcept { return single_ != nullptr; }
  // Returns the module that is being exchanged; empty: none.
  [[nodiscard]] std::string exchanged_module() const;
  void answer(std::uint32_t module, scheduler::CommandResult result, const std::string& text);
  [[nodiscard]] scheduler::ModuleRecord& record(std::uint32_t module) const noexcept {
    return context_.parts.run.modules()[module];
  }

  ExchangeContext context_;
  std::uint32_t module_ = 0;                 // of `single_`
  std::unique_ptr<VersionExchange> single_;  // null: none is in progress
  ExchangeSet set_;
};

}  // namespace indurop::node
