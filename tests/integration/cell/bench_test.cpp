// SPDX-License-Identifier: Apache-2.0
// The bench of examples/robot_cell (camera.xml) in virtual time: what its jobs say they did is compared with where
// parts and pieces really are, for many random scenes.

#include <gmock/gmock.h>
#include <indurop/generated.h>
#include <indurop/testing.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace irp::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr std::uint16_t kSort = 1;
constexpr std::uint16_t kUnstack = 2;
// Where the jobs have to put things: the pallet's corner is at 350, 200, 150 in the base frame, and it is not turned.
constexpr double kPallet = 150;
constexpr double kWithin = 1;       // mm
constexpr double kTurned = 1;       // deg
constexpr double kSearched = 0.65;  // mm: noise of the sensor 0.2, 40 mm/s for a period 0.4, the touched pallet 0.05

struct Slot {
  double x, y;
};

Slot part_slot(std::size_t i) {
  const std::size_t row = i / 3;
  return {390 + 70 * static_cast<double>(i % 3), 240 + 70 * static_cast<double>(row)};
}
Slot piece_slot(std::size_t i) {
  return {370 + 48 * static_cast<double>(i), 390};
}

std::uint32_t count_of(const char* variable, std::uint32_t otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

// The largest deviations that were seen.
struct Worst {
  double distance = 0, angle = 0;
};

class Bench : public ::testing::Test {
 protected:
  Bench() : p(BENCH_DIR "/camera.xml") {}

  void lay_out(std::uint32_t seed, unsigned parts, unsigned others, unsigned pieces, unsigned snatch = 0) {
    p.set("BENCH::scene", "{seed: " + std::to_string(seed) + ", parts: " + std::to_string(parts) +
                              ", others: " + std::to_string(others) + ", pieces: " + std::to_string(pieces) +
                              ", snatch: " + std::to_string(snatch) + "}");
    p.step(2);
  }
  // Returns true if the job ends without an error.
  bool works(
      std::uint16_t job, const std::function<void()>& at_each_tick = [] {}) {
    const auto state = [this] { return p.get<std::string>("ROBOT_JOB.eState"); };
    p.set("BENCH::job", 0);
    p.step();
    p.set("BENCH::job", job);
    EXPECT_TRUE(p.run_until([&] { return state() == "ROBOT_JOB_RUNS" || state() == "ROBOT_JOB_WAITS"; }, 5s));
    EXPECT_TRUE(p.run_until(
        [&] {
          at_each_tick();
          return state() == "ROBOT_JOB_ENDED" || state() == "ROBOT_JOB_FAILED";
        },
        3min));
    return state() == "ROBOT_JOB_ENDED";
  }
  void request(const std::string& service) {
    p.set("ROBOT_MODULE_SERVICE", "{eOpCode: " + service + ", nRequest: " +
                                      std::to_string(p.get<unsigned>("ROBOT_MODULE_STATE.nAcknowledge") + 1) + "}");
    p.run(100ms);
  }
  [[nodiscard]] std::string message() const { return p.get<std::string>("ROBOT_JOB.cMessage"); }
  [[nodiscard]] std::vector<BENCH::Item> items(const std::string& name, std::size_t count, BENCH::State state) const {
    std::vector<BENCH::Item> found;
    for (std::size_t i = 0; i < count; ++i) {
      const auto item = p.get<BENCH::Item>("BENCH::" + name + "[" + std::to_string(i) + "]");
      if (item.state == state) {
        found.push_back(item);
      }
    }
    return found;
  }
  [[nodiscard]] std::array<BENCH::Item, 8> all_parts() const {
    return p.get<std::array<BENCH::Item, 8>>("BENCH::part");
  }
  // Each of the first slots has one of them, straight.
  void expect_in_slots(const std::vector<BENCH::Item>& put, Slot slot(std::size_t), Worst& worst) const {
    for (std::size_t i = 0; i < put.size(); ++i) {
      const Slot at = slot(i);
      const auto far = [&](const BENCH::Item& item) { return std::hypot(item.x - at.x, item.y - at.y); };
      const auto nearest = *std::min_element(
          put.begin(), put.end(), [&](const BENCH::Item& a, const BENCH::Item& b) { return far(a) < far(b); });
      EXPECT_LT(far(nearest), kWithin) << "slot " << i;
      EXPECT_LT(std::fabs(nearest.angle), kTurned) << "slot " << i;
      EXPECT_EQ(nearest.z, kPallet) << "slot " << i;
      worst.distance = std::max(worst.distance, far(nearest));
      worst.angle = std::max(worst.angle, std::fabs(nearest.angle));
    }
  }

  Plant p;
};

TEST_F(Bench, Vision_finds_a_part_in_any_pose) {
  const std::uint32_t seeds = count_of("INDUROP_BENCH_IMAGES", 100);
  Worst worst;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    lay_out(seed, 1, 0, 0);
    p.set("CAMERA::shot", seed);
    ASSERT_TRUE(p.run_until([&] { return p.get<std::uint32_t>("CAMERA::seen.shot") == seed; }, 1s));
    ASSERT_EQ(p.get<int>("CAMERA::seen.parts"), 1);
    const BENCH::Item part = items("part", 1, BENCH::LIES).at(0);
    const double mounted = BENCH::CAMERA_ANGLE * std::numbers::pi / 180;
    const auto x = p.get<double>("CAMERA::seen.x");
    const auto y = p.get<double>("CAMERA::seen.y");
    const double real_x = BENCH::CAMERA_X + x * std::cos(mounted) - y * std::sin(mounted);
    const double real_y = BENCH::CAMERA_Y + x * std::sin(mounted) + y * std::cos(mounted);
    const double turned = p.get<double>("CAMERA::seen.angle") + BENCH::CAMERA_ANGLE - part.angle;
    worst.distance = std::max(worst.distance, std::hypot(real_x - part.x, real_y - part.y));
    worst.angle = std::max(worst.angle, std::fabs(std::remainder(turned, 360.0)));
  }
  std::cout << seeds << " images: at most " << worst.distance << " mm and " << worst.angle << " deg off\n";
  EXPECT_LT(worst.distance, 0.3);
  EXPECT_LT(worst.angle, 0.6);
}

TEST_F(Bench, Each_part_lies_straight_in_its_place_at_the_end) {
  const std::uint32_t seeds = count_of("INDUROP_BENCH_SCENES", 21);
  Worst worst;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const unsigned parts = seed % 7;
    SCOPED_TRACE("seed " + std::to_string(seed));
    lay_out(seed, parts, 0, 0);
    ASSERT_EQ(items("part", 8, BENCH::LIES).size(), parts);
    ASSERT_TRUE(works(kSort)) << message();
    const auto put = items("part", 8, BENCH::PUT);
    EXPECT_EQ(put.size(), parts);
    expect_in_slots(put, part_slot, worst);
    EXPECT_EQ(p.get<int>("BENCH::truth.lost"), 0);
    EXPECT_THAT(message(), HasSubstr(std::to_string(parts) + " parts are on the pallet"));
  }
  std::cout << seeds << " scenes: at most " << worst.distance << " mm and " << worst.angle << " deg off\n";
}

TEST_F(Bench, Each_height_of_the_stack_is_found) {
  const std::uint32_t seeds = count_of("INDUROP_BENCH_SCENES", 15);
  Worst worst;
  double farthest = 0;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const unsigned pieces = 1 + seed % 5;
    SCOPED_TRACE("seed " + std::to_string(seed));
    lay_out(seed, 0, 0, pieces);
    auto before = p.get<std::uint32_t>("STACK::found");
    unsigned searches = 0;
    ASSERT_TRUE(works(kUnstack, [&] {
      if (const auto found = p.get<std::uint32_t>("STACK::found"); found != before) {
        before = found;
        ++searches;
        const double off = p.get<double>("STACK::top") - p.get<double>("BENCH::truth.stack");
        farthest = std::max(farthest, std::fabs(off));
      }
    })) << message();
    EXPECT_EQ(searches, pieces);
    const auto put = items("piece", 5, BENCH::PUT);
    EXPECT_EQ(put.size(), pieces);
    expect_in_slots(put, piece_slot, worst);
    EXPECT_EQ(p.get<int>("BENCH::truth.lost"), 0);
  }
  std::cout << seeds << " stacks: heights within " << farthest << " mm, pieces at most " << worst.distance << " mm and "
            << worst.angle << " deg off\n";
  EXPECT_LT(farthest, kSearched);
}

TEST_F(Bench, An_empty_stack_is_reported) {
  lay_out(1, 0, 0, 0);
  EXPECT_FALSE(works(kUnstack));
  EXPECT_THAT(message(), HasSubstr("the stack is empty"));
  lay_out(2, 0, 0, 2);
  EXPECT_TRUE(works(kUnstack)) << "it works when the stack was filled; " << message();
}

TEST_F(Bench, A_part_that_was_taken_away_is_left_out) {
  lay_out(3, 4, 0, 0, 1);
  Worst worst;
  EXPECT_TRUE(works(kSort)) << message();
  const auto put = items("part", 8, BENCH::PUT);
  EXPECT_EQ(put.size(), 3U);
  expect_in_slots(put, part_slot, worst);
  EXPECT_THAT(message(), HasSubstr("1 were missing"));
}

TEST_F(Bench, Three_parts_that_were_taken_away_end_the_job) {
  lay_out(4, 5, 0, 0, 5);
  EXPECT_FALSE(works(kSort));
  EXPECT_THAT(message(), HasSubstr("three parts were not where the camera saw them"));
  EXPECT_EQ(items("part", 8, BENCH::LIES).size(), 2U);
}

TEST_F(Bench, A_piece_that_was_taken_away_ends_the_job) {
  lay_out(5, 0, 0, 3, 1);
  EXPECT_FALSE(works(kUnstack));
  EXPECT_THAT(message(), HasSubstr("the piece is not between the fingers"));
}

TEST_F(Bench, What_is_no_part_stays_and_is_reported) {
  lay_out(6, 3, 2, 0);
  EXPECT_FALSE(works(kSort));
  EXPECT_THAT(message(), HasSubstr("something that is no part: 2"));
  EXPECT_EQ(items("part", 8, BENCH::PUT).size(), 3U);
  EXPECT_EQ(items("part", 8, BENCH::LIES).size(), 2U);
}

TEST_F(Bench, A_camera_that_does_not_answer_ends_the_job) {
  lay_out(7, 2, 0, 0);
  p.force("CAMERA::seen.shot", 0);
  EXPECT_FALSE(works(kSort));
  EXPECT_THAT(message(), HasSubstr("the camera does not answer"));
  p.unforce("CAMERA::seen.shot");
  EXPECT_TRUE(works(kSort)) << message();
  EXPECT_EQ(items("part", 8, BENCH::PUT).size(), 2U);
}

TEST_F(Bench, A_crash_of_the_vision_does_not_disturb_the_job) {
  lay_out(8, 4, 0, 0);
  p.kill("vision");
  Worst worst;
  EXPECT_TRUE(works(kSort)) << message();
  expect_in_slots(items("part", 8, BENCH::PUT), part_slot, worst);
  EXPECT_EQ(p.module("vision").restarts, 1U);
}

TEST_F(Bench, The_simulated_arm_is_where_the_robot_says) {
  lay_out(9, 1, 0, 0);
  ASSERT_TRUE(works(kSort)) << message();
  p.run(1s);
  for (const char* axis : {"0", "1", "2"}) {
    const std::string index = std::string("[") + axis + "]";
    EXPECT_NEAR(p.get<double>("BENCH::truth.tip" + index), p.get<double>("ROBOT_ARM.position" + index), 0.01);
  }
}

// An emergency stop at any moment, also while the fingers close, open or hold something; then the job is resumed.
TEST_F(Bench, After_emergency_stops_each_part_still_lies_in_its_place) {
  const std::uint32_t seeds = count_of("INDUROP_BENCH_STOPS", 6);
  Worst worst;
  unsigned stops = 0;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    lay_out(seed, 3, 0, 0);
    std::mt19937 random(seed);
    std::uint64_t next = p.tick() + 100 + random() % 300;
    const auto state = [this] { return p.get<std::string>("ROBOT_MODULE_STATE.eState"); };
    ASSERT_TRUE(works(kSort, [&] {
      if (p.tick() < next || p.get<std::string>("ROBOT_JOB.eState") == "ROBOT_JOB_ENDED") {
        return;
      }
      next = p.tick() + 400 + random() % 300;
      p.force("PLC_ROBOT::I14", 0);
      EXPECT_TRUE(p.run_until([&] { return state() == "ROBOT_GROUP_ERRORSTOP"; }, 2s));
      p.run(1s);
      p.unforce("PLC_ROBOT::I14");
      EXPECT_TRUE(p.run_until([&] { return p.get<int>("EMERGENCY_STOP.bActive") == 0; }, 1s));
      ++stops;
      request("SVC_AD_GROUP_RESET");
      request("SVC_AD_GROUP_ENABLE");
      EXPECT_TRUE(p.run_until([&] { return state() == "ROBOT_GROUP_STANDBY"; }, 2s));
      ASSERT_EQ(p.get<int>("ROBOT_JOB.bResume"), 1);
      request("SVC_JB_RESUME");
      EXPECT_TRUE(p.run_until([&] { return state() == "ROBOT_GROUP_MOVING"; }, 2s));
    })) << message();
    const auto put = items("part", 8, BENCH::PUT);
    EXPECT_EQ(put.size(), 3U);
    expect_in_slots(put, part_slot, worst);
  }
  std::cout << stops << " stops: at most " << worst.distance << " mm and " << worst.angle << " deg off\n";
  EXPECT_GE(stops, seeds);
}

TEST_F(Bench, Runs_are_the_same_each_time) {
  std::vector<std::string> ends;
  for (int run = 0; run < 2; ++run) {
    Plant again(BENCH_DIR "/camera.xml");
    again.set("BENCH::scene", "{seed: 11, parts: 3, others: 0, pieces: 0, snatch: 1}");
    again.set("BENCH::job", kSort);
    again.run(20s);
    std::string& end = ends.emplace_back();
    for (const char* name : {"BENCH::part", "BENCH::truth", "ROBOT_ARM", "ROBOT_JOB", "CAMERA::seen"}) {
      end += again.get<std::string>(name) + "\n";
    }
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_THAT(ends[0], HasSubstr("2 parts are on the pallet, 1 were missing"));
}

// The page shows the jobs as they are.
TEST(BenchPage, Has_the_text_of_each_job) {
  const auto text = [](const std::string& file) {
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string page = text(BENCH_PAGE);
  for (const char* job : {"bench", "look", "sort", "grip", "release", "unstack"}) {
    const std::string content = text(BENCH_DIR "/" + std::string(job) + ".job");
    ASSERT_FALSE(content.empty()) << job;
    EXPECT_TRUE(page.find("# " + std::string(job) + ".job\n" + content + "```") != std::string::npos) << job;
  }
}

// Only what the fingers hold moves.
TEST_F(Bench, Parts_that_are_not_held_stay_where_they_are) {
  lay_out(10, 5, 2, 0);
  auto before = all_parts();
  unsigned held = 0;
  works(kSort, [&] {
    const auto now = all_parts();
    for (std::size_t i = 0; i < now.size(); ++i) {
      held += now[i].state == BENCH::HELD ? 1U : 0U;
      if (before[i].state == now[i].state && now[i].state != BENCH::HELD) {
        EXPECT_EQ(now[i].x, before[i].x);
        EXPECT_EQ(now[i].y, before[i].y);
        EXPECT_EQ(now[i].angle, before[i].angle);
      }
    }
    before = now;
  });
  EXPECT_GT(held, 100U) << "ticks in which one was held";
}

}  // namespace
}  // namespace irp::testing
