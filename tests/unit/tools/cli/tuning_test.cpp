// SPDX-License-Identifier: Apache-2.0
// Settings of a machine: a copy of its files.
#include "tools/cli/doctor/tuning.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kGovernor = "/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor";

class TuningTest : public testing::Test {
 protected:
  TuningTest() : root_(fs::temp_directory_path() / ("indurop_tuning_test." + std::to_string(getpid()))) {
    put(kGovernor, "performance\n");
    put("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
    put("/proc/sys/kernel/random/boot_id", "first\n");
    put("/proc/cmdline", "quiet isolcpus=1 nohz_full=1 rcu_nocbs=1\n");
  }
  ~TuningTest() override { fs::remove_all(root_); }
  void put(const std::string& file, const std::string& text) const {
    const fs::path path = root_ / file.substr(1);
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  [[nodiscard]] std::string get(const std::string& file) const {
    std::ifstream in(root_ / file.substr(1));
    std::string line;
    std::getline(in, line);
    return line;
  }
  [[nodiscard]] std::vector<std::string> changes() const {
    std::vector<std::string> found;
    for (const Setting& setting : examine_tuning(1, root_).settings) {
      found.push_back(setting.file + ": " + setting.now + " -> " + setting.wanted);
    }
    return found;
  }
  [[nodiscard]] fs::path record() const { return root_ / "state/tuning.json"; }
  fs::path root_;
};

TEST_F(TuningTest, A_machine_that_is_tuned_needs_nothing) {
  EXPECT_THAT(changes(), IsEmpty());
  EXPECT_THAT(examine_tuning(1, root_).boot, IsEmpty());
  EXPECT_THAT(examine_tuning(1, root_).hints, IsEmpty());
}

TEST_F(TuningTest, Says_what_is_different) {
  put(kGovernor, "powersave\n");
  put("/sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never\n");
  put("/proc/sys/vm/stat_interval", "1\n");
  EXPECT_THAT(changes(), ElementsAre(std::string(kGovernor) + ": powersave -> performance",
                                     "/sys/kernel/mm/transparent_hugepage/enabled: always -> madvise",
                                     "/proc/sys/vm/stat_interval: 1 -> 120"));
}

TEST_F(TuningTest, Interrupts_are_kept_off_the_core_of_the_node) {
  put("/proc/irq/default_smp_affinity", "3\n");
  put("/proc/irq/16/smp_affinity", "3\n");
  put("/proc/irq/17/smp_affinity", "1\n");
  put("/proc/irq/18/smp_affinity", "00000000,00000002\n");
  EXPECT_THAT(changes(), ElementsAre("/proc/irq/default_smp_affinity: 3 -> 1", "/proc/irq/16/smp_affinity: 3 -> 1",
                                     "/proc/irq/18/smp_affinity: 00000000,00000002 -> 1"));
}

TEST_F(TuningTest, Masks_of_many_cores_are_written_in_groups) {
  for (int core = 2; core < 40; ++core) {
    put("/sys/devices/system/cpu/cpu" + std::to_string(core) + "/online", "1\n");
  }
  put("/proc/irq/16/smp_affinity", "ff,ffffffff\n");
  EXPECT_EQ(examine_tuning(33, root_).settings.back().wanted, "fd,ffffffff");
  EXPECT_EQ(examine_tuning(1, root_).settings.back().wanted, "ff,fffffffd");
}

TEST_F(TuningTest, The_command_line_of_the_kernel_is_proposed) {
  put("/proc/cmdline", "quiet nohz_full=1\n");
  EXPECT_THAT(examine_tuning(1, root_).boot, ElementsAre("isolcpus=managed_irq,domain,1", "rcu_nocbs=1"));
}

TEST_F(TuningTest, What_is_set_can_be_undone) {
  put(kGovernor, "powersave\n");
  put("/proc/sys/vm/stat_interval", "1\n");
  const auto refused = apply_tuning(examine_tuning(1, root_), record(), root_);
  ASSERT_TRUE(refused.ok());
  EXPECT_THAT(*refused, IsEmpty());
  EXPECT_EQ(get(kGovernor), "performance");
  EXPECT_THAT(changes(), IsEmpty());
  const auto undone = undo_tuning(record(), root_);
  ASSERT_TRUE(undone.ok());
  EXPECT_EQ(undone->settings, 2U);
  EXPECT_EQ(get(kGovernor), "powersave");
  EXPECT_EQ(get("/proc/sys/vm/stat_interval"), "1");
  EXPECT_FALSE(undo_tuning(record(), root_).ok());
}

TEST_F(TuningTest, A_second_time_keeps_what_was_there_first) {
  put(kGovernor, "powersave\n");
  ASSERT_TRUE(apply_tuning(examine_tuning(1, root_), record(), root_).ok());
  put(kGovernor, "ondemand\n");
  ASSERT_TRUE(apply_tuning(examine_tuning(1, root_), record(), root_).ok());
  ASSERT_TRUE(undo_tuning(record(), root_).ok());
  EXPECT_EQ(get(kGovernor), "powersave");
}

TEST_F(TuningTest, After_a_new_start_nothing_is_undone) {
  put(kGovernor, "powersave\n");
  ASSERT_TRUE(apply_tuning(examine_tuning(1, root_), record(), root_).ok());
  put("/proc/sys/kernel/random/boot_id", "second\n");
  const auto undone = undo_tuning(record(), root_);
  ASSERT_FALSE(undone.ok());
  EXPECT_THAT(undone.error().text, HasSubstr("was started since"));
  EXPECT_EQ(get(kGovernor), "performance");
  EXPECT_FALSE(fs::exists(record()));
}

TEST_F(TuningTest, What_the_kernel_refuses_is_named_and_the_rest_is_set) {
  put("/proc/sys/vm/stat_interval", "1\n");
  Tuning tuning = examine_tuning(1, root_);
  tuning.settings.insert(tuning.settings.begin(), {"/proc/irq/9/smp_affinity", "3", "1", ""});
  const auto refused = apply_tuning(tuning, record(), root_);
  ASSERT_TRUE(refused.ok());
  EXPECT_THAT(*refused, ElementsAre(HasSubstr("/proc/irq/9/smp_affinity: No such file")));
  EXPECT_EQ(get("/proc/sys/vm/stat_interval"), "120");
}

}  // namespace
}  // namespace indurop::tools
