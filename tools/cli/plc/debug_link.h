// SPDX-License-Identifier: Apache-2.0
// The connection to the modules of a simulated node that were built with --debug (include/indurop/plc/debug.h).

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/descriptor.h"

namespace indurop::tools {

// The place at which a module has stopped. It waits for an answer.
struct DebugStop {
  enum class Kind { Begin, Line, Fault };
  struct Frame {
    std::uint32_t number = 0;
    std::vector<std::uint8_t> values;
  };
  Kind kind = Kind::Begin;  // begin of a scan; before the statement `line`; a fault in it
  std::int64_t time_ns = 0;
  std::uint64_t mark = 0;
  std::uint32_t line = 0;
  std::string module;
  std::string why;            // Fault
  std::vector<Frame> frames;  // the innermost first
  std::vector<std::uint8_t> globals;
};

enum class DebugMode : char { ToBreakpoint = 'c', Into = 'i', Over = 'o', Out = 'u' };

class DebugLink {
 public:
  // Listens at this path. Check is_open().
  explicit DebugLink(const std::filesystem::path& path);
  [[nodiscard]] bool is_open() const noexcept { return listener_.get() >= 0; }

  // Returns the next stop, nothing if no module has reported one within this time.
  std::optional<DebugStop> wait(int milliseconds);
  // Lets the module that stopped last continue.
  void answer(DebugMode mode, const std::vector<std::uint32_t>& breakpoints);
  // Lets all modules continue without further stops; others may connect.
  void release() { modules_.clear(); }
  // The same, and no others may connect.
  void close();

 private:
  std::optional<DebugStop> read(std::size_t which);

  base::Descriptor listener_;
  std::vector<base::Descriptor> modules_;
  std::size_t last_ = 0;
};

}  // namespace indurop::tools
