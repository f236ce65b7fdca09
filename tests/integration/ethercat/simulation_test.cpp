// SPDX-License-Identifier: Apache-2.0
// An EtherCAT bus in virtual time: no sockets, no rights, the same in every run, faults included.
#include <indurop/irp.h>

#include "core/base/read_file.h"
#include "node_fixture.h"

namespace indurop::test {
namespace {

class EthercatSimulation : public NodeTest {
 protected:
  // Two drives; the first one moves, the second one is read.
  static inline const std::string kDevices =
      "<device name='axis1' driver='ethercat' address='eth77' slave='0' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT' quality='TEST_CELL::link_good' errors='TEST_CELL::link_errors'/>\n"
      "<device name='axis2' driver='ethercat' address='eth77' slave='1' quality='TEST_CELL::I0_quality'>\n"
      "  <input variable='speeds[1]' at='6041'/>\n"
      "</device>\n";

  // Runs a configuration in virtual time.
  Outcome simulate(const std::string& elements, const std::string& time, const std::vector<std::string>& more = {}) {
    write("ioconfig.xml", "<ioconfig>\n" + elements + "</ioconfig>\n");
    return run_to_end(
        {{.file = IO_MODULE, .name = "io", .period = "2ms", .priority = 1, .properties = {{"config", "ioconfig.xml"}}},
         {.file = std::string(IO_FOLDER) + "/axis_user.so", .name = "axis_user", .period = "2ms", .priority = 2}},
        with({"--sim", "--until", time}, more));
  }
  static std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string values() const { return indurop({"vars", "-o", "json"}).out; }

  std::string out_;  // what the latest run said
};

TEST_F(EthercatSimulation, Moves_drives_and_is_the_same_twice) {
  const std::string simulation = "<simulation address='eth77' slaves='drive:start=5 drive:start=-20'/>\n";
  const Outcome first = simulate(kDevices + simulation, "3s");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, testing::HasSubstr("EtherCAT eth77: slave 1 (InduRoP simulated drive): operates"));
  EXPECT_THAT(first.out, testing::HasSubstr("frames sent: 0 came back late, 0 were lost"));
  EXPECT_EQ(value<std::uint8_t>("TEST_CELL::I0_quality"), 1);
  EXPECT_GT(std::stol(indurop({"get", "TEST_CELL::AXIS1_IN.position"}).out), 5000);
  const std::string before = values();
  ASSERT_EQ(simulate(kDevices + simulation, "3s").code, 0);
  EXPECT_EQ(before, values());
}

// The node reads in the slave, or in its EEPROM, that it runs no LRW; the drives move as all others.
TEST_F(EthercatSimulation, Slaves_without_lrw_are_exchanged_as_all_others) {
  const auto run_with = [this](const std::string& slaves) {
    const Outcome outcome = simulate(kDevices + "<simulation address='eth77' slaves='" + slaves + "'/>\n", "3s");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, testing::Not(testing::HasSubstr("working counter")));
    EXPECT_EQ(value<std::uint8_t>("TEST_CELL::I0_quality"), 1);
    return values();
  };
  const std::string usual = run_with("drive:start=5 drive:start=-20");
  EXPECT_EQ(run_with("drive:start=5,lrw=0 drive:start=-20"), usual);
  EXPECT_EQ(run_with("drive:start=5 drive:start=-20,lrw=0"), usual);
}

TEST_F(EthercatSimulation, Faults_come_at_their_virtual_time) {
  write("faults", "1s power_off slave=1 for=300ms\n2500ms frames_lost for=2s\n");
  const std::string simulation = "<simulation address='eth77' slaves='drive drive' script='faults'/>\n";
  const auto quality_at = [&](const std::string& time) {
    const Outcome outcome = simulate(kDevices + simulation, time);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return static_cast<int>(value<std::uint8_t>("TEST_CELL::I0_quality"));
  };
  EXPECT_EQ(quality_at("998ms"), 1);
  EXPECT_EQ(quality_at("1006ms"), 2) << "named within two ticks";
  EXPECT_EQ(quality_at("2s"), 1) << "back within a second";
  const Outcome outcome = simulate(kDevices + simulation, "3s");
  EXPECT_THAT(outcome.out, testing::HasSubstr("slave 1 (InduRoP simulated drive): does not answer"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("late or lost"));
  EXPECT_FALSE(value<bool>("TEST_CELL::link_good"));
}

TEST_F(EthercatSimulation, A_lost_drive_explains_why_its_values_are_old) {
  write("faults", "1s power_off slave=1 for=1s\n");
  const std::string recording = (folder() / "r.mcap").string();
  const Outcome outcome = simulate(kDevices + "<simulation address='eth77' slaves='drive drive' script='faults'/>\n",
                                   "1500ms", {"--record", recording});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  // From what the node left in memory, and from its recording.
  for (const std::vector<std::string>& from : {std::vector<std::string>{}, {"--from", recording}}) {
    const std::string said = indurop(with({"explain", "TEST_CELL::speeds"}, from)).out;
    EXPECT_THAT(said, testing::HasSubstr("exchanged with device axis2 (ethercat eth77, slave 1): it is lost"));
    EXPECT_THAT(said, testing::ContainsRegex("TEST_CELL::I0_quality is 2 since tick 50[0-9] "));
    EXPECT_THAT(indurop(with({"explain", "TEST_CELL::speeds", "--tick", "450"}, from)).out,
                testing::Not(testing::HasSubstr("axis2")))
        << "it was not lost then";
    EXPECT_THAT(indurop(with({"explain", "TEST_CELL::AXIS1_IN"}, from)).out,
                testing::Not(testing::HasSubstr("exchanged with device")));
  }
}

TEST_F(EthercatSimulation, A_cut_ring_is_reached_from_both_ends) {
  write("faults", "1s cable_cut slave=1 for=10s\n");
  const Outcome outcome = simulate(
      "<device name='axis1' driver='ethercat' address='eth77,eth78' slave='1' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT' cut='TEST_CELL::I0_quality' quality='TEST_CELL::link_good'/>\n"
      "<simulation address='eth77,eth78' slaves='drive drive' script='faults'/>\n",
      "2s");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("the cable is cut between slave 0 and slave 1; all slaves are reached"));
  EXPECT_EQ(value<std::uint8_t>("TEST_CELL::I0_quality"), 2) << "the second cable";
  EXPECT_TRUE(value<bool>("TEST_CELL::link_good"));
}

// The mode of a drive is what a relay behind it has, and that of its <set> while the relay is pulled.
TEST_F(EthercatSimulation, A_drive_gets_bytes_of_a_relay_and_its_fail_safe_value_without_it) {
  std::filesystem::copy_file(ESI_RELAY, folder() / "relay.xml");
  write("faults", "1s value slave=1 at=6010:1 to=8\n2s power_off slave=1 for=1s\n");
  const auto mode_at = [this](const std::string& time) {
    const Outcome outcome = simulate(
        "<device name='axis1' driver='ethercat' address='eth77' slave='0' quality='TEST_CELL::link_good'>\n"
        "  <input variable='speeds[1]' at='mode'/>\n"
        "  <set at='6060' type='int8' value='1'/>\n"
        "  <copy from='relay' at='6010:1' to='mode' hold='20ms'/>\n"
        "</device>\n"
        "<device name='relay' driver='ethercat' address='eth77' slave='1' quality='TEST_CELL::I0_quality'/>\n"
        "<simulation address='eth77' slaves='drive relay.xml' script='faults'/>\n",
        time);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(value<bool>("TEST_CELL::link_good"));
    out_ = outcome.out;
    return std::stol(indurop({"get", "TEST_CELL::speeds[1]"}).out);
  };
  EXPECT_EQ(mode_at("990ms"), 0);
  EXPECT_EQ(mode_at("1020ms"), 8);
  EXPECT_EQ(mode_at("2010ms"), 8) << "held";
  EXPECT_EQ(mode_at("2040ms"), 1);
  EXPECT_THAT(out_, testing::HasSubstr("slave 0 (InduRoP simulated drive): slave 1 has no valid bytes to copy to it; "
                                       "these outputs have their fail-safe values"));
  EXPECT_EQ(static_cast<int>(value<std::uint8_t>("TEST_CELL::I0_quality")), 2) << "the source says it, too";
  EXPECT_EQ(mode_at("4500ms"), 8) << "it is back";
}

TEST_F(EthercatSimulation, A_copy_between_slaves_that_do_not_fit_keeps_the_bus_from_starting) {
  std::filesystem::copy_file(ESI_RELAY, folder() / "relay.xml");
  const std::string slaves = "<simulation address='eth77' slaves='drive relay.xml'/>\n";
  const auto said = [this, &slaves](const std::string& at) {
    return simulate("<device name='axis1' driver='ethercat' address='eth77' slave='0'>\n  <copy from='relay' at='" +
                        at +
                        "' to='mode'/>\n</device>\n"
                        "<device name='relay' driver='ethercat' address='eth77' slave='1'/>\n" +
                        slaves,
                    "100ms")
        .out;
  };
  EXPECT_THAT(said("6000:2"),
              testing::HasSubstr("EtherCAT eth77: slave 0 (InduRoP simulated drive), device axis1: 6000:2 "
                                 "of relay has 2 bytes, and mode has 1 byte; copy what has one size"));
  EXPECT_THAT(said("6000:1-6010:1"),
              testing::HasSubstr("EtherCAT eth77: slave 1 (Sample safety relay), device relay: input 6000:1-6010:1 "
                                 "cannot be exchanged: no PDO of the slave has it, from its first object to its last "
                                 "one; its inputs are 6000:01, 6001:01"));
}

TEST_F(EthercatSimulation, The_tick_follows_the_clock_of_a_simulated_drive) {
  const Outcome outcome = simulate(
      "<device name='axis1' driver='ethercat' address='eth77' slave='0' in='TEST_CELL::AXIS1_IN'\n"
      "  out='TEST_CELL::AXIS1_OUT' quality='TEST_CELL::link_good'>\n"
      "  <sync activate='0x300' cycle='2ms' shift='500us'/></device>\n"
      "<simulation address='eth77' slaves='drive'/>\n",
      "5s");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(value<bool>("TEST_CELL::link_good")) << outcome.out;
  EXPECT_NEAR(static_cast<double>(run()->pulse_after_ns.load()), 500'000, 1000);
}

TEST_F(EthercatSimulation, A_bus_without_slaves_and_wrong_words_are_refused_with_their_place) {
  const Outcome none = simulate(kDevices, "1s");
  EXPECT_NE(none.code, 0);
  EXPECT_THAT(none.out + none.err,
              testing::HasSubstr("ioconfig.xml:2:1: error: a simulation has no cable; say which slaves it has instead: "
                                 "<simulation address=\"eth77\" slaves="));
  write("faults", "1s sleep\n");
  const Outcome wrong =
      simulate(kDevices + "<simulation address='eth77' slaves='drive drve' script='faults'/>\n", "1s");
  EXPECT_NE(wrong.code, 0);
  EXPECT_THAT(wrong.out + wrong.err, testing::HasSubstr("ioconfig.xml:7:"));
  EXPECT_THAT(wrong.out + wrong.err, testing::HasSubstr("faults:1:4: error: there is no fault 'sleep'"));
}

}  // namespace
}  // namespace indurop::test
