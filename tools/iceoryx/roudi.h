// SPDX-License-Identifier: Apache-2.0
// Finds out whether iceoryx's daemon RouDi runs on this machine, without iceoryx: its own check blocks for a minute and
// then aborts the program.

#pragma once

#include <sys/types.h>

#include <cstdint>

namespace indurop::iceoryx {

struct Roudi {
  enum class State { Absent, NoPermission, There };
  State state = State::Absent;
  // Identifies the daemon, to notice when another one replaces it.
  ino_t inode = 0;
  std::int64_t since_ns = 0;

  bool operator==(const Roudi&) const = default;
};

Roudi find_roudi() noexcept;

}  // namespace indurop::iceoryx
