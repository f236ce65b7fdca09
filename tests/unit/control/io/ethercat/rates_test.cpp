// SPDX-License-Identifier: Apache-2.0
// Slaves that are exchanged less often than once in a cycle: how often is counted in the frames, and what slaves and
// application get is compared with what the other one gave.
#include <gmock/gmock.h>

#include <map>
#include <random>

#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

// Counts process data by logical address.
class CountingLink final : public Link {
 public:
  explicit CountingLink(SimulatedBus& bus) : bus_(bus) {}
  bool send(Bytes frame) noexcept override {
    FrameReader reader(frame);
    Datagram datagram;
    while (reader.next(datagram)) {
      if (is_logical(datagram.command)) {
        ++exchanges[datagram.address];
      }
    }
    return bus_.send(frame);
  }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override { return bus_.receive(to); }

  std::map<std::uint32_t, unsigned> exchanges;

 private:
  SimulatedBus& bus_;
};

class Rates {
 public:
  explicit Rates(const std::vector<unsigned>& every, unsigned without = 0) : applied(every.size()) {
    auto plans = without_lrw(drive_plans(every.size()), without);
    for (std::size_t i = 0; i < every.size(); ++i) {
      plans[i].every = every[i];
      bus.segment().add(config_of(plans[i]), [this, i](Bytes outputs, std::span<std::uint8_t> inputs) {
        if (!outputs.empty()) {
          applied[i].assign(outputs.begin(), outputs.end());
          reflect(outputs, inputs);
        }
      });
    }
    master.emplace(link, std::move(plans), kTick);
  }
  void tick() {
    now += kTick;
    bus.advance(now);
    master->cycle(now);
    bus.segment().compute();
  }
  void start() {
    for (int i = 0; i < 5000 && !all_operate(*master); ++i) {
      tick();
    }
    ASSERT_TRUE(all_operate(*master));
    for (int i = 0; i < 20; ++i) {
      tick();  // each has been exchanged
    }
  }
  void set_outputs(std::uint8_t value) {
    for (std::size_t i = 0; i < master->size(); ++i) {
      const auto outputs = master->outputs(i);
      std::fill(outputs.begin(), outputs.end(), value);
      master->set_outputs_good(i, true);
    }
  }

  SimulatedBus bus;
  CountingLink link{bus};
  std::optional<Master> master;
  Clock now{0};
  std::vector<std::vector<std::uint8_t>> applied;
};

TEST(Rates, Each_slave_is_exchanged_once_in_its_number_of_cycles) {
  std::mt19937 random(11);
  for (int round = 0; round < 10; ++round) {
    std::vector<unsigned> every;
    for (int i = 0; i < 6; ++i) {
      every.push_back(1 + static_cast<unsigned>(random() % 6));
    }
    Rates sut(every, static_cast<unsigned>(random()));
    sut.start();
    sut.link.exchanges.clear();
    constexpr unsigned kCycles = 60;  // a multiple of each
    for (unsigned i = 0; i < kCycles; ++i) {
      sut.tick();
    }
    for (std::size_t i = 0; i < every.size(); ++i) {
      const SlavePlan& plan = sut.master->plan(i);
      EXPECT_EQ(sut.link.exchanges[plan.logical], kCycles / every[i]);
      const auto inputs_at = static_cast<std::uint32_t>(plan.logical + plan.output_bytes);
      EXPECT_EQ(sut.link.exchanges[inputs_at], plan.uses_lrw ? 0 : kCycles / every[i]);
    }
  }
}

TEST(Rates, Values_arrive_with_the_next_exchange_and_stay_good_until_then) {
  Rates sut({1, 4, 10}, 0b010);
  sut.set_outputs(1);
  sut.start();
  for (std::uint8_t value = 2; value < 60; ++value) {
    sut.set_outputs(value);
    for (unsigned i = 0; i < 10; ++i) {
      sut.tick();
      for (std::size_t slave = 0; slave < 3; ++slave) {
        EXPECT_TRUE(sut.master->is_fresh(slave)) << slave;
        const std::uint8_t seen = sut.applied[slave].at(0);
        EXPECT_TRUE(seen == value || seen == value - 1);
      }
    }
    EXPECT_EQ(sut.applied[0].at(0), value);
    EXPECT_EQ(sut.applied[1].at(0), value);
    EXPECT_EQ(sut.applied[2].at(0), value);
  }
}

TEST(Rates, A_slow_slave_that_is_lost_is_not_good_any_more) {
  Rates sut({1, 10});
  sut.set_outputs(1);
  sut.start();
  sut.bus.segment().set_power(1, false);
  unsigned ticks = 0;
  for (; ticks < 100 && sut.master->is_fresh(1); ++ticks) {
    sut.tick();
    EXPECT_TRUE(sut.master->is_fresh(0));
  }
  EXPECT_LE(ticks, 12U) << "its next exchange, or the check of its state";
}

}  // namespace
}  // namespace indurop::io::ethercat
