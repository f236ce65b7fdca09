// SPDX-License-Identifier: Apache-2.0
// Slaves with and without LRW on one cable: what each frame has for whom, read from the frames themselves, and that all
// slaves are written and read in the same tick.
#include <gmock/gmock.h>

#include <random>

#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

struct Access {
  Command command = Command::Nop;
  std::uint32_t address = 0;
  std::size_t length = 0;
  std::uint16_t wkc = 0;
};

// Notes all logical datagrams that come back.
class WatchedLink final : public Link {
 public:
  explicit WatchedLink(SimulatedBus& bus) : bus_(bus) {}
  bool send(Bytes frame) noexcept override { return bus_.send(frame); }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override {
    const std::size_t size = bus_.receive(to);
    if (size > 0) {
      FrameReader reader(Bytes(to).first(size));
      Datagram datagram;
      const std::size_t before = accesses.size();
      while (reader.next(datagram)) {
        if (is_logical(datagram.command)) {
          accesses.push_back({datagram.command, datagram.address, datagram.length, datagram.wkc});
        }
      }
      frames += accesses.size() > before ? 1U : 0U;
    }
    return size;
  }
  // What came back for these addresses, as text.
  [[nodiscard]] std::vector<std::string> of(std::uint32_t first, std::size_t length) const {
    std::vector<std::string> found;
    for (const Access& access : accesses) {
      if (access.address < first + length && first < access.address + access.length) {
        found.push_back(std::string(to_string(access.command)) + " " + std::to_string(access.address - first) + "+" +
                        std::to_string(access.length) + " wkc " + std::to_string(access.wkc));
      }
    }
    return found;
  }

  std::vector<Access> accesses;
  unsigned frames = 0;  // that had some

 private:
  SimulatedBus& bus_;
};

// Of which slaves have outputs only, inputs only, or both.
enum class Kind : std::uint8_t { Both, Outputs, Inputs };

Sii sii_of(Kind kind) {
  Sii sii = drive_sii();
  if (kind == Kind::Inputs) {
    sii.outputs.clear();
  } else if (kind == Kind::Outputs) {
    sii.inputs.clear();
  }
  return sii;
}

class MixedPlant {
 public:
  MixedPlant(const std::vector<Kind>& kinds, std::uint64_t without) : applied(kinds.size()) {
    std::vector<SlavePlan> plans;
    for (const Kind kind : kinds) {
      plans.push_back(plan_of(sii_of(kind), static_cast<std::uint32_t>(0x10000 + 12 * plans.size())));
    }
    plans = without_lrw(std::move(plans), without);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      SlaveConfig config = config_of(plans[i]);
      config.esc.eeprom = sii_image(sii_of(kinds[i]));
      bus.segment().add(config, [this, i](Bytes outputs, std::span<std::uint8_t> inputs) {
        applied[i].assign(outputs.begin(), outputs.end());
        std::fill(inputs.begin(), inputs.end(), given);
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
  [[nodiscard]] bool starts() {
    for (int i = 0; i < 4000 && !all_operate(*master); ++i) {
      tick();
    }
    tick();
    tick();
    return all_operate(*master);
  }
  void set_outputs(std::uint8_t value) {
    for (std::size_t i = 0; i < master->size(); ++i) {
      const auto outputs = master->outputs(i);
      std::fill(outputs.begin(), outputs.end(), value);
      master->set_outputs_good(i, true);
    }
  }

  SimulatedBus bus;
  WatchedLink link{bus};
  std::optional<Master> master;
  Clock now{0};
  std::uint8_t given = 0;  // by all slaves
  std::vector<std::vector<std::uint8_t>> applied;
};

std::vector<std::string> expected(Kind kind, bool has_lrw) {
  if (has_lrw) {
    return {kind == Kind::Both ? "LRW 0+12 wkc 3" : kind == Kind::Outputs ? "LRW 0+6 wkc 2" : "LRW 0+6 wkc 1"};
  }
  switch (kind) {
    case Kind::Both:
      return {"LWR 0+6 wkc 1", "LRD 6+6 wkc 1"};
    case Kind::Outputs:
      return {"LWR 0+6 wkc 1"};
    case Kind::Inputs:
      break;
  }
  return {"LRD 0+6 wkc 1"};
}

TEST(Lrw, Random_plants_get_the_commands_that_their_slaves_run_in_each_tick) {
  std::mt19937 random(17);
  for (int round = 0; round < 40; ++round) {
    std::vector<Kind> kinds(1 + random() % 8);
    std::generate(kinds.begin(), kinds.end(), [&random] { return static_cast<Kind>(random() % 3); });
    const auto without = static_cast<unsigned>(random());
    SCOPED_TRACE(testing::Message() << "round " << round << ", without LRW " << without % (1U << kinds.size()));
    MixedPlant sut(kinds, without);
    ASSERT_TRUE(sut.starts());
    for (std::uint8_t value = 1; value < 20; ++value) {
      sut.set_outputs(value);
      sut.link.accesses.clear();
      sut.tick();
      sut.given = value;
      for (std::size_t i = 0; i < kinds.size(); ++i) {
        const SlavePlan& plan = sut.master->plan(i);
        const std::size_t bytes = plan.output_bytes + plan.input_bytes;
        ASSERT_EQ(sut.link.of(plan.logical, bytes), expected(kinds[i], plan.uses_lrw)) << "slave " << i;
        ASSERT_TRUE(sut.master->is_fresh(i));
        ASSERT_EQ(sut.applied[i], std::vector<std::uint8_t>(plan.output_bytes, value)) << "slave " << i;
        // What it gave when the frame passed that came back in this tick.
        const Bytes inputs = sut.master->inputs(i);
        ASSERT_TRUE(value < 4 || std::all_of(inputs.begin(), inputs.end(),
                                             [value](std::uint8_t byte) { return byte == value - 3; }));
      }
    }
  }
}

// A datagram more for each slave.
TEST(Lrw, Data_that_fits_into_one_frame_with_it_takes_two_without) {
  constexpr std::size_t kSlaves = 45;
  for (const bool has_lrw : {true, false}) {
    MixedPlant sut(std::vector<Kind>(kSlaves, Kind::Both), has_lrw ? 0 : ~std::uint64_t{0});
    ASSERT_TRUE(sut.starts());
    sut.link.accesses.clear();
    sut.link.frames = 0;
    sut.tick();
    EXPECT_EQ(sut.link.accesses.size(), has_lrw ? kSlaves : 2 * kSlaves);
    EXPECT_EQ(sut.link.frames, has_lrw ? 1U : 2U);
    EXPECT_TRUE(sut.master->is_fresh(0));
    EXPECT_TRUE(sut.master->is_fresh(kSlaves - 1));
  }
}

TEST(Lrw, A_slave_without_it_in_the_place_of_one_with_it_is_named) {
  Plant plant(3);
  plant.run_until_all_operate(2000);
  plant.slave(1).esc().set<std::uint16_t>(reg::kFeatures, 0x000C | kNoLrw);
  plant.slave(1).fall_to(AlState::SafeOp, 0x8001);
  plant.run(50);
  EXPECT_EQ(plant.master().slave(1).problem(), Problem::NoLrw) << plant.story();
  EXPECT_THAT(plant.story(), testing::HasSubstr("slave 1 (drive): does not support LRW"));
  EXPECT_TRUE(plant.master().is_fresh(0));
  EXPECT_TRUE(plant.master().is_fresh(2));
  plant.slave(1).esc().set<std::uint16_t>(reg::kFeatures, 0x000C);
  EXPECT_LT(plant.run_until_all_operate(2000), 2000U) << plant.story();
}

TEST(Lrw, An_eeprom_that_says_so_is_believed) {
  Sii sii = drive_sii();
  EXPECT_TRUE(plan_of(sii, 0).uses_lrw);
  sii.no_lrw = true;
  const auto read = read_sii(sii_image(sii));
  ASSERT_TRUE(read);
  EXPECT_FALSE(plan_of(*read, 0).uses_lrw);
}

}  // namespace
}  // namespace indurop::io::ethercat
