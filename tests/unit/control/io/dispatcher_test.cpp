// SPDX-License-Identifier: Apache-2.0
// From ioconfig.xml to shared variables and back, with devices that live in the tick. The variables are private memory
// of this process, which the dispatcher shares with the generated header.
#include "control/io/dispatcher.h"

#include <gmock/gmock.h>
#include <indurop/indurop.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include <indurop/generated.h>

#include "cell_schema.h"

namespace indurop::io {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;

class DispatcherTest : public ::testing::Test {
 protected:
  DispatcherTest() : folder_(std::filesystem::temp_directory_path() / ("indurop-io-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~DispatcherTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::unique_ptr<Dispatcher> make(const std::string& devices, Phase phase = Phase::Both) {
    const auto file = write("io.xml", "<ioconfig>\n" + devices + "\n</ioconfig>\n");
    Dispatcher::Made made = Dispatcher::make(file, schema_, phase);
    for (const base::Diagnostic& each : made.diagnostics) {
      problems_.push_back(base::to_string(each));
    }
    return std::move(made.dispatcher);
  }
  std::unique_ptr<Dispatcher> started(const std::string& devices) {
    auto sut = make(devices);
    EXPECT_THAT(problems_, IsEmpty());
    EXPECT_TRUE(sut != nullptr && sut->start(0));
    return sut;
  }

  schema::Schema schema_ = cell_schema();
  std::filesystem::path folder_;
  std::vector<std::string> problems_;
};

TEST_F(DispatcherTest, Axis_structs_of_figure_11_are_a_drive) {
  const auto sut = started(R"(<device name="axis" driver="cia402" in="AXIS1_IN" out="AXIS1_OUT" start="90"/>)");
  TEST_CELL::AXIS1_OUT = {};
  sut->run(milliseconds(1));
  EXPECT_EQ(TEST_CELL::AXIS1_IN.position, 330'000) << "90 degrees of 1 320 000 counts";
  EXPECT_EQ(TEST_CELL::AXIS1_IN.status & 0x4F, 0x40);
  constexpr std::uint16_t kEnablingSteps[] = {0x06, 0x07, 0x0F};
  for (const std::uint16_t control : kEnablingSteps) {
    TEST_CELL::AXIS1_OUT.control = control;
    TEST_CELL::AXIS1_OUT.mode = 8;
    TEST_CELL::AXIS1_OUT.position = 330'000;
    sut->run(milliseconds(1));
  }
  EXPECT_EQ(TEST_CELL::AXIS1_IN.status & 0x6F, 0x27) << "enabled";
  EXPECT_EQ(TEST_CELL::AXIS1_IN.mode, 8);
  for (int i = 0; i < 100; ++i) {
    TEST_CELL::AXIS1_OUT.position += 500;
    sut->run(milliseconds(1));
  }
  EXPECT_NEAR(TEST_CELL::AXIS1_IN.position, 380'000, 1000);
  EXPECT_EQ(TEST_CELL::AXIS1_IN.error, 0);
}

TEST_F(DispatcherTest, Columns_of_a_file_become_variables) {
  write("in.csv", "time_ms,I0,p\n0,1,2.5\n2,2,\n");
  const auto sut = started(R"(<device name="rec" driver="csv" file="in.csv" quality="link_good" errors="link_errors">
    <input variable="TEST_CELL::I0" quality="I0_quality"/>
    <input variable="pressure" at="p" scale="2" offset="1" bad="-1"/>
    <input variable="speeds[2]" at="p"/>
  </device>)");
  TEST_CELL::speeds[1] = 77;
  sut->run(milliseconds(1));
  EXPECT_EQ(TEST_CELL::I0, 1);
  EXPECT_EQ(TEST_CELL::I0_quality, 1);
  EXPECT_EQ(TEST_CELL::pressure, 6.0);
  EXPECT_EQ(TEST_CELL::speeds[2], 2);
  EXPECT_EQ(TEST_CELL::speeds[1], 77) << "parts that are no points are left alone";
  EXPECT_TRUE(TEST_CELL::link_good);
  sut->run(milliseconds(1));
  sut->run(milliseconds(1));
  EXPECT_EQ(TEST_CELL::I0, 2);
  EXPECT_EQ(TEST_CELL::pressure, -1.0);
  EXPECT_EQ(TEST_CELL::speeds[2], 2) << "held";
  EXPECT_EQ(TEST_CELL::link_errors, 0U);
}

TEST_F(DispatcherTest, An_input_is_restored_after_any_overwrite) {
  write("in.csv", "time,I0\n0,5\n");
  const auto sut = started(R"(<device name="rec" driver="csv" file="in.csv"><input variable="I0"/></device>)");
  sut->run(milliseconds(1));
  TEST_CELL::I0 = 99;
  sut->run(milliseconds(1));
  EXPECT_EQ(TEST_CELL::I0, 5);
}

TEST_F(DispatcherTest, Values_that_do_not_change_are_not_written) {
  write("in.csv", "time,s\n0,5\n");
  const auto sut =
      started(R"(<device name="rec" driver="csv" file="in.csv"><input variable="speeds[0]" at="s"/></device>)");
  sut->run(milliseconds(1));
  const auto& row = INDUROP_TYPEOF(TEST_CELL::speeds)::tag_type::ref();
  const auto* ring = static_cast<const abi::RingHeader*>(row.entry);
  const std::uint64_t versions = ring->seq.load();
  for (int i = 0; i < 10; ++i) {
    sut->run(milliseconds(1));
  }
  EXPECT_EQ(ring->seq.load(), versions);
}

TEST_F(DispatcherTest, A_missing_file_and_a_missing_column_are_named) {
  EXPECT_EQ(make(R"(<device name="rec" driver="csv" file="gone.csv"><input variable="I0"/></device>)"), nullptr);
  write("in.csv", "time,a,b\n0,5,6\n");
  EXPECT_EQ(make(R"(<device name="rec" driver="csv" file="in.csv"><input variable="I0"/></device>)"), nullptr);
  ASSERT_EQ(problems_.size(), 2U);
  EXPECT_THAT(problems_[0], HasSubstr("gone.csv: error: cannot be read: No such file"));
  EXPECT_THAT(problems_[1], HasSubstr("in.csv:1:1: error: there is no column 'I0'; there are a, b"));
}

TEST_F(DispatcherTest, A_pipe_in_place_of_the_recorded_values_is_refused_at_once) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.csv").c_str(), 0600), 0);
  EXPECT_EQ(make(R"(<device name="rec" driver="csv" file="pipe.csv"><input variable="I0"/></device>)"), nullptr);
  ASSERT_EQ(problems_.size(), 1U);
  EXPECT_THAT(problems_[0], HasSubstr("pipe.csv: error: cannot be read: it is a pipe, not a file"));
}

TEST_F(DispatcherTest, A_drive_cannot_be_split_among_two_modules) {
  EXPECT_EQ(make(R"(<device name="axis" driver="cia402" in="AXIS1_IN" out="AXIS1_OUT"/>)", Phase::Inputs), nullptr);
  ASSERT_EQ(problems_.size(), 1U);
  EXPECT_THAT(problems_[0], HasSubstr("io.xml:2:1: error: the inputs and outputs of cia402 device axis cannot be"));
}

TEST_F(DispatcherTest, Two_drives_stay_apart) {
  const auto sut = started(R"(<device name="a" driver="cia402" in="AXIS1_IN" out="AXIS1_OUT" start="10"/>
                              <device name="b" driver="cia402" in="AXIS2_IN" out="AXIS2_OUT" start="20"/>)");
  sut->run(milliseconds(10));
  EXPECT_NEAR(TEST_CELL::AXIS1_IN.position, 36'667, 1);
  EXPECT_NEAR(TEST_CELL::AXIS2_IN.position, 73'333, 1);
}

}  // namespace
}  // namespace indurop::io
