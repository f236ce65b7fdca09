// SPDX-License-Identifier: Apache-2.0
// The code of a program that is debugged: which statements stand in which line, and the values a body sees.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plc/front/compiler.h"
#include "tools/plc/debug_link.h"

namespace indurop::tools {

// A line of a text, or a rung or step of a drawing.
struct CodeLine {
  std::string name;  // "motor.st:12", "POU main, rung 3"
  std::string text;  // of the source; "" if it is drawn
};

class DebugCode {
 public:
  explicit DebugCode(const plc::Compiled& compiled) : compiled_(compiled) {}

  // Null if there is no such module.
  [[nodiscard]] const plc::ModuleText* module(std::string_view name) const;
  [[nodiscard]] CodeLine line(const plc::DebugTable& table, std::uint32_t number);
  // Lines around it, the one itself marked.
  [[nodiscard]] std::vector<std::string> around(const plc::DebugTable& table, std::uint32_t number);

  // "12", "motor.st:12", "rung 3", "main rung 3", "Motor": the first statement of that line or of the next one with
  // code. `file`: the one meant by a number alone. Module by module.
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

// "t.ET" or "list[2]" of the frame, else of what is global. "" if there is no such variable.
[[nodiscard]] std::string debug_value(const plc::DebugTable& table, const DebugStop& stop, std::size_t frame,
                                      const std::string& name);
// "name = value" for each of them, hidden ones left out.
[[nodiscard]] std::vector<std::string> debug_values(const plc::FrameLayout& layout,
                                                    const std::vector<std::uint8_t>& bytes);

}  // namespace indurop::tools
