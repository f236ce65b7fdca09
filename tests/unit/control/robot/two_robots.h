// SPDX-License-Identifier: Apache-2.0
// Robots that share their space, with what each of them reads of the others: copies, as their modules make them. Where
// their bodies are is computed in another way (ReferenceArm).

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "group_cell.h"
#include "solid_reference.h"

namespace indurop::robot {

struct SharingRobot {
  std::string name;
  std::string job;
  std::vector<double> base{0, 0, 0, 0, 0, 0};  // mm, deg
  double turned = 90;                          // deg, where its first axis is at the start; the others are at 0
  int table = 0;                               // axes of its positioner
};

class SharingRobots {
 public:
  // All of them are the usual arm, some with a table. `shares`: false to show what happens without it.
  SharingRobots(const std::vector<SharingRobot>& robots, double period_ms, bool shares = true,
                std::vector<double> box = {0, -700, 0, 1400, 700, 1400});

  [[nodiscard]] Cell& operator[](std::size_t i) { return *cells_[i]; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] const SpaceReport& report(std::size_t i) const { return reports_[i]; }
  // One period of all, one after the other.
  void step();
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 20000) {
    for (int i = 0; i < most; ++i) {
      if (condition()) {
        return true;
      }
      step();
    }
    return false;
  }
  // Gives power to all; true if they have it.
  [[nodiscard]] bool enable();
  void start(std::size_t i) {
    cells_[i]->in.service.job = 1;
    cells_[i]->ask(Service::JobStart);
  }
  // m between the nearest bodies of two robots, `most` if that is less.
  [[nodiscard]] double apart(std::size_t one, std::size_t other, double most = 0.05) const;
  // Whether all bodies of a robot are in cells that it holds, as far as points of them show.
  [[nodiscard]] bool holds_its_bodies(std::size_t i) const;

 private:
  [[nodiscard]] std::vector<ReferencePlace> places(std::size_t i) const;

  std::vector<ReferenceArm> arms_;
  std::vector<double> box_;
  std::vector<Eigen::Isometry3d> bases_;
  std::vector<std::unique_ptr<Cell>> cells_;
  std::vector<SpaceReport> reports_;
  std::uint64_t tick_ = 0;
};

}  // namespace indurop::robot
