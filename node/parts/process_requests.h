// SPDX-License-Identifier: Apache-2.0
// Asks process modules for keyframes, twice a second; each writes its own, between two of its runs.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "node/run/prepared.h"
#include "store/tape/process_keyframes.h"

namespace indurop::node {

class ProcessRequests {
 public:
  // `waits`: for each answer, as in a simulation, where keyframes must be the same each time. Borrowed: `prepared`.
  ProcessRequests(std::string node, const Prepared& prepared, bool waits);

  [[nodiscard]] bool empty() const noexcept { return subjects_.empty(); }
  // All of them are asked again.
  void begin_period();
  // Called repeatedly, on one normal thread.
  void ask();

 private:
  struct Subject {
    std::uint32_t module = 0;
    bool due = false;
    bool asked = false;  // since it is due
    std::int32_t pid = 0;
    std::optional<tape::ProcessKeyframes> keyframes = {};  // of this process
  };
  // Returns true if nothing more is to be done for it in this period.
  bool ask_one(Subject& subject);

  std::string node_;
  const Prepared& prepared_;
  bool waits_;
  std::vector<Subject> subjects_;
};

}  // namespace indurop::node
