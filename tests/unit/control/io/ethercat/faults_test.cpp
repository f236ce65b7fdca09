// SPDX-License-Identifier: Apache-2.0
// Faults of the bus: each is named, everything recovers, and no slave in OP gets an output beyond its limits.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <random>

#include "random_fault.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

constexpr std::int32_t kLimit = 1000;

// Drives with pulses of their clocks.
std::vector<SlavePlan> synchronous_plans(std::size_t count) {
  auto plans = drive_plans(count);
  for (SlavePlan& plan : plans) {
    plan.sync = {0x0300, kTick, kTick / 2, {}};
  }
  return plans;
}

// Whether this fault is a reason to say that.
bool explains(const Fault& fault, const Event& event) {
  const auto is_one_of = [&event](std::initializer_list<Problem> problems) {
    return std::find(problems.begin(), problems.end(), event.problem) != problems.end();
  };
  const bool is_it = event.slave == fault.slave;
  switch (fault.kind) {
    case FaultKind::FramesLost:
    case FaultKind::FramesLate:
    case FaultKind::FramesDoubled:
    case FaultKind::FramesSwapped:
    case FaultKind::ForeignFrame:
    case FaultKind::ClockDrifts:
    case FaultKind::ObjectSet:
      return false;
    case FaultKind::FramesBroken:
      return is_it && event.problem == Problem::BrokenFrames;
    case FaultKind::WrongCounter:
      return is_it && event.problem == Problem::WrongCounter;
    case FaultKind::PowerOff:
    case FaultKind::CableCut:
      return event.slave >= fault.slave && is_one_of({Problem::WrongCounter, Problem::Missing});
    case FaultKind::StateRefused:
    case FaultKind::StateLost:
      return is_it && is_one_of({Problem::WrongCounter, Problem::StateLost, Problem::StateRefused});
    case FaultKind::SdoAborted:
      return is_it && is_one_of({Problem::WrongCounter, Problem::Missing, Problem::SdoAborted});
    case FaultKind::SdoSilence:
      return is_it && is_one_of({Problem::WrongCounter, Problem::Missing, Problem::SdoTimeout});
    case FaultKind::SdoRepeated:
    case FaultKind::StateSlow:
      return is_it && is_one_of({Problem::WrongCounter, Problem::Missing});
    case FaultKind::OtherIdentity:
      return is_it && is_one_of({Problem::WrongCounter, Problem::Missing, Problem::WrongIdentity});
    case FaultKind::EepromBusy:
      return is_it && is_one_of({Problem::WrongCounter, Problem::Missing, Problem::EepromBusy});
    case FaultKind::Emergency:
      return is_it && event.problem == Problem::EmergencySent;
    case FaultKind::ClockJumps:
      return is_it && event.problem == Problem::ClockNotInStep;
  }
  return false;
}

// A plant whose application moves targets within their limits. `without`: slaves without LRW, a bit for each.
class FaultyPlant {
 public:
  explicit FaultyPlant(std::size_t count, unsigned without = 0)
      : plant(count, without_lrw(synchronous_plans(count), without)) {
    plant.run_until_all_operate(2000);
    plant.run(20);
    plant.events().clear();
    // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after the plant operates
    before = plant.master().counters();
  }
  void run(unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      for (std::size_t k = 0; k < plant.master().size(); ++k) {
        const auto target = static_cast<std::int32_t>((tick_ * 7 + k * 100) % (2 * kLimit + 1)) - kLimit;
        store<std::uint16_t>(plant.master().outputs(k), 0, 0x0F);
        store<std::int32_t>(plant.master().outputs(k), 2, target);
        plant.master().set_outputs_good(k, plant.master().is_fresh(k));
      }
      ++tick_;
      plant.tick();
      check_outputs();
    }
  }
  // Returns whether the fault has left its own trace, not just any.
  [[nodiscard]] bool is_named(const Fault& fault) const {
    const BusCounters& now = plant.master().counters();
    switch (fault.kind) {
      case FaultKind::FramesLost:
        return now.lost > before.lost;
      case FaultKind::FramesLate:
        return now.late > before.late;
      case FaultKind::FramesDoubled:
        return now.duplicates > before.duplicates;
      case FaultKind::FramesSwapped:
        return now.lost == before.lost && now.foreign == before.foreign;
      case FaultKind::FramesBroken:
        return now.lost > before.lost && plant.slave(fault.slave).esc().at(reg::kRxErrors) > 0;
      case FaultKind::ForeignFrame:
        return now.foreign > before.foreign;
      case FaultKind::WrongCounter:
        return plant.happened(fault.slave, Problem::WrongCounter);
      case FaultKind::PowerOff:
        return plant.happened(fault.slave, Problem::Missing);
      case FaultKind::StateRefused:
        return has(fault.slave, Problem::StateLost, fault.value) &&
               has(fault.slave, Problem::StateRefused, fault.value);
      case FaultKind::StateLost:
        return has(fault.slave, Problem::StateLost, fault.value);
      case FaultKind::SdoAborted:
        return has(fault.slave, Problem::SdoAborted, fault.value);
      case FaultKind::SdoSilence:
        return plant.happened(fault.slave, Problem::SdoTimeout);
      case FaultKind::SdoRepeated:
        return plant.happened(fault.slave, Problem::None) && !plant.happened(fault.slave, Problem::SdoAborted);
      case FaultKind::StateSlow:
        return is_back_after(fault.slave, fault.at + Time(fault.value));
      case FaultKind::OtherIdentity:
        return plant.happened(fault.slave, Problem::WrongIdentity);
      case FaultKind::EepromBusy:
        return plant.happened(fault.slave, Problem::EepromBusy);
      case FaultKind::Emergency:
        return has(fault.slave, Problem::EmergencySent, fault.value);
      case FaultKind::ClockJumps:
        return plant.happened(fault.slave, Problem::ClockNotInStep);
      case FaultKind::ClockDrifts:
        return !plant.happened(fault.slave, Problem::ClockNotInStep);  // the master makes up for so little
      case FaultKind::CableCut:                                        // before the first slave all frames are lost
        return plant.happened(fault.slave, Problem::Missing) || (fault.slave == 0 && now.lost > before.lost);
      case FaultKind::ObjectSet:
        return true;
    }
    return false;
  }

  // What was said of a slave that this fault has nothing to do with, or that it did not do. Ports are asked once a
  // second, so they may tell of earlier faults.
  [[nodiscard]] std::string misnamed(const Fault& fault, const std::vector<Fault>& earlier) const {
    std::string text;
    for (const Event& event : plant.events()) {
      const bool is_late =
          event.problem == Problem::BrokenFrames &&
          std::any_of(earlier.begin(), earlier.end(), [&event](const Fault& other) { return explains(other, event); });
      if (event.problem != Problem::None && !is_late && !explains(fault, event)) {
        text += describe(event, "drive") + "\n";
      }
    }
    return text;
  }

  mutable Plant plant;
  BusCounters before;

 private:
  [[nodiscard]] bool has(std::size_t slave, Problem problem, std::uint32_t detail) const {
    return std::any_of(plant.events().begin(), plant.events().end(), [&](const Event& event) {
      return event.slave == slave && event.problem == problem && event.detail == detail;
    });
  }
  [[nodiscard]] bool is_back_after(std::size_t slave, Time time) const {
    for (const Event& event : plant.events()) {
      if (event.slave == slave && event.problem == Problem::None) {
        return event.time > time;
      }
    }
    return false;
  }
  void check_outputs() {
    for (std::size_t k = 0; k < plant.master().size(); ++k) {
      const auto& applied = plant.applied(k);
      if (plant.slave(k).state() != AlState::Op || applied.empty()) {
        continue;
      }
      const auto control = load<std::uint16_t>(applied, 0);
      const auto target = load<std::int32_t>(applied, 2);
      ASSERT_TRUE((control == 0x0F && std::abs(target) <= kLimit) || (control == 0x06 && target == 0))
          << "slave " << k << ": control " << control << ", target " << target;
    }
  }

  std::size_t tick_ = 0;
};

TEST(Faults, Each_kind_is_named_and_everything_recovers) {
  std::mt19937 random(3);
  for (std::uint8_t kind = 0; kind < kFaultKinds; ++kind) {
    FaultyPlant sut(3, kind);
    const Fault fault =
        random_fault(random, 3, static_cast<FaultKind>(kind), sut.plant.now() + std::chrono::milliseconds(5));
    sut.plant.bus().add_fault(fault);
    sut.run(2600);
    EXPECT_TRUE(sut.is_named(fault)) << "kind " << int{kind} << ", slave " << fault.slave << "\n" << sut.plant.story();
    EXPECT_TRUE(sut.plant.all_operate()) << "kind " << int{kind} << "\n" << sut.plant.story();
  }
}

TEST(Faults, Swapped_frames_come_back_in_the_other_order) {
  SimulatedBus sut;
  sut.segment().add(drive_config());
  Fault fault;
  fault.kind = FaultKind::FramesSwapped;
  fault.duration = kTick;
  sut.add_fault(fault);
  const auto order = [&sut](Clock now) {
    sut.advance(now);
    for (std::uint8_t index = 1; index <= 2; ++index) {
      FrameBuilder builder(kMasterMac);
      builder.add(Command::Brd, index, address_of(0, reg::kAlStatus), 2);
      sut.send(builder.finish());
    }
    sut.advance(now + kTick / 2);
    std::vector<int> indices;
    std::array<std::uint8_t, kMaxFrame> bytes{};
    for (std::size_t size = sut.receive(bytes); size > 0; size = sut.receive(bytes)) {
      FrameReader reader(Bytes(bytes).first(size));
      Datagram datagram;
      indices.push_back(reader.next(datagram) ? datagram.index : -1);
    }
    return indices;
  };
  EXPECT_THAT(order(Clock{0}), testing::ElementsAre(2, 1));
  EXPECT_THAT(order(kTick), testing::ElementsAre(1, 2)) << "it is over";
}

// Beyond what the chip's clock can make up for, a thousandth.
TEST(Faults, A_clock_that_drifts_too_much_leaves_the_reference_and_comes_back) {
  FaultyPlant sut(3);
  Fault fault;
  fault.kind = FaultKind::ClockDrifts;
  fault.slave = 1;
  fault.at = sut.plant.now() + kTick;
  fault.duration = std::chrono::milliseconds(500);
  fault.value = 3000;
  sut.plant.bus().add_fault(fault);
  const auto difference = [&sut](std::size_t slave) {
    return sut.plant.slave(slave).esc().value<std::uint32_t>(reg::kSystemTimeDifference) & 0x7FFFFFFFU;
  };
  sut.run(12);
  EXPECT_GT(difference(1), 10'000U) << "2 us in each tick";
  EXPECT_LT(difference(2), 1000U);
  EXPECT_FALSE(sut.plant.happened(1, Problem::ClockNotInStep)) << "it may still follow";
  sut.run(4000);
  EXPECT_TRUE(sut.plant.happened(1, Problem::ClockNotInStep)) << sut.plant.story();
  EXPECT_LT(difference(1), 1000U);
  EXPECT_TRUE(sut.plant.all_operate()) << sut.plant.story();
}

TEST(Faults, Random_scripts_recover_without_an_output_beyond_its_limits) {
  for (unsigned seed = 0; seed < 500 && !testing::Test::HasFailure(); ++seed) {
    std::mt19937 random(seed);
    const std::size_t slaves = 1 + random() % 4;
    FaultyPlant sut(slaves, seed);
    const unsigned count = 1 + static_cast<unsigned>(random() % 3);
    std::vector<Fault> faults;
    for (unsigned i = 0; i < count; ++i) {
      // One after the other has recovered, so that each has to leave its own trace.
      const Fault fault = random_fault(random, slaves, static_cast<FaultKind>(random() % kFaultKinds),
                                       sut.plant.now() + std::chrono::milliseconds(1 + random() % 20));
      sut.plant.events().clear();
      sut.before = sut.plant.master().counters();
      sut.plant.bus().add_fault(fault);
      unsigned ticks = 30;
      sut.run(ticks);
      const Time settled = fault.at + fault.duration + std::chrono::milliseconds(60);
      for (; ticks < 4000 && (!sut.plant.all_operate() || settled > sut.plant.now()); ++ticks) {
        sut.run(1);
      }
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(fault.kind) << ", slave "
                                      << fault.slave << " of " << slaves);
      EXPECT_TRUE(sut.is_named(fault)) << sut.plant.story();
      EXPECT_EQ(sut.misnamed(fault, faults), "") << sut.plant.story();
      faults.push_back(fault);
      ASSERT_TRUE(sut.plant.all_operate()) << sut.plant.story();
    }
  }
}

TEST(Faults, Scripts_that_overlap_recover_too) {
  for (unsigned seed = 0; seed < 100 && !testing::Test::HasFailure(); ++seed) {
    std::mt19937 random(seed + 1000);
    FaultyPlant sut(3, seed);
    for (unsigned i = 0; i < 6; ++i) {
      sut.plant.bus().add_fault(random_fault(random, 3, static_cast<FaultKind>(random() % kFaultKinds),
                                             sut.plant.now() + std::chrono::milliseconds(1 + random() % 200)));
    }
    unsigned ticks = 900;
    sut.run(ticks);
    for (; ticks < 8000 && !sut.plant.all_operate(); ++ticks) {
      sut.run(1);
    }
    ASSERT_TRUE(sut.plant.all_operate()) << "seed " << seed << "\n" << sut.plant.story();
  }
}

TEST(Faults, The_same_script_gives_the_same_story) {
  const auto story = [] {
    std::mt19937 random(7);
    FaultyPlant sut(3);
    for (unsigned i = 0; i < 6; ++i) {
      sut.plant.bus().add_fault(random_fault(random, 3, static_cast<FaultKind>(random() % kFaultKinds),
                                             sut.plant.now() + std::chrono::milliseconds(1 + random() % 200)));
    }
    sut.run(3000);
    return sut.plant.story();
  };
  const std::string first = story();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, story());
}

}  // namespace
}  // namespace indurop::io::ethercat
