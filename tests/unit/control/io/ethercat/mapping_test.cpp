// SPDX-License-Identifier: Apache-2.0
// What a slave exchanges: the PDOs that are chosen for the objects an application wants, judged by a decoder of the
// master's own writes and by slaves that take only what a real one would.
#include "control/io/ethercat/master/mapping.h"

#include <gmock/gmock.h>

#include <map>
#include <memory>
#include <random>

#include "control/io/ethercat/simulator/mapped_objects.h"
#include "fillable.h"
#include "real_data.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

constexpr std::uint8_t kInt16Type = 3;
constexpr std::uint8_t kInt32Type = 4;

// A drive with two fixed PDOs of each direction that have objects in common, and one that may be filled.
Sii mappable_drive() {
  Sii sii = drive_sii();
  sii.coe_details |= kCoePdoAssign | kCoePdoConfiguration;
  sii.outputs[0].flags = kPdoFixed;
  sii.outputs.push_back({0x1601, kNotAssigned, kPdoFixed, "Torque", {{0x6040, 0, 16, 6, ""}, {0x6071, 0, 16, 3, ""}}});
  sii.outputs.push_back({0x1602, kNotAssigned, kPdoFixed, "Probe", {{0x60B8, 0, 16, 6, ""}}});
  sii.inputs[0].flags = kPdoFixed;
  sii.inputs.push_back({0x1A01, kNotAssigned, 0, "Free", {}});
  return sii;
}

std::vector<std::uint16_t> assigned(const std::vector<Pdo>& pdos) {
  std::vector<std::uint16_t> indices;
  for (const Pdo& pdo : pdos) {
    if (pdo.sync_manager != kNotAssigned) {
      indices.push_back(pdo.index);
    }
  }
  return indices;
}

std::vector<WantedObject> objects(std::initializer_list<std::uint16_t> indices) {
  std::vector<WantedObject> wanted;
  for (const std::uint16_t index : indices) {
    wanted.push_back({index, 0, 0, 0});
  }
  return wanted;
}

TEST(Mapping, What_is_there_stays) {
  const auto sut = map_objects(mappable_drive(), objects({0x607A}), objects({0x6041, 0x6064}));
  ASSERT_TRUE(sut);
  EXPECT_THAT(assigned(sut->outputs), testing::ElementsAre(0x1600));
  EXPECT_THAT(assigned(sut->inputs), testing::ElementsAre(0x1A00));
}

TEST(Mapping, The_pdos_that_have_the_objects_are_assigned_and_no_object_twice) {
  const auto sut = map_objects(mappable_drive(), objects({0x6040, 0x6071, 0x60B8}), {});
  ASSERT_TRUE(sut);
  EXPECT_THAT(assigned(sut->outputs), testing::ElementsAre(0x1601, 0x1602)) << "1600h has the controlword, too";
  EXPECT_EQ(sut->outputs[1].sync_manager, 2);
}

TEST(Mapping, A_mandatory_pdo_stays) {
  Sii sii = mappable_drive();
  sii.outputs[0].flags |= kPdoMandatory;
  const auto sut = map_objects(sii, objects({0x60B8}), {});
  ASSERT_TRUE(sut);
  EXPECT_THAT(assigned(sut->outputs), testing::ElementsAre(0x1600, 0x1602));
  const auto both = map_objects(sii, objects({0x6071}), {});
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().reason, "no set of PDOs that may be assigned together has it and the others");
}

TEST(Mapping, A_pdo_is_filled_with_what_none_has) {
  const std::vector<WantedObject> inputs = {
      {0x6041, 0, 16, 6}, {0x6077, 0, 16, kInt16Type}, {0x6064, 0, 0, 0}, {0x6077, 0, 16, kInt16Type}};
  const auto sut = map_objects(mappable_drive(), {}, inputs);
  ASSERT_TRUE(sut);
  EXPECT_THAT(assigned(sut->inputs), testing::ElementsAre(0x1A01));
  ASSERT_EQ(sut->inputs[1].entries.size(), 3U) << "two points may have the same input";
  EXPECT_EQ(sut->inputs[1].entries[1].index, 0x6077);
  EXPECT_EQ(sut->inputs[1].entries[2].bits, 32) << "as another PDO has it";
}

TEST(Mapping, Objects_that_do_not_fit_go_to_the_next_pdo) {
  Sii sii = mappable_drive();
  sii.inputs.push_back({0x1A02, kNotAssigned, 0, "Free", {}});
  std::vector<WantedObject> inputs;
  for (std::uint16_t i = 0; i < 11; ++i) {
    inputs.push_back({static_cast<std::uint16_t>(0x2000 + i), 0, 32, kInt32Type});
  }
  const auto sut = map_objects(sii, {}, inputs);
  ASSERT_TRUE(sut);
  EXPECT_THAT(assigned(sut->inputs), testing::ElementsAre(0x1A01, 0x1A02));
  EXPECT_EQ(sut->inputs[1].entries.size(), 8U);
  EXPECT_EQ(sut->inputs[2].entries.size(), 3U);
}

TEST(Mapping, What_cannot_be_had_is_said_with_its_reason) {
  const auto reason = [](const Sii& sii, const WantedObject& output) {
    const auto sut = map_objects(sii, {&output, 1}, {});
    return sut ? "" : sut.error().reason;
  };
  Sii sii = mappable_drive();
  EXPECT_EQ(reason(sii, {0x2001, 0, 16, kInt16Type}), "no PDO of the slave has it, and what they contain is fixed");
  sii.outputs.push_back({0x1603, kNotAssigned, 0, "", {}});
  EXPECT_EQ(reason(sii, {0x2001, 0, 16, kInt16Type}), "");
  EXPECT_EQ(reason(sii, {0x2001, 0, 0, 0}),
            "no PDO of the slave has it, and its type is not known; give it: type=\"int16\"");
  sii.coe_details = kCoeSdo;
  EXPECT_EQ(reason(sii, {0x6071, 0, 16, kInt16Type}),
            "a PDO that is not assigned has it, and the slave does not let its master assign PDOs");
  EXPECT_EQ(reason(sii, {0x2001, 0, 16, kInt16Type}), "no PDO of the slave has it, and what they contain is fixed");
}

TEST(Mapping, Many_alternatives_do_not_take_forever) {
  Sii sii = mappable_drive();
  sii.outputs.clear();
  std::vector<WantedObject> wanted;
  for (std::uint16_t i = 0; i < 60; ++i) {
    wanted.push_back({static_cast<std::uint16_t>(0x3000 + i), 0, 0, 0});
    for (std::uint16_t k = 0; k < 3; ++k) {
      sii.outputs.push_back({static_cast<std::uint16_t>(0x1600 + 3 * i + k),
                             kNotAssigned,
                             kPdoFixed,
                             "",
                             {{wanted.back().index, 0, 16, 6, ""}, {0x2FFF, 0, 16, 6, ""}}});
    }
  }
  EXPECT_FALSE(map_objects(sii, wanted, {}));
}

// --- what the plan writes, decoded without the code that chose it ---

struct Decoded {
  std::map<std::uint32_t, std::pair<std::size_t, std::size_t>> places;  // by index and subindex: bit, bits
  std::size_t bytes = 0;
};

// What a slave exchanges in a SyncManager after these writes.
Decoded decode(const std::vector<StartObject>& writes, std::uint16_t assignment) {
  std::map<std::pair<std::uint16_t, std::uint8_t>, std::uint32_t> values;
  for (const StartObject& write : writes) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < write.value.size(); ++i) {
      number |= static_cast<std::uint32_t>(write.value[i]) << (8 * i);
    }
    values[{write.index, write.subindex}] = number;
  }
  Decoded decoded;
  std::size_t bit = 0;
  for (std::uint8_t i = 1; i <= values[{assignment, 0}]; ++i) {
    const auto pdo = static_cast<std::uint16_t>(values[{assignment, i}]);
    for (std::uint8_t k = 1; k <= values[{pdo, 0}]; ++k) {
      const std::uint32_t entry = values[{pdo, k}];
      decoded.places[entry >> 8] = {bit, entry & 0xFF};
      bit += entry & 0xFF;
    }
  }
  decoded.bytes = (bit + 7) / 8;
  return decoded;
}

std::vector<WantedObject> random_objects(std::mt19937& random, std::uint16_t from) {
  std::vector<WantedObject> wanted;
  const std::size_t count = 1 + random() % 14;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bytes = static_cast<std::uint8_t>(1U << random() % 3);
    wanted.push_back({static_cast<std::uint16_t>(from + i), 0, static_cast<std::uint8_t>(8 * bytes), 6});
  }
  return wanted;
}

// A master of one slave whose process data are the values of its objects.
class MappedBus {
 public:
  MappedBus(const SlaveConfig& config, const SlavePlan& plan)
      : slave_(bus_.segment().add(config,
                                  [this](Bytes from, std::span<std::uint8_t> to) {
                                    if (!from.empty()) {
                                      applied_in_ = slave_.state();
                                      process_.take(from);
                                    }
                                    process_.give(to);
                                  })),
        process_(slave_.objects(), slave_.sii()),
        master_(bus_, {plan}, kTick) {}

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      now_ += kTick;
      bus_.advance(now_);
      master_.cycle(now_);
      bus_.segment().compute();
    }
  }
  Slave& slave() { return slave_; }
  Master& master() { return master_; }
  // The state in which outputs were applied last.
  [[nodiscard]] AlState applied_in() const { return applied_in_; }

 private:
  SimulatedBus bus_;
  Slave& slave_;
  MappedObjects process_;
  Master master_;
  Clock now_{0};
  AlState applied_in_ = AlState::None;
};

void fill(std::span<std::uint8_t> bytes, std::mt19937& random) {
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random());
  }
}

void expect_same(const Decoded& decoded, const WantedObject& object, Bytes image, Bytes value) {
  const auto [bit, bits] = decoded.places.at(std::uint32_t{object.index} << 8);
  ASSERT_EQ(bits, object.bits);
  ASSERT_EQ(bit % 8, 0U);
  EXPECT_TRUE(std::equal(value.begin(), value.end(), image.begin() + static_cast<std::ptrdiff_t>(bit / 8)));
}

TEST(Mapping, A_slave_takes_it_and_each_value_arrives_in_its_object) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    const auto outputs = random_objects(random, 0x3000);
    const auto inputs = random_objects(random, 0x4000);
    const Fillable device(outputs, inputs);
    const auto mapped = map_objects(device.sii, outputs, inputs);
    ASSERT_TRUE(mapped) << mapped.error().reason;
    const SlavePlan plan = plan_of(*mapped, 0x10000);
    const Decoded out = decode(plan.start_objects, 0x1C12);
    const Decoded in = decode(plan.start_objects, 0x1C13);
    ASSERT_EQ(out.bytes, plan.output_bytes);
    ASSERT_EQ(in.bytes, plan.input_bytes);
    ASSERT_EQ(out.places.size(), outputs.size());
    MappedBus sut(device.config, plan);
    sut.run(3000);
    ASSERT_TRUE(sut.master().slave(0).operates()) << static_cast<int>(sut.master().slave(0).problem());
    EXPECT_EQ(sut.applied_in(), AlState::Op) << "outputs are applied in no other state";
    fill(sut.master().outputs(0), random);
    for (const WantedObject& object : inputs) {
      fill(sut.slave().objects().storage(object.index, 0), random);
    }
    sut.master().set_outputs_good(0, true);
    sut.run(4);
    for (const WantedObject& object : outputs) {
      expect_same(out, object, sut.master().outputs(0), sut.slave().objects().storage(object.index, 0));
    }
    for (const WantedObject& object : inputs) {
      expect_same(in, object, sut.master().inputs(0), sut.slave().objects().storage(object.index, 0));
    }
  }
}

TEST(Mapping, It_is_written_again_after_the_power_was_off_and_after_another_master) {
  const std::vector<WantedObject> outputs = {{0x3000, 0, 16, 6}};
  Fillable device(outputs, {});
  const auto mapped = map_objects(device.sii, outputs, {});
  ASSERT_TRUE(mapped);
  SimulatedBus bus;
  Slave& slave = bus.segment().add(device.config);
  Clock now{0};
  const auto comes_to_op = [&](Master& master) {
    for (int i = 0; i < 3000 && !master.slave(0).operates(); ++i) {
      now += kTick;
      bus.advance(now);
      master.cycle(now);
      bus.segment().compute();
    }
    return master.slave(0).operates();
  };
  Master first(bus, {plan_of(*mapped, 0x10000)}, kTick);
  EXPECT_TRUE(comes_to_op(first));
  EXPECT_EQ(slave.objects().number(0x1600, 1), 0x30000010U);
  bus.segment().set_power(0, false);
  bus.segment().set_power(0, true);
  EXPECT_EQ(slave.objects().number(0x1600, 1), 0x60400010U);
  for (int i = 0; i < 100; ++i) {  // it is noticed
    now += kTick;
    bus.advance(now);
    first.cycle(now);
  }
  EXPECT_TRUE(comes_to_op(first));
  EXPECT_EQ(slave.objects().number(0x1600, 1), 0x30000010U);
  Master second(bus, {plan_of(device.sii, 0x10000)}, kTick);
  EXPECT_TRUE(comes_to_op(second)) << "with the mapping that it has at first";
  EXPECT_EQ(slave.objects().number(0x1600, 1), 0x60400010U);
}

// --- EEPROMs of real slaves ---

TEST(Mapping, A_real_servo_drive_gets_the_pdos_that_its_manual_lists) {
  INDUROP_NEEDS_REAL_DATA();
  const auto akd = read_sii(bytes_of_file(real_data() / "dumps/eeprom/akd.hex"));
  ASSERT_TRUE(akd);
  const auto outputs = [&](std::initializer_list<std::uint16_t> indices) {
    const auto mapped = map_objects(*akd, objects(indices), {});
    return mapped ? assigned(mapped->outputs) : std::vector<std::uint16_t>();
  };
  const auto inputs = [&](std::initializer_list<std::uint16_t> indices) {
    const auto mapped = map_objects(*akd, {}, objects(indices));
    return mapped ? assigned(mapped->inputs) : std::vector<std::uint16_t>();
  };
  EXPECT_THAT(outputs({0x6040}), testing::ElementsAre(0x1701)) << "it comes with it";
  EXPECT_THAT(outputs({0x6040, 0x60FF}), testing::ElementsAre(0x1702));
  EXPECT_THAT(outputs({0x6040, 0x607A, 0x60B2}), testing::ElementsAre(0x1724));
  EXPECT_THAT(inputs({0x6041, 0x6063}), testing::ElementsAre(0x1B01)) << "it comes with it";
  EXPECT_THAT(inputs({0x6041, 0x6064}), testing::ElementsAre(0x1B24));
  EXPECT_THAT(inputs({0x6041, 0x6064, 0x6077}), testing::ElementsAre(0x1B26));
  const auto filled = map_objects(*akd, objects({0x607A, 0x60FF}), {});
  ASSERT_TRUE(filled);
  EXPECT_THAT(assigned(filled->outputs), testing::ElementsAre(0x1600)) << "no fixed one has both";
  const auto plan = plan_of(*filled, 0);
  EXPECT_EQ(plan.output_bytes, 8U);
  EXPECT_EQ(decode(plan.start_objects, 0x1C12).places.size(), 2U);
}

TEST(Mapping, A_real_terminal_is_as_it_is) {
  INDUROP_NEEDS_REAL_DATA();
  const auto terminal = read_sii(bytes_of_file(real_data() / "dumps/el2004-eeprom-dump.bin"));
  ASSERT_TRUE(terminal);
  const WantedObject channel{0x7030, 1, 0, 0};
  const auto mapped = map_objects(*terminal, {&channel, 1}, {});
  ASSERT_TRUE(mapped);
  EXPECT_THAT(plan_of(*mapped, 0).start_objects, testing::IsEmpty()) << "it has no mailbox";
  const WantedObject fifth{0x7040, 1, 0, 0};
  EXPECT_FALSE(map_objects(*terminal, {&fifth, 1}, {}));
}

}  // namespace
}  // namespace indurop::io::ethercat
