// SPDX-License-Identifier: Apache-2.0
// Grades of a machine.
#include "tools/cli/doctor/doctor_checks.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

class Doctor : public ::testing::Test {
 protected:
  Doctor() : root_(fs::temp_directory_path() / ("indurop_doctor_test." + std::to_string(getpid()))) {
    fs::create_directories(root_);
  }
  ~Doctor() override { fs::remove_all(root_); }
  void put(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  [[nodiscard]] Finding finding(const std::string& name) const {
    const auto all = examine_machine(root_);
    const auto found = std::find_if(all.begin(), all.end(), [&name](const Finding& f) { return f.name == name; });
    return found == all.end() ? Finding{} : *found;
  }

  fs::path root_;
};

TEST_F(Doctor, Slow_clock_source_is_warned_of) {
  const std::string file = "sys/devices/system/clocksource/clocksource0/current_clocksource";
  put(file, "tsc\n");
  EXPECT_EQ(finding("clock-source").grade, Grade::Ok);
  put(file, "hpet\n");
  EXPECT_EQ(finding("clock-source").grade, Grade::Warn);
}

TEST_F(Doctor, Swap_in_use_is_warned_of) {
  put("proc/swaps", "Filename Type Size Used Priority\n");
  EXPECT_EQ(finding("swap").grade, Grade::Ok);
  put("proc/swaps", "Filename Type Size Used Priority\n/dev/sda2 partition 100 0 -2\n");
  EXPECT_EQ(finding("swap").grade, Grade::Warn);
}

TEST_F(Doctor, Every_core_must_run_at_full_frequency) {
  EXPECT_EQ(finding("cpu-frequency").grade, Grade::Ok);
  put("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
  EXPECT_EQ(finding("cpu-frequency").grade, Grade::Ok);
  put("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave\n");
  EXPECT_EQ(finding("cpu-frequency").grade, Grade::Warn);
}

TEST_F(Doctor, Virtual_machine_is_recognised) {
  put("proc/cpuinfo", "processor : 0\nflags : fpu tsc hypervisor lm\n");
  EXPECT_EQ(finding("virtual-machine").grade, Grade::Warn);
  put("proc/cpuinfo", "processor : 0\nflags : fpu tsc lm\n");
  EXPECT_EQ(finding("virtual-machine").grade, Grade::Ok);
}

TEST_F(Doctor, A_file_is_no_folder_for_the_state) {
  ::setenv("INDUROP_STATE_DIR", (root_ / "state").c_str(), 1);
  EXPECT_EQ(finding("state-folder").grade, Grade::Ok) << "it can be made";
  put("state", "");
  fs::permissions(root_ / "state", fs::perms::owner_all);
  EXPECT_EQ(finding("state-folder").grade, Grade::Warn);
  ::unsetenv("INDUROP_STATE_DIR");
}

TEST_F(Doctor, Advice_in_a_container_names_its_options) {
  put("dev/cpu_dma_latency", "");
  EXPECT_TRUE(finding("container").found.starts_with("no")) << finding("container").found;
  EXPECT_EQ(finding("idle-states").grade, Grade::Ok);
  fs::remove(root_ / "dev/cpu_dma_latency");
  put("run/.containerenv", "");
  EXPECT_TRUE(finding("container").found.starts_with("yes")) << finding("container").found;
  EXPECT_NE(finding("idle-states").advice.find("--device /dev/cpu_dma_latency"), std::string::npos);
}

TEST_F(Doctor, Machine_made_from_an_image_of_docker_is_no_container) {
  put(".dockerenv", "");
  EXPECT_TRUE(finding("container").found.starts_with("yes")) << finding("container").found;
  put("proc/2/comm", "kthreadd\n");
  EXPECT_TRUE(finding("container").found.starts_with("no")) << finding("container").found;
}

TEST_F(Doctor, Whatever_is_not_fine_comes_with_advice) {
  for (const Finding& f : examine_machine()) {
    EXPECT_FALSE(f.name.empty());
    EXPECT_FALSE(f.found.empty()) << f.name;
    EXPECT_EQ(f.advice.empty(), f.grade == Grade::Ok) << f.name;
  }
}

TEST_F(Doctor, Late_wake_ups_are_graded) {
  EXPECT_EQ(grade_latency(5'000, 40'000, 90'000, 2000, true).grade, Grade::Ok);
  EXPECT_EQ(grade_latency(5'000, 140'000, 900'000, 2000, true).grade, Grade::Warn);
  EXPECT_EQ(grade_latency(5'000, 4'000'000, 9'000'000, 2000, true).grade, Grade::Fail);
  EXPECT_NE(grade_latency(1, 1, 1, 1, false).found.find("without real-time priority"), std::string::npos);
}

}  // namespace
}  // namespace indurop::tools
