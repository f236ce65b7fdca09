// SPDX-License-Identifier: Apache-2.0
// Distributed clocks, judged in the slaves: when the process data arrives, by the pulses of each slave's own clock. The
// master's tick has a clock of its own, which is slower or faster than the reference.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include "control/io/ethercat/master/master.h"
#include "control/io/ethercat/simulator/bus.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

constexpr Clock kCable(500);
constexpr Clock kShift = std::chrono::microseconds(250);
constexpr unsigned kSecond = 1000;  // ticks

struct Machine {
  std::size_t drives = 4;
  std::int64_t tick_ppb = 0;  // how much longer a period of the tick is
  std::vector<std::int64_t> drift_ppb = {0, 0, 0, 0};
  unsigned seed = 0;  // of what clocks show when they are switched on
  bool is_late_by_chance = false;
  std::vector<bool> has_short_clock = {};  // of 32 bits, by place
};

class Synchronous {
 public:
  explicit Synchronous(const Machine& machine) : machine_(machine), random_(machine.seed) {
    auto plans = drive_plans(machine.drives);
    for (std::size_t i = 0; i < machine.drives; ++i) {
      SlaveConfig config = drive_config();
      config.esc.clock_start = Time(static_cast<std::int64_t>(random_() % 4'000'000'000'000U));
      config.esc.drift_ppb = machine.drift_ppb[i % machine.drift_ppb.size()];
      if (i < machine.has_short_clock.size() && machine.has_short_clock[i]) {
        config.esc.features = kHasClock;
      }
      bus_.segment().add(config, [](Bytes outputs, std::span<std::uint8_t> inputs) { reflect(outputs, inputs); });
      plans[i].sync = {0x0300, kTick, kShift, {}};
    }
    now_ = Clock(static_cast<std::int64_t>(random_() % 1'000'000'000U));
    master_ = std::make_unique<Master>(bus_, std::move(plans), kTick);
  }

  void tick() {
    const Clock period = kTick + Clock(master_->clocks().tick_correction());
    const Clock late(machine_.is_late_by_chance ? static_cast<std::int64_t>(random_() % 20'000) : 0);
    own_ += period;
    now_ += period + Clock(period.count() * machine_.tick_ppb / 1'000'000'000);
    sent_at_ = now_ + late;
    bus_.advance(sent_at_);
    master_->cycle(own_ + late);
    bus_.segment().compute();
    Event event;
    while (master_->next_event(event)) {
      story_ += describe(event, "drive") + "\n";
    }
  }
  void run(unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      tick();
    }
  }
  [[nodiscard]] bool all_operate() const { return io::ethercat::all_operate(*master_); }
  void start() {
    for (unsigned i = 0; i < 5 * kSecond && !all_operate(); ++i) {
      tick();
    }
    ASSERT_TRUE(all_operate()) << story_;
  }
  // How far the frame of the last tick was from where it shall be between two pulses, in this slave.
  [[nodiscard]] std::int64_t phase_error(std::size_t place) {
    const Clock arrival = sent_at_ + static_cast<std::int64_t>(place + 1) * kCable;
    const auto since = slave(place).esc().since_pulse(arrival);
    if (!since) {
      ADD_FAILURE() << "slave " << place << " has no pulses";
      return 0;
    }
    // Pulses are at the same time everywhere, so frames reach slaves later by the cable before them.
    const Clock wanted = kTick - kShift + static_cast<std::int64_t>(place) * kCable;
    const std::int64_t error = (*since - wanted % kTick).count();
    return error - (error > kTick.count() / 2 ? kTick.count() : 0) + (error < -kTick.count() / 2 ? kTick.count() : 0);
  }
  [[nodiscard]] std::int64_t worst_phase() {
    std::int64_t worst = 0;
    for (std::size_t i = 0; i < machine_.drives; ++i) {
      worst = std::max<std::int64_t>(worst, std::abs(phase_error(i)));
    }
    return worst;
  }
  // The largest difference between the times that two clocks show.
  [[nodiscard]] std::int64_t spread() {
    std::int64_t least = slave(0).esc().system_time(now_).count();
    std::int64_t most = least;
    for (std::size_t i = 1; i < machine_.drives; ++i) {
      const std::int64_t shown = slave(i).esc().system_time(now_).count();
      least = std::min(least, shown);
      most = std::max(most, shown);
    }
    return most - least;
  }

  Slave& slave(std::size_t place) { return bus_.segment().slave(place); }
  SimulatedBus& bus() { return bus_; }
  Master& master() { return *master_; }
  [[nodiscard]] Clock now() const { return now_; }
  [[nodiscard]] const std::string& story() const { return story_; }

 private:
  Machine machine_;
  std::mt19937_64 random_;
  SimulatedBus bus_{kCable};
  std::unique_ptr<Master> master_;
  Clock own_{0};  // the master's clock, which is slower
  Clock now_{0};
  Clock sent_at_{0};
  std::string story_;
};

TEST(Clocks, Measures_the_cable_to_each_slave) {
  Synchronous bus({});
  bus.start();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(bus.master().clocks().delay_ns(i), i * kCable.count()) << i;
  }
}

TEST(Clocks, Are_not_touched_without_a_plan_for_pulses) {
  Plant plant(2);
  plant.run_until_all_operate(1000);
  EXPECT_FALSE(plant.master().clocks().reference());
  EXPECT_EQ(plant.slave(1).esc().value<std::int64_t>(reg::kSystemTimeOffset), 0);
}

// Whatever the clocks show when they are switched on, and whatever the tick's own clock drifts.
TEST(Clocks, Phase_is_the_same_at_every_start) {
  std::array<std::int64_t, 4> least{};
  std::array<std::int64_t, 4> most{};
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const std::int64_t drift = static_cast<std::int64_t>(seed * 7919 % 201) * 1000 - 100'000;
    Synchronous bus({4, drift, {0, 20'000, -35'000, 50'000}, seed});
    bus.start();
    bus.run(2 * kSecond);
    for (unsigned tick = 0; tick < 100; ++tick) {
      bus.tick();
      for (std::size_t i = 0; i < 4; ++i) {
        const std::int64_t phase = bus.phase_error(i);
        least[i] = seed == 1 && tick == 0 ? phase : std::min(least[i], phase);
        most[i] = seed == 1 && tick == 0 ? phase : std::max(most[i], phase);
      }
    }
    EXPECT_LT(bus.worst_phase(), 1000) << "from the wanted one";
    EXPECT_LT(bus.spread(), 1000);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(most[i] - least[i], 1000) << "between two starts, slave " << i;
  }
}

TEST(Clocks, The_tick_follows_a_drift_of_100_ppm_in_both_directions) {
  for (const std::int64_t drift : {-100'000, 100'000}) {
    SCOPED_TRACE(drift);
    Synchronous bus({4, drift, {0, 100'000, -100'000, 0}, 7});
    bus.start();
    bus.run(2 * kSecond);
    std::int64_t worst = 0;
    for (unsigned i = 0; i < 10 * kSecond; ++i) {
      bus.tick();
      worst = std::max(worst, bus.worst_phase());
    }
    EXPECT_LT(worst, 1000);
  }
}

// A clock of 32 bits wraps around every 4.3 s, the one that the others follow, too.
TEST(Clocks, Clocks_of_32_bits_and_of_64_go_together) {
  for (const auto& has_short : {std::vector<bool>{true, false, true, false}, {false, true, false, true}}) {
    SCOPED_TRACE(has_short[0]);
    Synchronous bus({4, 30'000, {0, 20'000, -35'000, 50'000}, 11, false, has_short});
    bus.start();
    bus.run(2 * kSecond);
    std::int64_t worst = 0;
    for (unsigned i = 0; i < 10 * kSecond; ++i) {
      bus.tick();
      worst = std::max(worst, bus.worst_phase());
    }
    EXPECT_LT(worst, 1000);
    EXPECT_TRUE(bus.all_operate()) << bus.story();
    EXPECT_EQ(bus.story().find("does not follow"), std::string::npos) << bus.story();
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(bus.slave(i).esc().system_time(bus.now()) < Time(std::int64_t{1} << 32U), has_short[i]) << i;
    }
  }
}

TEST(Clocks, A_reference_of_32_bits_that_comes_back_goes_on_with_its_time) {
  Synchronous bus({4, -40'000, {0, 20'000, -30'000, 10'000}, 12, false, {true, false, false, true}});
  bus.start();
  bus.run(2 * kSecond);
  bus.bus().add_fault({FaultKind::PowerOff, bus.now() + kTick, 30 * kTick, 0, 0});
  bus.run(4 * kSecond);
  EXPECT_TRUE(bus.all_operate()) << bus.story();
  EXPECT_LT(bus.worst_phase(), 1000);
}

// Its chip could have a clock, and stamps frames; the EEPROM of the device has switched the clock off.
TEST(Clocks, A_clock_that_is_switched_off_is_a_piece_of_cable) {
  SimulatedBus wire{kCable};
  auto plans = drive_plans(3);
  for (const std::size_t place : {0U, 1U, 2U}) {
    SlaveConfig config = drive_config();
    config.esc.has_clock = place != 1;
    wire.segment().add(config);
    plans[place].sync.activation = 0;
  }
  plans[2].sync = {0x0300, kTick, kShift, {}};
  Master master(wire, std::move(plans), kTick);
  for (Clock now = kTick; now < std::chrono::seconds(1) && !all_operate(master); now += kTick) {
    wire.advance(now);
    master.cycle(now);
    wire.segment().compute();
  }
  EXPECT_TRUE(all_operate(master));
  EXPECT_FALSE(master.clocks().has_clock(1));
  EXPECT_EQ(master.clocks().delay_ns(2), 2 * kCable.count());
}

// What each slave says to the master, against when frames arrive there by the slave's own pulses.
TEST(Clocks, The_phase_of_pulses_is_reported_as_the_slaves_have_it) {
  Synchronous bus({4, 30'000, {0, 20'000, -35'000, 50'000}, 13, false, {false, true, false, false}});
  bus.start();
  bus.run(2 * kSecond);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto after = bus.master().slave(i).pulse_after();
    ASSERT_TRUE(after) << i;
    EXPECT_NEAR(static_cast<double>(after->count()), static_cast<double>(kShift.count() - bus.phase_error(i)), 500)
        << i;
  }
  // One whose pulses are elsewhere is seen although the tick keeps its phase.
  auto& esc = bus.slave(2).esc();
  const auto start = static_cast<std::int64_t>(esc.value<std::uint64_t>(reg::kSyncStart));
  std::vector<std::uint8_t> word(8);
  store<std::int64_t>(word, 0, start + kSecond * kTick.count() + 100'000);
  const std::uint8_t on = 0x03;
  ASSERT_TRUE(esc.write(reg::kSyncStart, word, bus.now()));
  ASSERT_TRUE(esc.write(reg::kSyncActivation + 1U, Bytes(&on, 1), bus.now()));
  bus.run(2 * kSecond);
  EXPECT_NEAR(static_cast<double>(bus.master().slave(2).pulse_after()->count()), 350'000, 1000);
  EXPECT_LT(std::abs(bus.master().clocks().phase_ns()), 1000);
}

TEST(Clocks, Late_ticks_move_the_phase_by_little) {
  Synchronous bus({4, 60'000, {0, 100'000, -100'000, 0}, 8, true});
  bus.start();
  bus.run(2 * kSecond);
  std::int64_t least = 0;
  std::int64_t most = 0;
  for (unsigned i = 0; i < 5 * kSecond; ++i) {
    bus.tick();
    const auto phase = bus.phase_error(0);
    least = std::min(least, phase);
    most = std::max(most, phase);
  }
  EXPECT_LT(most - least, 24'000);  // frames leave up to 20 us late, and that is nearly all
}

TEST(Clocks, A_slave_that_comes_back_is_set_again_and_disturbs_no_other) {
  Synchronous bus({4, 40'000, {0, 20'000, -30'000, 10'000}, 9});
  bus.start();
  bus.run(2 * kSecond);
  bus.bus().add_fault({FaultKind::PowerOff, bus.now() + kTick, 50 * kTick, 3, 0});
  std::int64_t worst = 0;
  for (unsigned i = 0; i < 2 * kSecond; ++i) {
    bus.tick();
    worst = std::max(worst, std::max(std::abs(bus.phase_error(0)), std::abs(bus.phase_error(2))));
  }
  EXPECT_LT(worst, 1000);
  EXPECT_TRUE(bus.all_operate()) << bus.story();
  EXPECT_LT(std::abs(bus.phase_error(3)), 1000);
}

TEST(Clocks, A_reference_that_comes_back_goes_on_with_its_time) {
  Synchronous bus({4, -40'000, {0, 20'000, -30'000, 10'000}, 10});
  bus.start();
  bus.run(2 * kSecond);
  bus.bus().add_fault({FaultKind::PowerOff, bus.now() + kTick, 30 * kTick, 0, 0});
  bus.run(4 * kSecond);
  EXPECT_TRUE(bus.all_operate()) << bus.story();
  EXPECT_LT(bus.worst_phase(), 1000);
  EXPECT_LT(bus.spread(), 1000);
}

TEST(Clocks, A_clock_that_jumps_is_brought_back) {
  Synchronous bus({});
  bus.start();
  bus.run(kSecond);
  for (const std::size_t place : {std::size_t{2}, std::size_t{0}}) {
    bus.slave(place).esc().jump_clock(std::chrono::microseconds(200));
    bus.run(kSecond);
    EXPECT_LT(bus.worst_phase(), 1000);
    EXPECT_NE(bus.story().find("slave " + std::to_string(place) + " (drive): its clock does not follow"),
              std::string::npos);
  }
}

TEST(Clocks, A_slave_without_a_clock_is_named) {
  SimulatedBus wire;
  SlaveConfig config = drive_config();
  config.esc.has_clock = false;
  wire.segment().add(drive_config());
  wire.segment().add(config);
  auto plans = drive_plans(2);
  plans[1].sync = {0x0300, kTick, kShift, {}};
  Master master(wire, std::move(plans), kTick);
  std::string story;
  for (Clock now = kTick; now < std::chrono::seconds(1); now += kTick) {
    wire.advance(now);
    master.cycle(now);
    wire.segment().compute();
    Event event;
    while (master.next_event(event)) {
      story += describe(event, "drive") + "\n";
    }
  }
  EXPECT_TRUE(master.slave(0).operates());
  EXPECT_NE(story.find("slave 1 (drive): has no distributed clock"), std::string::npos) << story;
}

}  // namespace
}  // namespace indurop::io::ethercat
