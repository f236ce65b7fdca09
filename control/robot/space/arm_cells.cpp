// SPDX-License-Identifier: Apache-2.0
#include "control/robot/space/arm_cells.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

void ArmCells::add(const Joints& q, const Joints& around, int tool, double more, SpaceCells& cells) const noexcept {
  ChainFrames frames;
  clearance_.frames_in_world(q, frames);
  for (std::size_t i = 0; i < clearance_.parts().size(); ++i) {
    if (counts(i, tool)) {
      const Clearance::Part& part = clearance_.parts()[i];
      grid_.add(Clearance::placed(part, frames), more + part.lever.dot(around), cells);
    }
  }
}

double ArmCells::most_moved(const Joints& moved, int tool) const noexcept {
  double most = 0;
  for (std::size_t i = 0; i < clearance_.parts().size(); ++i) {
    if (counts(i, tool)) {
      most = std::max(most, clearance_.parts()[i].lever.dot(moved));
    }
  }
  return most;
}

// One axis moves the bodies most. Places along it are stamped, at which the other axes may be anywhere on their ways;
// if these are not short, one place in the middle is better.
void ArmCells::add_way(const Joints& from, const Joints& to, int tool, double more, SpaceCells& cells) const noexcept {
  constexpr double kMostPlaces = 16;
  const Joints moved = (to - from).cwiseAbs();
  int main = 0;
  double most = 0;
  for (int i = 0; i < kAxes; ++i) {
    const double alone = most_moved(moved[i] * Joints::Unit(i), tool);
    if (alone > most) {
      main = i;
      most = alone;
    }
  }
  Joints others = moved;
  others[main] = 0;
  if (most_moved(others, tool) > most / 2) {
    add((from + to) / 2, moved / 2, tool, more, cells);
    return;
  }
  const int places = static_cast<int>(std::clamp(std::ceil(most / grid_.slack()), 1.0, kMostPlaces));
  Joints around = others;
  around[main] = moved[main] / places / 2;
  for (int i = 0; i < places; ++i) {
    add(from + (to - from) * ((i + 0.5) / places), around, tool, more, cells);
  }
}

}  // namespace indurop::robot
