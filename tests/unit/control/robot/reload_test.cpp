// SPDX-License-Identifier: Apache-2.0
// Jobs that are read again at standstill: from then on it does what a robot does that was started with the new files,
// to the last bit of its set points; and whatever is wrong changes nothing.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "drive_answer.h"
#include "robot_fixture.h"
#include "tests/unit/allocations.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

// Variables by name: those called unknown... are not there.
class Named final : public Signals {
 public:
  explicit Named(const std::vector<std::string>& names) : present_(names) {}
  double read(std::size_t index) noexcept override { return values[present_[index]]; }
  void write(std::size_t index, double value) noexcept override { values[present_[index]] = value; }
  Result<void, std::string> prepare(const std::vector<std::string>& names) override {
    next_ = names;
    const bool known =
        std::none_of(names.begin(), names.end(), [](const std::string& name) { return name.rfind("unknown", 0) == 0; });
    return known ? Result<void, std::string>() : std::string("there is no variable unknown");
  }
  void adopt() noexcept override { std::swap(present_, next_); }

  std::map<std::string, double> values;

 private:
  std::vector<std::string> present_, next_;
};

class Robot {
 public:
  explicit Robot(const std::string& job, bool in_tick = true, bool (*learned)(bool) noexcept = nullptr)
      : folder(std::filesystem::temp_directory_path() /
               ("reload." + std::to_string(::getpid()) + "." + std::to_string(++count))) {
    std::filesystem::create_directories(folder);
    write("arm.urdf", solid_cell_urdf());
    write("main.job", job);
    Settings settings;
    settings.urdf = folder / "arm.urdf";
    settings.jobs = {folder / "main.job"};
    settings.plan_in_tick = in_tick;
    settings.learned = learned;
    std::vector<std::string> errors;
    sut = Controller::load(settings, errors);
    if (sut == nullptr) {
      throw std::runtime_error(errors.at(0));
    }
    signals = std::make_unique<Named>(sut->signals());
    in.requests_known = true;
    for (DriveIn& drive : in.drives) {
      drive.status = 0x40;
    }
    step();
    EXPECT_TRUE(serve(Service::GroupEnable));
  }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  ~Robot() { std::filesystem::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  void step() {
    sut->step(in, *signals, out);
    for (std::size_t k = 0; k < kJoints; ++k) {
      DriveIn& drive = in.drives[k];
      const unsigned control = out.drives[k].control & 0x0FU;
      drive.status = test::next_status(drive.status, control);
      drive.mode = out.drives[k].mode;
      drive.position = drive.status == 0x27 ? out.drives[k].position : drive.position;
    }
  }
  void ask(Service service, std::uint32_t job = 1) {
    in.service.job = job;
    in.service.code = static_cast<std::int32_t>(service);
    in.service.number = out.acknowledged + 1;
  }
  // True if it ends well.
  bool serve(Service service, std::uint32_t job = 1) {
    ask(service, job);
    for (int i = 0; i < 20000 && (out.done != in.service.number); ++i) {
      step();
      std::this_thread::yield();
    }
    return out.done == in.service.number && out.error == ErrorCode::Ok;
  }
  // Set points of the whole job.
  std::vector<std::array<double, kJoints>> run_job() {
    std::vector<std::array<double, kJoints>> seen;
    ask(Service::JobStart);
    for (int i = 0; i < 4000; ++i) {
      step();
      seen.push_back(out.command);
      if (i > 3 && (out.job.state == JobState::Ended || out.job.state == JobState::Failed)) {
        break;
      }
    }
    return seen;
  }

  static inline int count = 0;
  std::filesystem::path folder;
  std::unique_ptr<Controller> sut;
  std::unique_ptr<Named> signals;
  Inputs in;
  Outputs out;
};

constexpr const char* kHome = "POINT HOME = JOINT 0 -20 10 0 100 0\n";
constexpr const char* kFirst =
    "TOOL grip = POSE 0 0 120 RPY 0 0 0\nPOINT HOME = JOINT 0 -20 10 0 100 0\nPOINT A = JOINT 20 10 -20 0 60 0\n"
    "TOOL grip\nSET one ON\nMOVJ A\nMOVJ HOME\n";
// Another tool before it, and other variables.
constexpr const char* kTools =
    "TOOL wide = POSE 0 30 150 RPY 0 0 20\nTOOL grip = POSE 0 0 90 RPY 0 0 0\n"
    "POINT HOME = JOINT 0 -20 10 0 100 0\nPOINT B = POSE 500 100 400 RPY 180 0 180\n"
    "TOOL wide\nSET two ON\nMOVJ B\nMOVL B OFFSET 0, 0, 50\nTOOL grip\nMOVJ HOME\nSET three 5\n";
// A frame, a zone and a load.
constexpr const char* kZone =
    "TOOL grip = POSE 0 0 120 RPY 0 0 0\nPOINT HOME = JOINT 0 -20 10 0 100 0\n"
    "FRAME table = POSE 400 0 200 RPY 0 0 30\nKEEPOUT post = BOX 570 370 0 630 430 300\n"
    "POINT C = POSE 50 60 100 RPY 180 0 180 IN table\nLOAD 2 kg CENTRE 0 0 40\nMOVJ HOME\nZONE 20\nMOVL C\nMOVJ HOME\n";
constexpr const char* kSlow =
    "TOOL grip = POSE 0 0 120 RPY 0 0 0\nPOINT HOME = JOINT 0 -20 10 0 100 0\nPOINT A = JOINT 30 0 0 0 60 0\n"
    "SPEED 30%\nMOVJ A\nWAIT 0.1s\n";

TEST(Reload, From_then_on_all_is_as_if_it_had_been_started_so) {
  for (const char* other : {kTools, kZone, kSlow}) {
    Robot fresh(other);
    Robot sut(kFirst);
    sut.run_job();
    ASSERT_EQ(sut.out.job.state, JobState::Ended) << sut.out.job.message;
    sut.write("main.job", std::string(kHome) + "MOVJ HOME\n");
    fresh.write("main.job", other);
    sut.write("main.job", other);
    ASSERT_TRUE(sut.serve(Service::JobReload)) << sut.out.job.message;
    // Where the first job ended both begin.
    fresh.serve(Service::GroupDisable);
    sut.serve(Service::GroupDisable);
    for (std::size_t k = 0; k < kJoints; ++k) {
      fresh.in.drives[k].position = sut.in.drives[k].position;
    }
    for (int i = 0; i < 20; ++i) {
      fresh.step();
      sut.step();
    }
    ASSERT_TRUE(fresh.serve(Service::GroupEnable));
    ASSERT_TRUE(sut.serve(Service::GroupEnable));
    const auto expected = fresh.run_job();
    const auto seen = sut.run_job();
    EXPECT_EQ(fresh.out.job.state, JobState::Ended) << fresh.out.job.message;
    EXPECT_EQ(sut.out.job.state, JobState::Ended) << sut.out.job.message;
    EXPECT_GT(expected.size(), 20U);
    EXPECT_EQ(seen, expected) << other;
    fresh.signals->values.erase("one");
    sut.signals->values.erase("one");
    EXPECT_EQ(sut.signals->values, fresh.signals->values);
    EXPECT_STREQ(sut.out.tool_name, fresh.out.tool_name);
  }
}

TEST(Reload, What_is_wrong_is_said_and_changes_nothing) {
  const std::pair<std::string, const char*> wrong[] = {
      {"MOVJ NOWHERE\nMOVJ NEITHER\n", "main.job:1:6: error: "},
      {std::string(kFirst) + "SET unknown ON\n", "there is no variable unknown"},
      {"TOOL grip = POSE 0 0 120 RPY 0 0 0\nPOINT P = JOINT 500 0 0 0 0 0\nMOVJ P\n", "main.job:2:"},
      {std::string(kHome) + "MOVJ HOME\n", "the tool that is held is not in the files any more"},
  };
  Robot before(kFirst);
  const auto expected = before.run_job();
  Robot sut(kFirst);
  EXPECT_EQ(sut.run_job(), expected);
  before.run_job();
  const auto again = before.run_job();
  sut.run_job();
  for (const auto& [job, said] : wrong) {
    sut.write("main.job", job);
    EXPECT_FALSE(sut.serve(Service::JobReload)) << job;
    EXPECT_THAT(sut.out.job.message, HasSubstr(said));
    EXPECT_EQ(sut.run_job(), again);
    EXPECT_EQ(sut.out.job.state, JobState::Ended);
  }
  std::filesystem::remove(sut.folder / "main.job");
  EXPECT_FALSE(sut.serve(Service::JobReload));
  EXPECT_THAT(sut.out.job.message, HasSubstr("main.job:1:1: error: "));
  sut.write("main.job", kFirst);
  sut.write("arm.urdf", solid_cell_urdf() + "\n");
  EXPECT_FALSE(sut.serve(Service::JobReload));
  EXPECT_THAT(sut.out.job.message, HasSubstr("the arm's description (property urdf) has changed"));
  sut.write("arm.urdf", solid_cell_urdf());
  EXPECT_TRUE(sut.serve(Service::JobReload));
  EXPECT_EQ(sut.run_job(), again);
}

TEST(Reload, Nothing_is_taken_while_it_moves_and_a_job_that_was_left_is_forgotten) {
  Robot sut(kFirst);
  sut.ask(Service::JobStart);
  for (int i = 0; i < 20; ++i) {
    sut.step();
  }
  ASSERT_EQ(sut.out.state, GroupState::Moving);
  EXPECT_FALSE(sut.serve(Service::JobReload));
  EXPECT_EQ(sut.out.error, ErrorCode::State);
  EXPECT_TRUE(sut.serve(Service::JobStop));
  EXPECT_TRUE(sut.out.job.can_resume);
  EXPECT_TRUE(sut.serve(Service::JobReload)) << sut.out.job.message;
  EXPECT_FALSE(sut.out.job.can_resume);
  EXPECT_FALSE(sut.serve(Service::JobResume));
  EXPECT_EQ(sut.out.error, ErrorCode::NoResume);
}

bool g_made = false;
std::uint64_t g_allocated_before = 0;
bool note_made(bool what) noexcept {
  g_allocated_before = g_made ? g_allocated_before : g_allocations.load();
  g_made = g_made || what;
  return what;
}

// The thread has nothing to do any more once the period that takes what it has read knows that it is there; before, it
// may read during the same period.
TEST(Reload, The_tick_allocates_nothing_and_goes_on_meanwhile) {
  Robot sut(kFirst, false, note_made);
  for (int run = 0; run < 3; ++run) {
    sut.write("main.job", kZone);
    g_made = false;
    sut.ask(Service::JobReload);
    int periods = 0;
    std::uint64_t allocated = 0;
    for (; periods < 1'000'000 && (sut.out.done != sut.in.service.number); ++periods) {
      sut.step();
      allocated = g_made ? g_allocations - g_allocated_before : 0;
      std::this_thread::yield();
    }
    EXPECT_EQ(sut.out.error, ErrorCode::Ok) << sut.out.job.message;
    EXPECT_TRUE(g_made);
    EXPECT_EQ(allocated, 0U);
    EXPECT_GT(periods, 1);
  }
}

}  // namespace
}  // namespace indurop::robot
