// SPDX-License-Identifier: Apache-2.0
// Frames as the wire has them, and bytes that are none.
#include "control/io/ethercat/frame.h"

#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "control/io/ethercat/registers.h"

namespace indurop::io::ethercat {
namespace {

constexpr Mac kSource = {2, 0, 0, 0, 0, 1};

std::vector<std::uint8_t> bytes_of(FrameBuilder& builder) {
  const Bytes bytes = builder.finish();
  return {bytes.begin(), bytes.end()};
}

TEST(Frame, One_datagram_is_as_the_standard_has_it) {
  FrameBuilder builder(kSource);
  EXPECT_TRUE(builder.is_empty());
  ASSERT_TRUE(builder.add(Command::Brd, 7, address_of(0, reg::kAlStatus), 2));
  const auto frame = bytes_of(builder);
  ASSERT_EQ(frame.size(), kMinFrame);
  const std::vector<std::uint8_t> head(frame.begin(), frame.begin() + 30);
  EXPECT_THAT(head, testing::ElementsAre(0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 2, 0, 0, 0, 0, 1, 0x88, 0xA4,  // Ethernet
                                         14, 0x10,                                                          // length
                                         7, 7, 0, 0, 0x30, 0x01, 2, 0, 0, 0, 0, 0, 0, 0));
}

TEST(Frame, Datagrams_are_read_as_they_were_added) {
  FrameBuilder builder(kSource);
  const std::vector<std::uint8_t> data = {1, 2, 3};
  ASSERT_TRUE(builder.add(Command::Fpwr, 1, address_of(0x1001, 0x1100), data));
  ASSERT_TRUE(builder.add(Command::Lrw, 2, 0x00010002, 4));
  const auto frame = bytes_of(builder);
  FrameReader reader(frame);
  Datagram datagram;
  ASSERT_EQ(reader.fault(), FrameFault::None);
  ASSERT_TRUE(reader.next(datagram));
  EXPECT_EQ(datagram.command, Command::Fpwr);
  EXPECT_EQ(datagram.address, address_of(0x1001, 0x1100));
  EXPECT_THAT(datagram.data(frame), testing::ElementsAreArray(data));
  ASSERT_TRUE(reader.next(datagram));
  EXPECT_EQ(datagram.command, Command::Lrw);
  EXPECT_EQ(datagram.index, 2);
  EXPECT_EQ(datagram.address, 0x00010002U);
  EXPECT_EQ(datagram.length, 4);
  EXPECT_FALSE(reader.next(datagram));
}

TEST(Frame, A_datagram_without_room_changes_nothing) {
  FrameBuilder builder(kSource);
  EXPECT_FALSE(builder.add(Command::Lrw, 0, 0, kMaxData + 1));
  EXPECT_TRUE(builder.is_empty());
  ASSERT_TRUE(builder.add(Command::Lrw, 0, 0, kMaxData));
  EXPECT_FALSE(builder.add(Command::Brd, 1, 0, std::size_t{0}));
  const auto frame = bytes_of(builder);
  EXPECT_EQ(frame.size(), kMaxFrame);
  EXPECT_EQ(FrameReader(frame).fault(), FrameFault::None);
}

TEST(Frame, Broken_frames_have_no_datagrams) {
  FrameBuilder builder(kSource);
  builder.add(Command::Brd, 7, 0, 2);
  const auto good = bytes_of(builder);
  const auto fault = [&good](std::size_t at, std::uint8_t byte) {
    auto frame = good;
    frame[at] = byte;
    FrameReader reader(frame);
    Datagram datagram;
    EXPECT_FALSE(reader.next(datagram));
    return reader.fault();
  };
  EXPECT_EQ(fault(12, 0x08), FrameFault::NotEtherCat);
  EXPECT_EQ(fault(15, 0x40), FrameFault::NoCommands);
  EXPECT_EQ(fault(15, 0x11), FrameFault::TooShort);
  EXPECT_EQ(fault(14, 0), FrameFault::NoDatagram);
  EXPECT_EQ(fault(16, 15), FrameFault::BrokenDatagram);
  EXPECT_EQ(fault(22, 3), FrameFault::BrokenDatagram);     // longer than the frame
  EXPECT_EQ(fault(23, 0x80), FrameFault::BrokenDatagram);  // promises another one
  EXPECT_EQ(FrameReader(Bytes(good).first(15)).fault(), FrameFault::NotEtherCat);
}

TEST(Frame, Bytes_after_the_last_datagram_are_not_read) {
  FrameBuilder builder(kSource);
  builder.add(Command::Brd, 7, 0, 1);
  auto frame = bytes_of(builder);
  frame[14] = 14;  // as TwinCAT sends it: the length counts a byte more
  FrameReader reader(frame);
  Datagram datagram;
  ASSERT_EQ(reader.fault(), FrameFault::None);
  ASSERT_TRUE(reader.next(datagram));
  EXPECT_EQ(datagram.length, 1);
  EXPECT_FALSE(reader.next(datagram));
}

TEST(Frame, No_bytes_lead_the_reader_astray) {
  std::mt19937 random(1);
  for (int round = 0; round < 200'000; ++round) {
    std::vector<std::uint8_t> frame(random() % 120);
    for (auto& byte : frame) {
      byte = static_cast<std::uint8_t>(random());
    }
    if (frame.size() >= kFrameHeader && round % 8 != 0) {  // most of them come as far as the datagrams
      frame[12] = 0x88;
      frame[13] = 0xA4;
      frame[14] = static_cast<std::uint8_t>(random() % 100);
      frame[15] = 0x10;
      for (std::size_t at = kFrameHeader; at + 8 < frame.size() && round % 3 != 0; at += 12U + frame[at + 6]) {
        frame[at] = static_cast<std::uint8_t>(random() % 15);
        frame[at + 6] = static_cast<std::uint8_t>(random() % 12);
        frame[at + 7] &= 0xC0U;
      }
    }
    FrameReader reader(frame);
    Datagram datagram;
    int count = 0;
    while (reader.next(datagram)) {
      ASSERT_LE(datagram.wkc_at() + 2, frame.size());
      ASSERT_LT(++count, 20);
    }
    ASSERT_EQ(count == 0, reader.fault() != FrameFault::None);
  }
}

TEST(Registers, Have_names) {
  EXPECT_EQ(register_name(0x0131), "AL status");
  EXPECT_EQ(register_name(0x0813), "SyncManager");
  EXPECT_EQ(register_name(0x0910), "system time");
  EXPECT_EQ(register_name(0x0020), "register");
}

TEST(Registers, States_and_codes_have_words) {
  EXPECT_EQ(to_string(AlState::SafeOp), "SAFEOP");
  EXPECT_EQ(to_string(static_cast<AlState>(5)), "unknown state");
  EXPECT_EQ(al_status_text(kAlSyncWatchdog), "SyncManager watchdog: no outputs arrived in time");
  EXPECT_EQ(al_status_text(0x8001), "error of the vendor's own");
  EXPECT_EQ(al_status_text(0x0FFF), "reserved code");
  EXPECT_EQ(to_string(Command::Armw), "ARMW");
}

}  // namespace
}  // namespace indurop::io::ethercat
