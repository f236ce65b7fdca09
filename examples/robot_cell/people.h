// SPDX-License-Identifier: Apache-2.0
// The people around the cell and what they see: buttons of the panel, the visitor of the tour, CELL::world.
#pragma once

#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <cstdint>
#include <string_view>

#include "surroundings.h"
#include "tour.h"

// What is pressed by hand, and by the visitor of the tour `time` seconds after its beginning; less than 0: there is
// none.
inline Panel pressed(double time, std::string_view& doing) {
  const auto by_hand = INDUROP_TYPEOF(CELL::panel)(CELL::panel);
  Panel panel{by_hand.start, by_hand.stop, by_hand.reset, by_hand.emergency_stop, by_hand.curtain};
  doing = "";
  for (const TourStep& step : kTour) {
    if (time >= step.from && time < step.to) {
      panel.*step.what = true;
      doing = step.text;
    }
  }
  return panel;
}

// Calls set(number, value) for each input that is wired, I0 to I15 of the cell.
template <class Set>
void wire(const Panel& panel, const Surroundings& cell, const Set& set) {
  set(0, panel.start);
  set(1, !panel.stop);
  set(2, panel.reset);
  set(3, cell.part_at_end());
  set(4, cell.holds());
  set(5, cell.open());
  set(6, cell.pallet_has_room());
  set(7, true);
  set(14, !panel.emergency_stop);
  set(15, !panel.curtain);
}

inline void show(const Surroundings& cell, std::string_view doing, std::uint32_t requests) {
  INDUROP_TYPEOF(CELL::world) now = CELL::world;
  now.belt = cell.belt();
  now.opening = 100 * cell.opening();
  now.holds = cell.holds();
  now.on_pallet = cell.on_pallet();
  now.placed = cell.placed();
  now.lost = cell.lost();
  now.dots = cell.dots();
  now.spilled = cell.spilled();
  now.requests = requests;
  now.doing = doing;
  CELL::world = now;
}
