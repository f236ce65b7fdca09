// SPDX-License-Identifier: Apache-2.0
// The prompt of indurop plc debug: breakpoints, steps, values. Reads standard input, so it can be a script.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"
#include "tools/cli/plc/debug_back.h"
#include "tools/cli/plc/debug_code.h"
#include "tools/cli/plc/debug_history.h"
#include "tools/cli/plc/debug_link.h"
#include "tools/cli/plc/debugged_node.h"

namespace indurop::tools {

class DebugSession {
 public:
  // All references are borrowed; the node was started. `ends`: the simulation ends on its own.
  DebugSession(Context& context, const plc::Compiled& compiled, DebugLink& link, DebuggedNode& node, bool ends);

  // Runs until the user leaves or the node ends. Returns the exit code.
  int run();

 private:
  enum class Aim { Run, Into, Over, Out, Scan };

  // Returns false if the session is over.
  bool meet(const DebugStop& stop);
  void go_on(DebugMode mode);
  void begin_of_scan(const DebugStop& stop);
  bool is_same_line(const DebugStop& before, const DebugStop& next);
  [[nodiscard]] DebugMode mode_of_aim() const;
  // Reads commands until one lets the program continue; returns false to leave.
  bool prompt();
  // Executes a command. Nothing: stay at the prompt.
  std::optional<bool> obey(const std::string& line);
  bool aim(Aim aim);
  // Returns whether a user, a breakpoint or the end of the simulation can stop the program once it runs.
  [[nodiscard]] bool can_stop() const { return prompts_ || ends_ || !breakpoints_.empty(); }
  std::optional<bool> travel(const std::string& verb, const std::string& rest);
  bool go_back();
  void stand_at(const DebugStop& stop);
  void show_values(const std::string& verb, const std::string& rest);
  void print_place();
  void print(const std::string& names);
  void where();
  void add_breakpoint(const std::string& what, bool once);
  void remove_breakpoint(const std::string& what);
  void set(const std::string& assignment);
  [[nodiscard]] std::string time_of(const DebugStop& stop) const;
  [[nodiscard]] const plc::DebugTable& table() const { return code_.module(stop_.module)->debug; }

  struct Breakpoint {
    DebugCode::Breakpoint at;
    bool once = false;
  };
  Context& context_;
  DebugCode code_;
  DebugLink& link_;
  DebuggedNode& node_;
  DebugHistory history_;
  std::string first_file_;
  std::vector<Breakpoint> breakpoints_;
  Aim aim_ = Aim::Into;
  std::uint64_t scans_left_ = 0;
  std::size_t frame_ = 0;
  DebugStop stop_;  // the stop shown last
  std::string stop_line_;
  std::optional<std::int64_t> began_ns_;
  bool prompts_ = false;
  bool ends_;
};

}  // namespace indurop::tools
