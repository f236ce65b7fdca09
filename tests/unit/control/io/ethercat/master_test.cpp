// SPDX-License-Identifier: Apache-2.0
// The master over simulated slaves: from nothing to OP, process data, objects, and slaves that come and go.
#include "control/io/ethercat/master/master.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "control/io/ethercat/master/copies.h"
#include "simulated_plant.h"
#include "tests/unit/allocations.h"

namespace indurop::io::ethercat {
namespace {

TEST(Master, Brings_slaves_to_op_and_exchanges_data) {
  Plant plant(3);
  EXPECT_LT(plant.run_until_all_operate(2000), 500U) << plant.story();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(plant.slave(i).state(), AlState::Op);
    EXPECT_EQ(plant.slave(i).objects().number(0x6060, 0), 8U);
    std::vector<std::uint8_t> value;
    EXPECT_FALSE(plant.slave(i).objects().read(0x2000, 0, false, value));
    EXPECT_EQ(value, std::vector<std::uint8_t>(150, static_cast<std::uint8_t>(i)));  // came in segments
    EXPECT_EQ(plant.applied(i), (std::vector<std::uint8_t>{6, 0, 0, 0, 0, 0}));      // its safe outputs
    plant.master().outputs(i)[0] = 15;
    plant.master().outputs(i)[2] = static_cast<std::uint8_t>(i + 1);
    plant.master().set_outputs_good(i, true);
  }
  plant.run(3);  // there, into the inputs, and back
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(plant.master().is_fresh(i));
    EXPECT_THAT(plant.master().inputs(i), testing::ElementsAre(15, 0, i + 1, 0, 0, 0));
  }
  EXPECT_EQ(plant.master().slaves_seen(), 3);
  EXPECT_EQ(plant.master().counters().lost, 0U);
  EXPECT_EQ(plant.master().counters().foreign, 0U);
  plant.master().set_outputs_good(1, false);
  plant.run(2);
  EXPECT_EQ(plant.applied(1)[0], 6);
  EXPECT_EQ(plant.applied(2)[0], 15);
}

TEST(Master, A_pulled_slave_is_named_in_the_next_tick_and_others_keep_their_data) {
  Plant plant(4);
  plant.run_until_all_operate(2000);
  plant.run(10);
  plant.events().clear();
  plant.bus().segment().set_power(2, false);
  plant.tick();                             // sends into the gap
  EXPECT_TRUE(plant.master().is_fresh(2));  // that of the frame before
  plant.tick();
  EXPECT_FALSE(plant.master().is_fresh(2));
  EXPECT_FALSE(plant.master().is_fresh(3));
  EXPECT_TRUE(plant.master().is_fresh(0));
  EXPECT_TRUE(plant.master().is_fresh(1));
  EXPECT_TRUE(plant.happened(2, Problem::WrongCounter));
  EXPECT_EQ(plant.master().slaves_seen(), 2);
  plant.run(2);
  EXPECT_TRUE(plant.happened(2, Problem::Missing)) << plant.story();
  for (int i = 0; i < 1000; ++i) {
    plant.tick();
    ASSERT_TRUE(plant.master().is_fresh(0));
  }
  const auto before = plant.slave(2).sdo().downloads();
  plant.bus().segment().set_power(2, true);
  EXPECT_LT(plant.run_until_all_operate(2000), 2000U) << plant.story();
  EXPECT_EQ(plant.slave(2).sdo().downloads(), before + 2);  // everything was applied again
  plant.run(2);
  EXPECT_TRUE(plant.master().is_fresh(2));
  EXPECT_TRUE(plant.master().is_fresh(3));
}

// Without and with pulses of their clocks. Of the first slave no frame comes back, so that all are without data.
TEST(Master, A_slave_pulled_anywhere_is_named_within_a_tick_and_operates_again_within_two_seconds) {
  std::mt19937 random(5);
  for (unsigned round = 0; round < 40; ++round) {
    const std::size_t place = round % 4;
    SCOPED_TRACE(testing::Message() << "round " << round << ", slave " << place);
    auto plans = drive_plans(4);
    for (SlavePlan& plan : plans) {
      plan.sync.activation = round % 8 < 4 ? 0 : 0x0300;
      plan.sync.cycle = kTick;
      plan.sync.shift = kTick / 2;
    }
    Plant plant(4, plans);
    plant.run_until_all_operate(2000);
    plant.run(10 + static_cast<unsigned>(random() % 100));
    const auto downloads = plant.slave(place).sdo().downloads();
    plant.events().clear();
    plant.bus().segment().set_power(place, false);
    plant.run(2);  // there, and back
    EXPECT_TRUE(place == 0 || plant.happened(place, Problem::WrongCounter)) << plant.story();
    const auto away = static_cast<unsigned>(20 + random() % 400);
    for (unsigned tick = 0; tick < away; ++tick) {
      plant.tick();
      for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_EQ(plant.master().is_fresh(i), i < place) << "slave " << i << ", tick " << tick;
        ASSERT_TRUE(i >= place || !plant.happened(i, Problem::WrongCounter));
      }
    }
    plant.bus().segment().set_power(place, true);
    unsigned ticks = 0;
    for (; ticks < 2000 && !(plant.master().is_fresh(place) && plant.master().is_fresh(3)); ++ticks) {
      plant.tick();
    }
    EXPECT_LT(ticks, 2000U) << plant.story();
    EXPECT_TRUE(plant.all_operate());
    EXPECT_EQ(plant.slave(place).sdo().downloads(), downloads + 2) << "everything was applied again";
    EXPECT_TRUE(plant.happened(place, Problem::Missing)) << plant.story();
  }
}

// As couplers and terminals of real buses are: the chip copies the state with the bit that acknowledges.
TEST(Master, Starts_slaves_without_a_processor) {
  Sii sii;
  sii.identity = {2, 0xB0C3052, 1, 0};
  sii.pdi_control = 0x0104;
  sii.fmmus = {FmmuUse::Outputs};
  sii.sync_managers = {{0x0F00, 1, 0x44, 9, SyncManagerUse::Outputs}};
  sii.outputs = {{0x1600, 0, 0, "Channel 1", {{0x7000, 1, 8, 5, "Output"}}}};
  std::vector<std::uint8_t> applied;
  SimulatedBus wire;
  SlaveConfig config;
  config.esc.eeprom = sii_image(sii);
  wire.segment().add(config, [&applied](Bytes outputs, std::span<std::uint8_t> /*inputs*/) {
    applied.assign(outputs.begin(), outputs.end());
  });
  Master master(wire, {plan_of(sii, 0x10000)}, kTick);
  Clock now{0};
  const auto run = [&](unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      now += kTick;
      wire.advance(now);
      master.cycle(now);
      wire.segment().compute();
    }
  };
  run(100);
  ASSERT_TRUE(master.slave(0).operates());
  master.outputs(0)[0] = 0xA5;
  master.set_outputs_good(0, true);
  run(2);
  EXPECT_EQ(applied, std::vector<std::uint8_t>{0xA5});
  EXPECT_TRUE(master.is_fresh(0));
}

TEST(Master, Reads_an_eeprom_of_four_bytes_and_gives_it_to_the_processor) {
  SimulatedBus wire;
  SlaveConfig config = drive_config();
  config.esc.eeprom_features = 0;
  wire.segment().add(config);
  wire.segment().slave(0).esc().set<std::uint8_t>(reg::kEepromConfig, kEepromOfDevice);  // another master left it so
  Master master(wire, drive_plans(1), kTick);
  for (Clock now = kTick; now < std::chrono::seconds(1); now += kTick) {
    wire.advance(now);
    master.cycle(now);
    wire.segment().compute();
  }
  EXPECT_TRUE(master.slave(0).operates());
  EXPECT_EQ(wire.segment().slave(0).esc().at(reg::kEepromConfig), kEepromOfDevice);
}

TEST(Master, A_cut_cable_at_the_master_is_named) {
  Plant plant(2);
  plant.run_until_all_operate(2000);
  plant.events().clear();
  plant.bus().segment().set_power(0, false);
  plant.run(100);
  EXPECT_TRUE(plant.happened(0, Problem::Missing));
  EXPECT_TRUE(plant.happened(1, Problem::Missing));
  EXPECT_FALSE(plant.master().is_fresh(1));
}

TEST(Master, A_swapped_slave_is_refused) {
  auto plans = drive_plans(2);
  plans[1].identity.product = 0x999;
  Plant plant(2, plans);
  plant.run(1000);
  EXPECT_TRUE(plant.master().slave(0).operates());
  EXPECT_EQ(plant.master().slave(1).problem(), Problem::WrongIdentity);
  EXPECT_EQ(plant.slave(1).state(), AlState::Init);
  EXPECT_THAT(plant.story(), testing::HasSubstr("slave 1 (drive): another device is at its position: product code "
                                                "00000402h"));
}

TEST(Master, Objects_are_read_in_one_piece_and_in_segments) {
  Plant plant(1);
  plant.run_until_all_operate(2000);
  const auto read = [&plant](std::uint16_t index, std::uint8_t subindex, bool complete,
                             std::vector<std::uint8_t>& room) {
    SdoTransfer transfer;
    transfer.index = index;
    transfer.subindex = subindex;
    transfer.complete = complete;
    transfer.upload = true;
    transfer.room = room;
    for (int i = 0; i < 100 && !plant.master().start(0, transfer, plant.now()); ++i) {
      plant.tick();
    }
    for (int i = 0; i < 2000 && transfer.state == SdoTransfer::State::Waiting; ++i) {
      plant.tick();
    }
    room.resize(transfer.size);
    return transfer;
  };
  std::vector<std::uint8_t> room(200);
  EXPECT_EQ(read(0x1000, 0, false, room).state, SdoTransfer::State::Done);
  EXPECT_THAT(room, testing::ElementsAre(0x92, 0x01, 0x02, 0x00));
  room.resize(200);
  EXPECT_EQ(read(0x1008, 0, false, room).state, SdoTransfer::State::Done);
  EXPECT_EQ(std::string(room.begin(), room.end()),
            "A drive whose name is longer than its mailbox, so that it comes in three segments or in more than that");
  room.resize(200);
  EXPECT_EQ(read(0x1018, 0, true, room).state, SdoTransfer::State::Done);
  EXPECT_EQ(room.size(), 18U);
  EXPECT_EQ(load<std::uint32_t>(room, 6), 0x402U);
  room.resize(200);
  const auto missing = read(0x3000, 0, false, room);
  EXPECT_EQ(missing.state, SdoTransfer::State::Aborted);
  EXPECT_EQ(sdo_abort_text(missing.abort_code), "there is no such object");
  room.resize(3);
  EXPECT_EQ(read(0x1008, 0, false, room).abort_code, kAbortMemory);
}

// A cable whose own memory does not count.
class Counted final : public Link {
 public:
  explicit Counted(Link& link) : link_(link) {}
  bool send(Bytes frame) noexcept override {
    const auto before = g_allocations.load();
    const bool sent = link_.send(frame);
    allocated_ += g_allocations.load() - before;
    return sent;
  }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override {
    const auto before = g_allocations.load();
    const std::size_t size = link_.receive(to);
    allocated_ += g_allocations.load() - before;
    return size;
  }
  [[nodiscard]] std::uint64_t allocated() const { return allocated_; }

 private:
  Link& link_;
  std::uint64_t allocated_ = 0;
};

// A frame that comes too late has been at the slave: it has taken the message, or believes that its answer was read.
TEST(Master, A_message_whose_frame_is_lost_is_not_lost_and_not_taken_twice) {
  Plant plant(1);
  plant.run_until_all_operate(2000);
  std::vector<std::uint8_t> sent(150);
  for (unsigned delay = 0; delay < 30; ++delay) {
    SCOPED_TRACE(delay);
    std::fill(sent.begin(), sent.end(), static_cast<std::uint8_t>(delay));
    SdoTransfer transfer;
    transfer.index = 0x2000;
    transfer.sent = sent;
    for (int i = 0; i < 100 && !plant.master().start(0, transfer, plant.now()); ++i) {
      plant.tick();
    }
    const auto before = plant.slave(0).sdo().downloads();
    const auto lost = delay % 2 == 0 ? FaultKind::FramesLate : FaultKind::FramesLost;
    plant.bus().add_fault({lost, plant.now() + delay / 2 * kTick, kTick, 0, 20'000'000});
    for (int i = 0; i < 2000 && transfer.state == SdoTransfer::State::Waiting; ++i) {
      plant.tick();
    }
    EXPECT_EQ(transfer.state, SdoTransfer::State::Done);
    EXPECT_EQ(plant.slave(0).sdo().downloads(), before + 1);
    const auto stored = plant.slave(0).objects().storage(0x2000, 0);
    EXPECT_TRUE(std::equal(sent.begin(), sent.end(), stored.begin()));
    plant.run_until_all_operate(2000);
    plant.run(40);
  }
}

TEST(Master, The_exchange_allocates_nothing) {
  constexpr std::size_t kDrives = 8;
  SimulatedBus bus;
  for (std::size_t i = 0; i < kDrives; ++i) {
    bus.segment().add(drive_config(), reflect);
  }
  Counted cable(bus);
  Master sut(cable, drive_plans(kDrives), kTick);
  Copies copies({{kDrives - 1, 3, 0, 5, 40, kTick}}, sut);
  std::array<std::uint8_t, 200> room{};
  SdoTransfer transfer;
  transfer.index = 0x1008;
  transfer.upload = true;
  transfer.room = room;
  bool is_started = false;
  unsigned fresh = 0;
  std::uint64_t allocated = 0;
  const auto run = [&](int ticks) {
    static Clock now{0};
    for (int i = 0; i < ticks; ++i) {
      now += kTick;
      bus.advance(now);
      const auto before = g_allocations.load() - cable.allocated();
      sut.receive(now);
      copies.run(sut, now);
      sut.send(now);
      Event event;
      while (sut.next_event(event) || copies.next_event(event)) {
      }
      is_started = is_started || sut.start(3, transfer, now);
      allocated += g_allocations.load() - cable.allocated() - before;
      bus.segment().compute();
      fresh += sut.is_fresh(kDrives - 1) ? 1U : 0U;
    }
  };
  run(1000);
  EXPECT_GT(fresh, 500U) << "all slaves are in OP";
  EXPECT_EQ(transfer.state, SdoTransfer::State::Done);
  bus.segment().slave(2).fall_to(AlState::SafeOp, 0x8001);
  bus.segment().slave(4).send_emergency({0x2310, 1, {}});
  run(100);
  bus.segment().set_power(5, false);
  run(300);
  EXPECT_FALSE(sut.is_fresh(kDrives - 1));
  bus.segment().set_power(5, true);
  run(1000);
  EXPECT_TRUE(sut.is_fresh(kDrives - 1)) << "it has recovered";
  EXPECT_EQ(allocated, 0U);
}

TEST(Master, What_another_master_left_in_a_slave_answers_for_no_other) {
  Plant plant(2);
  auto& esc = plant.slave(0).esc();
  // It maps the process data of the second slave into its own memory, and has a SyncManager too many.
  const std::size_t fmmu = reg::kFmmu + std::size_t{7} * kFmmuBytes;
  esc.set<std::uint32_t>(fmmu, plant.master().plan(1).logical);
  esc.set<std::uint16_t>(fmmu + 4, 12);
  esc.set<std::uint8_t>(fmmu + 7, 7);
  esc.set<std::uint16_t>(fmmu + 8, 0x1800);
  esc.set<std::uint8_t>(fmmu + 11, 3);
  esc.set<std::uint8_t>(fmmu + 12, 1);
  esc.set<std::uint8_t>(reg::kSyncManager + 5 * kSyncManagerBytes + 6, 1);
  EXPECT_LT(plant.run_until_all_operate(2000), 500U) << plant.story();
  plant.run(10);
  EXPECT_TRUE(plant.master().is_fresh(0));
  EXPECT_TRUE(plant.master().is_fresh(1)) << plant.story();
  EXPECT_EQ(esc.at(fmmu + 12), 0);
  EXPECT_EQ(esc.at(reg::kSyncManager + 5 * kSyncManagerBytes + 6), 0);
}

TEST(Master, Data_of_many_slaves_goes_in_several_frames) {
  Plant plant(80);
  plant.run_until_all_operate(4000);
  EXPECT_TRUE(plant.all_operate());
  const auto before = plant.master().counters().sent;
  plant.run(1);
  EXPECT_GE(plant.master().counters().sent - before, 2U);
  plant.run(2);
  EXPECT_TRUE(plant.master().is_fresh(0));
  EXPECT_TRUE(plant.master().is_fresh(79));
}

}  // namespace
}  // namespace indurop::io::ethercat
