// SPDX-License-Identifier: Apache-2.0
// Goes back in a debugged simulation. Virtual time takes the same way again: the node is started again and gets the
// answers that it had got, up to the begin of the scan; the statements of that scan are then counted one by one.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/plc/debug_history.h"
#include "tools/cli/plc/debug_link.h"
#include "tools/cli/plc/debugged_node.h"

namespace indurop::tools {

class DebugBack {
 public:
  // Says whether `next` is a further statement of the line of `before`.
  using SameLine = std::function<bool(const DebugStop& before, const DebugStop& next)>;

  // All references are borrowed.
  DebugBack(DebuggedNode& node, DebugLink& link, DebugHistory& history, SameLine same_line)
      : node_(node), link_(link), history_(history), same_line_(std::move(same_line)) {}

  // Brings the program to the line that ran before the present stop, in this scan or the one before. Returns the stop
  // there, and the history leads to it; nothing if there is no earlier line, or the simulation took another way (then
  // the program has to be started again). Waits for as long as the simulation takes.
  std::optional<DebugStop> line_before();
  // Returns true if the last failure has left the program somewhere else.
  [[nodiscard]] bool is_lost() const noexcept { return lost_; }

 private:
  struct Trail {
    std::vector<DebugStop> stops;                           // of one scan, statement by statement
    std::vector<std::pair<std::size_t, std::string>> sets;  // before the answer to this one of them
    bool whole = false;                                     // the scan ended; else the last one is the present stop
  };

  std::optional<DebugStop> wait();
  std::optional<DebugStop> go_to(std::uint64_t number, bool silent);
  bool follow(std::uint64_t begin, std::uint64_t end, Trail& trail);
  [[nodiscard]] std::optional<std::size_t> begin_of_line_before(const Trail& trail) const;
  std::optional<DebugStop> repeat(std::uint64_t begin, const Trail& trail, std::size_t target);

  DebuggedNode& node_;
  DebugLink& link_;
  DebugHistory& history_;
  SameLine same_line_;
  bool lost_ = false;
};

}  // namespace indurop::tools
