// SPDX-License-Identifier: Apache-2.0
// Disk and network interrupts that the kernel assigns to a core that runs ticks: each takes time from a tick.

#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "tools/cli/doctor/doctor_checks.h"

namespace indurop::tools {

enum class Movable { Yes, No, Unknown };

// Returns whether the kernel allows a user to choose the core of interrupt `number`. Only root can find out, for other
// users it is unknown; nothing is changed.
Movable can_move_interrupt(int number);

// `cores`: those that run ticks. `root` is put before /proc and /sys; `movable` is called for interrupts that fired
// there (tests use copies).
Finding examine_interrupts(const std::vector<int>& cores, const std::filesystem::path& root = "/",
                           const std::function<Movable(int)>& movable = can_move_interrupt);

}  // namespace indurop::tools
