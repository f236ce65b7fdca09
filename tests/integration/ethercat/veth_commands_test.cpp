// SPDX-License-Identifier: Apache-2.0
// The commands of process data on the wire, as tshark sees them.
#include "veth_bus.h"

namespace indurop::io::ethercat {
namespace {

using VethCommands = VethTest;

// Of a drive with LRW: 3 for LRW; of one without: 1 each for LWR and LRD in the same frame.
TEST_F(VethCommands, Drives_without_lrw_get_two_datagrams_as_tshark_sees_them) {
  if (!has_tshark()) {
    GTEST_SKIP() << "tshark is not installed";
  }
  constexpr std::size_t kCycles = 500;
  slaves_ = start_slaves({"drive", "drive:lrw=0", "drive"}, pcap());
  auto plans = plans_of_drives(3);
  plans[1].uses_lrw = false;
  Bus sut(std::move(plans));
  ASSERT_TRUE(sut.run_until_all_operate()) << sut.story();
  ASSERT_TRUE(sut.run_until([&] { return sut.all_fresh(); }));
  for (std::size_t i = 0; i < kCycles; ++i) {
    sut.cycle();
    ASSERT_TRUE(sut.all_fresh()) << "cycle " << i << "\n" << sut.story();
  }
  end_simulation();
  EXPECT_THAT(tshark("!ecat || _ws.malformed || _ws.expert", {"frame.number"}), testing::IsEmpty());
  std::size_t exchanges = 0;
  for (const std::string& line : tshark("ecat.cmd == 0x0b", {"ecat.cmd", "ecat.cnt", "ecat.reg.alstatus.status"})) {
    const auto field = fields_of(line);
    ASSERT_EQ(field.size(), 3U);
    // The broadcast that counts the slaves, LRW, LRW, LWR, LRD.
    EXPECT_EQ(field[0], "0x07,0x0c,0x0c,0x0b,0x0a");
    if (field[2] == "0x0008") {
      EXPECT_EQ(field[1], "3,3,3,1,1");
      ++exchanges;
    }
  }
  EXPECT_GE(exchanges, kCycles);
}

}  // namespace
}  // namespace indurop::io::ethercat
