// SPDX-License-Identifier: Apache-2.0
// Slaves in a tree. The oracle is a walk of its own through random trees, which counts the cables that a frame passes.
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "control/io/ethercat/master/master.h"
#include "control/io/ethercat/simulator/bus.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

constexpr Clock kCableTime(500);
constexpr Clock kPulseShift = std::chrono::microseconds(250);
constexpr std::array<std::size_t, 3> kLeaves{3, 1, 2};  // ports, as the standard has it

struct Place {
  Segment::Outlet outlet;                   // of the first one: none
  std::int64_t cables = 0;                  // that the frame has passed when it comes
  std::size_t end = 0;                      // the first slave that is not behind this one
  std::array<std::int64_t, kPorts> back{};  // the same when it comes in at each port; 0: nothing is linked
};

class CableTree {
 public:
  CableTree(unsigned seed, std::size_t size) : random_(seed), size_(size) { grow({}); }
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }

 private:
  void grow(Segment::Outlet outlet) {
    const std::size_t own = places_.size();
    places_.push_back({outlet, ++cables_});
    places_[own].back[0] = cables_;
    for (const std::size_t port : kLeaves) {
      if (places_.size() < size_ && random_() % 2 == 0) {
        grow({own, port});
        places_[own].back[port] = ++cables_;
      }
    }
    places_[own].end = places_.size();
  }

  std::mt19937 random_;
  std::size_t size_;
  std::int64_t cables_ = 0;
  std::vector<Place> places_;
};

std::vector<SlavePlan> plans_with_pulses(std::size_t count) {
  auto plans = drive_plans(count);
  for (SlavePlan& plan : plans) {
    plan.sync = {0x0300, kTick, kPulseShift, {}};
  }
  return plans;
}

// Drives whose clocks show and do what they like.
void add_drives(Segment& segment, unsigned seed, const std::vector<Place>& places) {
  std::mt19937_64 random(seed);
  for (const Place& place : places) {
    SlaveConfig config = drive_config();
    config.esc.clock_start = Time(static_cast<std::int64_t>(random() % 4'000'000'000'000U));
    config.esc.drift_ppb = static_cast<std::int64_t>(random() % 40'000) - 20'000;
    if (segment.size() == 0) {
      segment.add(config, reflect);
    } else {
      EXPECT_TRUE(segment.can_add(place.outlet));
      segment.add(config, reflect, place.outlet);
    }
  }
}

class TreePlant : public Plant {
 public:
  explicit TreePlant(unsigned seed) : TreePlant(seed, CableTree(seed, 2 + seed % 7).places()) {}

  void start() {
    run_until_all_operate(5000);
    ASSERT_TRUE(all_operate()) << story();
  }
  // How far the pulses of this slave are from where they shall be when the frame of the last tick comes.
  [[nodiscard]] std::int64_t phase_error(std::size_t place) {
    const std::int64_t cables = places_[place].cables;
    const auto since = slave(place).esc().since_pulse(now() + cables * kCableTime);
    if (!since) {
      ADD_FAILURE() << "slave " << place << " has no pulses";
      return 0;
    }
    const std::int64_t error = (*since - (kTick - kPulseShift + (cables - 1) * kCableTime) % kTick).count();
    const std::int64_t half = kTick.count() / 2;
    return (error + half + kTick.count()) % kTick.count() - half;
  }
  [[nodiscard]] std::size_t size() const { return places_.size(); }
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }

 private:
  TreePlant(unsigned seed, std::vector<Place> places)
      : Plant(plans_with_pulses(places.size()), [&](Segment& segment) { add_drives(segment, seed, places); }),
        places_(std::move(places)) {}

  std::vector<Place> places_;
};

TEST(Tree, A_frame_comes_to_each_port_when_it_has_passed_the_cables_before) {
  for (unsigned seed = 0; seed < 200 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    TreePlant sut(seed);
    FrameBuilder builder(kMasterMac);
    builder.add(Command::Bwr, 1, address_of(0, reg::kReceiveTimes), 4);
    const Bytes built = builder.finish();
    std::vector<std::uint8_t> frame(built.begin(), built.end());
    const Time sent = std::chrono::seconds(1);
    const auto back = sut.bus().segment().process(frame, sent);
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, sent + 2 * static_cast<std::int64_t>(sut.size()) * kCableTime);
    for (std::size_t i = 0; i < sut.size(); ++i) {
      const Place& place = sut.places()[i];
      auto& esc = sut.slave(i).esc();
      const auto status = esc.value<std::uint16_t>(reg::kDlStatus);
      for (std::size_t port = 0; port < kPorts; ++port) {
        EXPECT_EQ((unsigned{status} >> (4 + port) & 1U) != 0, place.back[port] != 0) << i << ", port " << port;
        if (place.back[port] != 0) {
          EXPECT_EQ(esc.value<std::uint32_t>(static_cast<std::uint16_t>(reg::kReceiveTimes + 4 * port)),
                    static_cast<std::uint32_t>(esc.local_time(sent + place.back[port] * kCableTime).count()))
              << i << ", port " << port;
        }
      }
    }
  }
}

TEST(Tree, Slaves_are_added_in_the_order_of_a_frame) {
  Segment sut;
  sut.add(drive_config());
  EXPECT_FALSE(sut.can_add({0, 0})) << "leads to the master";
  EXPECT_FALSE(sut.can_add({0, 4}));
  EXPECT_FALSE(sut.can_add({1, 1})) << "there is no such slave";
  sut.add(drive_config(), {}, {0, 1});
  EXPECT_FALSE(sut.can_add({0, 3})) << "a frame leaves there first";
  EXPECT_FALSE(sut.can_add({0, 1})) << "is taken";
  sut.add(drive_config(), {}, {0, 2});
  EXPECT_FALSE(sut.can_add({1, 1})) << "the frame has come back from there";
  EXPECT_TRUE(sut.can_add({2, 3}));
  sut.make_ring();
  EXPECT_FALSE(sut.can_add({2, 3}));
}

TEST(Tree, Clocks_have_one_time_wherever_they_are) {
  for (unsigned seed = 0; seed < 40 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    TreePlant sut(seed);
    sut.start();
    sut.run(3000);
    for (std::size_t i = 0; i < sut.size(); ++i) {
      EXPECT_LT(std::abs(sut.phase_error(i)), 1000) << "ns, slave " << i << " of " << sut.size() << "\n" << sut.story();
    }
  }
}

TEST(Tree, A_branch_that_is_cut_takes_only_its_own_slaves_along) {
  for (unsigned seed = 0; seed < 60 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    TreePlant sut(seed);
    sut.start();
    sut.run(500);
    sut.events().clear();
    const std::size_t place = sut.size() > 1 ? 1 + seed % (sut.size() - 1) : 0;
    const std::size_t end = sut.places()[place].end;
    sut.bus().segment().set_cable(place, false);
    sut.run(2);
    for (unsigned i = 0; i < 300; ++i) {
      sut.tick();
      for (std::size_t k = 0; k < sut.size(); ++k) {
        ASSERT_EQ(sut.master().is_fresh(k), place > 0 && (k < place || k >= end)) << "slave " << k << "\n"
                                                                                  << sut.story();
      }
    }
    for (const Event& event : sut.events()) {
      EXPECT_TRUE(event.slave >= place && event.slave < end) << sut.story();
    }
    for (std::size_t k = place; k < end; ++k) {
      EXPECT_FALSE(sut.master().slave(k).operates());
    }
    sut.bus().segment().set_cable(place, true);
    sut.run(2000);
    EXPECT_TRUE(sut.all_operate()) << sut.story();
    sut.run(1000);
    for (std::size_t i = 0; i < sut.size(); ++i) {
      EXPECT_LT(std::abs(sut.phase_error(i)), 1000) << "ns, slave " << i << "\n" << sut.story();
    }
  }
}

}  // namespace
}  // namespace indurop::io::ethercat
