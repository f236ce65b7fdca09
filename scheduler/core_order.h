// SPDX-License-Identifier: Apache-2.0
// The ways to keep the order of Table 3 among modules of several cores.

#pragma once

namespace indurop::scheduler {

enum class CoreOrder {
  Data,   // within a tick a module waits for those of other cores it exchanges data with (Task::after)
  Total,  // a module waits for all of higher priority
};

}  // namespace indurop::scheduler
