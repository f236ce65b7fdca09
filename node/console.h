// SPDX-License-Identifier: Apache-2.0
// What the node tells its user while it runs: text of the modules to stdout, faults, overruns and losses to stderr,
// summed up so that a permanent overrun cannot flood the terminal.

#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/message_ring.h"
#include "scheduler/run_block.h"

namespace indurop::node {

class Console {
 public:
  Console(std::string node, bool quiet) : node_(std::move(node)), quiet_(quiet) {}

  // Messages of the node itself; info() is left out by --quiet.
  template <class... Argument>
  void info(fmt::format_string<Argument...> format, Argument&&... arguments) {
    if (!quiet_) {
      line("", fmt::format(format, std::forward<Argument>(arguments)...));
    }
  }
  template <class... Argument>
  void warning(fmt::format_string<Argument...> format, Argument&&... arguments) {
    line("warning: ", fmt::format(format, std::forward<Argument>(arguments)...));
  }
  template <class... Argument>
  void error(fmt::format_string<Argument...> format, Argument&&... arguments) {
    line("error: ", fmt::format(format, std::forward<Argument>(arguments)...));
  }

  void watch(scheduler::RunBlock& run);
  // Prints what has happened since the last call. `last`: also what was held back to be summed up.
  void report(std::int64_t now_ns, bool last);

 private:
  void line(std::string_view kind, std::string_view text) const;
  void print_messages(std::int64_t now_ns);
  void report_faults();
  void report_overruns(std::int64_t now_ns, bool last);
  void report_losses();

  struct Seen {
    std::uint64_t faults = 0;
    std::uint64_t overruns = 0;
    std::uint64_t misses = 0;
    std::uint64_t lost_messages = 0;
  };
  std::string node_;
  bool quiet_;
  scheduler::RunBlock* run_ = nullptr;
  std::optional<runtime::MessageReader> reader_;  // none before watch()
  std::vector<Seen> seen_;
  std::int64_t next_summary_ns_ = 0;
};

}  // namespace indurop::node
