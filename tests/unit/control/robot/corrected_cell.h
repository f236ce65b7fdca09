// SPDX-License-Identifier: Apache-2.0
// A cell with a sensor, whose set points are judged in each period.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "group_cell.h"
#include "limit_judge.h"

namespace indurop::robot {

inline constexpr const char* kSeam =
    "POINT A = POSE 200 0 1300 RPY 180 0 0\nPOINT B = POSE 2700 0 1300 RPY 180 0 0\nPOINT C = POSE 200 400 1300 RPY "
    "180 0 0\n";

class CorrectedCell : public testing::Test {
 protected:
  void start(const std::string& job, double period_ms = 4, const std::string& urdf = urdf_of("gantry"),
             const JobTexts& others = {}) {
    cell = std::make_unique<Cell>(job, period_ms, 0, true, Settings{}, urdf, others);
    judge = std::make_unique<Judge>(period_ms / 1000, urdf);
    period = period_ms / 1000;
    for (std::size_t i = 0; i < cell->sut->signals().size(); ++i) {
      values[cell->sut->signals()[i]] = &cell->values[i];
    }
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    begin();
  }
  void begin() {
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  // One period, in which the sensor says what `sensor` writes.
  void step(double hardness = 1) {
    sensor();
    cell->step();
    EXPECT_EQ(judge->look(*cell, hardness), "") << "period " << cell->periods;
  }
  template <class Condition>
  bool follow(const Condition& condition, int most = 20'000) {
    for (int i = 0; i < most && !HasFailure(); ++i) {
      if (condition()) {
        return true;
      }
      step();
    }
    return false;
  }
  // 0: emergency stop, 1: fault of a drive, 2: disabled. It comes to rest within the limits.
  void stop(int kind) {
    cell->in.emergency = kind == 0;
    if (kind == 1) {
      cell->in.drives[0].status = Cell::kFault;
    } else if (kind == 2) {
      cell->ask(Service::GroupDisable);
    }
    for (int i = 0; i < 1000; ++i) {
      step(kEmergency);
    }
    EXPECT_EQ(cell->out.tool_speed, 0);
  }
  bool ended() const { return cell->out.done == cell->in.service.number; }
  bool resting() const { return cell->out.state == GroupState::Standby || cell->out.state == GroupState::ErrorStop; }
  double x() const { return cell->out.position[0]; }
  double y() const { return cell->out.position[1]; }
  double z() const { return cell->out.position[2]; }
  std::string message() const { return cell->out.job.message; }

  std::unique_ptr<Cell> cell;
  std::unique_ptr<Judge> judge;
  std::map<std::string, double*> values;
  std::function<void()> sensor = [] {};
  double period = 0.004;
};

}  // namespace indurop::robot
