// SPDX-License-Identifier: Apache-2.0
// What a debugger answered at each stop of a simulation since its start. The same answers lead to the same stops again.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/plc/debug_link.h"

namespace indurop::tools {

class DebugHistory {
 public:
  struct Answer {
    DebugMode mode = DebugMode::ToBreakpoint;
    std::vector<std::uint32_t> breakpoints;  // sorted
    friend bool operator==(const Answer&, const Answer&) = default;
  };

  // Number of answers; the program has stopped after the last of them.
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  void add(const Answer& answer);
  [[nodiscard]] const Answer& at(std::uint64_t number) const;

  // A variable that was set at the present stop, as `indurop set` takes it.
  void add_set(std::string assignment) { sets_.emplace_back(size_, std::move(assignment)); }
  [[nodiscard]] std::vector<std::string> sets_at(std::uint64_t number) const;

  // The present stop is the begin of a scan.
  void note_scan() { scans_.push_back(size_); }
  // The begins of scans, as numbers of their answers, oldest first.
  [[nodiscard]] const std::vector<std::uint64_t>& scans() const noexcept { return scans_; }

  // Forgets this answer and all after it.
  void cut(std::uint64_t number);

 private:
  std::uint64_t size_ = 0;
  std::vector<std::pair<std::uint64_t, Answer>> changes_;  // by the first number; equal ones in a row are kept once
  std::vector<std::pair<std::uint64_t, std::string>> sets_;
  std::vector<std::uint64_t> scans_;
};

}  // namespace indurop::tools
