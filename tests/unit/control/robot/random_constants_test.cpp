// SPDX-License-Identifier: Apache-2.0
// Wrong constants are errors of their lines when jobs are read, and never of a job that runs: random statements with
// random numbers and expressions of numbers, against the tables of docs/robot.md.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "control/robot/job/job.h"
#include "control/robot/job/runner.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr double kNoValue = NAN;

// What a job needs, all of which comes at once; an axis pushes with all of its torque as soon as that has grown.
class ObligingCell final : public Signals, public MotionPort {
 public:
  double read(std::size_t) noexcept override { return 1; }
  void write(std::size_t, double) noexcept override {}
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return pushed_ < 0; }
  Fault move(const MoveCommand&) noexcept override { return {}; }
  Fault push(const PushWay& way) noexcept override {
    grows_ = way.ramp > 0 ? std::abs(way.torque) / way.ramp : 0;
    pushed_ = 0;
    return {};
  }
  [[nodiscard]] PushState pushing() const noexcept override { return {pushed_ >= grows_, {}, 1}; }
  void end_push() noexcept override { pushed_ = -1; }
  void pass(double seconds) noexcept { pushed_ += pushed_ >= 0 ? seconds : 0; }

 private:
  double pushed_ = -1;  // s; below 0: no axis does
  double grows_ = 0;    // s
};

// A constant, as it is written, and its value.
struct Constant {
  std::string text;
  double value = 0;
};

class Statements {
 public:
  explicit Statements(unsigned seed) : random_(seed) {}

  struct Statement {
    std::string text;
    bool right = true;
  };
  Statement next() {
    static const std::vector<Statement (Statements::*)()> kAll{
        &Statements::speed,  &Statements::zone,  &Statements::acceleration, &Statements::motion,
        &Statements::wait,   &Statements::raise, &Statements::ask,          &Statements::element,
        &Statements::loop,   &Statements::press, &Statements::push,         &Statements::correct,
        &Statements::search, &Statements::weave, &Statements::value,        &Statements::place};
    return (this->*kAll[one_of(kAll.size())])();
  }

 private:
  std::size_t one_of(std::size_t many) { return std::uniform_int_distribution<std::size_t>(0, many - 1)(random_); }
  double among(const std::vector<double>& values) { return values[one_of(values.size())]; }
  Constant number(const std::vector<double>& values) {
    const double value = among(values);
    return {fmt::format("{}", value), value};
  }
  // An expression of numbers; now and then one that has no value.
  Constant expression(const std::vector<double>& values) {
    const double value = among(values);
    const std::string text = value < 0 ? fmt::format("({})", value) : fmt::format("{}", value);
    switch (one_of(12)) {
      case 0:
        return {text + " * 2", value * 2};
      case 1:
        return {"(" + text + " + 1)", value + 1};
      case 2:
        return {"-" + text, -value};
      case 3:
        return {"MAX(" + text + ", 2)", std::max(value, 2.0)};
      case 4:
        return {"ABS(" + text + ") / 4", std::abs(value) / 4};
      case 5:
        switch (one_of(6)) {
          case 0:
            return {text + " / 0", kNoValue};
          case 1:
            return {"SQRT(-1)", kNoValue};
          case 2:
            return {"ASIN(2) * " + text, kNoValue};
          case 3:
            return {"1e300 * 1e300", kNoValue};
          case 4:
            return {"5 MOD (2 - 2)", kNoValue};
          default:
            return {"1 / (3 < 2)", kNoValue};
        }
      default:
        return {fmt::format("{}", value), value};
    }
  }

  Statement speed() {
    const Constant part = expression({-5, 0, 0.5, 50, 100, 100.5});
    const Constant way = expression({-250, 0, 0.1, 250, 4000});
    return one_of(2) == 0 ? Statement{"SPEED " + part.text + "%", part.value > 0 && part.value <= 100}
                          : Statement{"SPEED " + way.text + " mm/s", way.value > 0};
  }
  Statement zone() {
    const Constant size = expression({-1, 0, 20, 1000, 1001});
    return {"ZONE " + size.text + " mm", size.value >= 0 && size.value <= 1000};
  }
  Statement acceleration() {
    const Constant part = expression({-5, 0, 0.5, 1, 50, 100, 101});
    return {"ACC " + part.text + "%", part.value >= 1 && part.value <= 100};
  }
  Statement motion() {
    const Statement fast = speed(), hard = acceleration(), wide = zone();
    const Constant x = expression({0, -50}), z = expression({100, 1e5});
    return {"MOVL P1 OFFSET " + x.text + ", 0, " + z.text + " " + fast.text + " " + hard.text + " " + wide.text,
            fast.right && hard.right && wide.right && !std::isnan(x.value) && !std::isnan(z.value)};
  }
  Statement wait() {
    const Constant met = expression({0, 0, 1, 2});
    const bool otherwise = one_of(2) == 0;
    return {"WAIT (" + met.text + ")" + (otherwise ? " TIMEOUT 20 ms ELSE\nEND" : " TIMEOUT 20 ms"),
            otherwise ? !std::isnan(met.value) : std::abs(met.value) > 0};
  }
  Statement raise() {
    const Constant error = expression({-1, 0, 0.5, 101});
    return {"TRY\nRAISE " + error.text + ", \"at \", 1\nRECOVER\nEND", error.value > 0};
  }
  Statement ask() {
    const Constant from = expression({0, 5, 40}), to = expression({1, 5, 39.5});
    const Constant step = number({-1, 0, 0.5, 100});
    const bool stepped = one_of(2) == 0;
    return {"ASK answer = \"how many\" " + from.text + " TO " + to.text + (stepped ? " STEP " + step.text : "") +
                " TIMEOUT 20 ms ELSE\nEND",
            from.value <= to.value && (!stepped || step.value > 0)};
  }
  Statement element() {
    const Constant index = expression({-1, 0, 0.5, 3, 4, 9});
    const bool inside = index.value >= 0 && index.value < 5 && index.value == std::floor(index.value);
    return {one_of(2) == 0 ? "list[" + index.text + "] = 3" : "SET O1 = list[" + index.text + "]", inside};
  }
  Statement loop() {
    const Constant from = expression({0, 3}), to = expression({-2, 5}), step = number({-2, 0, 0.5, 3});
    const Constant times = number({-1, 0, 1, 2.5, 4});
    if (one_of(2) == 0) {
      return {"LOOP " + times.text + "\nSET O1 = 1\nEND", times.value >= 1 && times.value == std::floor(times.value)};
    }
    return {"FOR i = " + from.text + " TO " + to.text + " STEP " + step.text + "\nSET O1 = i\nEND",
            !std::isnan(from.value) && !std::isnan(to.value) && step.value != 0};
  }
  // More than MOST ends the job, and so would the wanted force: of several directions the vector sum counts.
  Statement press() {
    const Constant first = expression({-30, 0, 12, 30, 65}), second = expression({0, 25, 45});
    const Constant most = number({-60, 0, 32.5, 60}), stiffness = number({0, 40}), limit = number({0, 5});
    const bool both = one_of(2) == 0;
    const double sum = both ? std::hypot(first.value, second.value) : std::abs(first.value);
    return {"PRESS " + first.text + ", F ALONG Z" + (both ? ", " + second.text + ", F ALONG X" : "") + " TOOL MOST " +
                most.text + " N STIFFNESS " + stiffness.text + " N/mm LIMIT " + limit.text +
                " mm RATE 10 mm/s\nWAIT 20 ms\nMOVL P1\nPRESS OFF",
            sum <= most.value && most.value > 0 && stiffness.value > 0 && limit.value > 0};
  }
  // Without FOR it ends as soon as the axis pushes with all of the torque, which takes torque / RAMP.
  Statement push() {
    const Constant torque = number({-20, 0, 20}), speed = number({0, 10}), ramp = number({0, 400, 4000});
    const Constant hold = number({0, 0.02, 0.1}), timeout = number({0.05, 0.1, 1});
    const bool ramped = one_of(2) == 0, held = one_of(2) == 0, until = !held && one_of(2) == 0;
    const Constant met = expression({0, 1});
    const double takes = (held ? hold.value : 0) + (ramped ? std::abs(torque.value) / ramp.value : 0);
    const bool in_time = until ? std::abs(met.value) > 0 : takes < timeout.value;
    return {"PUSH AXIS 3 TORQUE " + torque.text + " Nm SPEED " + speed.text + " deg/s" +
                (ramped ? " RAMP " + ramp.text + " Nm/s" : "") +
                (held    ? " FOR " + hold.text + "s"
                 : until ? " UNTIL " + met.text
                         : "") +
                " TIMEOUT " + timeout.text + "s",
            speed.value > 0 && (!ramped || ramp.value > 0) && in_time};
  }
  Statement correct() {
    const Constant y = expression({0, 3, 1e6}), limit = number({-1, 0, 20}), rate = number({0, 50});
    return {
        "CORRECT 0, " + y.text + ", 0 LIMIT " + limit.text + " mm RATE " + rate.text + " mm/s\nMOVL P1\nCORRECT OFF",
        !std::isnan(y.value) && limit.value > 0 && rate.value > 0};
  }
  Statement search() {
    const Constant met = expression({0, 1});
    return {"SEARCH P1 UNTIL " + met.text + " SPEED 20 mm/s", std::abs(met.value) > 0};
  }
  Statement weave() {
    const Constant width = number({0.4, 0.5, 200, 201}), length = number({0.4, 4, 1000, 1001});
    const Constant turned = number({-30, 90});
    return {"WEAVE SINE WIDTH " + width.text + " mm LENGTH " + length.text + " mm TURNED " + turned.text +
                "\nMOVL P1\nWEAVE OFF",
            width.value >= 0.5 && width.value <= 200 && length.value >= 0.5 && length.value <= 1000};
  }
  // Any value will do.
  Statement value() {
    const Constant one = expression({-3, 0, 7});
    static const std::vector<std::string> kUses{"SET O1 = {}",
                                                "VAR fresh{1} = {0}",
                                                "n = n + {}",
                                                "CALL sub {}",
                                                "FOLLOW O1 = {}\nFOLLOW O1 OFF",
                                                "MESSAGE \"it is \", {}",
                                                "IF {}\nSET O1 = 1\nEND",
                                                "WHILE {} AND n < 0\nEND",
                                                "SWITCH n\nCASE {}\nSET O1 = 1\nEND",
                                                "MOVL P1\nSET O1 = {} AFTER 20 mm"};
    return {fmt::format(fmt::runtime(kUses[one_of(kUses.size())]), one.text, declared_++), !std::isnan(one.value)};
  }
  Statement place() {
    const Constant x = expression({-300, 500}), yaw = expression({0, 400});
    return {"P1 = POSE " + x.text + ", 0, 300 RPY 180, 0, " + yaw.text, !std::isnan(x.value) && !std::isnan(yaw.value)};
  }

  std::mt19937 random_;
  int declared_ = 0;
};

constexpr const char* kBefore =
    "POINT P1 = POSE 500 0 300 RPY 180 0 0\nVAR n\nVAR answer\nVAR i\nVAR list[5]\nMOVJ P1\n";
constexpr std::size_t kLine = 7;  // of the statement

// Runs it to its end. Returns the message of an error.
std::string run(const JobBook& book) {
  ObligingCell cell;
  JobRunner sut(book);
  sut.start(0);
  for (int i = 0; i < 2000 && sut.running(); ++i) {
    constexpr double kPeriod = 0.004;
    cell.pass(kPeriod);
    static_cast<void>(sut.step_outputs(kPeriod, cell, cell));
    sut.step(kPeriod, cell, cell);
  }
  const JobReport report = sut.report();
  return report.state == JobState::Ended ? ""
                                         : fmt::format("state {}: {}", static_cast<int>(report.state), report.message);
}

TEST(Random_constants, Are_wrong_when_they_are_read_or_not_at_all) {
  const int runs = number_of("INDUROP_ROBOT_CONSTANTS", 20'000);
  int wrong = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    Statements statements(static_cast<unsigned>(seed));
    const auto [text, right] = statements.next();
    SCOPED_TRACE(fmt::format("seed {}: {}", seed, text));
    const ReadJobs read = parse_jobs({{"main.job", kBefore + text + "\n"}, {"sub.job", "PARAM a\nSET O1 = a\n"}});
    const std::string errors = base::to_text(read.diagnostics);
    ASSERT_EQ(read.diagnostics.empty(), right) << errors;
    if (right) {
      ASSERT_EQ(run(read.book), "");
      continue;
    }
    ++wrong;
    const auto line = static_cast<std::size_t>(read.diagnostics.front().place.line);
    ASSERT_GE(line, kLine) << errors;
    ASSERT_LE(line, kLine + 1) << errors;  // a TRY stands before its RAISE
  }
  fmt::print("{} of {} statements were wrong\n", wrong, runs);
  EXPECT_GT(wrong, runs / 4);
  EXPECT_LT(wrong, 3 * runs / 4);
}

}  // namespace
}  // namespace indurop::robot
