// SPDX-License-Identifier: Apache-2.0
// Interrupts of disks and network that the kernel gives to a core where ticks run: each takes time from a tick.

#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "tools/doctor/doctor_checks.h"

namespace indurop::tools {

enum class Movable { Yes, No, Unknown };

// Whether the kernel lets a user say which core takes interrupt `number`. Root learns it, for others it is unknown;
// nothing is changed.
Movable can_move_interrupt(int number);

// `cores`: where ticks run. `root` is put before /proc and /sys, `movable` asked for what fired there (tests use
// copies).
Finding examine_interrupts(const std::vector<int>& cores, const std::filesystem::path& root = "/",
                           const std::function<Movable(int)>& movable = can_move_interrupt);

}  // namespace indurop::tools
