// SPDX-License-Identifier: Apache-2.0
// Output of the node to its user while it runs: text of the modules to stdout, faults, overruns and losses to stderr,
// or all of it to the journal; summarized so that a permanent overrun cannot flood the terminal.

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "scheduler/run_block.h"
#include "store/runtime/message_ring.h"

namespace indurop::node {

class Console : public base::Log {
 public:
  Console(std::string_view node, bool quiet, std::shared_ptr<const base::Journal> journal = {})
      : base::Log("indurop-node", node, quiet, std::move(journal)) {}

  void watch(scheduler::RunBlock& run);
  // Prints the events since the last call. `last`: also those held back to be summarized.
  void report(rt::MonoTime now, bool last);
  // Prints what modules printed since the last call, as far as its reader takes it within `patience`.
  void print_messages(rt::MonoTime now, std::chrono::milliseconds patience);
  // Reports how many lines of the modules were dropped since the last call.
  void report_losses();

 private:
  void print_message(const runtime::Message& message) const;
  void report_faults();
  void report_overruns(rt::MonoTime now, bool last);

  struct Seen {
    std::uint64_t faults = 0;
    std::uint64_t overruns = 0;
    std::uint64_t misses = 0;
    std::uint64_t lost_messages = 0;
  };
  scheduler::RunBlock* run_ = nullptr;
  std::optional<runtime::MessageReader> reader_;  // none before watch()
  std::vector<Seen> seen_;
  rt::MonoTime next_summary_;
};

}  // namespace indurop::node
