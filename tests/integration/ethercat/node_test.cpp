// SPDX-License-Identifier: Apache-2.0
// A node moves drives over EtherCAT: ioconfig.xml names slaves of a bus, here simulated ones at a veth pair.
#include "node_of_drives.h"

namespace indurop::test {
namespace {

TEST_F(EthercatNode, A_drive_moves_as_the_program_commands) {
  simulate(2);
  Program& sut = run_node_with_two_drives();
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_EQ(number("AXIS1_IN.error"), 0);
  EXPECT_EQ(number("AXIS1_IN.mode"), 8);
  // On a busy machine the drives may answer too late at times.
  EXPECT_TRUE(wait_until([&] { return value<bool>("TEST_CELL::link_good"); })) << sut.out();
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 1; })) << sut.out();
  EXPECT_TRUE(sut.prints("EtherCAT ec0: slave 1 (InduRoP simulated drive): operates"));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(EthercatNode, A_pulled_drive_is_named_and_comes_back) {
  simulate(2);
  Program& sut = run_node_with_two_drives();
  ASSERT_TRUE(moves()) << sut.out() << sut.err();
  drives_->input("0s power_off slave=1 for=300ms\n");
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 2; }));
  EXPECT_TRUE(sut.prints("EtherCAT ec0: slave 1 (InduRoP simulated drive): does not answer; check its power"));
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 1; })) << sut.out();
  EXPECT_TRUE(moves());
}

TEST_F(EthercatNode, A_device_with_a_cycle_of_its_own_moves_and_one_that_does_not_fit_is_refused) {
  simulate(2);
  const auto device = [](const std::string& cycle) {
    return "<device name='axis1' driver='ethercat' address='ec0' slave='0' cycle='" + cycle +
           "'\n  in='TEST_CELL::AXIS1_IN' out='TEST_CELL::AXIS1_OUT' quality='TEST_CELL::link_good'\n"
           "  errors='TEST_CELL::link_errors'/>";
  };
  Program& refused = run_node(device("3ms"));
  EXPECT_TRUE(
      refused.prints("EtherCAT ec0: slave 0, device axis1: its cycle is 3000 us, which is no multiple of the "
                     "module's period, 2000 us"))
      << refused.out();
  refused.signal(SIGTERM);
  EXPECT_EQ(refused.wait(), 0);
  Program& sut = run_node(device("8ms"));
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_TRUE(wait_until([&] { return value<bool>("TEST_CELL::link_good"); })) << sut.out();
}

TEST_F(EthercatNode, Lost_frames_are_reported_and_counted) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT' quality='TEST_CELL::link_good'/>");
  ASSERT_TRUE(moves()) << sut.out() << sut.err();
  drives_->input("0s frames_lost for=500ms\n");
  EXPECT_TRUE(wait_until([&] { return !value<bool>("TEST_CELL::link_good"); }));
  EXPECT_TRUE(wait_until([&] { return value<bool>("TEST_CELL::link_good"); })) << sut.out();
  EXPECT_TRUE(sut.prints(" late or lost")) << sut.out();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_THAT(sut.out(), testing::ContainsRegex("EtherCAT ec0: [0-9]+ frames sent: [0-9]+ came back late, "
                                                "[1-9][0-9]* were lost, 0 doubled"));
}

TEST_F(EthercatNode, A_bad_cable_is_named) {
  simulate(2);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='1' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT' cable_errors='TEST_CELL::link_errors'/>");
  ASSERT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_EQ(value<std::uint32_t>("TEST_CELL::link_errors"), 0U);
  drives_->input("0s frames_broken slave=1 for=40ms\n");
  EXPECT_TRUE(sut.prints("EtherCAT ec0: slave 1 (InduRoP simulated drive): port 0 received ")) << sut.out();
  EXPECT_TRUE(wait_until([&] { return value<std::uint32_t>("TEST_CELL::link_errors") > 0; }));
  EXPECT_TRUE(moves());
}

TEST_F(EthercatNode, A_bus_that_is_not_there_yet_is_waited_for) {
  Program& sut = run_node_with_two_drives();
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: no slave answers; check the cable, and the power of the first slave; trying "
                 "again"));
  EXPECT_FALSE(value<bool>("TEST_CELL::link_good"));
  EXPECT_GT(value<std::uint32_t>("TEST_CELL::link_errors"), 0U);
  simulate(1);
  EXPECT_TRUE(sut.prints("EtherCAT ec0: device axis2 is slave 1, and 1 answer, from 0 on; check the cable"));
  drives_.reset();
  simulate(2);
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
}

TEST_F(EthercatNode, Another_device_than_the_file_says_is_not_used) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' vendor='0x2' quality='TEST_CELL::link_good'\n"
      "  in='TEST_CELL::AXIS1_IN'/>");
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: slave 0, device axis1: it is InduRoP simulated drive, vendor 0x0, product 0x49525001, "
                 "revision 0x1, and the file says another one; `indurop io scan ec0` shows what is there"))
      << sut.out();
  EXPECT_FALSE(value<bool>("TEST_CELL::link_good"));
}

TEST_F(EthercatNode, The_tick_follows_the_clocks_of_drives) {
  simulate(2);
  const std::string sync = "<sync activate='0x300' cycle='2ms' shift='500us'/>\n";
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT'>\n" +
      sync +
      "</device>\n"
      "<device name='axis2' driver='ethercat' address='ec0' slave='1' quality='TEST_CELL::I0_quality'>\n" +
      sync +
      "  <input variable='speeds[1]' at='6041'/>\n"
      "</device>");
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_TRUE(sut.prints("EtherCAT ec0: slave 1 (InduRoP simulated drive): operates"));
  EXPECT_TRUE(wait_until([&] { return indurop({"status"}).out.find("pulse     SYNC0 ") != std::string::npos; }))
      << indurop({"status"}).out;
  drives_->input("0s clock_jumps slave=1 by=300us\n");
  EXPECT_TRUE(sut.prints("EtherCAT ec0: slave 1 (InduRoP simulated drive): its clock does not follow")) << sut.out();
}

TEST_F(EthercatNode, A_cut_ring_is_named_and_the_drive_moves_on) {
  ASSERT_TRUE(io::ethercat::make_way_back());
  drives_ = io::ethercat::start_drives(2, (folder() / "frames.pcap").string(), {"--ring", "ec3"});
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0,ec2' slave='1' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT' cut='TEST_CELL::I0_quality'/>");
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 0; }));
  drives_->input("0s cable_cut slave=1 for=2s\n");
  EXPECT_TRUE(sut.prints("EtherCAT ec0,ec2: the cable is cut between slave 0 and slave 1; all slaves are reached"))
      << sut.out();
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 2; })) << "the second cable";
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_TRUE(sut.prints("EtherCAT ec0,ec2: the cable is whole again")) << sut.out();
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 0; }));
}

TEST_F(EthercatNode, A_device_is_found_by_its_alias) {
  const auto start_drives = [this](const std::string& first, const std::string& second) {
    drives_ = std::make_unique<Program>(std::vector<std::string>{ECSIM_PROGRAM, "ec1", "drive:alias=" + first,
                                                                 "drive:alias=" + second, "--script", "-"});
    ASSERT_TRUE(drives_->prints("slaves at")) << drives_->err();
  };
  const std::string device =
      "<device name='axis1' driver='ethercat' address='ec0' alias='7' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT'/>";
  start_drives("9", "8");
  Program& sut = run_node(device);
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: device axis1 is the slave with alias 7, and 2 answer, none of them with it; "
                 "`indurop io scan` shows their aliases"))
      << sut.out();
  drives_.reset();
  start_drives("7", "7");
  EXPECT_TRUE(sut.prints("device axis1 is the slave with alias 7, and several have it")) << sut.out();
  drives_.reset();
  start_drives("9", "7");
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_TRUE(sut.prints("EtherCAT ec0: slave 1 (InduRoP simulated drive): operates"));
  // Equal drives in another order while the node runs.
  drives_.reset();
  start_drives("7", "9");
  EXPECT_TRUE(sut.prints("slave 1 (InduRoP simulated drive): another device is at its position: alias 9")) << sut.out();
}

TEST_F(EthercatNode, A_ring_has_no_clocks) {
  ASSERT_TRUE(io::ethercat::make_way_back());
  drives_ = io::ethercat::start_drives(1, (folder() / "frames.pcap").string(), {"--ring", "ec3"});
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0,ec2' slave='0' in='TEST_CELL::AXIS1_IN'>\n"
      "  <sync activate='0x300' cycle='2ms'/>\n"
      "</device>");
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0,ec2: slave 0, device axis1: a ring has no clocks; leave out <sync>, or name one "
                 "interface only"))
      << sut.out();
}

TEST_F(EthercatNode, Pulses_that_fit_no_period_are_refused) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' in='TEST_CELL::AXIS1_IN'>\n"
      "  <sync activate='0x300' cycle='3ms'/>\n"
      "</device>");
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: slave 0, device axis1: the cycle of <sync> is 3000 us, which is no multiple of the "
                 "module's period, 2000 us"))
      << sut.out();
}

TEST_F(EthercatNode, Objects_are_set_before_the_exchange_begins) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT'>\n"
      "  <set at='1c12:0' type='uint8' value='0'/>\n"
      "  <set at='1c12:1' type='uint16' value='5632'/>\n"
      "  <set at='1c12:0' type='uint8' value='1'/>\n"
      "</device>");
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
}

// The drive exchanges its mode, which no point writes.
TEST_F(EthercatNode, What_is_set_stays_set_although_it_is_exchanged) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0'>\n"
      "  <set at='6060' type='int8' value='8'/>\n"
      "  <input variable='speeds[1]' at='mode' quality='TEST_CELL::I0_quality'/>\n"
      "  <output variable='speeds[2]' at='control'/>\n"
      "</device>");
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 1; })) << sut.out();
  EXPECT_TRUE(wait_until([&] { return indurop({"get", "speeds[1]"}).out == "8\n"; })) << indurop({"get", "speeds"}).out;
}

TEST_F(EthercatNode, An_object_that_the_slave_refuses_is_named) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' in='TEST_CELL::AXIS1_IN'>\n"
      "  <set at='2001:3' type='int32' value='-5'/>\n"
      "</device>");
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: slave 0 (InduRoP simulated drive): refused object 2001:03: there is no such object"))
      << sut.out();
  sut.signal(SIGTERM);
  sut.wait();
  drives_->signal(SIGTERM);
  ASSERT_EQ(drives_->wait(), 0) << drives_->err();
  const Outcome seen = Program({"/usr/bin/env", "tshark", "-r", (folder() / "frames.pcap").string(), "-Y",
                                "ecat_mailbox.coe.abortcode", "-T", "fields", "-e", "ecat_mailbox.coe.abortcode"})
                           .finish();
  if (seen.code == 0) {
    EXPECT_CONTAINS(seen.out, "0x06020000");
  }
}

// The mapping that the drive comes with has neither the torque nor the digital inputs, and no PDO of it has the latter.
TEST_F(EthercatNode, The_process_data_of_a_slave_is_what_the_points_name) {
  simulate(2);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT'>\n"
      "  <input variable='speeds[1]' at='torque' quality='TEST_CELL::I0_quality'/>\n"
      "  <input variable='speeds[2]' at='60fd:0'/>\n"
      "  <output variable='speeds[3]' at='torque_offset'/>\n"
      "</device>\n"
      "<device name='axis2' driver='ethercat' address='ec0' slave='1' quality='TEST_CELL::link_good'>\n"
      "  <input variable='speeds[0]' at='velocity'/>\n"
      "</device>");
  EXPECT_TRUE(moves()) << sut.out() << sut.err();
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 1; })) << sut.out();
  EXPECT_TRUE(wait_until([&] { return value<bool>("TEST_CELL::link_good"); })) << sut.out();
  drives_->input("0s power_off slave=0 for=300ms\n");
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 2; }));
  EXPECT_TRUE(moves()) << "it was mapped again\n" << sut.out();
}

TEST_F(EthercatNode, An_object_that_the_slave_cannot_exchange_is_named_and_nothing_starts) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0' quality='TEST_CELL::link_good'>\n"
      "  <input variable='speeds[1]' at='7000:1' quality='TEST_CELL::I0_quality'/>\n"
      "  <input variable='TEST_CELL::AXIS1_IN.status' at='status'/>\n"
      "</device>");
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: slave 0 (InduRoP simulated drive), device axis1: input 7000:1 (7000:01) cannot be "
                 "exchanged: no PDO of the slave has it, and its type is not known; give it: type=\"int16\"; its "
                 "inputs are 603f:00, 6041:00, 6061:00, 6064:00, 606c:00, 6077:00; trying again"))
      << sut.out();
  EXPECT_FALSE(value<bool>("TEST_CELL::link_good"));
  EXPECT_EQ(number("AXIS1_IN.status"), 0);
}

TEST_F(EthercatNode, An_object_that_the_slave_does_not_have_is_named) {
  simulate(1);
  Program& sut = run_node(
      "<device name='axis1' driver='ethercat' address='ec0' slave='0'>\n"
      "  <input variable='speeds[1]' at='7000:1' type='int16'/>\n"
      "</device>");
  EXPECT_TRUE(
      sut.prints("EtherCAT ec0: slave 0 (InduRoP simulated drive): refused object 1a00:01: there is no such "
                 "object"))
      << sut.out();
}

}  // namespace
}  // namespace indurop::test
