// SPDX-License-Identifier: Apache-2.0
// Motions keep to what the axes can give: of random jobs of an arm with masses, with something heavy in its hand, the
// torques along the set points are computed by orocos-kdl. INDUROP_ROBOT_EFFORTS says how many jobs.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <vector>

#include "control/robot/job/job.h"
#include "group_cell.h"
#include "heavy_arm.h"
#include "heavy_jobs.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr double kPeriod = 0.004;

struct EffortRun {
  double worst = 0;  // part of the effort
  double seconds = 0;
  JobState end = JobState::Idle;
  std::string message;
};

// `disturb`: holds and overrides at random instants.
EffortRun run(const HeavyArm& heavy, const std::string& urdf, const std::string& job, std::mt19937* disturb = nullptr) {
  Cell cell(job, 1000 * kPeriod, 0, true, {}, urdf);
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
  EffortRun result;
  std::array<Joints, 3> seen;
  int count = 0;
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  for (int i = 0; i < 40000; ++i) {
    cell.step();
    if (disturb != nullptr && (*disturb)() % 100 == 0) {
      cell.in.hold = (*disturb)() % 2 == 0;
      cell.in.speed_override = between(*disturb, 10, 100);
    }
    seen = {seen[1], seen[2], Joints::Zero()};
    for (int axis = 0; axis < 6; ++axis) {
      seen[2][axis] = radians(cell.out.command[static_cast<std::size_t>(axis)]);
    }
    if (++count >= 3) {
      const Joints torque = kdl_torques(heavy, kHeld, seen[1], (seen[2] - seen[0]) / (2 * kPeriod),
                                        (seen[2] - 2 * seen[1] + seen[0]) / (kPeriod * kPeriod));
      result.worst = std::max(result.worst, torque.head<6>().cwiseAbs().cwiseQuotient(efforts().head<6>()).maxCoeff());
    }
    result.seconds += kPeriod;
    result.end = cell.out.job.state;
    if (i > 2 && (result.end == JobState::Ended || result.end == JobState::Failed)) {
      break;
    }
  }
  result.message = cell.out.job.message;
  return result;
}

int jobs() {
  const char* wanted = std::getenv("INDUROP_ROBOT_EFFORTS");
  return wanted != nullptr ? std::atoi(wanted) : 12;
}

struct Sum {
  int ended = 0, beyond = 0;
  double worst = 0, seconds = 0;
  void add(const EffortRun& one) {
    ended += one.end == JobState::Ended ? 1 : 0;
    beyond += one.worst > 1.02 ? 1 : 0;
    worst = std::max(worst, one.worst);
    seconds += one.seconds;
  }
};

TEST(Effort, Torques_of_random_jobs_keep_to_it) {
  const HeavyArm limited = heavy_cell_arm(efforts());
  const HeavyArm unlimited = heavy_cell_arm(Joints::Zero());
  const Arm arm = arm_from_urdf("", limited.urdf)->arm;
  std::mt19937 random(5);
  Sum kept;
  Sum free;
  for (int i = 0; i < jobs(); ++i) {
    const std::string job = random_job(random, arm);
    const EffortRun one = run(limited, limited.urdf, job);
    if (one.worst > 1.02) {
      fmt::print("{} beyond effort\n{}", one.worst, job);
    }
    kept.add(one);
    free.add(run(unlimited, unlimited.urdf, job));
  }
  fmt::print(
      "of {} jobs: {} ended, {} beyond, most {:.3f}, {:.1f} s; without limits {} ended, {} beyond, most {:.2f}, {:.1f} "
      "s\n",
      jobs(), kept.ended, kept.beyond, kept.worst, kept.seconds, free.ended, free.beyond, free.worst, free.seconds);
  EXPECT_EQ(kept.beyond, 0);
  EXPECT_EQ(kept.ended, free.ended);  // what is possible is done
  EXPECT_GT(free.beyond, jobs() / 2);
}

TEST(Effort, Holds_and_overrides_keep_to_it_too) {
  const HeavyArm limited = heavy_cell_arm(efforts());
  const Arm arm = arm_from_urdf("", limited.urdf)->arm;
  std::mt19937 random(6);
  std::mt19937 disturb(7);
  Sum kept;
  for (int i = 0; i < jobs(); ++i) {
    kept.add(run(limited, limited.urdf, random_job(random, arm), &disturb));
  }
  fmt::print("of {} jobs: {} ended, {} beyond, most {:.3f}\n", jobs(), kept.ended, kept.beyond, kept.worst);
  EXPECT_EQ(kept.beyond, 0);
}

// A new tool or load counts from its line on, in whatever way a job comes there.
TEST(Effort, A_load_counts_where_a_job_begins_and_after_it) {
  const HeavyArm heavy = heavy_cell_arm(joints_of({250, 150, 130, 26, 22, 12}));
  const std::string job = point("P1", joints_of({0, 0.3, -0.5, 0, 0.9, 0})) +
                          point("P2", joints_of({0, 1.57, -1.6, 0, 0, 0})) +
                          "LOAD 5 kg CENTRE 0 0 50\nWAIT 0.1s\nMOVJ P1\n";
  Cell cell(job, 1000 * kPeriod, 0, true, {}, heavy.urdf);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.point = 2;
  EXPECT_TRUE(cell.serve(Service::MoveJoints));
  cell.in.service.point = 1;
  EXPECT_TRUE(cell.serve(Service::MoveJoints));
  cell.in.service.job = 1;
  cell.in.service.line = 5;  // behind LOAD
  EXPECT_TRUE(cell.serve(Service::JobStart));
  cell.in.service.point = 2;
  EXPECT_FALSE(cell.serve(Service::MoveJoints));
  EXPECT_EQ(cell.out.error, ErrorCode::Torque);
}

TEST(Effort, Wrong_masses_are_errors_with_their_line) {
  const std::pair<const char*, const char*> wrong[] = {
      {"LOAD\n", "a.job:1:5: error: expected a mass, 2.5 kg, found the end of the line"},
      {"LOAD -1 kg CENTRE 0 0 0\n", "a.job:1:6: error: a mass is above 0 kg; LOAD 0 says that nothing is held"},
      {"LOAD 2.5 lb\n", "a.job:1:10: error: expected kg, found 'lb'"},
      {"LOAD 2.5 kg\n",
       "a.job:1:12: error: expected CENTRE and x y z of the centre of mass in mm, seen from the arm's "
       "end; found the end of the line"},
      {"LOAD 2.5 kg CENTRE 0 0\n", "a.job:1:23: error: expected 3 numbers: x y z of the centre of mass in mm"},
      {"LOAD 2.5 kg CENTRE 0 0 0 INERTIA 1 1 1 0 0\n", "a.job:1:43: error: expected 6 numbers"},
      {"LOAD 2.5 kg CENTRE 0 0 0 INERTIA 1 1 3 0 0 0\n", "a.job:1:26: error: no body has this inertia"},
      {"LOAD 2.5 kg CENTRE 0 0 0 1\n", "a.job:1:26: error: unexpected '1'"},
      {"TOOL t = POSE 0 0 0 RPY 0 0 0 MASS 0 kg CENTRE 0 0 0\n", "a.job:1:36: error: a mass is above 0 kg"},
      {"TOOL t = POINTS A B C MASS 1\n", "a.job:1:29: error: expected kg"},
  };
  for (const auto& [text, error] : wrong) {
    EXPECT_THAT(base::to_text(parse_jobs({{"a.job", text}}).diagnostics), HasSubstr(error)) << text;
  }
  const auto read =
      parse_jobs({{"a.job",
                   "LOAD 0\nLOAD 0 kg\nload 2 kg centre 1 2 3\n"
                   "TOOL t = POSE 0 0 0 RPY 0 0 0 MASS 1 kg CENTRE 0 0 5 INERTIA 1 2 2.5 0.1 0.2 0.3\n"}});
  EXPECT_EQ(base::to_text(read.diagnostics), "");
  ASSERT_EQ(read.book.loads.size(), 2U);
  EXPECT_EQ(read.book.loads[1].centre, Vec3(0.001, 0.002, 0.003));
  EXPECT_EQ(read.book.tools[1].body.inertia(1, 2), 0.3);
}

TEST(Effort, What_cannot_be_held_is_refused_with_its_line) {
  const HeavyArm heavy = heavy_cell_arm(joints_of({250, 150, 130, 26, 22, 12}));
  const std::string points =
      point("FRONT", joints_of({0, 0.3, -0.5, 0, 0.9, 0})) + point("OUT", joints_of({0, 1.57, -1.6, 0, 0, 0}));
  const EffortRun empty = run(heavy, heavy.urdf, points + "MOVJ FRONT\nMOVJ OUT\n");
  EXPECT_EQ(empty.end, JobState::Ended) << empty.message;
  const EffortRun loaded = run(heavy, heavy.urdf, points + "LOAD 5 kg CENTRE 0 0 50\nMOVJ FRONT\nMOVJ OUT\n");
  EXPECT_EQ(loaded.end, JobState::Failed);
  EXPECT_THAT(loaded.message, HasSubstr("main.job:5"));
  EXPECT_THAT(loaded.message, HasSubstr("torque"));
  const EffortRun tool =
      run(heavy, heavy.urdf,
          points + "TOOL grip = POSE 0 0 100 RPY 0 0 0 MASS 5 kg CENTRE 0 0 50\nTOOL grip\nMOVJ FRONT\nMOVJ OUT\n");
  EXPECT_EQ(tool.end, JobState::Failed);
  EXPECT_THAT(tool.message, HasSubstr("main.job:6"));
  const EffortRun put_down = run(heavy, heavy.urdf, points + "LOAD 5 kg CENTRE 0 0 50\nMOVJ FRONT\nLOAD 0\nMOVJ OUT\n");
  EXPECT_EQ(put_down.end, JobState::Ended) << put_down.message;
}

}  // namespace
}  // namespace indurop::robot
