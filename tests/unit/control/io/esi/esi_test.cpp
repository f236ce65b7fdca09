// SPDX-License-Identifier: Apache-2.0
// ESI files: what they say of a device, what is wrong with them, and slaves that are simulated from them.
#include "control/io/esi/esi_file.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "control/io/ethercat/master/mapping.h"
#include "control/io/ethercat/master/master.h"
#include "control/io/ethercat/simulator/bus.h"
#include "control/io/ethercat/simulator/sii_image.h"
#include "control/io/slaves/slave_word.h"

namespace indurop::io::esi {
namespace {

using namespace ethercat;

const std::string kServo = std::string(ESI_SAMPLES) + "/servo.xml";

Device servo() {
  EsiFile file = read_esi(kServo);
  EXPECT_EQ(base::to_text(file.diagnostics), "");
  EXPECT_EQ(file.devices.size(), 1U);
  return file.devices.empty() ? Device() : file.devices.front();
}

TEST(Esi, Says_who_a_device_is_and_what_it_exchanges) {
  const Device sut = servo();
  EXPECT_EQ(sut.type, "SAMPLE-SERVO");
  EXPECT_EQ(sut.vendor, "InduRoP samples");
  EXPECT_EQ(sut.sii.name, "Sample servo drive") << "the English name";
  EXPECT_EQ(sut.sii.identity, (Identity{0, 0x49520101, 0x10000, 0}));
  EXPECT_EQ(sut.sii.mailbox.receive_at, 0x1000);
  EXPECT_EQ(sut.sii.mailbox.send_size, 128);
  EXPECT_EQ(sut.sii.protocols, kProtocolCoe | kProtocolFoe);
  EXPECT_EQ(sut.sii.coe_details, kCoeSdo | kCoeSdoInfo | kCoePdoAssign | kCoePdoConfiguration);
  EXPECT_THAT(sut.sii.fmmus, testing::ElementsAre(FmmuUse::Outputs, FmmuUse::Inputs, FmmuUse::MailboxState));
  ASSERT_EQ(sut.sii.sync_managers.size(), 4U);
  EXPECT_EQ(sut.sii.sync_managers[2].start, 0x1100);
  EXPECT_EQ(sut.sii.sync_managers[2].control, 0x64);
  EXPECT_EQ(sut.sii.sync_managers[2].use, SyncManagerUse::Outputs);
  ASSERT_EQ(sut.sii.outputs.size(), 3U);
  EXPECT_EQ(sut.sii.outputs[0].flags, kPdoFixed | kPdoMandatory);
  EXPECT_EQ(sut.sii.outputs[1].sync_manager, 2);
  EXPECT_THAT(sut.sii.outputs[1].excludes, testing::ElementsAre(0x1702));
  EXPECT_EQ(sut.sii.outputs[2].sync_manager, kNotAssigned);
  ASSERT_EQ(sut.sii.outputs[2].entries.size(), 2U);
  EXPECT_EQ(sut.sii.outputs[2].entries[0].index, 0x6071);
  EXPECT_EQ(sut.sii.outputs[2].entries[0].type, 3);
  EXPECT_EQ(sut.sii.outputs[2].entries[1].index, 0) << "a gap";
  EXPECT_EQ(sut.sii.inputs[0].flags, 0);
}

TEST(Esi, Says_how_clocks_are_used_and_what_is_set) {
  const Device sut = servo();
  ASSERT_EQ(sut.modes.size(), 3U);
  EXPECT_EQ(sut.modes[0].assign_activate, 0x300);
  EXPECT_EQ(sut.modes[0].factor0, 1);
  EXPECT_EQ(sut.modes[0].shift0, 125'000);
  EXPECT_EQ(sut.modes[1].factor0, -2);
  EXPECT_EQ(sut.modes[1].factor1, 2);
  EXPECT_EQ(sut.modes[2].assign_activate, 0);
  ASSERT_EQ(sut.commands.size(), 3U);
  EXPECT_EQ(sut.commands[0].index, 0x6060);
  EXPECT_THAT(sut.commands[0].data, testing::ElementsAre(8));
  EXPECT_EQ(sut.commands[0].comment, "cyclic position");
  EXPECT_THAT(sut.commands[1].transitions, testing::ElementsAre("SO"));
  EXPECT_THAT(sut.commands[1].data, testing::ElementsAre(0xE8, 3, 0, 0));
}

TEST(Esi, An_eeprom_that_is_made_of_it_says_the_same) {
  const Device sut = servo();
  const auto read = read_sii(sii_image(sut.sii));
  ASSERT_TRUE(read) << read.error();
  EXPECT_TRUE(read->checksum_fits);
  EXPECT_EQ(read->identity, sut.sii.identity);
  EXPECT_EQ(read->name, sut.sii.name);
  EXPECT_EQ(read->coe_details, sut.sii.coe_details);
  ASSERT_EQ(read->outputs.size(), sut.sii.outputs.size());
  for (std::size_t i = 0; i < read->outputs.size(); ++i) {
    EXPECT_EQ(read->outputs[i].index, sut.sii.outputs[i].index);
    EXPECT_EQ(read->outputs[i].sync_manager, sut.sii.outputs[i].sync_manager);
    EXPECT_EQ(read->outputs[i].flags, sut.sii.outputs[i].flags);
    EXPECT_EQ(bits_of(read->outputs[i]), bits_of(sut.sii.outputs[i]));
  }
}

TEST(Esi, Pdos_that_exclude_each_other_are_not_assigned_together) {
  const Device sut = servo();
  const std::vector<WantedObject> torque = {{0x6071, 0, 0, 0}};
  const auto mapped = map_objects(sut.sii, torque, {});
  ASSERT_TRUE(mapped);
  EXPECT_EQ(mapped->outputs[0].sync_manager, 2) << "it is mandatory";
  EXPECT_EQ(mapped->outputs[1].sync_manager, kNotAssigned);
  EXPECT_EQ(mapped->outputs[2].sync_manager, 2);
  const std::vector<WantedObject> both = {{0x607A, 0, 0, 0}, {0x6071, 0, 0, 0}};
  EXPECT_FALSE(map_objects(sut.sii, both, {}));
}

TEST(Esi, Files_in_latin_letters_are_read) {
  const EsiFile sut = read_esi_text(
      "<?xml version=\"1.0\" encoding=\"ISO8859-1\"?>\n"
      "<EtherCATInfo><Vendor><Id>2</Id><Name>M\xFCller</Name></Vendor><Descriptions><Groups/><Devices>\n"
      "<Device Physics=\"YY\"><Type ProductCode=\"1\" RevisionNo=\"1\">A</Type><Name>K\xE4stchen</Name></Device>\n"
      "</Devices></Descriptions></EtherCATInfo>\n",
      "a.xml");
  EXPECT_EQ(base::to_text(sut.diagnostics), "");
  ASSERT_EQ(sut.devices.size(), 1U);
  EXPECT_EQ(sut.devices[0].vendor, "M\xC3\xBCller");
  EXPECT_EQ(sut.devices[0].sii.name, "K\xC3\xA4stchen");
}

TEST(Esi, What_is_wrong_is_named_with_its_place) {
  const auto said = [](const std::string& xml) { return base::to_text(read_esi_text(xml, "a.xml").diagnostics); };
  EXPECT_EQ(said("<root/>"),
            "a.xml:1:1: error: the root element is <root>, not the one of an ESI file: that is <EtherCATInfo> with "
            "<Vendor> and <Descriptions>\n");
  EXPECT_EQ(said("<EtherCATInfo/>"),
            "a.xml:1:1: error: <EtherCATInfo> has no <Vendor>; is this the whole file of the maker?\n"
            "a.xml:1:1: error: <EtherCATInfo> has no <Descriptions>; is this the whole file of the maker?\n");
  const std::string all = said(
      "<EtherCATInfo><Vendor><Id>0x2</Id></Vendor><Descriptions><Devices><Device>\n"
      "<Type ProductCode=\"#xZ\" RevisionNo=\"#x100000000\">A</Type>\n"
      "<Sm>Outputs</Sm>\n"
      "<RxPdo Sm=\"1\" Fixed=\"yes\"><Index>#x10000</Index><Entry><Index>0</Index></Entry></RxPdo>\n"
      "<Mailbox><CoE><InitCmd><Index>1</Index><Data>0G</Data></InitCmd></CoE></Mailbox>\n"
      "</Device></Devices></Descriptions></EtherCATInfo>\n");
  for (const char* const part : {"a.xml:1:27: error: Id: '0x2' is no number from 0 to 4294967295; write 18 or #x12",
                                 "a.xml:2:20: error: ProductCode: '#xZ' is no number",
                                 "a.xml:2:37: error: RevisionNo: '#x100000000' is no number",
                                 "a.xml:4:1: error: PDO 0000h: there is no <Sm> 1 of outputs",
                                 "a.xml:4:22: error: Fixed: 'yes' is none of 0, 1, false and true",
                                 "a.xml:4:34: error: Index: '#x10000' is no number from 0 to 65535",
                                 "a.xml:4:49: error: <Entry> has no <BitLen>",
                                 "a.xml:5:1: error: a device with <Mailbox> needs <Sm> of MBoxOut and of MBoxIn",
                                 "a.xml:5:46: error: Data: '0G' is no row of bytes"}) {
    EXPECT_THAT(all, testing::HasSubstr(part));
  }
  EXPECT_THAT(said("<EtherCATInfo><Vendor>"), testing::StartsWith("a.xml:1:"));
  EXPECT_THAT(base::to_text(read_esi("/nowhere.xml").diagnostics), testing::HasSubstr("No such file"));
}

TEST(Esi, Whatever_the_bytes_are_they_are_read_or_refused) {
  std::ifstream file(kServo);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(whole.empty());
  std::mt19937 random(1);
  std::size_t refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string xml = whole;
    for (std::size_t k = 0; k < 1 + random() % 4; ++k) {
      xml[random() % xml.size()] = static_cast<char>(random());
    }
    xml.resize(random() % 4 == 0 ? random() % xml.size() : xml.size());
    const EsiFile sut = read_esi_text(xml, "a.xml");
    refused += sut.ok() ? 0U : 1U;
    for (const Device& device : sut.devices) {
      static_cast<void>(read_sii(sii_image(device.sii)));
    }
  }
  EXPECT_GT(refused, 500U);
  EXPECT_LT(refused, 2000U);
}

TEST(Esi, The_newest_revision_of_a_type_is_found) {
  EsiFile file = read_esi(ESI_TERMINALS);
  EXPECT_EQ(find_device(file, ""), nullptr) << "it has two";
  ASSERT_EQ(file.devices.size(), 2U);
  file.devices.push_back(file.devices.front());
  file.devices.back().sii.identity.revision = 7;
  EXPECT_EQ(find_device(file, "SAMPLE-DI16"), &file.devices.back());
  EXPECT_EQ(find_device(file, "DI16"), nullptr);
}

TEST(Esi, The_schema_of_the_group_accepts_our_samples) {
  const char* const folder = std::getenv("INDUROP_ETHERCAT_DATA");
  const std::string schema = folder == nullptr ? "" : std::string(folder) + "/schemas/EtherCATInfo.xsd";
  if (folder == nullptr || !std::filesystem::exists(schema)) {
    GTEST_SKIP() << "INDUROP_ETHERCAT_DATA names no folder with schemas/EtherCATInfo.xsd";
  }
  for (const std::string& file : {kServo, std::string(ESI_TERMINALS)}) {
    EXPECT_EQ(std::system(("xmllint --noout --schema " + schema + " " + file).c_str()), 0);  // NOLINT(cert-env33-c)
  }
}

// --- slaves from it ---

class EsiSlave : public testing::Test {
 protected:
  Slave& add(const std::string& word) {
    auto model = slaves::read_slave_word(word);
    EXPECT_TRUE(model) << model.error();
    EXPECT_EQ(slaves::add_slave(bus_.segment(), std::move(*model), [this] { return now_; }), "");
    return bus_.segment().slave(bus_.segment().size() - 1);
  }
  void run(Master& master, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      now_ += std::chrono::milliseconds(1);
      bus_.advance(now_);
      master.cycle(now_);
      bus_.segment().compute();
    }
  }

  SimulatedBus bus_;
  Clock now_{0};
};

TEST_F(EsiSlave, Keeps_its_outputs_and_sends_its_inputs) {
  Slave& in = add(std::string(ESI_TERMINALS) + ":SAMPLE-DI16");
  Slave& out = add(std::string(ESI_TERMINALS) + ":SAMPLE-DO16");
  std::vector<SlavePlan> plans = {plan_of(in.sii(), 0x10000), plan_of(out.sii(), 0x10002)};
  Master master(bus_, plans, std::chrono::milliseconds(1));
  run(master, 500);
  ASSERT_TRUE(master.slave(0).operates());
  ASSERT_TRUE(master.slave(1).operates());
  Fault set;
  set.kind = FaultKind::ObjectSet;
  set.at = now_;
  set.slave = 0;
  set.object = 0x603001;
  set.value = 1;
  bus_.add_fault(set);
  store<std::uint16_t>(master.outputs(1), 0, 0x8004);
  master.set_outputs_good(1, true);
  run(master, 4);
  EXPECT_EQ(load<std::uint16_t>(master.inputs(0), 0), 0x0008);
  EXPECT_EQ(out.objects().number(0x7020, 1), 1U);
  EXPECT_EQ(out.objects().number(0x7030, 1), 0U);
  EXPECT_EQ(out.objects().number(0x70F0, 1), 1U);
}

TEST_F(EsiSlave, Takes_the_mapping_of_its_master) {
  Slave& slave = add(kServo);
  const std::vector<WantedObject> outputs = {{0x6040, 0, 0, 0}, {0x6071, 0, 0, 0}};
  const std::vector<WantedObject> inputs = {{0x6041, 0, 0, 0}, {0x6077, 0, 0, 0}};
  const auto mapped = map_objects(slave.sii(), outputs, inputs);
  ASSERT_TRUE(mapped) << mapped.error().reason;
  Master master(bus_, {plan_of(*mapped, 0x10000)}, std::chrono::milliseconds(1));
  run(master, 1000);
  ASSERT_TRUE(master.slave(0).operates());
  store<std::int16_t>(master.outputs(0), 2, -5);
  master.set_outputs_good(0, true);
  run(master, 4);
  EXPECT_EQ(slave.objects().number(0x6071, 0), 0xFFFBU);
}

TEST(EsiWords, A_slave_is_refused_where_a_frame_does_not_pass_it_next) {
  Segment sut;
  const auto added = [&sut](const std::string& word) {
    return slaves::add_slave(sut, *slaves::read_slave_word(word), [] { return Time{0}; });
  };
  EXPECT_EQ(added("drive"), "");
  EXPECT_EQ(added("drive@0.3"), "");
  EXPECT_EQ(added("drive"), "") << "behind slave 1";
  EXPECT_EQ(added("drive@0.1"), "");
  EXPECT_THAT(added("drive@1.2"), testing::StartsWith("slave 4 cannot be at port 2 of slave 1: "));
  EXPECT_EQ(sut.size(), 4U);
}

TEST(EsiWords, What_is_no_slave_is_said) {
  const auto said = [](const std::string& word) {
    const auto model = slaves::read_slave_word(word);
    return model ? std::string() : model.error();
  };
  EXPECT_EQ(said("drive"), "");
  EXPECT_EQ(said("drive:start=-20,speed=220,following=20"), "");
  EXPECT_EQ(said("drive:sped=1"), "a drive has no 'sped'; did you mean 'speed'?");
  EXPECT_EQ(said("drive:speed=fast"), "'fast' is no speed of a drive; write speed=220");
  EXPECT_EQ(said("drive:speed=0"), "'0' is no speed of a drive; write speed=220");
  EXPECT_THAT(said(ESI_TERMINALS), testing::HasSubstr("it has 2 devices; write which one, "));
  EXPECT_THAT(said(std::string(ESI_TERMINALS) + ":SAMPLE-DI"),
              testing::HasSubstr("it has no device 'SAMPLE-DI'; did you mean 'SAMPLE-DI16'?"));
  EXPECT_EQ(said("drive@1.3"), "");
  EXPECT_EQ(said("drive:speed=5@0.2"), "");
  for (const std::string place : {"@", "@1", "@1.", "@1.3.1", "@-1.3", "@a.1"}) {
    EXPECT_EQ(said("drive" + place),
              "'" + place + "' is no place on the cable; write drive@1.3 for a drive at port 3 of slave 1");
  }
  EXPECT_THAT(said("/nowhere@home/a.bin"), testing::HasSubstr("write 'drive', or a file"));
  EXPECT_THAT(said("/nowhere.bin"), testing::HasSubstr("write 'drive', or a file with the EEPROM or the description"));
}

}  // namespace
}  // namespace indurop::io::esi
