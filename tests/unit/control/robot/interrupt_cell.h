// SPDX-License-Identifier: Apache-2.0
// An arm that runs random jobs which are interrupted and stopped at any moment, and a judge of its set points.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "control/robot/job/job.h"
#include "limit_judge.h"

namespace indurop::robot {

// Each error of this job, which may call two others.
inline std::vector<std::string> interrupt_errors(const std::string& text) {
  std::vector<std::string> all;
  for (const auto& each :
       parse_jobs({{"main.job", text}, {"eject.job", "SET O1 ON\n"}, {"two.job", "PARAM a\n"}}).diagnostics) {
    all.push_back(base::to_text({each}));
  }
  return all;
}

inline const std::string kInterruptPoints =
    "POINT H = JOINT 0 -20 10 0 100 0\nTOOL pen = POSE 0 40 90 RPY 0 0 0\n"
    "POINT A = POSE 500 -250 300 RPY 180 0 180\nPOINT B = POSE 500 -100 200 RPY 180 0 150\n"
    "POINT C = POSE 450 100 300 RPY 170 10 180\nPOINT D = POSE 450 250 350 RPY 180 0 200\n"
    "POINT E = POSE 550 0 450 RPY 180 20 180\n";

// Sets `out` to the number of each of its motions that is not a joint motion, on its way.
inline std::string random_job(const std::string& interrupts, std::mt19937& random) {
  const auto one_of = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  const auto point = [&] { return std::string(1, static_cast<char>('A' + one_of(5))); };
  std::string job = kInterruptPoints + interrupts + "MOVJ H STRAIGHT\n";
  for (int i = 1; i <= 6; ++i) {
    job += one_of(3) == 0 ? fmt::format("SPEED {} mm/s\n", 100 + one_of(600)) : "";
    switch (one_of(5)) {
      case 0:
        job += "MOVJ " + point() + " STRAIGHT\n";
        continue;
      case 1:
        job += "MOVL A\nMOVC E D\n";
        break;
      case 2:
        job += "MOVS A B C D\n";
        break;
      default:
        job += "MOVL " + point() + "\n";
    }
    job += fmt::format("SET out = {} BEFORE {} mm\n", i, one_of(60));
  }
  return job + "SET out = 0\n";
}

inline Vec3 tip(const Cell& cell) {
  return {cell.out.position[0], cell.out.position[1], cell.out.position[2]};
}

inline double away(const std::vector<Vec3>& path, const Vec3& place) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 way = path[i] - path[i - 1];
    const double part = std::clamp((place - path[i - 1]).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    least = std::min(least, (place - path[i - 1] - part * way).squaredNorm());
  }
  return std::sqrt(least);
}

class JobMachine {
 public:
  JobMachine(const std::string& job, const JobTexts& others) {
    cell.sut = controller_of(cell_urdf(), job, {}, others);
    cell.step();
    EXPECT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
  }
  double& signal(const std::string& name) {
    const auto& names = cell.sut->signals();
    return cell.values[std::find(names.begin(), names.end(), name) - names.begin()];
  }
  // What is set on the way, in its order.
  void step() {
    cell.step();
    broken += judge_.look(cell, cell.in.emergency ? kEmergency : 1);
    if (signal("out") != last_) {
      last_ = signal("out");
      set.push_back(last_);
    }
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition) {
    for (int i = 0; i < 5000 && !condition(); ++i) {
      step();
    }
    return condition();
  }
  [[nodiscard]] bool ended() const { return cell.out.done == cell.in.service.number; }

  Cell cell;
  std::string broken;
  std::vector<double> set;

 private:
  Judge judge_{0.01};
  double last_ = 0;
};

// Behind an emergency stop at any moment, also of an interrupt that comes, is served or returns.
inline void go_on(JobMachine& sut) {
  sut.cell.in.emergency = true;
  ASSERT_TRUE(sut.cell.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }));
  sut.cell.in.emergency = false;
  for (int i = 0; i < 50; ++i) {
    sut.step();
  }
  ASSERT_TRUE(sut.cell.serve(Service::GroupReset)) << to_string(sut.cell.out.error);
  ASSERT_TRUE(sut.cell.serve(Service::GroupEnable)) << to_string(sut.cell.out.error);
  for (int i = 0; i < 4; ++i) {
    sut.step();
  }
  sut.broken.clear();  // the judge did not see the stop
  ASSERT_TRUE(sut.cell.out.job.can_resume);
  sut.cell.ask(Service::JobResume);
}

}  // namespace indurop::robot
