// SPDX-License-Identifier: Apache-2.0
// Outputs that a job sets during its motions, at a distance or time from their beginning or end. Real-time safe.

#pragma once

#include <indurop/robot/controller.h>

#include <array>
#include <cstdint>

#include "control/robot/job/pulses.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

// An output that is to be set during a motion.
struct PathOutput {
  int signal = 0;
  double value = 0;
  std::uint32_t ticket = 0;  // of the motion
  bool by_time = false, after = false;
  double amount = 0;  // m or s, before the end of the motion or after its beginning
  double pulse = 0;   // s; 0: it is set permanently
};

class PathOutputs {
 public:
  // Returns false if the most are waiting already.
  bool add(const PathOutput& output) noexcept;
  [[nodiscard]] bool is_full() const noexcept;
  // Returns whether any is still to be set.
  [[nodiscard]] bool any() const noexcept;
  // Discards all, but continues to follow the motions.
  void clear() noexcept;
  // Discards those of this motion and of all after it.
  void discard_from(std::uint32_t ticket) noexcept;
  // Called once per period: sets the outputs that are due. After the end of its motion each one is set in any case.
  // `settled`: all motions have ended.
  void step(double seconds, const PathPlace& now, bool settled, Signals& signals, Pulses& pulses) noexcept;

 private:
  struct Trigger {
    bool waits = false;
    PathOutput output;
  };
  [[nodiscard]] bool is_due(const PathOutput& output, const PathPlace& now, bool settled) const noexcept;

  std::array<Trigger, 16> all_{};
  std::uint32_t present_ = 0;  // motion that was followed last
  double since_ = 0;           // s for which this motion has been followed
};

}  // namespace indurop::robot
