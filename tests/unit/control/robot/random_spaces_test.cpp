// SPDX-License-Identifier: Apache-2.0
// Robots that share their space, with random jobs, holds, overrides, stops, emergencies and failing drives at random
// instants: their bodies, which are placed and measured in another way, never touch, and each robot holds the cells
// where its bodies are. Some have tables, which turn within the reach of others. INDUROP_ROBOT_SPACES says how many
// runs, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "robot_fixture.h"
#include "two_robots.h"

namespace indurop::robot {
namespace {

// Motions all around, most of them in front of the robot, or above its table, which has `table` axes.
std::string random_motions(std::mt19937& random, int table = 0) {
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto one_of = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  std::string job;
  constexpr int kPoints = 8;
  const auto tilted = [&] { return in(-40, 40); };
  const auto turned = [&] { return in(-150, 150); };
  const auto axes = [&] {
    return table == 2 ? fmt::format(" AXIS 7 {} AXIS 8 {}", tilted(), turned()) : fmt::format(" AXIS 7 {}", turned());
  };
  for (int i = 0; i < kPoints; ++i) {
    if (i % 2 == 0) {
      job += fmt::format("POINT P{} = JOINT {} {} {} {} {} {}", i,
                         table > 0 ? in(35, 100) * (1 - 2 * one_of(2)) : in(-100, 100), in(-40, 80), in(-90, 30),
                         in(-90, 90), in(-80, 80), in(-180, 180));
      job += (table == 2 ? fmt::format(" {}", tilted()) : "") + (table > 0 ? fmt::format(" {}", turned()) : "") + "\n";
    } else if (table > 0) {
      job += fmt::format("POINT P{} = POSE {} {} {} RPY 180 0 {}{}\n", i, in(-300, 300), in(-300, 300), in(60, 400),
                         in(-60, 60), one_of(2) == 0 ? axes() : "");
    } else {
      job += fmt::format("POINT P{} = POSE {} {} {} RPY 180 0 {}\n", i, in(350, 750), in(-400, 400), in(200, 700),
                         in(-60, 60));
    }
  }
  job += table > 0 ? "TRY\nMOVJ P0\nRECOVER\nWAIT 0.1 s\nEND\n" : "MOVJ P0\n";
  for (int i = 0; i < 12; ++i) {
    if (one_of(4) == 0) {
      job += fmt::format("SPEED {}%\n", 20 + one_of(81));
    }
    if (one_of(4) == 0) {
      job += fmt::format("ZONE {} mm\n", one_of(2) * (5 + one_of(60)));
    }
    const int to = one_of(kPoints);
    const bool line = to % 2 != 0 && one_of(3) == 0;
    const std::string where = table > 0 && one_of(4) == 0 ? "HERE" + axes() : fmt::format("P{}", to);
    job += fmt::format("TRY\nMOV{} {}\nRECOVER\nWAIT 0.1 s\nEND\n", line ? "L" : "J", where);
    if (one_of(5) == 0) {
      job += fmt::format("WAIT {:.2f} s\n", in(0.1, 1));
    }
  }
  return job;
}

class Random_spaces : public testing::Test {
 protected:
  double least = HUGE_VAL;  // m between robots
  std::map<std::string, int> seen;

  template <class Run>
  void run_all(int usual, const Run& run_one) {
    const int first = number_of("INDUROP_ROBOT_SEED", usual);
    const int many = number_of("INDUROP_ROBOT_SPACES", 12);
    for (int i = 0; i < many && !HasFatalFailure(); ++i) {
      run_one(static_cast<unsigned>(first + i));
    }
    for (const auto& [what, times] : seen) {
      fmt::print("{:8} {}\n", times, what);
    }
    fmt::print("{:.1f} mm between robots at least\n", 1000 * least);
  }

  void run(unsigned seed, bool shares, bool disturbs) {
    std::mt19937 random(seed);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    std::vector<SharingRobot> robots{{"A", random_motions(random)},
                                     {"B", random_motions(random), {in(850, 1300), in(-200, 200), 0, 0, 0, 180}}};
    if (seed % 4 == 3) {
      robots.push_back({"C", random_motions(random), {in(300, 700), in(850, 1100), 0, 0, 0, -90}});
    }
    run(robots, {0, -700, 0, 1400, 700, 1400}, random, seed, shares, disturbs);
  }

  // The table of A is between both; that of B, if it has one, is within the reach of A.
  void run_with_tables(unsigned seed, bool shares, bool disturbs) {
    std::mt19937 random(seed);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const int first = 1 + static_cast<int>(seed % 2);
    const int second = static_cast<int>(seed / 2 % 3);
    const double x = second > 0 ? in(1850, 2100) : in(1200, 1450);
    run({{"A", random_motions(random, first), {0, 0, 0, 0, 0, 0}, 90, first},
         {"B", random_motions(random, second), {x, in(-100, 200), 0, 0, 0, 180}, 90, second}},
        {0, -800, 0, x + 100, 800, 1400}, random, seed, shares, disturbs);
  }

 private:
  void run(const std::vector<SharingRobot>& robots, const std::vector<double>& box, std::mt19937& random, unsigned seed,
           bool shares, bool disturbs) {
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double period_ms = seed % 3 == 0 ? 2 : seed % 3 == 1 ? 4 : 10;
    SharingRobots sut(robots, period_ms, shares, box);
    ASSERT_TRUE(sut.enable()) << "seed " << seed;
    for (int i = 0; i < 20000 / period_ms; ++i) {
      for (std::size_t k = 0; k < sut.size(); ++k) {
        if (disturbs && in(0, 1) < 0.3 * period_ms / 1000) {
          disturb(sut[k], random);
        }
        if (!disturbs && sut[k].out.state == GroupState::ErrorStop) {
          EXPECT_EQ(sut[k].out.error, ErrorCode::OtherRobot)
              << "seed " << seed << ", period " << i << ", robot " << k << ": " << sut[k].out.job.message;
        }
        recover(sut, k);
      }
      sut.step();
      constexpr double kEach = 10;  // ms
      if (i % static_cast<int>(kEach / period_ms) == 0) {
        judge(sut, shares, fmt::format("seed {}, period {} of {} ms", seed, i, period_ms));
      }
      if (HasFatalFailure()) {
        return;
      }
    }
    for (std::size_t k = 0; k < sut.size(); ++k) {
      seen["motions that ended"] += static_cast<int>(sut[k].out.job.cycles);
      seen["intrusions"] += static_cast<int>(sut.report(k).intrusions);
    }
  }

  // Starts each job again, and resets and enables a robot that stopped.
  void recover(SharingRobots& sut, std::size_t k) {
    Cell& cell = sut[k];
    if (cell.out.done != cell.in.service.number && cell.out.error == ErrorCode::Ok) {
      return;
    }
    if (cell.out.state == GroupState::ErrorStop) {
      seen[to_string(cell.out.error)] += cell.in.service.code == static_cast<int>(Service::GroupReset) ? 0 : 1;
      cell.in.emergency = false;
      for (DriveIn& drive : cell.in.drives) {
        drive.status = drive.status == Cell::kFault ? Cell::kSwitchOnDisabled : drive.status;
      }
      cell.ask(Service::GroupReset);
    } else if (cell.out.state == GroupState::Disabled) {
      cell.ask(Service::GroupEnable);
    } else if (cell.out.state == GroupState::Standby) {
      cell.in.service.job = 1;
      cell.ask(cell.out.job.can_resume ? Service::JobResume : Service::JobStart);
    }
  }

  static void disturb(Cell& cell, std::mt19937& random) {
    switch (std::uniform_int_distribution<int>(0, 9)(random)) {
      case 0:
      case 1:
        cell.in.hold = !cell.in.hold;
        break;
      case 2:
      case 3:
        cell.in.speed_override = std::uniform_real_distribution<double>(0, 100)(random);
        break;
      case 4:
        cell.ask(Service::Stop);
        break;
      case 5:
        cell.in.emergency = true;
        break;
      case 6:
        cell.in.drives[std::uniform_int_distribution<std::size_t>(0, 7)(random)].status = Cell::kFault;
        break;
      case 7:
        cell.ask(Service::GroupDisable);
        break;
      default:
        cell.in.hold = false;
        cell.in.speed_override = 100;
    }
  }

  void judge(SharingRobots& sut, bool shares, const std::string& where) {
    for (std::size_t k = 0; k < sut.size(); ++k) {
      for (std::size_t other = 0; other < k; ++other) {
        const double apart = sut.apart(k, other);
        least = std::min(least, apart);
        if (shares) {
          ASSERT_GT(apart, 0) << where;
        }
      }
      if (shares) {
        ASSERT_TRUE(sut.holds_its_bodies(k)) << where << ", robot " << k;
        seen["periods of waiting"] += sut.report(k).waits_for.view().empty() ? 0 : 1;
        seen["periods"] += 1;
      }
    }
  }
};

TEST_F(Random_spaces, Robots_never_touch) {
  run_all(1, [&](unsigned seed) { run(seed, true, false); });
}

TEST_F(Random_spaces, Robots_never_touch_whatever_happens) {
  run_all(1001, [&](unsigned seed) { run(seed, true, true); });
}

TEST_F(Random_spaces, Robots_and_tables_never_touch) {
  run_all(1, [&](unsigned seed) { run_with_tables(seed, true, false); });
}

TEST_F(Random_spaces, Robots_and_tables_never_touch_whatever_happens) {
  run_all(1001, [&](unsigned seed) { run_with_tables(seed, true, true); });
}

// The judge sees it if robots do not share their space.
TEST_F(Random_spaces, Robots_touch_without_it) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    run(seed, false, false);
  }
  EXPECT_EQ(least, 0);
}

TEST_F(Random_spaces, Tables_touch_without_it) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    run_with_tables(seed, false, false);
  }
  EXPECT_EQ(least, 0);
}

}  // namespace
}  // namespace indurop::robot
