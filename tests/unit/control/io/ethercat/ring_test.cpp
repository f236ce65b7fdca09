// SPDX-License-Identifier: Apache-2.0
// A cable that leads through all slaves and back: cut at each place, healed, with slaves that come and go meanwhile.
#include "control/io/ethercat/link/ring_link.h"

#include <gmock/gmock.h>

#include <functional>
#include <random>
#include <utility>

#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

bool has(Bytes frame, Command command, std::uint32_t address) {
  FrameReader reader(frame);
  Datagram datagram;
  while (reader.next(datagram)) {
    if (datagram.command == command && datagram.address == address) {
      return true;
    }
  }
  return false;
}

// The first end of the cable. Calls a function once, after it has sent a frame with such a datagram and before the last
// end does.
class FirstEnd final : public Link {
 public:
  explicit FirstEnd(Link& link) : link_(link) {}
  bool send(Bytes frame) noexcept override {
    const bool sent = link_.send(frame);
    if (after_ && has(frame, command_, address_)) {
      std::exchange(after_, nullptr)();
    }
    return sent;
  }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override { return link_.receive(to); }
  void after(Command command, std::uint32_t address, std::function<void()> call) {
    command_ = command;
    address_ = address;
    after_ = std::move(call);
  }

 private:
  Link& link_;
  Command command_ = Command::Nop;
  std::uint32_t address_ = 0;
  std::function<void()> after_;
};

class RingPlant {
 public:
  // `without`: slaves without LRW, a bit for each.
  explicit RingPlant(std::size_t count, std::optional<std::size_t> cut = std::nullopt, unsigned without = 0) {
    auto plans = without_lrw(drive_plans(count), without);
    for (const SlavePlan& plan : plans) {
      bus_.segment().add(config_of(plan), [](Bytes outputs, std::span<std::uint8_t> inputs) {
        if (!outputs.empty()) {
          reflect(outputs, inputs);
        }
      });
    }
    link_ = std::make_unique<RingLink>(first_, bus_.make_ring());
    if (cut) {
      bus_.segment().set_cable(*cut, false);
    }
    master_ = std::make_unique<Master>(*link_, std::move(plans), kTick);
  }
  void tick() {
    now_ += kTick;
    ++number_;
    bus_.advance(now_);
    for (std::size_t i = 0; i < master_->size(); ++i) {
      master_->outputs(i)[2] = number_;
      master_->set_outputs_good(i, true);
    }
    master_->cycle(now_);
    bus_.segment().compute();
    Event event;
    while (master_->next_event(event)) {
      story_ += std::to_string(event.slave) + ": " + describe(event, "drive") + "\n";
    }
  }
  void run(unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      tick();
    }
  }
  [[nodiscard]] bool starts() {
    for (unsigned i = 0; i < 3000 && !io::ethercat::all_operate(*master_); ++i) {
      tick();
    }
    run(3);
    return io::ethercat::all_operate(*master_);
  }
  // Ticks in which the data of a slave did not come, or was not what it had been sent two ticks before.
  unsigned lost(unsigned ticks, std::optional<std::size_t> but = std::nullopt) {
    unsigned count = 0;
    for (unsigned i = 0; i < ticks; ++i) {
      tick();
      for (std::size_t k = 0; k < master_->size(); ++k) {
        const bool is_right = master_->is_fresh(k) && master_->inputs(k)[2] == static_cast<std::uint8_t>(number_ - 2);
        count += is_right || k == but ? 0U : 1U;
      }
    }
    return count;
  }

  SimulatedBus& bus() { return bus_; }
  FirstEnd& first() { return first_; }
  RingLink& link() { return *link_; }
  Master& master() { return *master_; }
  Slave& slave(std::size_t place) { return bus_.segment().slave(place); }
  [[nodiscard]] Clock now() const { return now_; }
  [[nodiscard]] const std::string& story() const { return story_; }

 private:
  SimulatedBus bus_;
  FirstEnd first_{bus_};
  std::unique_ptr<RingLink> link_;
  std::unique_ptr<Master> master_;
  Clock now_{0};
  std::uint8_t number_ = 0;
  std::string story_;
};

TEST(Ring, Slaves_work_as_on_a_line) {
  RingPlant sut(4);
  ASSERT_TRUE(sut.starts()) << sut.story();
  EXPECT_EQ(sut.lost(100), 0U);
  EXPECT_FALSE(sut.link().cut());
  EXPECT_EQ(sut.master().slaves_seen(), 4);
  EXPECT_EQ(sut.master().counters().lost, 0U);
  EXPECT_EQ(sut.master().counters().foreign, 0U);
}

TEST(Ring, A_cut_at_any_place_is_named_and_loses_no_tick_nor_does_its_end) {
  constexpr std::size_t kSlaves = 4;
  for (const unsigned without : {0b0000U, 0b0110U, 0b1111U}) {
    RingPlant sut(kSlaves, std::nullopt, without);
    ASSERT_TRUE(sut.starts()) << sut.story();
    for (std::size_t place = 0; place <= kSlaves; ++place) {
      SCOPED_TRACE(testing::Message() << "cut " << place << ", without LRW " << without);
      sut.bus().add_fault({FaultKind::CableCut, sut.now() + 5 * kTick, 200 * kTick, place, 0});
      EXPECT_EQ(sut.lost(100), 0U);
      ASSERT_TRUE(sut.link().cut());
      EXPECT_EQ(sut.link().cut()->before, place);
      EXPECT_EQ(sut.link().cut()->behind, place);
      EXPECT_EQ(sut.master().slaves_seen(), kSlaves);
      EXPECT_EQ(sut.lost(300), 0U);
      EXPECT_FALSE(sut.link().cut());
    }
    EXPECT_EQ(sut.master().counters().lost, 0U);
  }
}

// A frame passes the slaves behind that cable at neither end: at the first one while it is cut, at the last one after
// it.
TEST(Ring, A_cable_that_is_plugged_in_while_a_frame_is_sent_stops_no_slave) {
  constexpr std::size_t kSlaves = 4;
  RingPlant sut(kSlaves);
  ASSERT_TRUE(sut.starts()) << sut.story();
  for (std::size_t place = 1; place < kSlaves; ++place) {
    for (const bool in_query : {false, true}) {  // of the state; otherwise in process data
      SCOPED_TRACE(testing::Message() << "place " << place << ", in a query " << in_query);
      sut.bus().segment().set_cable(place, false);
      EXPECT_EQ(sut.lost(20), 0U);
      ASSERT_TRUE(sut.link().cut());
      const std::string before = sut.story();
      sut.first().after(in_query ? Command::Fprd : Command::Brd,
                        address_of(in_query ? station_of(place) : 0, reg::kAlStatus),
                        [&] { sut.bus().segment().set_cable(place, true); });
      EXPECT_LE(sut.lost(30), 2 * (kSlaves - place)) << "of each, the outputs of one tick, and its inputs";
      EXPECT_FALSE(sut.link().cut());
      EXPECT_TRUE(io::ethercat::all_operate(sut.master())) << sut.story().substr(before.size());
    }
  }
}

TEST(Ring, A_bus_that_is_cut_before_it_starts_starts) {
  for (const std::size_t place : {0U, 2U, 4U}) {
    SCOPED_TRACE(place);
    RingPlant sut(4, place);
    ASSERT_TRUE(sut.starts()) << sut.story();
    EXPECT_EQ(sut.lost(100), 0U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(sut.slave(i).esc().value<std::uint16_t>(reg::kStation), station_of(i));
    }
  }
}

TEST(Ring, A_slave_without_power_is_missing_alone_and_comes_back) {
  RingPlant sut(5);
  ASSERT_TRUE(sut.starts()) << sut.story();
  for (std::size_t place = 0; place < 5; ++place) {
    SCOPED_TRACE(place);
    sut.bus().segment().set_power(place, false);
    EXPECT_EQ(sut.lost(300, place), 0U);
    EXPECT_EQ(sut.master().slave(place).problem(), Problem::Missing) << sut.story();
    ASSERT_TRUE(sut.link().cut());
    EXPECT_EQ(sut.link().cut()->before, place);
    EXPECT_EQ(sut.link().cut()->behind, place + 1);
    sut.bus().segment().set_power(place, true);
    EXPECT_EQ(sut.lost(300, place), 0U);
    EXPECT_TRUE(io::ethercat::all_operate(sut.master())) << sut.story();
    EXPECT_EQ(sut.lost(20), 0U);
  }
}

// It is behind the cut, so only the last end reaches it.
TEST(Ring, A_slave_behind_a_cut_comes_back) {
  RingPlant sut(4);
  ASSERT_TRUE(sut.starts()) << sut.story();
  sut.bus().segment().set_cable(1, false);
  sut.run(10);
  sut.slave(2).fall_to(AlState::SafeOp, 0x8001);
  EXPECT_EQ(sut.lost(300, 2), 0U);
  EXPECT_TRUE(io::ethercat::all_operate(sut.master())) << sut.story();
  EXPECT_EQ(sut.lost(20), 0U);
}

TEST(Ring, Random_cuts_and_losses_of_power_are_survived) {
  std::mt19937 random(5);
  RingPlant sut(6, std::nullopt, 0b101010);
  ASSERT_TRUE(sut.starts()) << sut.story();
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const auto kind = random() % 3 == 0 ? FaultKind::PowerOff : FaultKind::CableCut;
    for (unsigned i = 0; i < 1 + random() % 2; ++i) {
      sut.bus().add_fault(
          {kind, sut.now() + (1 + random() % 50) * kTick, (1 + random() % 200) * kTick, random() % 6, 0});
    }
    sut.run(300);
    for (unsigned i = 0; i < 3000 && !io::ethercat::all_operate(sut.master()); ++i) {
      sut.tick();
    }
    ASSERT_TRUE(io::ethercat::all_operate(sut.master())) << sut.story();
    sut.run(3);
    EXPECT_EQ(sut.lost(10), 0U);
    EXPECT_FALSE(sut.link().cut());
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(sut.slave(i).esc().value<std::uint16_t>(reg::kStation), station_of(i));
    }
  }
}

TEST(Ring, A_lost_frame_is_no_cut) {
  RingPlant sut(3);
  ASSERT_TRUE(sut.starts()) << sut.story();
  sut.bus().add_fault({FaultKind::FramesLost, sut.now() + kTick, 3 * kTick, 0, 0});
  for (int i = 0; i < 20; ++i) {
    sut.tick();
    EXPECT_FALSE(sut.link().cut());
  }
  EXPECT_GT(sut.master().counters().lost, 0U);
  EXPECT_EQ(sut.lost(20), 0U);
}

}  // namespace
}  // namespace indurop::io::ethercat
