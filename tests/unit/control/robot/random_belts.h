// SPDX-License-Identifier: Apache-2.0
// Random belts, tables and products.

#pragma once

#include <cmath>
#include <random>

#include "belt_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {

// Random belts, tables and products, with holds and overrides.
class RandomBelts : public Belts {
 protected:
  explicit RandomBelts(const std::string& urdf = "") : Belts(in_tick(), urdf) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int one_of(int most) { return std::uniform_int_distribution<int>(0, most - 1)(random); }

  // As steady as belts are, or swinging slowly.
  void choose_belt(bool turns) {
    const double most = turns ? 12 : 120;
    const double speed = between(-most, most);
    const double swings = one_of(2) == 0 ? 0 : between(0, most / 4);
    const double often = between(0.3, 2);
    belt = [=](double t) { return 1000 + speed * t + swings / often * std::sin(often * t); };
    resolution = one_of(2) == 0 ? 1e-4 : 0.01;
    // What filters of 30 ms make of a swing and of steps, once where the product is now, once where it was at first.
    const double size = turns ? 600 * kPi / 180 : 1;  // mm
    near = 0.01 + size * 2 * (6 * resolution + 20 * swings * often * often / 27000);
  }
  void choose_origin(bool turns) {
    const double way = between(-180, 180);
    from = turns ? Eight{between(450, 550), between(-60, 60), between(150, 250), 0, 0, way}
                 : Eight{between(450, 520), between(-80, 80), between(150, 250), 0, between(-5, 5), way};
    const double on_table = turns ? between(-90, 90) : between(-20, 20);
    on_it = {on_table, between(-20, 20), between(0, 20), 0, 0, -way + between(-30, 30)};
  }
  void disturb(int period) {
    if (period > 150) {
      cell.in.hold = false;
      cell.in.speed_override = 100;
      return;
    }
    if (one_of(60) == 0) {
      cell.in.hold = !cell.in.hold;
    }
    if (one_of(60) == 0) {
      cell.in.speed_override = between(0, 100);
    }
  }

  std::mt19937 random;
  Eight from{}, on_it{};
  double near = 0;
};

}  // namespace indurop::robot
