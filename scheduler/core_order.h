// SPDX-License-Identifier: Apache-2.0
// How the order of Table 3 is kept among modules of several cores.

#pragma once

namespace indurop::scheduler {

enum class CoreOrder {
  Data,   // within a tick a module waits for those of other cores it exchanges data with (Task::after)
  Total,  // a module waits for all of higher priority
};

}  // namespace indurop::scheduler
