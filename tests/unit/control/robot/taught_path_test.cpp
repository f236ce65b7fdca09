// SPDX-License-Identifier: Apache-2.0
// Jobs of guided paths: random paths of several arms are reduced to motions, and the job is played. The tip, where
// orocos-kdl or the arm of the test places it, stays within the tolerance of the guided path.
// INDUROP_ROBOT_TAUGHT says how many paths, INDUROP_ROBOT_SEED from which one on.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "control/robot/files/read_files.h"
#include "control/robot/files/teach.h"
#include "drive_faults.h"
#include "group_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("taught." + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  [[nodiscard]] std::string name(const std::string& file) const { return path_ / file; }

 private:
  std::filesystem::path path_;
};

class TaughtPaths : public testing::Test {
 protected:
  std::mt19937 random;
  ArmSpec spec = cell_spec();

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }

  // A path as a hand leads it: smooth, in jerks or straight, with rests and marks. deg, mm.
  std::vector<GuidedPlace> hand_path() {
    std::vector<GuidedPlace> path;
    std::vector<double> q = spec.start;
    const std::size_t count = spec.parts.size();
    std::vector<double> v(count, 0);
    std::vector<double> to(count, 0);
    const int places = 100 + one_of(200);
    const bool straight = one_of(4) == 0;
    for (int i = 0; i < places; ++i) {
      if (i == 0 || (!straight && one_of(25) == 0)) {
        for (std::size_t k = 0; k < count; ++k) {
          to[k] = one_of(6) == 0 ? 0 : in(-0.25, 0.25) * (spec.parts[k].slides ? 0.2 : 1);
        }
      }
      GuidedPlace place;
      for (std::size_t k = 0; k < count; ++k) {
        v[k] = straight ? to[k] : v[k] + 0.15 * (to[k] - v[k]);
        q[k] = std::clamp(q[k] + 0.02 * v[k], spec.parts[k].lower + 0.05, spec.parts[k].upper - 0.05);
        place.joints.push_back(spec.parts[k].slides ? 1000 * q[k] : 180 / kPi * q[k]);
      }
      place.marked = one_of(90) == 0;
      path.push_back(place);
    }
    return path;
  }
  // mm from the tip to the nearest place of the guided path.
  static double off(const KDL::Vector& tip, const std::vector<KDL::Vector>& path) {
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const KDL::Vector way = path[i + 1] - path[i];
      const double size = KDL::dot(way, way);
      const double part = size > 0 ? std::clamp(KDL::dot(tip - path[i], way) / size, 0.0, 1.0) : 0;
      nearest = std::min(nearest, (path[i] + part * way - tip).Norm());
    }
    return 1000 * nearest;
  }
};

// What became of many paths.
struct Sums {
  int played = 0;
  int refused = 0;
  long places = 0;
  long points = 0;
  double worst = 0;  // part of the tolerance
};

class RandomTaughtPaths : public TaughtPaths {
 protected:
  Sums sums;

  void run(int i) {
    random.seed(static_cast<unsigned>(i));
    spec = i % 3 == 0 ? cell_spec() : i % 3 == 1 ? irb4600_spec() : xarm6_spec();
    const Folder folder;
    const std::string tool = "TOOL pen = POSE 10 20 150 RPY 0 30 0\n";
    const FileNames names{folder.write("arm.urdf", spec.urdf()), {folder.write("points.job", tool)}, {}};
    PathOrder order;
    order.job = "guided";
    order.tool = i % 2 == 0 ? "pen" : "";
    order.tolerance = in(0.2, 5);
    order.turn_tolerance = in(0.3, 3);
    const auto path = hand_path();
    const TaughtPath taught = teach_path(names, order, path);
    ASSERT_TRUE(taught.errors.empty()) << base::to_text(taught.errors);
    ASSERT_EQ(taught.problem, "");
    sums.places += static_cast<long>(path.size());
    sums.points += taught.points;
    Cell cell(tool, 4, 0, true, Settings{}, spec.urdf(), {{"guided", taught.text}});
    play(cell, order, path, taught.text);
  }
  void play(Cell& cell, const PathOrder& order, const std::vector<GuidedPlace>& path, const std::string& text) {
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 2;
    cell.ask(Service::JobStart);
    const KDL::Frame pen(KDL::Rotation::RPY(0, kPi / 6, 0), KDL::Vector(0.01, 0.02, 0.15));
    KdlPlaces where(spec, order.tool.empty() ? KDL::Frame::Identity() : pen);
    std::vector<KDL::Vector> seen;
    for (int period = 0; period < 60000; ++period) {
      cell.step();
      if (cell.out.job.state != JobState::Runs && cell.out.job.state != JobState::Idle) {
        break;
      }
      if (!seen.empty() || is_at(cell, path[0])) {
        seen.push_back(where.at(cell.out.command).tip);
      }
    }
    if (cell.out.job.state == JobState::Failed) {
      ++sums.refused;
      fmt::print("refused: {}\n", cell.out.job.message);
      return;
    }
    ASSERT_EQ(cell.out.job.state, JobState::Ended) << cell.out.job.message << "\n" << text;
    ++sums.played;
    compare(seen, where, path, order.tolerance);
  }
  [[nodiscard]] bool is_at(const Cell& cell, const GuidedPlace& place) const {
    for (std::size_t k = 0; k < spec.parts.size(); ++k) {
      if (!(std::abs(cell.out.command[k] - place.joints[k]) < 2e-3)) {
        return false;
      }
    }
    return true;
  }
  void compare(const std::vector<KDL::Vector>& seen, KdlPlaces& where, const std::vector<GuidedPlace>& path,
               double tolerance) {
    std::vector<KDL::Vector> wanted;
    for (const GuidedPlace& one : path) {
      AxisNumbers q;
      std::copy(one.joints.begin(), one.joints.end(), q.begin());
      wanted.push_back(where.at(q).tip);
    }
    double worst = 0;
    for (const KDL::Vector& tip : seen) {
      worst = std::max(worst, off(tip, wanted) / tolerance);
    }
    for (const KDL::Vector& place : wanted) {
      worst = std::max(worst, off(place, seen) / tolerance);
    }
    EXPECT_LE(worst, 1);
    sums.worst = std::max(sums.worst, worst);
  }
};

TEST_F(RandomTaughtPaths, Are_played_within_the_tolerance) {
  const int runs = number_of("INDUROP_ROBOT_TAUGHT", 12);
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  for (int i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    run(i);
  }
  fmt::print("{} paths of {} places became jobs of {} points; {} played, {} refused; at most {:.2f} of the tolerance\n",
             runs, sums.places, sums.points, sums.played, sums.refused, sums.worst);
  EXPECT_GE(sums.played, runs * 19 / 20);
}

TEST_F(TaughtPaths, The_simplest_motion_that_is_near_enough_is_chosen) {
  const Folder folder;
  const FileNames names{
      folder.write("arm.urdf", spec.urdf()), {folder.write("points.job", "POINT A = JOINT 0 0 0 0 90 0\n")}, {}};
  const auto words = [&](const PathOrder& order, const std::vector<GuidedPlace>& path) {
    const TaughtPath taught = teach_path(names, order, path);
    EXPECT_EQ(taught.problem, "");
    std::filesystem::remove(taught.file);
    std::string out;
    std::istringstream lines(taught.text);
    for (std::string line; std::getline(lines, line);) {
      out += line.starts_with("MOV") ? line.substr(0, 4) + (line.ends_with("STRAIGHT") ? " STRAIGHT" : "") + " " : "";
    }
    return out;
  };
  PathOrder order;
  order.job = "one";
  std::vector<GuidedPlace> turning;  // axis 1 only: the tip goes along a circle
  for (int i = 0; i <= 60; ++i) {
    turning.push_back({{i * 1.0, 0, -20, 0, 90, 0}, i == 30});
  }
  EXPECT_EQ(words(order, turning), "MOVJ MOVJ STRAIGHT MOVJ STRAIGHT ");
  std::vector<GuidedPlace> wavy = turning;
  for (std::size_t i = 0; i < wavy.size(); ++i) {
    wavy[i].joints[1] = 8 * std::sin(0.1 * static_cast<double>(i));
    wavy[i].marked = false;
  }
  EXPECT_EQ(words(order, wavy), "MOVJ MOVS ");
  order.tolerance = 500;
  order.turn_tolerance = 90;
  EXPECT_EQ(words(order, wavy), "MOVJ MOVL ");
}

TEST_F(TaughtPaths, What_cannot_be_written_is_said) {
  const Folder folder;
  const std::string points =
      folder.write("points.job", "POINT A = JOINT 0 0 0 0 90 0\nPOINT two_1 = JOINT 0 0 0 0 9 0\n");
  const FileNames names{folder.write("arm.urdf", spec.urdf()), {points}, {}};
  const std::vector<GuidedPlace> path{{{0, 0, 0, 0, 90, 0}}, {{10, 0, 0, 0, 90, 0}}};
  const auto problem = [&](const PathOrder& order, const std::vector<GuidedPlace>& places) {
    return teach_path(names, order, places).problem;
  };
  PathOrder order;
  order.job = "two words";
  EXPECT_THAT(problem(order, path), HasSubstr("is no name of a job"));
  order.job = "one";
  order.tool = "pen";
  EXPECT_THAT(problem(order, path), HasSubstr("there is no tool 'pen'"));
  order.tool = "";
  EXPECT_THAT(problem(order, {path[0], path[0]}), HasSubstr("the arm was not moved"));
  EXPECT_THAT(problem(order, {path[0], {{1, 2}}}), HasSubstr("places without 6 joint values"));
  order.tolerance = 0;
  EXPECT_THAT(problem(order, path), HasSubstr("above 0"));
  order.tolerance = 1;
  EXPECT_EQ(problem(order, path), "");
  EXPECT_THAT(problem(order, path), HasSubstr("choose another name, or a file that the property jobs names"));
  order.job = "two";
  const TaughtPath twice = teach_path(names, order, path);
  ASSERT_FALSE(twice.errors.empty());
  EXPECT_THAT(base::to_text(twice.errors), HasSubstr("two_1"));
  EXPECT_FALSE(std::filesystem::exists(folder.name("two.job")));
}

TEST_F(TaughtPaths, Only_jobs_that_were_guided_are_replaced) {
  const Folder folder;
  const FileNames names{folder.write("arm.urdf", spec.urdf()),
                        {folder.write("points.job", "POINT A = JOINT 0 0 0 0 90 0\n"),
                         folder.write("own.job", "MOVJ A\n"), folder.write("seam.job", "")},
                        {}};
  const std::vector<GuidedPlace> path{{{0, 0, 0, 0, 90, 0}}, {{10, 0, 0, 0, 90, 0}}, {{20, 0, 0, 0, 90, 0}}};
  PathOrder order;
  order.job = "own";
  EXPECT_THAT(teach_path(names, order, path).problem, HasSubstr("it was not written by guiding, and is kept"));
  order.job = "seam";
  for (const std::size_t places : {2U, 3U}) {
    const TaughtPath taught = teach_path(names, order, {path.begin(), path.begin() + static_cast<int>(places)});
    EXPECT_EQ(taught.problem, "");
    EXPECT_TRUE(taught.is_read);
  }
}

}  // namespace
}  // namespace indurop::robot
