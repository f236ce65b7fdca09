// SPDX-License-Identifier: Apache-2.0
// A cell with a belt on which a job runs, instead of commands.

#pragma once

#include <map>
#include <string>

#include "belt_cell.h"

namespace indurop::robot {

// On belts, or on random ones.
template <class Base>
class JobOnBelt : public Base {
 protected:
  using Base::cell;
  void SetUp() override {}
  // Loads the job and starts it, with power.
  void run_job(const std::string& job) {
    Settings settings = Base::in_tick();
    settings.period = std::chrono::milliseconds(10);
    cell.sut = controller_of(cell_urdf(), job, settings);
    cell.in = {};
    for (DriveIn& drive : cell.in.drives) {
      drive.status = Cell::kSwitchOnDisabled;
    }
    values.clear();
    for (std::size_t i = 0; i < cell.sut->signals().size(); ++i) {
      cell.values[i] = 0;
      values[cell.sut->signals()[i]] = &cell.values[i];
    }
    this->judge = Judge(0.01, cell_urdf());
    this->step();
    cell.ask(Service::GroupEnable);
    ASSERT_TRUE(this->until([&] { return cell.out.state == GroupState::Standby; }));
    start_job();
  }
  void start_job() {
    tracked = false;
    *values.at("STEP") = 0;
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
  }
  // One period of a job that sets STEP to 1 in the period in which it begins to track.
  void note_begin() {
    if (*values["STEP"] == 1 && !tracked) {
      tracked = true;
      this->zero = this->belt(this->time);
    }
  }
  // The step that the job has come to.
  [[nodiscard]] bool until_step(double number) {
    return this->until([&] {
      note_begin();
      return *values["STEP"] >= number || ended();
    });
  }
  [[nodiscard]] bool ended() const { return cell.out.done == cell.in.service.number; }
  void expect_end() {
    ASSERT_TRUE(this->until([&] { return ended(); }));
    EXPECT_EQ(cell.out.error, ErrorCode::Ok) << this->message();
    EXPECT_EQ(cell.out.state, GroupState::Standby);
  }
  std::map<std::string, double*> values;
  bool tracked = false;
};

}  // namespace indurop::robot
