// SPDX-License-Identifier: Apache-2.0
// The code of a program that is debugged: the statements of each line, and the values that a body accesses.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/front/compiler.h"
#include "tools/cli/plc/debug_link.h"

namespace indurop::tools {

// A line of a text, or a rung or step of a drawing.
struct CodeLine {
  std::string name;  // "motor.st:12", "POU main, rung 3"
  std::string text;  // source text; "" for a drawing
};

class DebugCode {
 public:
  explicit DebugCode(const plc::Compiled& compiled) : compiled_(compiled) {}

  // Null if there is no such module.
  [[nodiscard]] const plc::ModuleText* module(std::string_view name) const;
  [[nodiscard]] CodeLine line(const plc::DebugTable& table, std::uint32_t number);
  // Returns the lines around it, with a mark on the line itself.
  [[nodiscard]] std::vector<std::string> around(const plc::DebugTable& table, std::uint32_t number);

  // A breakpoint at "12", "motor.st:12", "rung 3", "main rung 3" or "Motor": the first statement of that line or of the
  // next one with code, in each module. `file`: the file of a line number without file name.
  struct Breakpoint {
    std::string asked;
    CodeLine line;
    std::map<std::string, std::vector<std::uint32_t>> numbers;  // by module
  };
  [[nodiscard]] std::optional<Breakpoint> find(const std::string& what, const std::string& file);

 private:
  const std::vector<std::string>& source(const std::string& file);

  const plc::Compiled& compiled_;
  std::map<std::string, std::vector<std::string>> sources_;
};

// Returns the value of "t.ET" or "list[2]" in the frame, else of a global variable. "" if there is no such variable.
[[nodiscard]] std::string debug_value(const plc::DebugTable& table, const DebugStop& stop, std::size_t frame,
                                      const std::string& name);
// Returns "name = value" for each variable, without hidden ones.
[[nodiscard]] std::vector<std::string> debug_values(const plc::FrameLayout& layout,
                                                    const std::vector<std::uint8_t>& bytes);

}  // namespace indurop::tools
