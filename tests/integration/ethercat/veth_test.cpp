// SPDX-License-Identifier: Apache-2.0
// The master at a network interface, simulated drives at the other end of the cable, tshark as the judge of what is
// between them.
#include <array>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "control/io/ethercat/link/ring_link.h"
#include "tests/support/unprivileged.h"
#include "tests/unit/allocations.h"
#include "veth_bus.h"

namespace indurop::io::ethercat {
namespace {

// One end of a ring: keeps what has come until it is asked for.
class QueuedLink final : public Link {
 public:
  explicit QueuedLink(PacketLink& link) : link_(link) {}
  bool send(Bytes frame) noexcept override {
    ++sent_;
    return link_.send(frame);
  }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override {
    if (frames_.empty()) {
      return 0;
    }
    const auto frame = frames_.front();
    frames_.pop_front();
    std::copy_n(frame.begin(), std::min(frame.size(), to.size()), to.begin());
    return frame.size();
  }
  // Fetches what comes in within a millisecond. Returns how many frames those were.
  int fetch() {
    std::array<std::uint8_t, kMaxFrame> frame{};
    int count = 0;
    for (; link_.wait(std::chrono::milliseconds(count == 0 ? 1 : 0)); ++count) {
      const std::size_t size = link_.receive(frame);
      frames_.emplace_back(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
    }
    return count;
  }
  int take_sent() noexcept { return std::exchange(sent_, 0); }

 private:
  PacketLink& link_;
  int sent_ = 0;
  std::deque<std::vector<std::uint8_t>> frames_;
};

// Copies come out at either end: waits until as many are back as were sent, or some are lost.
void settle(QueuedLink& first, QueuedLink& last) {
  int under_way = first.take_sent() + last.take_sent();
  test::wait_until([&] {
    under_way -= first.fetch() + last.fetch();
    return under_way <= 0;
  });
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
    ++found;
  }
  return found;
}

// What tshark shows of the frames, each line with these fields.
const std::vector<std::string> kFields = {"ecat.cmd",
                                          "ecat.idx",
                                          "ecat.cnt",
                                          "ecat.adp",
                                          "ecat.reg.alctrl.ctrl",
                                          "ecat.reg.alstatus.status",
                                          "ecat.fmmu.lstart",
                                          "ecat.syncman.start",
                                          "ecat_mailbox.coe.sdoreq",
                                          "ecat_mailbox.coe.sdores",
                                          "ecat_mailbox.coe.sdoidx"};
struct Seen {
  std::map<std::string, int> frames;  // by their commands
  std::map<std::string, std::vector<std::string>> states;
  std::vector<std::string> counters;
  std::set<std::string> fmmus;
  std::set<std::string> managers;
  std::set<std::string> requests;
  std::set<std::string> answers;
};

Seen seen_by(const std::vector<std::string>& lines) {
  Seen seen;
  for (const std::string& line : lines) {
    auto field = fields_of(line);
    EXPECT_EQ(field.size(), kFields.size()) << line;
    field.resize(kFields.size());
    ++seen.frames[field[0] + " " + field[1]];
    const bool is_back = field[2].find_first_not_of("0,") != std::string::npos;
    if (field[0].starts_with("0x07") && field[5] == "0x0008") {
      seen.counters.push_back(field[2]);
    } else if (is_back && field[0].starts_with("0x05")) {
      seen.states["requested " + field[4]].push_back(field[3]);
    } else if (is_back && field[0].starts_with("0x04")) {
      seen.states["reported " + field[5]].push_back(field[3]);
    }
    seen.fmmus.insert(field[6]);
    seen.managers.insert(field[7]);
    seen.requests.insert(field[8].empty() ? "" : field[10]);
    seen.answers.insert(field[9].empty() ? "" : field[10]);
  }
  return seen;
}

using Veth = VethTest;

TEST_F(Veth, A_master_brings_drives_to_op_and_exchanges_data_without_allocation) {
  constexpr std::size_t kDrives = 5;
  simulate(kDrives);
  Bus sut(kDrives);
  ASSERT_TRUE(sut.run_until_all_operate()) << sut.story();
  for (int i = 0; i < 5; ++i) {
    sut.cycle();
  }
  const auto allocated = g_allocations.load();
  for (int i = 0; i < 5000; ++i) {
    sut.cycle();
    ASSERT_TRUE(sut.all_fresh()) << "cycle " << i << "\n" << sut.story();
  }
  EXPECT_EQ(g_allocations.load(), allocated);
  const BusCounters& counters = sut.master().counters();
  EXPECT_EQ(counters.lost + counters.late + counters.duplicates + counters.foreign + counters.not_sent, 0U);
  EXPECT_EQ(sut.master().slaves_seen(), kDrives);
}

TEST_F(Veth, Every_frame_is_what_tshark_expects) {
  if (!has_tshark()) {
    GTEST_SKIP() << "tshark is not installed";
  }
  constexpr std::size_t kDrives = 3;
  constexpr std::size_t kCycles = 1000;
  simulate(kDrives);
  Bus sut(kDrives);
  ASSERT_TRUE(sut.run_until_all_operate()) << sut.story();
  for (std::size_t i = 0; i < kCycles; ++i) {
    sut.cycle();
  }
  end_simulation();

  const std::string fault =
      "!ecat || _ws.malformed || _ws.expert || ecat_mailbox.invalid || ecat_mailbox.coe.invalid || "
      "ecat_mailbox.coe.abortcode || ecat.subframe.circulating == 1";
  EXPECT_THAT(tshark(fault, {"frame.number"}), testing::IsEmpty());

  Seen seen = seen_by(tshark("ecat", kFields));
  for (const auto& [commands, times] : seen.frames) {
    EXPECT_EQ(times % 2, 0) << "what the master sends comes back with the same commands: " << commands;
  }
  // Of the process data in OP: all drives in the broadcast, three of each drive that reads and writes.
  EXPECT_GE(seen.counters.size(), kCycles);
  EXPECT_THAT(seen.counters, testing::Each("3,3,3,3"));
  const std::string drives = "0x1001,0x1002,0x1003";
  for (const std::string state : {"1", "2", "4", "8"}) {
    const std::string all = "0x000" + state + ",0x000" + state + ",0x000" + state;
    EXPECT_THAT(seen.states["requested " + all], testing::Contains(drives)) << state;
    EXPECT_THAT(seen.states["reported " + all], testing::Contains(drives)) << state;
  }
  EXPECT_THAT(seen.fmmus, testing::Contains(testing::StartsWith("0x00010000,")));
  EXPECT_THAT(seen.managers, testing::Contains("0x1000,0x1080,0x1000,0x1080,0x1000,0x1080"));
  EXPECT_THAT(seen.requests, testing::Contains("0x1c12,0x1c12,0x1c12"));
  EXPECT_THAT(seen.answers, testing::Contains("0x1c12,0x1c12,0x1c12"));
}

// What the drive comes with has no torque. One direction is filled, for the other a PDO has all.
TEST_F(Veth, The_mapping_is_written_as_tshark_reads_it) {
  if (!has_tshark()) {
    GTEST_SKIP() << "tshark is not installed";
  }
  simulate(1);
  const std::vector<WantedObject> outputs = {
      {0x6040, 0, 0, 0}, {0x6060, 0, 0, 0}, {0x6071, 0, 0, 0}, {0x60B8, 0, 16, 6}};
  const std::vector<WantedObject> inputs = {{0x6041, 0, 0, 0}, {0x6064, 0, 0, 0}, {0x6077, 0, 0, 0}};
  const auto sii = read_sii(slaves::Drive::slave().esc.eeprom);
  ASSERT_TRUE(sii);
  const auto mapped = map_objects(*sii, outputs, inputs);
  ASSERT_TRUE(mapped);
  Bus sut({plan_of(*mapped, 0x10000)});
  ASSERT_TRUE(sut.run_until_all_operate()) << sut.story();
  ASSERT_TRUE(sut.run_until([&] { return sut.all_fresh(); }));
  EXPECT_EQ(sut.master().outputs(0).size(), 7U);
  EXPECT_EQ(sut.master().inputs(0).size(), 15U);
  end_simulation();
  // Frames of the master, before a slave has counted in them.
  const auto writes = tshark("ecat_mailbox.coe.sdoreq && !(ecat.cnt > 0)",
                             {"ecat_mailbox.coe.sdoidx", "ecat_mailbox.coe.sdosub", "ecat_mailbox.coe.sdodata"});
  EXPECT_THAT(writes, testing::ElementsAre("0x1c12\t0x00\t0x00",                                    //
                                           "0x1600\t0x00\t0x00", "0x1600\t0x01\t0x60400010",        //
                                           "0x1600\t0x02\t0x60600008", "0x1600\t0x03\t0x60710010",  //
                                           "0x1600\t0x04\t0x60b80010", "0x1600\t0x00\t0x04",        //
                                           "0x1c12\t0x01\t0x1600", "0x1c12\t0x00\t0x01",            //
                                           "0x1c13\t0x00\t0x00", "0x1c13\t0x01\t0x1b00",            //
                                           "0x1c13\t0x00\t0x01"));
  EXPECT_THAT(tshark("ecat_mailbox.coe.abortcode", {"frame.number"}), testing::IsEmpty());
  // The lengths of SyncManagers and FMMUs follow.
  EXPECT_THAT(tshark("ecat.syncman.start == 0x1100 && ecat.cnt > 0", {"ecat.syncman.start", "ecat.syncman.len"}),
              testing::Contains("0x1100,0x1180\t0x0007,0x000f"));
  EXPECT_THAT(tshark("ecat.fmmu.lstart == 0x10000 && ecat.cnt > 0", {"ecat.fmmu.llen"}),
              testing::Contains("0x0007,0x000f"));
}

TEST_F(Veth, Lost_late_and_doubled_frames_are_counted_and_the_exchange_goes_on) {
  simulate(3);
  Bus sut(3);
  ASSERT_TRUE(sut.run_until_all_operate()) << sut.story();
  const auto counted = [&](std::uint64_t BusCounters::*counter, const std::string& line) {
    const std::uint64_t before = sut.master().counters().*counter;
    sut.link().set_patience(std::chrono::milliseconds(1));
    slaves_->input(line + "\n");
    EXPECT_TRUE(sut.run_until([&] { return sut.master().counters().*counter > before + 3; })) << line << sut.story();
    sut.link().set_patience(std::chrono::milliseconds(200));  // of the last frames some are lost
    EXPECT_TRUE(sut.run_until([&] { return sut.all_operate() && sut.all_fresh(); })) << line << sut.story();
  };
  counted(&BusCounters::lost, "0s frames_lost for=20ms");
  counted(&BusCounters::late, "0s frames_late for=20ms by=5ms");
  counted(&BusCounters::duplicates, "0s frames_doubled for=20ms");
  EXPECT_EQ(slaves_->err(), "");
}

TEST_F(Veth, Drives_before_a_pulled_one_keep_their_data) {
  simulate(4);
  Bus sut(4);
  ASSERT_TRUE(sut.run_until_all_operate()) << sut.story();
  ASSERT_TRUE(sut.run_until([&] { return sut.all_fresh(); }));
  for (int round = 0; round < 3; ++round) {
    sut.story().clear();
    slaves_->input("0s power_off slave=2 for=100ms\n");
    const auto others_run = [&] { return sut.master().is_fresh(0) && sut.master().is_fresh(1); };
    ASSERT_TRUE(sut.run_until([&] { return !others_run() || !sut.master().is_fresh(2); }));
    EXPECT_TRUE(others_run());
    const bool between_frames =
        sut.master().is_fresh(3);  // the process data had passed it, the request for its state not
    if (between_frames) {
      sut.cycle();
    }
    EXPECT_FALSE(sut.master().is_fresh(3));
    EXPECT_EQ(count(sut.story(), "slave 2 (drive): wrong working counter"), between_frames ? 0U : 1U) << sut.story();
    ASSERT_TRUE(sut.run_until([&] { return !others_run() || !sut.master().slave(2).operates(); }));
    ASSERT_TRUE(sut.run_until([&] { return !others_run() || sut.all_operate(); })) << sut.story();
    EXPECT_TRUE(others_run()) << sut.story();
    EXPECT_THAT(sut.story(), testing::HasSubstr("slave 2 (drive): does not answer"));
    EXPECT_THAT(sut.story(), testing::HasSubstr("slave 2 (drive): operates"));
    ASSERT_TRUE(sut.run_until([&] { return sut.all_fresh(); }));
  }
}

// No cycle is lost when the ring is cut. When it is whole again one may be: the copy of the first end has turned round
// at the cut, and that of the last end comes through.
TEST_F(Veth, A_ring_of_two_cables_is_cut_and_healed) {
  ASSERT_TRUE(make_way_back());
  slaves_ = start_drives(4, pcap(), {"--ring", "ec3"});
  auto there = PacketLink::open("ec0");
  auto back = PacketLink::open("ec2");
  ASSERT_TRUE(there && back);
  QueuedLink first(**there);
  QueuedLink last(**back);
  RingLink ring(first, last);
  Master sut(ring, plans_of_drives(4), kCycle);
  Clock now{0};
  unsigned lost = 0;  // cycles without the data of all slaves
  const auto all_fresh = [&sut] { return sut.is_fresh(0) && sut.is_fresh(1) && sut.is_fresh(2) && sut.is_fresh(3); };
  const auto run_until = [&](auto condition) {
    for (unsigned i = 0; i < 100'000 && !condition(); ++i) {
      now += kCycle;
      settle(first, last);
      sut.cycle(now);
      lost += all_fresh() ? 0U : 1U;
    }
    return condition();
  };
  ASSERT_TRUE(run_until(all_fresh));
  for (std::size_t place = 1; place < 4; ++place) {
    lost = 0;
    slaves_->input("0s cable_cut slave=" + std::to_string(place) + " for=100ms\n");
    ASSERT_TRUE(run_until([&] { return ring.cut().has_value(); }));
    EXPECT_EQ(ring.cut()->before, place);
    EXPECT_EQ(ring.cut()->behind, place);
    EXPECT_EQ(lost, 0U) << place;
    ASSERT_TRUE(run_until([&] { return !ring.cut(); }));
    EXPECT_LE(lost, 1U) << place;
  }
  EXPECT_EQ(sut.counters().lost, 0U);
  EXPECT_EQ(slaves_->err(), "");
}

TEST_F(Veth, A_link_that_cannot_be_used_says_why) {
  const auto error_of = [](const std::string& interface) {
    const auto link = PacketLink::open(interface);
    return link ? std::string() : link.error();
  };
  EXPECT_THAT(error_of("ec7"), testing::StartsWith("there is no network interface 'ec7'; there are: "));
  EXPECT_THAT(error_of("an interface with a long name"), testing::StartsWith("there is no network interface"));
  auto sut = PacketLink::open("ec0");
  ASSERT_TRUE(sut) << sut.error();
  EXPECT_TRUE((*sut)->has_carrier());
  ASSERT_EQ(test::Program({kEnv, "ip", "link", "set", "ec1", "down"}).wait(), 0);
  EXPECT_TRUE(test::wait_until([&] { return !(*sut)->has_carrier(); }));
  EXPECT_FALSE((*sut)->send(FrameBuilder(kMasterMac).finish())) << "there is no cable";
  ASSERT_EQ(test::Program({kEnv, "ip", "link", "set", "ec0", "down"}).wait(), 0);
  EXPECT_EQ(error_of("ec0"), "interface ec0 is switched off; run: ip link set ec0 up");
}

TEST_F(Veth, A_program_without_the_right_to_raw_sockets_says_so) {
  test::Environment unprivileged;
  unprivileged.user = test::kUnprivileged;
  const auto outcome = test::Program({ECSIM_PROGRAM, "ec1", "drive"}, unprivileged).finish();
  if (outcome.code == test::Program::kNotPrepared) {
    GTEST_SKIP() << "no right to become another user";
  }
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err,
            "indurop-ecsim: error: no right to open raw sockets; give the program CAP_NET_RAW, or start it as root\n");
}

}  // namespace
}  // namespace indurop::io::ethercat
