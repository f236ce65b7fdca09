// SPDX-License-Identifier: Apache-2.0
// `indurop io import`: devices of an ioconfig.xml from the descriptions of their makers.
#include <fstream>
#include <nlohmann/json.hpp>

#include "config/xml/io_reader.h"
#include "node_of_drives.h"

namespace indurop::test {
namespace {

class EsiImport : public NodeTest {
 public:
  static std::string bytes_of(const std::string& file) {
    std::ifstream bytes(file);
    return {std::istreambuf_iterator<char>(bytes), {}};
  }

 protected:
  [[nodiscard]] std::string file() const { return (folder() / "ioconfig.xml").string(); }
  [[nodiscard]] std::string text() const { return bytes_of(file()); }
};

TEST_F(EsiImport, Lists_what_the_files_describe) {
  const Outcome sut = indurop({"io", "import", ESI_SERVO, ESI_TERMINALS});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(sut.out, "SAMPLE-SERVO");
  EXPECT_CONTAINS(sut.out, "DC 0x300, DC2 0x700, Free 0x0");
  EXPECT_CONTAINS(sut.out, "Sixteen digital inputs");
  const auto json = indurop({"io", "import", ESI_SERVO, "-o", "json"}).json();
  ASSERT_EQ(json["devices"].size(), 1U);
  EXPECT_EQ(json["devices"][0]["product"], 0x49520101);
  EXPECT_EQ(json["devices"][0]["pdos"], 5);
}

TEST_F(EsiImport, Writes_devices_with_clocks_and_objects) {
  const Outcome sut = indurop({"io", "import", ESI_SERVO, ESI_TERMINALS, "--write", file(), "--device", "SAMPLE-SERVO",
                               "--device", "SAMPLE-DI16", "--address", "ec0", "--namespace", "CELL", "--cycle", "2ms"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(text(),
                  "  <device name=\"slave0\" driver=\"ethercat\" address=\"ec0\" slave=\"0\" vendor=\"0x0\" "
                  "product=\"0x49520101\" revision=\"0x10000\"\n"
                  "          in=\"CELL::SLAVE0_IN\" out=\"CELL::SLAVE0_OUT\">\n"
                  "    <sync activate=\"0x300\" cycle=\"2ms\" shift=\"125us\"/>  <!-- DC: with SYNC0 -->\n"
                  "    <set at=\"6060:0\" type=\"uint8\" value=\"8\"/>  <!-- cyclic position -->\n"
                  "    <!-- not possible as a set: 2010:1, 4 bytes at SO -->\n"
                  "    <set at=\"60c2:2\" type=\"uint16\" value=\"65533\"/>\n"
                  "  </device>\n"
                  "  <device name=\"slave1\" driver=\"ethercat\" address=\"ec0\" slave=\"1\" vendor=\"0x0\" "
                  "product=\"0x49520016\" revision=\"0x1\">\n"
                  "    <input variable=\"CELL::SLAVE1_6000_1\" at=\"6000:1\"/>  <!-- Input -->\n");
  const auto read = config::read_io_config(file());
  EXPECT_EQ(base::to_text(read.diagnostics), "");
  ASSERT_EQ(read.config.devices.size(), 2U);
  EXPECT_EQ(read.config.devices[0].slave.sync.shift, std::chrono::microseconds(125));
  EXPECT_EQ(read.config.devices[1].points.size(), 16U);
  // What is there stays, the next one comes after it.
  const std::string before = text();
  EXPECT_EQ(indurop({"io", "import", ESI_SERVO, "--write", file(), "--device", "SAMPLE-SERVO", "--address", "ec0",
                     "--mode", "DC2"})
                .code,
            0);
  EXPECT_EQ(text().substr(0, before.find("</ioconfig>")), before.substr(0, before.find("</ioconfig>")));
  EXPECT_CONTAINS(text(), "slave=\"2\"");
  EXPECT_CONTAINS(text(), "<sync activate=\"0x700\" cycle=\"500us\" sync1=\"1ms\"/>  <!-- DC2 -->");
}

TEST_F(EsiImport, Devices_of_a_file_that_are_described_get_what_they_lack) {
  write(
      "ioconfig.xml",
      "<ioconfig>  <!-- \xC3\xA4 > -->\n"
      "  <device name='a>b' driver='ethercat' address='e' slave='0' vendor='0x0' product='0x49520101' in='A::IN'/>\n"
      "  <device name='other' driver='ethercat' address='e' slave='1' vendor='0x1' product='0x49520101' in='A::IN'/>\n"
      "  <device name='b' driver='ethercat' address='e' slave='2' vendor='0x0' product='0x49520101'>\n"
      "    <input variable='A::X' at='6041'/>\n"
      "  </device>\n"
      "  <device name='c' driver='ethercat' address='e' slave='3' vendor='0x0' product='0x49520101' in='A::IN'>\n"
      "    <sync activate='0x300' cycle='4ms'/>\n"
      "  </device>\n"
      "</ioconfig>\n");
  const Outcome sut = indurop({"io", "import", ESI_SERVO, "--write", file()});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(sut.err + sut.out, "0 devices added, 2 extended");
  const auto read = config::read_io_config(file());
  EXPECT_EQ(base::to_text(read.diagnostics), "") << text();
  ASSERT_EQ(read.config.devices.size(), 4U);
  EXPECT_EQ(read.config.devices[0].slave.sync.activate, 0x300);
  EXPECT_EQ(read.config.devices[0].slave.values.size(), 2U);
  EXPECT_EQ(read.config.devices[1].slave.sync.activate, 0);
  EXPECT_EQ(read.config.devices[2].slave.sync.cycle, std::chrono::milliseconds(1));
  EXPECT_EQ(read.config.devices[2].points.size(), 1U);
  EXPECT_EQ(read.config.devices[3].slave.sync.cycle, std::chrono::milliseconds(4)) << "it has its own";
  const Outcome again = indurop({"io", "import", ESI_SERVO, "--write", file()});
  EXPECT_EQ(again.code, 1);
  EXPECT_CONTAINS(again.err, "nothing to write: ");
}

TEST_F(EsiImport, What_is_wrong_is_said) {
  write("broken.xml",
        "<EtherCATInfo>\n<Vendor><Id>two</Id></Vendor>\n<Descriptions><Devices/></Descriptions></EtherCATInfo>");
  const Outcome broken = indurop({"io", "import", (folder() / "broken.xml").string()});
  EXPECT_EQ(broken.code, 1);
  EXPECT_CONTAINS(broken.err, "broken.xml:2:13: error: Id: 'two' is no number from 0 to 4294967295; write 18 or #x12");
  const Outcome unknown = indurop({"io", "import", ESI_SERVO, "--write", file(), "--device", "SAMPLE-SERVA"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_CONTAINS(unknown.err, "the files have no device 'SAMPLE-SERVA'; did you mean 'SAMPLE-SERVO'?");
  EXPECT_EQ(indurop({"io", "import", ESI_SERVO, "--cycle", "fast"}).code, 2);
}

// The description says what the slave can exchange before it is there.
TEST_F(EsiImport, Points_are_checked_with_the_description) {
  write("servo.xml", bytes_of(ESI_SERVO));
  write("terminals.xml", bytes_of(ESI_TERMINALS));
  write("module.xml",
        xml({{.file = IO_MODULE, .name = "io", .period = "2ms", .properties = {{"config", "ioconfig.xml"}}},
             {.file = std::string(IO_FOLDER) + "/axis_user.so", .name = "axis_user", .period = "2ms"}}));
  const auto checked = [this](const std::string& devices) {
    write("ioconfig.xml", "<ioconfig>\n" + devices + "\n</ioconfig>\n");
    return indurop({"check", (folder() / "module.xml").string(), "-q"});
  };
  const std::string servo = "<device name='a' driver='ethercat' address='e' slave='0' description='servo.xml' ";
  const Outcome good = checked(servo +
                               "in='TEST_CELL::AXIS1_IN'>\n"
                               "  <input variable='speeds[1]' at='torque'/><output variable='speeds[2]' at='torque'/>\n"
                               "</device>");
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  const Outcome sut = checked(servo +
                              "out='TEST_CELL::AXIS1_OUT'>\n"
                              "  <input variable='speeds[1]' at='2000:1'/>\n"
                              "  <output variable='speeds[2]' at='torque'/>\n"
                              "</device>");
  EXPECT_EQ(sut.code, 4) << sut.out << sut.err;
  EXPECT_CONTAINS(sut.out,
                  "ioconfig.xml:2:87: error: device a: SAMPLE-SERVO cannot exchange output mode: no PDO of the "
                  "slave has it, and what they contain is fixed");
  EXPECT_CONTAINS(sut.out,
                  "ioconfig.xml:4:36: error: device a: SAMPLE-SERVO cannot exchange output torque: no set of "
                  "PDOs that may be assigned together has it and the others");
  EXPECT_CONTAINS(sut.out,
                  "ioconfig.xml:3:35: error: device a: SAMPLE-SERVO cannot exchange input 2000:1: no PDO of the "
                  "slave has it, and its type is not known; give it: type=\"int16\"");
  EXPECT_CONTAINS(checked("<device name='a' driver='ethercat' address='e' slave='0' description='terminals.xml'\n"
                          "  in='TEST_CELL::AXIS1_IN'/>")
                      .out,
                  "description: 'terminals.xml' has 2 devices; give vendor and product; `indurop io import "
                  "terminals.xml` lists its devices");
  EXPECT_CONTAINS(checked("<device name='a' driver='ethercat' address='e' slave='0' product='0x1' "
                          "description='terminals.xml'\n  in='TEST_CELL::AXIS1_IN'/>")
                      .out,
                  "ioconfig.xml:2:85: error: description: 'terminals.xml' has no device with this vendor and product");
  EXPECT_CONTAINS(checked("<device name='a' driver='ethercat' address='e' slave='0' description='none.xml'\n"
                          "  in='TEST_CELL::AXIS1_IN'/>")
                      .out,
                  "none.xml: No such file");
}

// What only the PDOs of both slaves say of a copy.
TEST_F(EsiImport, Copies_are_checked_with_the_description) {
  write("relay.xml", bytes_of(ESI_RELAY));
  write("module.xml",
        xml({{.file = IO_MODULE, .name = "io", .period = "2ms", .properties = {{"config", "ioconfig.xml"}}},
             {.file = std::string(IO_FOLDER) + "/axis_user.so", .name = "axis_user", .period = "2ms"}}));
  const auto checked = [this](const std::string& in_a, const std::string& in_b) {
    write("ioconfig.xml",
          "<ioconfig>\n<device name='a' driver='ethercat' address='e' slave='0' description='relay.xml'>\n" + in_a +
              "\n</device>\n<device name='b' driver='ethercat' address='e' slave='1' description='relay.xml'>\n" +
              in_b + "\n</device>\n</ioconfig>\n");
    return indurop({"check", (folder() / "module.xml").string(), "-q"});
  };
  const Outcome good =
      checked("<copy from='b' at='6000:1-6000:2' to='7000:1-7000:2'/><output variable='speeds[1]' at='7010:1'/>",
              "<copy from='a' at='1a00' to='1600'/><copy from='a' at='6010:1' to='7010:1'/>");
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  const Outcome sut = checked(
      "<output variable='speeds[1]' at='7001:1'/>\n"
      "<copy from='b' at='1a00' to='1600'/>",
      "<copy from='a' at='6000:2-6000:1' to='7000:2'/>\n"
      "<copy from='a' at='6010:1' to='7000:9'/>\n"
      "<copy from='a' at='6000:1-6001:1' to='7000:1'/>\n"
      "<copy from='a' at='6000:3' to='7001:1-7000:3'/>\n"
      "<copy from='a' at='6000:3' to='7000:3'/>\n"
      "<copy from='a' at='1a02' to='1601'/>");
  EXPECT_EQ(sut.code, 4) << sut.out << sut.err;
  EXPECT_CONTAINS(
      sut.out,
      "ioconfig.xml:4:30: error: device a: SAMPLE-RELAY cannot exchange output 1600: 7001:1 writes the same "
      "outputs");
  EXPECT_CONTAINS(sut.out,
                  "ioconfig.xml:7:20: error: device a: SAMPLE-RELAY cannot exchange input 6000:2-6000:1: no PDO of the "
                  "slave has it, from its first object to its last one");
  EXPECT_CONTAINS(sut.out,
                  "ioconfig.xml:8:32: error: device b: SAMPLE-RELAY cannot exchange output 7000:9: no PDO of the slave "
                  "has it, and what they contain is fixed");
  EXPECT_CONTAINS(sut.out,
                  "ioconfig.xml:9:1: error: 6000:1-6001:1 of a has 9 bits, and 7000:1 has 1 byte; copy what has one "
                  "size, and more than none");
  EXPECT_CONTAINS(
      sut.out,
      "ioconfig.xml:11:32: error: device b: SAMPLE-RELAY cannot exchange output 7000:3: 7001:1-7000:3 writes "
      "the same outputs");
  EXPECT_CONTAINS(sut.out, "ioconfig.xml:12:20: error: device a: SAMPLE-RELAY cannot exchange input 1a02: no PDO");
}

// Two PDOs of one object each: an EEPROM does not say that they exclude each other, the slave would refuse them.
TEST_F(EthercatNode, Exclusions_of_the_description_count) {
  write("servo.xml", EsiImport::bytes_of(ESI_SERVO));
  drives_ = std::make_unique<Program>(std::vector<std::string>{ECSIM_PROGRAM, "ec1", ESI_SERVO, "--script", "-"});
  ASSERT_TRUE(drives_->prints("slaves at")) << drives_->err();
  const std::string device =
      "<device name='servo' driver='ethercat' address='ec0' slave='0' product='0x49520101' "
      "quality='TEST_CELL::link_good'";
  const std::string outputs =
      ">\n  <output variable='speeds[2]' at='position'/><output variable='speeds[3]' at='torque'/>\n</device>";
  Program& sut = run_node(device + outputs);
  EXPECT_TRUE(sut.prints("slave 0 (Sample servo drive): operates"))
      << "the EEPROM says nothing against it" << sut.out();
  sut.signal(SIGTERM);
  sut.wait();
  Program& described = start_node(device + " description='servo.xml'" + outputs);
  EXPECT_NE(described.wait(), 0);
  EXPECT_CONTAINS(described.err() + described.out(), "SAMPLE-SERVO cannot exchange output position");
}

// From the maker's file to moving data: slaves are simulated from it, found on the cable, and exchanged.
TEST_F(EthercatNode, Slaves_of_a_makers_file_are_exchanged) {
  drives_ = std::make_unique<Program>(std::vector<std::string>{
      ECSIM_PROGRAM, "ec1", std::string(ESI_TERMINALS) + ":SAMPLE-DI16", ESI_SERVO, "--script", "-"});
  ASSERT_TRUE(drives_->prints("slaves at")) << drives_->err();
  Program& sut = run_node(
      "<device name='in' driver='ethercat' address='ec0' slave='0' product='0x49520016'\n"
      "  quality='TEST_CELL::link_good'>\n"
      "  <input variable='speeds[1]' at='6030:1' quality='TEST_CELL::I0_quality'/>\n"
      "</device>\n"
      "<device name='servo' driver='ethercat' address='ec0' slave='1' product='0x49520101'>\n"
      "  <input variable='speeds[2]' at='torque'/>\n"
      "  <output variable='speeds[3]' at='6071'/>\n"
      "</device>");
  EXPECT_TRUE(wait_until([&] { return value<std::uint8_t>("TEST_CELL::I0_quality") == 1; })) << sut.out();
  drives_->input("0s value slave=0 at=6030:1 to=1\n0s value slave=1 at=6077 to=7\n");
  EXPECT_TRUE(wait_until([&] { return indurop({"get", "speeds[1]"}).out == "1\n"; })) << indurop({"get", "speeds"}).out;
  EXPECT_TRUE(wait_until([&] { return indurop({"get", "speeds[2]"}).out == "7\n"; })) << indurop({"get", "speeds"}).out;
  EXPECT_EQ(drives_->err(), "");
}

}  // namespace
}  // namespace indurop::test
