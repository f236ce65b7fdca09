// SPDX-License-Identifier: Apache-2.0
// Simulated slaves answer as controller chips do: addressing, working counters, memory, EEPROM, states, clocks.
#include "control/io/ethercat/simulator/segment.h"

#include <gmock/gmock.h>

#include "slaves.h"

namespace indurop::io::ethercat {
namespace {

using Data = std::vector<std::uint8_t>;

class SegmentTest : public testing::Test {
 protected:
  void add(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      segment_.add(drive_config(static_cast<std::uint32_t>(i)), reflect);
      master_.write<std::uint16_t>(Command::Apwr, address_of(position(i), reg::kStation), station(i));
    }
  }
  static std::uint16_t station(std::size_t index) { return static_cast<std::uint16_t>(0x1001 + index); }
  static std::uint32_t of(std::size_t index, std::uint16_t offset) { return address_of(station(index), offset); }

  void set_sync_manager(std::size_t slave, unsigned number, SyncManagerEntry entry) {
    Data bytes(8);
    store<std::uint16_t>(bytes, 0, entry.start);
    store<std::uint16_t>(bytes, 2, entry.length);
    bytes[4] = entry.control;
    bytes[6] = 1;
    EXPECT_EQ(master_.send(Command::Fpwr, of(slave, static_cast<std::uint16_t>(reg::kSyncManager + 8 * number)), bytes),
              1);
  }
  std::uint16_t request(std::size_t slave, AlState state, std::uint8_t flags = 0) {
    master_.write<std::uint16_t>(Command::Fpwr, of(slave, reg::kAlControl),
                                 static_cast<std::uint16_t>(static_cast<unsigned>(state) | flags));
    master_.wait(Time(2'000'000));
    return master_.read<std::uint16_t>(Command::Fprd, of(slave, reg::kAlStatus));
  }
  std::uint16_t code(std::size_t slave) {
    return master_.read<std::uint16_t>(Command::Fprd, of(slave, reg::kAlStatusCode));
  }
  void bring_to_op(std::size_t slave) {
    const Sii sii = drive_sii();
    for (unsigned i = 0; i < 4; ++i) {
      set_sync_manager(slave, i, sii.sync_managers[i]);
    }
    EXPECT_EQ(request(slave, AlState::PreOp), 2);
    EXPECT_EQ(request(slave, AlState::SafeOp), 4);
    EXPECT_EQ(request(slave, AlState::Op), 8);
  }
  void set_fmmu(std::size_t slave, unsigned number, std::uint32_t logical, std::uint16_t physical, std::uint8_t type) {
    Data bytes(16);
    store<std::uint32_t>(bytes, 0, logical);
    store<std::uint16_t>(bytes, 4, 6);
    bytes[7] = 7;
    store<std::uint16_t>(bytes, 8, physical);
    bytes[11] = type;
    bytes[12] = 1;
    EXPECT_EQ(master_.send(Command::Fpwr, of(slave, static_cast<std::uint16_t>(reg::kFmmu + 16 * number)), bytes), 1);
  }

  Segment segment_;
  Prober master_{segment_};
};

TEST_F(SegmentTest, Positions_count_up_and_broadcasts_are_combined) {
  add(3);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Aprd, address_of(position(2), reg::kStation)), 0x1003);
  EXPECT_EQ(static_cast<std::uint16_t>(master_.address()), 1U);  // it began at -2 and passed three
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Brd, address_of(0, reg::kStation), 3), 0x1003);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(1, reg::kStation)), 0x1002);
  master_.read<std::uint16_t>(Command::Fprd, address_of(0x2000, reg::kStation), 0);
}

TEST_F(SegmentTest, One_writes_what_the_others_take) {
  add(3);
  segment_.slave(1).esc().set<std::uint16_t>(0x0F80, 0x1234);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Frmw, of(1, 0x0F80), 3), 0x1234);
  EXPECT_EQ(segment_.slave(0).esc().value<std::uint16_t>(0x0F80), 0);  // it was before the one that reads
  EXPECT_EQ(segment_.slave(2).esc().value<std::uint16_t>(0x0F80), 0x1234);
}

TEST_F(SegmentTest, Registers_that_are_not_there_do_not_answer) {
  add(1);
  Data fmmu(16);
  EXPECT_EQ(master_.send(Command::Bwr, address_of(0, reg::kFmmu + 16 * 7), fmmu), 1);
  EXPECT_EQ(master_.send(Command::Bwr, address_of(0, reg::kFmmu + 16 * 8), fmmu), 0);
  EXPECT_EQ(master_.write<std::uint8_t>(Command::Fpwr, of(0, reg::kType), 0xFF), 0);
  EXPECT_EQ(master_.read<std::uint8_t>(Command::Fprd, of(0, reg::kType)), 0x11);  // can only be read
}

TEST_F(SegmentTest, An_access_answers_if_a_part_of_it_is_there) {
  add(1);
  segment_.slave(0).esc().set<std::uint16_t>(reg::kFmmu + 16 * 8, 0x1234);
  Data two(32, 0xFF);
  EXPECT_EQ(master_.send(Command::Fprd, of(0, reg::kFmmu + 16 * 7), two), 1);
  EXPECT_EQ(two, Data(32));
}

TEST_F(SegmentTest, Another_eeprom_gives_four_bytes_and_one_of_a_processor_none) {
  SlaveConfig config = drive_config();
  config.esc.eeprom_features = 0;
  segment_.add(config);
  master_.write<std::uint16_t>(Command::Apwr, address_of(0, reg::kStation), 0x1001);
  Data command = {0x00, 0x01, 0x08, 0, 0, 0};
  EXPECT_EQ(master_.send(Command::Fpwr, of(0, reg::kEepromControl), command), 1);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kEepromControl)), kEepromBusy | kEepromRead);
  master_.wait(Time(200'000));
  EXPECT_EQ(master_.read<std::uint64_t>(Command::Fprd, of(0, reg::kEepromData)), 0x4D8U);
  EXPECT_EQ(master_.write<std::uint8_t>(Command::Fpwr, of(0, reg::kEepromConfig), kEepromOfDevice), 1);
  EXPECT_EQ(master_.send(Command::Fpwr, of(0, reg::kEepromControl), command), 0);
}

TEST_F(SegmentTest, A_slave_without_a_processor_copies_the_state_that_is_asked_for) {
  SlaveConfig config = drive_config();
  config.esc.pdi_control = 0x0104;
  segment_.add(config);
  master_.write<std::uint16_t>(Command::Apwr, address_of(0, reg::kStation), 0x1001);
  for (const unsigned request : {0x11U, 0x02U, 0x12U, 0x04U, 0x08U}) {
    master_.write<std::uint16_t>(Command::Fpwr, of(0, reg::kAlControl), static_cast<std::uint16_t>(request));
    EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kAlStatus)), request);
  }
}

TEST_F(SegmentTest, The_eeprom_is_read_word_by_word) {
  add(1);
  Data command = {0x00, 0x01, 0x08, 0, 0, 0};  // read word 8
  EXPECT_EQ(master_.send(Command::Fpwr, of(0, reg::kEepromControl), command), 1);
  EXPECT_NE(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kEepromControl)) & kEepromBusy, 0);
  master_.wait(Time(200'000));
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kEepromControl)), kEepromEightBytes);
  EXPECT_EQ(master_.read<std::uint64_t>(Command::Fprd, of(0, reg::kEepromData)), 0x00000402'000004D8ULL);
}

TEST_F(SegmentTest, A_state_is_refused_with_its_reason) {
  add(1);
  EXPECT_EQ(request(0, AlState::PreOp), 0x11);
  EXPECT_EQ(code(0), kAlInvalidMailbox);
  EXPECT_EQ(request(0, AlState::PreOp), 0x11);  // not acknowledged
  const Sii sii = drive_sii();
  set_sync_manager(0, 0, sii.sync_managers[0]);
  set_sync_manager(0, 1, sii.sync_managers[1]);
  EXPECT_EQ(request(0, AlState::PreOp, kAlError), 2);
  EXPECT_EQ(code(0), kAlNoError);
  EXPECT_EQ(request(0, AlState::Op), 0x12);
  EXPECT_EQ(code(0), kAlInvalidChange);
  EXPECT_EQ(request(0, AlState::SafeOp, kAlError), 0x12);
  EXPECT_EQ(code(0), kAlInvalidOutputs);
}

TEST_F(SegmentTest, Logical_addresses_reach_process_data) {
  add(2);
  for (std::size_t i = 0; i < 2; ++i) {
    bring_to_op(i);
    set_fmmu(i, 0, static_cast<std::uint32_t>(0x10000 + 6 * i), kDriveOutputs, 2);
    set_fmmu(i, 1, static_cast<std::uint32_t>(0x10000 + 6 * i), kDriveInputs, 1);
  }
  Data image = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_EQ(master_.send(Command::Lrw, 0x10000, image), 6);
  EXPECT_EQ(master_.send(Command::Lrd, 0x10000, image), 2);
  EXPECT_THAT(image, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  Data part(2);
  EXPECT_EQ(master_.send(Command::Lrd, 0x10005, part), 2);  // one byte of each
  EXPECT_THAT(part, testing::ElementsAre(6, 7));
}

TEST_F(SegmentTest, A_chip_without_lrw_leaves_it_alone_and_runs_lrd_and_lwr) {
  SlaveConfig config = drive_config();
  config.esc.features |= kNoLrw;
  Slave& slave = segment_.add(std::move(config), reflect);
  master_.write<std::uint16_t>(Command::Apwr, address_of(0, reg::kStation), station(0));
  bring_to_op(0);
  set_fmmu(0, 0, 0x10000, kDriveOutputs, 2);
  set_fmmu(0, 1, 0x10006, kDriveInputs, 1);
  Data outputs = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(master_.send(Command::Lwr, 0x10000, outputs), 1);
  const auto memory = [&slave] {
    const auto bytes = slave.esc().memory(reg::kMemory, 0x1000);
    return Data(bytes.begin(), bytes.end());
  };
  const Data before = memory();
  Data both = {11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22};
  const Data sent = both;
  EXPECT_EQ(master_.send(Command::Lrw, 0x10000, both), 0);
  EXPECT_EQ(both, sent);
  EXPECT_EQ(memory(), before);
  Data inputs(6);
  EXPECT_EQ(master_.send(Command::Lrd, 0x10006, inputs), 1);
  EXPECT_EQ(inputs, outputs);
  // It does not trigger the watchdog either.
  for (int i = 0; i < 11; ++i) {
    master_.wait(Time(10'000'000));
    EXPECT_EQ(master_.send(Command::Lrw, 0x10000, both), 0);
  }
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kAlStatus)), 0x14);
  EXPECT_EQ(code(0), kAlSyncWatchdog);
}

TEST_F(SegmentTest, Outputs_that_stay_away_end_operation) {
  add(1);
  bring_to_op(0);
  master_.wait(Time(90'000'000));
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kAlStatus)), 8);
  master_.wait(Time(20'000'000));
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kAlStatus)), 0x14);
  EXPECT_EQ(code(0), kAlSyncWatchdog);
}

TEST_F(SegmentTest, A_mailbox_is_written_and_read_once) {
  add(1);
  bring_to_op(0);
  Data message(64);
  write_mailbox_header(message, 10, MailboxType::Coe, 1);
  write_coe_header(message, CoeService::SdoRequest);
  message[kCoeHeader] = kSdoUpload;
  store<std::uint16_t>(message, kCoeHeader + 1, 0x1000);
  Data answer(64);
  EXPECT_EQ(master_.send(Command::Fprd, of(0, 0x1040), answer), 0);  // nothing there
  EXPECT_EQ(master_.send(Command::Fpwr, of(0, 0x1000), message), 1);
  master_.wait(Time(1'000'000));
  EXPECT_EQ(master_.send(Command::Fprd, of(0, 0x1040), answer), 1);
  EXPECT_EQ(load<std::uint32_t>(answer, kCoeHeader + 4), 0x00020192U);
  const Data first = answer;
  EXPECT_EQ(master_.send(Command::Fprd, of(0, 0x1040), answer), 0);
  master_.write<std::uint8_t>(Command::Fpwr, of(0, 0x080E), 0x03);  // again, please
  master_.wait(Time(1'000'000));
  EXPECT_EQ(master_.read<std::uint8_t>(Command::Fprd, of(0, 0x080F)) & 2, 2);
  EXPECT_EQ(master_.send(Command::Fprd, of(0, 0x1040), answer), 1);
  EXPECT_EQ(answer, first);
}

TEST_F(SegmentTest, Without_power_the_line_ends_before) {
  add(3);
  segment_.set_power(1, false);
  master_.read<std::uint16_t>(Command::Brd, address_of(0, reg::kAlStatus), 1);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kDlStatus)), 0x5611);
  segment_.set_power(1, true);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Aprd, address_of(position(1), reg::kStation)), 0);  // it begins again
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(2, reg::kStation)), 0x1003);
  EXPECT_EQ(master_.read<std::uint16_t>(Command::Fprd, of(0, reg::kDlStatus)), 0x5A31);
  segment_.set_power(0, false);
  Data data(1);
  EXPECT_EQ(master_.send(Command::Brd, 0, data), 0xFFFF);
}

TEST_F(SegmentTest, Receive_times_show_the_length_of_the_cable) {
  add(3);
  EXPECT_EQ(master_.write<std::uint32_t>(Command::Bwr, address_of(0, reg::kReceiveTimes), 0), 3);
  const auto between = [this](std::size_t index) {
    return master_.read<std::uint32_t>(Command::Fprd, of(index, reg::kReceiveTimes + 4)) -
           master_.read<std::uint32_t>(Command::Fprd, of(index, reg::kReceiveTimes));
  };
  EXPECT_EQ(between(0), 2000U);  // two cables there and back, 500 ns each
  EXPECT_EQ(between(1), 1000U);
  EXPECT_EQ(master_.read<std::uint32_t>(Command::Fprd, of(2, reg::kReceiveTimes + 4)), 0U) << "nothing comes in there";
}

TEST(Clock, A_clock_drifts_and_follows_the_reference) {
  Segment segment(Time(500));
  auto config = drive_config();
  segment.add(config);
  config.esc.clock_start = Time(70'000);
  config.esc.drift_ppb = 100'000;
  segment.add(config);
  Prober master(segment);
  auto& esc = segment.slave(1).esc();
  EXPECT_EQ(esc.local_time(Time(1'000'000'000)) - Time(1'000'000'000), Time(170'000));
  master.write<std::uint16_t>(Command::Apwr, address_of(0, reg::kStation), 0x1001);
  master.write<std::uint32_t>(Command::Apwr, address_of(position(1), reg::kSystemTimeDelay), 500);
  for (int i = 0; i < 200; ++i) {
    master.wait(Time(1'000'000));
    master.read<std::uint64_t>(Command::Frmw, address_of(0x1001, reg::kSystemTime), 2);
  }
  const Time apart = esc.system_time(master.now()) - segment.slave(0).esc().system_time(master.now());
  EXPECT_LT(std::abs(apart.count()), 1000);
}

TEST(SiiImage, Is_read_as_it_was_written) {
  auto sii = drive_sii(7);
  sii.clocks = {{"DC", 0x0300, 0, 5, 6, 1, 2}};
  const auto read = read_sii(sii_image(sii));
  ASSERT_TRUE(read.ok()) << read.error();
  EXPECT_TRUE(read->checksum_fits);
  EXPECT_EQ(read->identity, sii.identity);
  EXPECT_EQ(read->name, "Test drive");
  EXPECT_EQ(read->mailbox.send_at, 0x1040);
  EXPECT_EQ(read->coe_details, sii.coe_details);
  ASSERT_EQ(read->sync_managers.size(), 4U);
  EXPECT_EQ(read->sync_managers[2].control, 0x64);
  EXPECT_EQ(read->outputs[0].entries[1].name, "Target");
  EXPECT_EQ(read->clocks[0].assign_activate, 0x0300);
  EXPECT_EQ(read->clocks[0].shift1, 6U);
}

}  // namespace
}  // namespace indurop::io::ethercat
