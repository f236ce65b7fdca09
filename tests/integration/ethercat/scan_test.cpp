// SPDX-License-Identifier: Apache-2.0
// `indurop io scan`: the slaves of a bus, before a node, while it runs and after it.
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "node_of_drives.h"

namespace indurop::test {
namespace {

using EthercatScan = EthercatNode;

TEST_F(EthercatScan, A_scan_lists_the_slaves_and_writes_a_file_for_them) {
  const Outcome empty_bus = indurop({"io", "scan", "ec0"});
  EXPECT_EQ(empty_bus.code, 6);
  EXPECT_CONTAINS(empty_bus.err, "ec0: no slave answers; check the cable, and the power of the first slave");
  simulate(2);
  const std::string file = (folder() / "found.xml").string();
  const Outcome sut = indurop({"io", "scan", "ec0", "--write", file, "--namespace", "CELL"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(sut.out, "InduRoP simulated drive");
  EXPECT_CONTAINS(sut.out, "0x49525001");
  EXPECT_CONTAINS(sut.out, "607a:0");
  std::ifstream written(file);
  const std::string text{std::istreambuf_iterator<char>(written), {}};
  EXPECT_CONTAINS(text,
                  "  <device name=\"slave1\" driver=\"ethercat\" address=\"ec0\" slave=\"1\" vendor=\"0x0\" "
                  "product=\"0x49525001\" revision=\"0x1\"\n          in=\"CELL::SLAVE1_IN\" "
                  "out=\"CELL::SLAVE1_OUT\"/>\n");
  const auto json = indurop({"io", "scan", "ec0", "-o", "json"}).json();
  ASSERT_EQ(json["slaves"].size(), 2U);
  EXPECT_EQ(json["slaves"][1]["position"], 1);
  EXPECT_EQ(json["slaves"][1]["state"], "INIT");
  EXPECT_EQ(json["slaves"][1]["outputs"][2]["at"], "607a:0");
  EXPECT_EQ(json["slaves"][1]["outputs"][2]["type"], "int32");
}

TEST_F(EthercatScan, The_objects_of_a_slave_are_listed_as_tshark_sees_them) {
  simulate(2);
  const Outcome table = indurop({"io", "objects", "ec0", "--slave", "1"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_CONTAINS(table.out, "607a:0");
  const auto listed = indurop({"io", "objects", "ec0", "-o", "json"}).json()["objects"];
  drives_->signal(SIGTERM);
  ASSERT_EQ(drives_->wait(), 0) << drives_->err();
  const std::string frames = (folder() / "frames.pcap").string();
  const Outcome seen =
      Program({"/usr/bin/env", "tshark", "-r", frames, "-Y", "ecat_mailbox.coe.sdoinfoopcode == 6", "-T", "fields",
               "-e", "ecat_mailbox.coe.sdoinfoindex", "-e", "ecat_mailbox.coe.sdoinfosubindex", "-e",
               "ecat_mailbox.coe.sdoinfobitlen", "-e", "ecat_mailbox.coe.sdoinfoname"})
          .finish();
  if (seen.code != 0) {
    GTEST_SKIP() << "no tshark";
  }
  for (const auto& object : listed) {
    const std::string at = object["at"];
    const std::size_t colon = at.find(':');
    std::ostringstream wanted;
    wanted << std::hex << std::setfill('0') << "0x" << at.substr(0, colon) << "\t0x" << std::setw(2)
           << std::stoi(at.substr(colon + 1), nullptr, 16) << "\t0x" << std::setw(4) << object["bits"].get<int>()
           << '\t';
    const std::string line = wanted.str();
    EXPECT_NE(seen.out.find(line), std::string::npos) << line;
  }
  EXPECT_NE(seen.out.find("\tTarget position"), std::string::npos);
}

TEST_F(EthercatScan, A_file_goes_to_a_slave_and_back_as_tshark_sees_it) {
  simulate(1);
  const std::string sent = (folder() / "sent").string();
  const std::string received = (folder() / "received").string();
  std::string content;
  for (int i = 0; i < 1000; ++i) {
    content += std::to_string(i * i) + "\n";
  }
  std::ofstream(sent) << content;
  const Outcome refused = indurop({"io", "write-file", "ec0", "firmware.efw", sent});
  EXPECT_EQ(refused.code, 6);
  EXPECT_CONTAINS(refused.err, "slave 0 (InduRoP simulated drive): it refuses: only in the state BOOT (8008h)");
  const Outcome written = indurop({"io", "write-file", "ec0", "firmware.efw", sent, "--boot"});
  EXPECT_EQ(written.code, 0) << written.err;
  const Outcome read = indurop({"io", "read-file", "ec0", "firmware.efw", received});
  EXPECT_EQ(read.code, 0) << read.err;
  std::ifstream file(received);
  EXPECT_EQ((std::string{std::istreambuf_iterator<char>(file), {}}), content);
  drives_->signal(SIGTERM);
  ASSERT_EQ(drives_->wait(), 0) << drives_->err();
  const std::string frames = (folder() / "frames.pcap").string();
  const auto tshark = [&frames](const std::string& filter, const std::string& field) {
    return Program({"/usr/bin/env", "tshark", "-r", frames, "-Y", filter, "-T", "fields", "-e", field}).finish();
  };
  const Outcome names = tshark("ecat_mailbox.foe_opmode == 2", "ecat_mailbox.foe_filename");
  if (names.code != 0) {
    GTEST_SKIP() << "no tshark";
  }
  EXPECT_CONTAINS(names.out, "firmware.efw\n");
  EXPECT_CONTAINS(tshark("ecat_mailbox.foe_opmode == 5", "ecat_mailbox.foe_errcode").out, "32776\n");  // 8008h
  EXPECT_EQ(tshark("ecat_mailbox.foe.invalid", "frame.number").out, "");
}

TEST_F(EthercatScan, A_node_that_ends_leaves_its_slaves_in_init) {
  simulate(2);
  Program& sut = run_node_with_two_drives();
  ASSERT_TRUE(moves()) << sut.out() << sut.err();
  const auto state = [&] { return indurop({"io", "scan", "ec0", "-o", "json"}).json()["slaves"][1]["state"]; };
  EXPECT_TRUE(wait_until([&] { return state() == "OP"; }));
  EXPECT_TRUE(moves()) << "although a scan was on the bus";
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_EQ(state(), "INIT");
}

}  // namespace
}  // namespace indurop::test
