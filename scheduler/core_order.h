// SPDX-License-Identifier: Apache-2.0
// What keeps the order of Table 3 among modules of several cores.

#pragma once

namespace indurop::scheduler {

enum class CoreOrder {
  Data,   // within a tick a module waits for those of other cores that data comes from or goes to (Task::after)
  Total,  // for all of higher priority
};

}  // namespace indurop::scheduler
