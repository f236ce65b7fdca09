// SPDX-License-Identifier: Apache-2.0
// What a process module keeps, in a replay: asked of the process, and put back by it, between two runs.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "node/modules/module_memory.h"
#include "store/tape/process_keyframes.h"

namespace indurop::node {

class ReplayedProcess {
 public:
  // What it keeps, as in a keyframe.
  struct State {
    std::string form;
    std::vector<std::uint8_t> bytes;
  };

  // Finds the memory of the process that runs now. Returns false if it does not declare what it keeps.
  bool open(const std::string& node, std::uint32_t module, std::int32_t node_pid);

  // Returns true if the process declares that it keeps nothing.
  [[nodiscard]] bool is_empty() const { return keyframes_ && keyframes_->form().empty(); }

  // Puts bytes of this form back. Returns the names of what was not possible with.
  std::vector<std::string> restore(std::string_view form, std::span<const std::uint8_t> bytes);

  // What it keeps now; nothing: it cannot be taken.
  std::optional<State> state();

  // The same in memory of this process; null: it cannot be taken.
  const ModuleMemory* memory();

 private:
  bool request(bool puts_back, std::uint64_t bytes);
  bool take();

  std::optional<tape::ProcessKeyframes> keyframes_;
  std::vector<std::uint8_t> bytes_;
  std::vector<StateItem> items_;  // the items of the form, in bytes_; those of its own functions follow
  std::string form_;
  ModuleMemory memory_;
};

}  // namespace indurop::node
