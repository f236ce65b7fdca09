// SPDX-License-Identifier: Apache-2.0
// The objects of a slave as a reader finds them by SDO information, against those that the simulated slave has. What is
// on the wire is judged by tshark (integration/ethercat).
#include <gmock/gmock.h>

#include <random>

#include "control/io/ethercat/master/dictionary_reader.h"
#include "control/io/ethercat/sdo_information.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

using testing::HasSubstr;

class DictionaryTest : public testing::Test {
 protected:
  Requester::Wait wait() {
    return [this] {
      now += std::chrono::microseconds(20);
      bus.advance(now);
      return now;
    };
  }
  Result<std::vector<DescribedObject>, std::string> read() {
    const auto slaves = Scan(bus, wait()).run();
    return DictionaryReader(bus, wait(), 0, slaves->front()).run();
  }
  static SlaveConfig config(std::uint8_t details) {
    SlaveConfig made = drive_config();
    Sii sii = *read_sii(made.esc.eeprom);
    sii.coe_details = details;
    made.esc.eeprom = sii_image(sii);
    return made;
  }

  SimulatedBus bus;
  Clock now{0};
};

TEST_F(DictionaryTest, Is_what_the_slave_has) {
  SlaveConfig slave = config(kCoeSdo | kCoeSdoInfo);
  std::mt19937 random(7);
  // So many that the list takes several fragments.
  for (unsigned i = 0; i < 300; ++i) {
    const auto index = static_cast<std::uint16_t>(0x2000 + random() % 0x2000);
    const auto last = static_cast<unsigned>(random() % 3);
    for (unsigned subindex = 0; subindex <= last; ++subindex) {
      slave.objects.add(index, static_cast<std::uint8_t>(subindex), std::vector<std::uint8_t>(1U << random() % 4U),
                        random() % 2 == 0);
      slave.objects.describe(index, static_cast<std::uint8_t>(subindex), static_cast<std::uint8_t>(1 + random() % 8),
                             "Object " + std::to_string(random() % 1000));
    }
  }
  bus.segment().add(slave);
  const ObjectDictionary& wanted = bus.segment().slave(0).objects();
  const auto sut = read();
  ASSERT_TRUE(sut) << sut.error();
  std::vector<std::uint16_t> indices;
  for (const DescribedObject& found : *sut) {
    const std::uint16_t index = found.object.index;
    indices.push_back(index);
    const auto entries = wanted.entries(index);
    ASSERT_EQ(found.entries.size(), entries.size()) << index;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      EXPECT_EQ(found.entries[i].subindex, entries[i].subindex);
      EXPECT_EQ(found.entries[i].bits, 8 * entries[i].bytes);
      EXPECT_EQ((found.entries[i].access & kEntryWritable) != 0, entries[i].writable);
      EXPECT_TRUE(entries[i].type == 0 || found.entries[i].type == entries[i].type);
      EXPECT_EQ(found.entries[i].name, entries[i].name);
    }
  }
  EXPECT_EQ(indices, wanted.indices());
  EXPECT_EQ(bus.segment().slave(0).state(), AlState::Init) << "as it was";
}

TEST_F(DictionaryTest, Says_what_can_be_a_point) {
  SlaveConfig slave = config(kCoeSdo | kCoeSdoInfo);
  slave.objects.add_number<std::int32_t>(0x607A, 0, 0);
  slave.objects.add_number<std::int32_t>(0x6064, 0, 0, false);
  bus.segment().add(slave);
  const auto sut = read();
  ASSERT_TRUE(sut) << sut.error();
  std::map<std::uint16_t, std::uint16_t> access;
  for (const DescribedObject& found : *sut) {
    access[found.object.index] = found.entries.empty() ? std::uint16_t{0} : found.entries.front().access;
  }
  EXPECT_EQ(access[0x607A] & (kEntryForOutputs | kEntryForInputs), kEntryForOutputs);
  EXPECT_EQ(access[0x6064] & (kEntryForOutputs | kEntryForInputs), kEntryForInputs);
  EXPECT_EQ(access[0x1018] & (kEntryForOutputs | kEntryForInputs), 0);
}

TEST_F(DictionaryTest, A_slave_without_it_and_one_that_a_master_runs_are_refused) {
  bus.segment().add(config(kCoeSdo));
  const auto without = read();
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error(), "it does not describe its objects (no SDO information)");

  Plant plant(1);
  plant.run_until_all_operate(2000);
  Clock later = plant.now();
  const auto wait = [&] {
    later += std::chrono::microseconds(20);
    plant.bus().advance(later);
    return later;
  };
  auto slaves = Scan(plant.bus(), wait).run();
  ASSERT_TRUE(slaves);
  slaves->front().sii.coe_details |= kCoeSdoInfo;
  const auto running = DictionaryReader(plant.bus(), wait, 0, slaves->front()).run();
  ASSERT_FALSE(running);
  EXPECT_EQ(running.error(), "it is in OP: a master runs it");
  EXPECT_EQ(plant.slave(0).state(), AlState::Op);
}

TEST(SdoInformation, Random_bytes_are_read_or_refused) {
  std::mt19937 random(3);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 24);
    std::generate(bytes.begin(), bytes.end(), [&random] { return static_cast<std::uint8_t>(random()); });
    if (bytes.size() > 1) {
      bytes[1] = 0x80;
    }
    if (const auto information = read_information(bytes)) {
      static_cast<void>(read_object(information->data));
      static_cast<void>(read_entry(information->data));
    }
  }
}

}  // namespace
}  // namespace indurop::io::ethercat
