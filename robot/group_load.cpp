// SPDX-License-Identifier: Apache-2.0
// What the arm holds, for its torques: the tool's mass, and the load of a job.

#include "robot/group.h"

namespace indurop::robot {

// Nothing is planned.
void Group::weigh() noexcept {
  const JobBook& book = parts_.book;
  dynamics_.hold(joined(book.tools[static_cast<std::size_t>(tool_)].body, book.loads[static_cast<std::size_t>(load_)]));
}

bool Group::take_load(int load) noexcept {
  if (!settled() || desk_.holds_forgotten()) {
    return false;
  }
  load_ = load;
  weigh();
  return true;
}

}  // namespace indurop::robot
