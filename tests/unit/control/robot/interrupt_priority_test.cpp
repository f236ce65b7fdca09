// SPDX-License-Identifier: Apache-2.0
// Interrupts that interrupt each other: the lines with a PRIORITY and what is wrong with them; random interrupts
// against the rules of a scheduler with priorities; and, with an arm, that each path goes on where it was left.
#include <gmock/gmock.h>

#include <map>
#include <random>
#include <vector>

#include "interrupt_cell.h"
#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(InterruptPriority, Errors_are_reported_with_their_place) {
  EXPECT_THAT(interrupt_errors("ON I1 CALL eject PRIORITY 1\nON I2 CALL eject PRIORITY 99\nON I3 CALL eject\n"),
              ElementsAre());
  EXPECT_THAT(interrupt_errors("ON I1 CALL eject PRIORITY\n"),
              ElementsAre(HasSubstr("main.job:1:26: error: expected the number of the priority")));
  for (const char* const wrong : {"0", "100", "1.5", "-1"}) {
    EXPECT_THAT(
        interrupt_errors(std::string("ON I1 CALL eject PRIORITY ") + wrong + "\n"),
        ElementsAre("main.job:1:27: error: a priority is a whole number from 1, which interrupts all others, to "
                    "99\n"));
  }
  EXPECT_THAT(interrupt_errors("ON I1 CALL eject 1\n"), ElementsAre(HasSubstr("main.job:1:18: error: ")));
  const std::string three = "ON I1 CALL eject PRIORITY 1\nON I2 CALL eject PRIORITY 2\nON I3 CALL eject PRIORITY 3\n";
  EXPECT_THAT(interrupt_errors(three + "ON I4 CALL eject PRIORITY 2\n"), ElementsAre());
  EXPECT_THAT(
      interrupt_errors(three + "ON I4 CALL eject PRIORITY 4\nON I4 CALL eject PRIORITY 3\n"),
      ElementsAre(HasSubstr(
          "main.job:4:18: error: the ON of these jobs have more than 3 different priorities: 1, 2, 3, 4; none")));
  EXPECT_THAT(interrupt_errors(three + "ON I4 CALL eject\n"),
              ElementsAre(HasSubstr("main.job:4:17: error: the ON of these")));
}

// ---- Random interrupts of a job that only waits

struct Served {
  std::size_t interrupt = 0;
  int began = 0;
  int lost = 0;  // periods in which others interrupted it
};

class Scheduler {
 public:
  struct Interrupt {
    int priority = 100;
    int periods = 1;  // that its job waits
    bool input = false;
    bool pending = false;
    int began = 0, edges = 0;
  };

  explicit Scheduler(std::mt19937& random) : random_(random) {
    const int last = one_of(98) + 1;
    const int priorities[] = {100, last, last + 1};
    for (int i = 0; i < 8; ++i) {
      all.push_back({priorities[one_of(3)], 2 + one_of(30)});
    }
  }
  [[nodiscard]] int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }

  [[nodiscard]] std::vector<JobFile> files() const {
    std::string main;
    std::vector<JobFile> jobs;
    for (std::size_t i = 0; i < all.size(); ++i) {
      main += fmt::format("ON I{} CALL job{}{}\n", i + 1, i,
                          all[i].priority < 100 ? fmt::format(" PRIORITY {}", all[i].priority) : "");
      jobs.push_back({fmt::format("job{}.job", i),
                      fmt::format("SET begin = {}\nWAIT {} ms\nSET end = {}\n", i, 10 * all[i].periods, i)});
    }
    jobs.insert(jobs.begin(), {"main.job", main + "WAIT 20s\nSET finished = 1\n"});
    return jobs;
  }

  // Changes some inputs; not in the last periods.
  void change_inputs(int period, World& world) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      Interrupt& one = all[i];
      const bool before = one.input;
      one.input = period > 0 && period < kLastEdge && (one_of(40) == 0 ? !before : before);
      one.pending = one.pending || (one.input && !before);
      one.edges += one.input && !before ? 1 : 0;
      world.values[fmt::format("I{}", i + 1)] = one.input ? 1 : 0;
    }
  }

  // What the jobs have written in this period, by the rules: one that is due begins at once, unless the robot is
  // returning from another one, which takes two periods; of several the one with the lowest number, then the first one.
  void check(int period, const World& world) {
    const std::size_t due = due_now();
    std::size_t begun = all.size();
    for (; seen_ < world.written.size(); ++seen_) {
      const auto& [name, value] = world.written[seen_];
      const auto i = static_cast<std::size_t>(value);
      if (name == "begin") {
        ASSERT_EQ(begun, all.size()) << "two began in period " << period;
        ASSERT_TRUE(all[i].pending) << i << " began without an edge in period " << period;
        begun = i;
      } else if (name == "end") {
        ASSERT_FALSE(open_.empty());
        ASSERT_EQ(open_.back().interrupt, i) << "period " << period;
        const int took = period - open_.back().began;
        ASSERT_EQ(took - open_.back().lost, all[i].periods) << "of job " << i << ", which ends in period " << period;
        open_.pop_back();
        returns_until_ = period + 1;
        if (!open_.empty()) {
          open_.back().lost += took + 2;
        }
        lost += open_.empty() ? took + 2 : 0;
      }
    }
    const bool returning = period <= returns_until_;
    ASSERT_EQ(begun, returning ? all.size() : due) << "period " << period;
    if (begun < all.size()) {
      all[begun].pending = false;
      ++all[begun].began;
      open_.push_back({begun, period, 0});
      deepest = std::max(deepest, open_.size());
    }
  }

  // What is reported after the same period: all jobs wait in their second line, the first one after all its ON.
  void check(int period, const JobReport& report) const {
    const auto name = [](std::size_t i) { return fmt::format("job{}", i); };
    ASSERT_EQ(report.interrupted_count, open_.size()) << "period " << period;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      ASSERT_EQ(report.interrupted[i].name, i == 0 ? "main" : name(open_[i - 1].interrupt)) << "period " << period;
      ASSERT_EQ(report.interrupted[i].line, i == 0 ? all.size() + 1 : 2) << "period " << period;
    }
    ASSERT_EQ(report.state == JobState::Resumes, period == returns_until_ - 1) << "period " << period;
    ASSERT_EQ(std::string(report.called), open_.empty() ? "main" : name(open_.back().interrupt)) << "period " << period;
    std::vector<std::pair<int, std::size_t>> due;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].pending) {
        due.emplace_back(all[i].priority, i);
      }
    }
    std::sort(due.begin(), due.end());
    ASSERT_EQ(report.pending_count, due.size()) << "period " << period;
    for (std::size_t i = 0; i < due.size(); ++i) {
      ASSERT_EQ(report.pending[i], name(due[i].second)) << "period " << period;
    }
  }

  static constexpr int kLastEdge = 1500;
  std::vector<Interrupt> all;
  std::size_t deepest = 0;
  int lost = 0;

 private:
  [[nodiscard]] std::size_t due_now() const {
    std::size_t best = all.size();
    for (std::size_t i = all.size(); i-- > 0;) {
      const bool may = open_.empty() || all[i].priority < all[open_.back().interrupt].priority;
      if (all[i].pending && may && (best == all.size() || all[i].priority <= all[best].priority)) {
        best = i;
      }
    }
    return best;
  }

  std::mt19937& random_;
  std::vector<Served> open_;
  std::size_t seen_ = 0;
  int returns_until_ = -1;
};

TEST(InterruptPriority, Random_interrupts_are_served_as_a_scheduler_with_priorities_does) {
  const int runs = number_of("INDUROP_ROBOT_INTERRUPTS", 100);
  int served = 0;
  std::map<std::size_t, int> deepest;
  for (int seed = 1; seed <= runs; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    Scheduler oracle(random);
    const ReadJobs read = parse_jobs(oracle.files());
    ASSERT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
    World world(read.book.signals);
    JobRunner sut(read.book);
    sut.start(0);
    int period = 0;
    for (; period < 20'000 && sut.running(); ++period) {
      oracle.change_inputs(period, world);
      sut.step(0.01, world, world);
      oracle.check(period, world);
      if (sut.running()) {
        oracle.check(period, sut.report());
      }
      if (HasFatalFailure()) {
        return;
      }
    }
    EXPECT_EQ(sut.report().state, JobState::Ended) << sut.report().message;
    EXPECT_EQ(world.values["finished"], 1);
    EXPECT_NEAR(period, 2000 + oracle.lost, 3);
    for (const auto& each : oracle.all) {
      EXPECT_FALSE(each.pending);
      EXPECT_LE(each.began, each.edges);
      served += each.began;
    }
    ++deepest[oracle.deepest];
  }
  fmt::print("{} interrupts; {} of {} runs had three inside of each other\n", served, deepest[3], runs);
  EXPECT_GT(deepest[3], runs / 2);
  EXPECT_EQ(deepest.rbegin()->first, 3U);
}

// Each is in the TRY of its own job only.
TEST(InterruptPriority, An_error_is_handled_by_the_job_that_made_it) {
  ReadJobs read = parse_jobs({{"main.job",
                               "ON I1 CALL one\nON I2 CALL two PRIORITY 1\nTRY\nWAIT 3s\nRECOVER\nSET n = 1\n"
                               "END\n"},
                              {"one.job", "TRY\nWAIT 1s\nRECOVER\nSET n = 2\nEND\nSET one = 1\n"},
                              {"two.job", "TRY\nRAISE 77\nRECOVER\nSET n = ERROR\nEND\nRAISE 78\n"}});
  ASSERT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  World world(read.book.signals);
  JobRunner sut(read.book);
  sut.start(0);
  for (int i = 0; i < 1000 && sut.running(); ++i) {
    world.values["I1"] = i >= 20 ? 1 : 0;
    world.values["I2"] = i >= 40 ? 1 : 0;
    sut.step(0.01, world, world);
  }
  EXPECT_EQ(sut.report().state, JobState::Failed);
  EXPECT_THAT(sut.report().message, HasSubstr("two.job:6: error 78 was raised"));
  EXPECT_EQ(world.values["n"], 77);
  EXPECT_EQ(world.values["one"], 0);
}

// ---- With the arm

const std::string kMore = "POINT G = JOINT 20 -10 0 0 90 0\nPOINT K = JOINT -30 -30 20 10 95 0\n";
const JobTexts kJobs = {
    {"slow", "SET busy ON\nSPEED 40%\nTOOL pen\nMOVJ H\nTOOL FLANGE\nMOVJ BACK\nSET busy OFF\n"},
    {"mid", "SET busier ON\nSPEED 60%\nMOVJ G\nMOVL H SPEED 300 mm/s\nWAIT 0.1s\nMOVJ BACK\nSET busier OFF\n"},
    {"fast", "SET busiest ON\nMOVJ K\nMOVJ BACK\nSET busiest OFF\n"}};
constexpr const char* kOn = "ON I1 CALL slow\nON I2 CALL fast PRIORITY 1\nON I3 CALL mid PRIORITY 20\n";

// Which interrupts are being served, and where the arm was when each of them came.
class Nested {
 public:
  void look(JobMachine& sut) {
    const char* const names[] = {"busy", "busier", "busiest"};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool on = sut.signal(names[i]) != 0;
      const AxisNumbers& place = sut.cell.out.command;  // not the tip, because the tools change
      if (on && !on_[i]) {
        ASSERT_TRUE(open_.empty() || open_.back() < i) << "a job of lower priority has begun inside of another one";
        open_.push_back(i);
        left_[i] = place;
        ++served;
        inside += open_.size() > 1 ? 1 : 0;
        all_three += open_.size() > 2 ? 1 : 0;
      } else if (!on && on_[i]) {
        ASSERT_EQ(open_.back(), i);
        open_.pop_back();
        EXPECT_THAT(place, testing::Pointwise(testing::DoubleNear(1e-9), left_[i])) << names[i];
      }
      on_[i] = on;
    }
  }
  [[nodiscard]] bool any() const { return !open_.empty(); }

  int served = 0, inside = 0, all_three = 0;

 private:
  std::array<bool, 3> on_{};
  std::array<AxisNumbers, 3> left_{};
  std::vector<std::size_t> open_;
};

TEST(InterruptPriority, Anywhere_on_each_path_it_is_left_and_taken_up_within_all_limits) {
  const auto jobs = static_cast<unsigned>(number_of("INDUROP_ROBOT_JOBS", 4));
  Nested nested;
  int stops = 0;
  double farthest = 0;
  for (unsigned seed = 1; seed <= jobs; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    std::mt19937 random(seed);
    const std::string job = random_job(kMore + kOn, random);
    JobMachine calm(job, kJobs);
    std::vector<Vec3> path;
    for (int i = 0; i < 20'000 && !calm.ended(); ++i) {
      calm.step();
      path.push_back(tip(calm.cell));
    }
    if (calm.cell.out.error != ErrorCode::Ok) {
      continue;  // not every way is possible
    }
    JobMachine sut(job, kJobs);
    const auto happens = [&](double per_second) {
      return std::uniform_real_distribution<double>(0, 1)(random) < per_second * 0.01;
    };
    int emergencies = seed % 2 == 0 ? 3 : 0;
    bool returning = false;
    for (int i = 0; i < 60'000 && !sut.ended(); ++i) {
      sut.signal("I1") = happens(0.5) ? 1 : 0;
      sut.signal("I2") = happens(0.15) ? 1 : 0;
      sut.signal("I3") = happens(0.25) ? 1 : 0;
      sut.step();
      ASSERT_EQ(sut.broken, "") << job;
      ASSERT_NE(sut.cell.out.state, GroupState::ErrorStop) << sut.cell.out.job.message << "\n" << job;
      nested.look(sut);
      ASSERT_FALSE(HasFailure()) << job;
      returning = returning && sut.cell.out.job.state != JobState::Runs;
      if (!nested.any() && !returning && i % 4 == 0) {
        farthest = std::max(farthest, away(path, tip(sut.cell)));
      }
      if (emergencies > 0 && sut.cell.out.state == GroupState::Moving && sut.cell.out.job.line != 0 && happens(0.5)) {
        --emergencies;
        ++stops;
        go_on(sut);
        returning = true;
        ASSERT_FALSE(HasFatalFailure());
      }
    }
    ASSERT_EQ(sut.cell.out.job.state, JobState::Ended) << sut.cell.out.job.message << "\n" << job;
    EXPECT_LT((tip(sut.cell) - tip(calm.cell)).norm(), 1e-3);
    EXPECT_EQ(sut.set, calm.set) << job;
  }
  fmt::print(
      "{} interrupts, {} inside of another one, {} inside of two; {} emergency stops; at most {:.4f} mm from the "
      "path without them\n",
      nested.served, nested.inside, nested.all_three, stops, farthest);
  EXPECT_GT(nested.inside, static_cast<int>(jobs));
  EXPECT_LT(farthest, 0.2);  // arcs are cut short between places 10 ms apart
}

}  // namespace
}  // namespace indurop::robot
