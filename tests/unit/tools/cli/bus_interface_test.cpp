// SPDX-License-Identifier: Apache-2.0
// What is said of a network interface for a fieldbus.
#include "tools/cli/doctor/bus_interface.h"

#include <gmock/gmock.h>

#include <fstream>

namespace indurop::tools {
namespace {

using testing::HasSubstr;

// A card as its driver sets it up, and as it should be.
InterfaceFacts card() {
  return {true, true, true, true, "igb", {3, 50, true}, {124, 125}};
}
InterfaceFacts tuned_card() {
  return {true, true, true, false, "igb", {0, 0, false}, {124, 125}};
}

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += std::string(to_text(finding.grade)) + " " + finding.found + " | " + finding.advice + "\n";
  }
  return text;
}

TEST(BusInterface, All_that_delays_a_frame_is_named_with_its_command) {
  const std::string sut = text_of(examine_interface("eth1", card(), true));
  EXPECT_THAT(sut, HasSubstr("WARN eth1: the kernel sends frames of its own there (IPv6) | sysctl net.ipv6.conf.eth1"));
  EXPECT_THAT(sut, HasSubstr("WARN eth1: the card holds back interrupts for 3 us (receive) and 50 us (send) | "));
  EXPECT_THAT(sut, HasSubstr("ethtool -C eth1 adaptive-rx off rx-usecs 0 tx-usecs 0"));
  EXPECT_THAT(sut, HasSubstr("ethtool -K eth1 gro off lro off"));
  EXPECT_THAT(sut, HasSubstr("OK eth1: interrupts 124, 125, handled by threads of the kernel | "));
}

TEST(BusInterface, One_that_is_fit_has_one_finding) {
  EXPECT_EQ(text_of(examine_interface("eth1", tuned_card(), false)), "OK eth1: fit (igb) | \n");
}

TEST(BusInterface, One_that_is_not_there_or_off_fails) {
  EXPECT_THAT(text_of(examine_interface("eth7", facts_of_interface("eth7"), false)),
              HasSubstr("FAIL eth7: there is no such network interface | `ip link`"));
  InterfaceFacts off = tuned_card();
  off.is_up = false;
  EXPECT_EQ(text_of(examine_interface("eth1", off, false)), "FAIL eth1: it is switched off | ip link set eth1 up\n");
  off.is_up = true;
  off.has_carrier = false;
  EXPECT_THAT(text_of(examine_interface("eth1", off, false)), HasSubstr("WARN eth1: no link"));
}

TEST(BusInterface, Facts_are_read_from_the_kernel) {
  namespace fs = std::filesystem;
  const fs::path root = fs::temp_directory_path() / ("indurop_interface_" + std::to_string(::getpid()));
  const fs::path folder = root / "sys/class/net/eth1";
  fs::create_directories(folder / "device/msi_irqs/130");
  fs::create_directories(folder / "device/msi_irqs/129");
  fs::create_directories(root / "proc/sys/net/ipv6/conf/eth1");
  fs::create_symlink("../../../bus/pci/drivers/r8169", folder / "device/driver");
  std::ofstream(folder / "flags") << "0x1003\n";
  std::ofstream(folder / "carrier") << "1\n";
  std::ofstream(root / "proc/sys/net/ipv6/conf/eth1/disable_ipv6") << "0\n";
  const InterfaceFacts sut = facts_of_interface("eth1", root);
  fs::remove_all(root);
  EXPECT_TRUE(sut.is_there && sut.is_up && sut.has_carrier && sut.speaks_ipv6);
  EXPECT_EQ(sut.driver, "r8169");
  EXPECT_EQ(sut.interrupts, (std::vector<int>{129, 130}));
  EXPECT_FALSE(facts_of_interface("../eth1", root).is_there);
}

}  // namespace
}  // namespace indurop::tools
