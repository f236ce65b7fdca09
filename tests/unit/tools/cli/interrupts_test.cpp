// SPDX-License-Identifier: Apache-2.0
// Interrupts of disks and network on the cores of ticks, in a copy of what the kernel shows of a machine.
#include "tools/cli/doctor/interrupts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

class Interrupts : public ::testing::Test {
 protected:
  Interrupts() : root_(fs::temp_directory_path() / ("indurop_interrupts_test." + std::to_string(getpid()))) {
    put("proc/interrupts",
        "           CPU0       CPU1       \n"
        " 35:          0          1 PCI-MSIX-0000:00:02.0   0-edge      virtio1-config\n"
        " 36:          0    4982744 PCI-MSIX-0000:00:02.0   1-edge      virtio1-req.0\n"
        " 38:          0      57286 PCI-MSIX-0000:00:03.0   1-edge      virtio2-input.0\n"
        " 39:      47498          0 PCI-MSIX-0000:00:03.0   2-edge      virtio2-output.0\n"
        " 42:          0     131418 PCI-MSIX-0000:00:04.0   2-edge      virtio3-tx\n"
        "NMI:          0          0   Non-maskable interrupts\n");
    device("sys/block/vda", "0000:00:02.0/virtio1", {35, 36});
    device("sys/class/net/eth0", "0000:00:03.0/virtio2", {37, 38, 39});
    put("proc/irq/35/effective_affinity_list", "1\n");
    put("proc/irq/36/effective_affinity_list", "1\n");
    put("proc/irq/38/effective_affinity_list", "1\n");
    put("proc/irq/39/effective_affinity_list", "0\n");
    put("proc/irq/42/effective_affinity_list", "1\n");
  }
  ~Interrupts() override { fs::remove_all(root_); }
  void put(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  void device(const std::string& name, const std::string& place, const std::vector<int>& numbers) const {
    const fs::path real = root_ / "sys/devices/pci0000:00" / place;
    fs::create_directories(real);
    fs::create_directories(root_ / name);
    fs::create_directory_symlink(real, root_ / name / "device");
    for (const int number : numbers) {
      put("sys/devices/pci0000:00/" + fs::path(place).parent_path().string() + "/msi_irqs/" + std::to_string(number),
          "msix\n");
    }
  }
  [[nodiscard]] Finding look(const std::vector<int>& cores, Movable movable = Movable::Yes) const {
    return examine_interrupts(cores, root_, [movable](int) { return movable; });
  }
  static bool says(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

  fs::path root_;
};

TEST_F(Interrupts, Of_disk_and_network_on_the_core_of_ticks_are_named) {
  const Finding finding = look({1});
  EXPECT_EQ(finding.grade, Grade::Warn);
  EXPECT_TRUE(says(finding.found, "disk vda (interrupt 36, core 1)")) << finding.found;
  EXPECT_TRUE(says(finding.found, "network eth0 (interrupt 38, core 1)")) << finding.found;
  EXPECT_FALSE(says(finding.found, "35")) << "hardly ever fires";
  EXPECT_FALSE(says(finding.found, "39")) << "is taken by another core";
  EXPECT_FALSE(says(finding.found, "42")) << "is of another device";
  EXPECT_TRUE(says(finding.advice, "tune --apply --core 1")) << finding.advice;
  EXPECT_TRUE(says(finding.advice, "/dev/shm")) << finding.advice;
  EXPECT_FALSE(says(finding.advice, "does not let"));
}

TEST_F(Interrupts, Of_the_network_alone_are_no_reason_to_record_to_memory) {
  const Finding finding = look({0});
  EXPECT_EQ(finding.found, "where ticks run: network eth0 (interrupt 39, core 0)");
  EXPECT_FALSE(says(finding.advice, "/dev/shm")) << finding.advice;
}

TEST_F(Interrupts, That_cannot_be_moved_are_said_to_be_so) {
  const Finding finding = look({1}, Movable::No);
  EXPECT_TRUE(says(finding.found, "cannot be moved")) << finding.found;
  EXPECT_TRUE(says(finding.advice, "does not let interrupt 36, 38 be moved")) << finding.advice;
  EXPECT_TRUE(says(finding.advice, "another core")) << finding.advice;
  EXPECT_FALSE(says(finding.advice, "--apply")) << finding.advice;
}

TEST_F(Interrupts, Elsewhere_or_silent_are_fine) {
  EXPECT_EQ(look({7}).grade, Grade::Ok);
  EXPECT_TRUE(look({7}).advice.empty());
  put("proc/irq/39/effective_affinity_list", "0-1\n");
  EXPECT_FALSE(says(look({1}).found, "interrupt 39")) << "never came to this core";
  put("proc/irq/36/effective_affinity_list", "0,2-3\n");
  EXPECT_FALSE(says(look({1}).found, "vda"));
}

TEST_F(Interrupts, A_machine_that_shows_nothing_is_fine) {
  fs::remove_all(root_);
  EXPECT_EQ(look({0, 1}).grade, Grade::Ok);
}

}  // namespace
}  // namespace indurop::tools
