// SPDX-License-Identifier: Apache-2.0
// Meaning of the manifest: every element and attribute, its defaults, and what is refused.

#include <fstream>

#include "config/xml/plant_reader.h"
#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string plant(const std::string& content) {
  return "<plant name=\"cell\">\n" + content + "</plant>\n";
}
std::string board(const std::string& attributes, const std::string& content = periodic("a.so", "1ms", 1)) {
  return "<board " + attributes + ">" + content + "</board>\n";
}
std::vector<std::string> lines_of(const std::string& xml) {
  return lines(read_plant_text(xml, "p.xml").diagnostics);
}
// Diagnostics of a plant with one good board and this.
std::vector<std::string> with_board(const std::string& content) {
  return lines_of(plant(board("name=\"good\"") + content));
}

TEST(PlantReader, Defaults) {
  const ReadPlant sut = read_plant_text(plant(board("name=\"sensor\"")), "/cell/p.xml");
  ASSERT_THAT(lines(sut.diagnostics), IsEmpty());
  EXPECT_EQ(sut.plant.name, "cell");
  EXPECT_EQ(sut.plant.file, "/cell/p.xml");
  EXPECT_EQ(sut.plant.domain, 77);
  EXPECT_EQ(sut.plant.external_domain, 0);
  EXPECT_TRUE(sut.plant.multicast);
  EXPECT_EQ(sut.plant.lease, milliseconds(500));
  EXPECT_THAT(sut.plant.types, IsEmpty());
  EXPECT_THAT(sut.plant.variables, IsEmpty());
  ASSERT_EQ(sut.plant.boards.size(), 1U);
  const Board& b = sut.plant.boards[0];
  EXPECT_EQ(b.name, "sensor");
  EXPECT_EQ(b.address, "");
  EXPECT_EQ(b.interface_name, "");
  EXPECT_EQ(b.config.file, "/cell/p.xml");
  ASSERT_EQ(b.config.modules.size(), 1U);
  EXPECT_EQ(b.config.modules[0].file, "/cell/a.so");
}

TEST(PlantReader, A_standby_is_the_same_module_on_another_board) {
  const std::string module = periodic("a.so", "1ms", 1, "<standby>spare</standby>");
  const ReadPlant sut = read_plant_text(plant(board("name=\"main\"", module) + board("name=\"spare\"")), "/cell/p.xml");
  EXPECT_THAT(lines(sut.diagnostics), ElementsAre(HasSubstr("has a module named 'a' of its own")));
  const ReadPlant other = read_plant_text(
      plant(board("name=\"main\"", module) + board("name=\"spare\"", periodic("b.so", "1ms", 1))), "/cell/p.xml");
  ASSERT_THAT(lines(other.diagnostics), IsEmpty());
  const auto& modules = other.plant.boards[1].config.modules;
  ASSERT_EQ(modules.size(), 2U);
  EXPECT_EQ(modules[1].file, "/cell/a.so");
  EXPECT_TRUE(modules[1].is_standby);
  EXPECT_FALSE(other.plant.boards[0].config.modules[0].is_standby);
}

TEST(PlantReader, A_standby_that_cannot_be_is_refused) {
  const auto with = [](const std::string& name) {
    return lines_of(plant(board("name=\"main\"", periodic("a.so", "1ms", 1, "<standby>" + name + "</standby>")) +
                          board("name=\"spare\"", periodic("b.so", "1ms", 1))));
  };
  EXPECT_THAT(with("spar"), ElementsAre(HasSubstr("there is no board 'spar'; did you mean 'spare'?")));
  EXPECT_THAT(with("main"), ElementsAre(HasSubstr("runs on this board anyway")));
  EXPECT_THAT(lines(read_config_text("<root>" + periodic("a.so", "1ms", 1, "<standby>b</standby>") + "</root>", "m.xml")
                        .diagnostics),
              ElementsAre(HasSubstr("<standby> names another board of a plant")));
}

TEST(PlantReader, Every_element_reaches_the_plant) {
  const ReadPlant sut = read_plant_text(R"(<?xml version="1.0" encoding="UTF-8"?>
<plant xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="plant.xsd" name="cell-1">
  <variable name="cell::speed" owner="control" every="100Hz" reliability="best-effort"/>
  <variable name="tick" reliability="reliable"/>
  <types>./libcell_types.so</types> <types>/opt/other.so</types>
  <lease>20ms</lease> <multicast>off</multicast> <external>off</external> <domain>0</domain>
  <board name="sensor" address="10.77.0.1" interface="eth0.7">
    <core>1</core> <spin>off</spin> <minimum_period>20us</minimum_period>
  </board>
  <board name="control" address="fd00::2"/>
</plant>)",
                                        "/cell/p.xml");
  EXPECT_TRUE(sut.ok());
  EXPECT_EQ(sut.plant.name, "cell-1");
  EXPECT_EQ(sut.plant.domain, 0);
  EXPECT_FALSE(sut.plant.external_domain.has_value());
  EXPECT_FALSE(sut.plant.multicast);
  EXPECT_EQ(sut.plant.lease, milliseconds(20));
  EXPECT_THAT(sut.plant.types, ElementsAre("/cell/libcell_types.so", "/opt/other.so"));
  EXPECT_EQ(sut.plant.type_places.size(), 2U);
  ASSERT_EQ(sut.plant.variables.size(), 2U);
  const VariableRule& rule = sut.plant.variables[0];
  EXPECT_EQ(rule.name, "cell::speed");
  EXPECT_EQ(rule.owner, "control");
  EXPECT_EQ(rule.every, milliseconds(10));
  EXPECT_TRUE(rule.best_effort);
  EXPECT_EQ(rule.place.line, 3);
  EXPECT_EQ(rule.owner_place.column, 39);
  EXPECT_FALSE(sut.plant.variables[1].best_effort);
  ASSERT_EQ(sut.plant.boards.size(), 2U);
  EXPECT_EQ(sut.plant.boards[0].address, "10.77.0.1");
  EXPECT_EQ(sut.plant.boards[0].interface_name, "eth0.7");
  EXPECT_EQ(sut.plant.boards[0].config.core, 1);
  EXPECT_EQ(sut.plant.boards[0].config.minimum_period, base::Nanos(microseconds(20)));
  EXPECT_EQ(sut.plant.boards[1].address, "fd00::2");
}

TEST(PlantReader, A_board_without_modules_is_noted) {
  EXPECT_THAT(with_board("<board name=\"viewer\"/>\n"),
              ElementsAre(StartsWith("p.xml:4:1: note: the board 'viewer' has no <module>")));
}

TEST(PlantReader, Modules_of_one_name_on_two_boards_are_fine_on_one_not) {
  EXPECT_THAT(with_board(board("name=\"other\"")), IsEmpty());
  EXPECT_THAT(
      with_board(board("name=\"other\"", periodic("a.so", "1ms", 1) + periodic("a.so", "1ms", 2, "<name>a.so</name>") +
                                             periodic("x/a.so", "1ms", 2, "<name>a.so</name>"))),
      Contains(HasSubstr("a second module named 'a.so'")));
}

TEST(PlantReader, A_plant_needs_a_name_and_boards) {
  EXPECT_THAT(lines_of("<plant/>"), ElementsAre(HasSubstr("<plant> needs a name; write <plant name=\"cell\">"),
                                                HasSubstr("p.xml:1:1: error: <plant> has no <board>")));
  EXPECT_THAT(lines_of("<plant name=\"my cell\"><bord/></plant>"),
              ElementsAre(HasSubstr("'my cell' is not a name of a plant; use up to 40 letters"),
                          HasSubstr("unknown element '<bord>' in <plant>; did you mean 'board'?")));
}

TEST(PlantReader, Board_names_differ_in_more_than_case) {
  EXPECT_THAT(with_board(board("name=\"good\"")),
              ElementsAre(AllOf(StartsWith("p.xml:4:1: error: a second board named 'good', the first is in line 2"))));
  EXPECT_THAT(with_board(board("name=\"Good\"")), ElementsAre(HasSubstr("differ only in upper and lower case")));
  EXPECT_THAT(with_board(board("")), ElementsAre(HasSubstr("<board> needs a name; write <board name=\"sensor\">")));
  for (const std::string& bad : std::vector<std::string>{"a b", "a.b", "\xC3\xA4", std::string(41, 'a')}) {
    EXPECT_THAT(with_board(board("name=\"" + bad + "\"")), ElementsAre(HasSubstr("is not a name of a board")));
  }
  EXPECT_THAT(with_board(board("name=\"" + std::string(40, 'a') + "\"")), IsEmpty());
}

TEST(PlantReader, Unknown_and_second_names_are_reported_with_what_was_probably_meant) {
  EXPECT_THAT(with_board("<domian>3</domian>\n"), ElementsAre(HasSubstr("in <plant>; did you mean 'domain'?")));
  EXPECT_THAT(with_board("<module/>\n"), ElementsAre(HasSubstr("unknown element '<module>' in <plant>; known are: ")));
  EXPECT_THAT(with_board(board("name=\"b\" adress=\"a\"")), ElementsAre(HasSubstr("did you mean 'address'?")));
  EXPECT_THAT(with_board(board("name=\"b\"", "<modul/>")),
              Contains(HasSubstr("unknown element '<modul>' in <board>; did you mean 'module'?")));
  EXPECT_THAT(with_board(board("name=\"b\"", periodic("a.so", "1ms", 1) + "<core>0</core><core>1</core>")),
              ElementsAre(HasSubstr("a second <core> in this <board>; the first is in line 5")));
  EXPECT_THAT(with_board("<domain>3</domain>\n<domain>4</domain>\n"),
              ElementsAre(StartsWith("p.xml:5:1: error: a second <domain> in this <plant>; the first is in line 4")));
  EXPECT_THAT(with_board("<variable name=\"x\" rate=\"1ms\"/>\n"), ElementsAre(HasSubstr("unknown attribute 'rate'")));
  EXPECT_THAT(with_board("more\n"), ElementsAre(HasSubstr("text 'more' inside <plant>")));
}

TEST(PlantReader, Domains_are_numbers_up_to_230_and_differ) {
  EXPECT_THAT(with_board("<domain>230</domain><external>229</external>"), IsEmpty());
  EXPECT_THAT(with_board("<domain>231</domain>"), ElementsAre(HasSubstr("write a number from 0 to 230")));
  EXPECT_THAT(with_board("<domain>-1</domain>"), ElementsAre(HasSubstr("'-1' is not a DDS domain")));
  EXPECT_THAT(with_board("<domain/>"), ElementsAre(HasSubstr("<domain> is empty")));
  EXPECT_THAT(with_board("<external>no</external>"), ElementsAre(HasSubstr("from 0 to 230, or off")));
  EXPECT_THAT(with_board("<external>77</external>"),
              ElementsAre(HasSubstr("p.xml:4:11: error: the boards' domain and")));
  EXPECT_THAT(with_board("<domain>0</domain>"), ElementsAre(HasSubstr("both 0 (<external> is 0 unless given)")));
  EXPECT_THAT(with_board("<domain>0</domain><external>off</external>"), IsEmpty());
}

TEST(PlantReader, Lease_has_limits) {
  EXPECT_THAT(with_board("<lease>60s</lease>"), IsEmpty());
  EXPECT_THAT(with_board("<lease>19ms</lease>"), ElementsAre(HasSubstr("write a time from 20 ms to 60 s")));
  EXPECT_THAT(with_board("<lease>61s</lease>"), ElementsAre(HasSubstr("<lease>: 61 s is not possible")));
  EXPECT_THAT(with_board("<lease>soon</lease>"), ElementsAre(HasSubstr("<lease>: ")));
}

TEST(PlantReader, Without_multicast_every_board_needs_an_address) {
  EXPECT_THAT(with_board("<multicast>off</multicast>" + board("name=\"b\" address=\"10.0.0.2\"")),
              ElementsAre(AllOf(StartsWith("p.xml:2:1: error: the board 'good' has no address"),
                                HasSubstr("write <board name=\"good\" address=\"10.0.0.1\">"))));
  EXPECT_THAT(with_board("<multicast>no</multicast>"), ElementsAre(HasSubstr("write on or off")));
}

TEST(PlantReader, Addresses_are_of_one_machine) {
  for (const char* good : {"10.0.0.1", "fe80::1", "localhost", "sensor-1.cell.local", "a_b"}) {
    EXPECT_THAT(with_board(board("name=\"b\" address=\"" + std::string(good) + "\"")), IsEmpty()) << good;
  }
  for (const char* bad : {"10.0.0.256", "10.0.0", "0.0.0.0", "239.255.0.1", "::", "ff02::1", "fe80:::1",
                          "10.0.0.1:7400", "a b", "-a", "a..b", "a/b", "&lt;x&gt;", "", "a."}) {
    EXPECT_THAT(with_board(board("name=\"b\" address=\"" + std::string(bad) + "\"")),
                ElementsAre(AllOf(HasSubstr("error: address: "), HasSubstr("write"))))
        << bad;
  }
  EXPECT_THAT(with_board(board("name=\"b\" address=\"h\"") + board("name=\"c\" address=\"H\"")),
              ElementsAre(HasSubstr("note: the boards 'b' and 'c' have one address")));
}

TEST(PlantReader, Arch_stands_for_the_architecture_of_the_board_that_runs_the_module) {
  const std::string module = periodic("build-${arch}/a.so", "1ms", 1, "<standby>spare</standby>");
  const ReadPlant sut = read_plant_text(
      plant(board(R"(name="main" arch="amd64")", module) + board(R"(name="spare" arch="arm64")", "")), "/cell/p.xml");
  ASSERT_TRUE(sut.ok());
  const Module& first = sut.plant.boards[0].config.modules[0];
  const Module& second = sut.plant.boards[1].config.modules[0];
  EXPECT_EQ(first.file, "/cell/build-amd64/a.so");
  EXPECT_EQ(first.name, "a");
  EXPECT_EQ(second.file, "/cell/build-arm64/a.so");
  EXPECT_EQ(second.file_as_written, "build-arm64/a.so");
  EXPECT_THAT(lines_of(plant(board("name=\"main\"", periodic("build-${arch}/a.so", "1ms", 1)))),
              ElementsAre(AllOf(HasSubstr("p.xml:2:"), HasSubstr("the board 'main' does not say it; write <board "
                                                                 "name=\"main\" arch=\"amd64\">, or arm64"))));
  const std::string types = "<types>lib-${arch}/t.so</types>";
  const ReadPlant typed = read_plant_text(
      plant(types + board(R"(name="a" arch="amd64")", "") + board(R"(name="b" arch="arm64")", "")), "/cell/p.xml");
  ASSERT_TRUE(typed.ok());
  EXPECT_THAT(typed.plant.boards[0].types.types, ElementsAre("/cell/lib-amd64/t.so"));
  EXPECT_THAT(typed.plant.boards[1].types.types_as_written, ElementsAre("lib-arm64/t.so"));
  const ReadPlant here =
      read_plant_text(plant(types + board(R"(name="a" arch="amd64")", periodic("m-${arch}/a.so", "1ms", 1))), "p.xml");
  ASSERT_TRUE(here.ok());
  EXPECT_EQ(here.plant.boards[0].types.types.front(), std::filesystem::current_path() / "lib-amd64/t.so");
  EXPECT_EQ(here.plant.boards[0].config.modules[0].file, std::filesystem::current_path() / "m-amd64/a.so");
  EXPECT_THAT(lines_of(plant(types + board("name=\"b\"", periodic("a.so", "1ms", 1)))),
              ElementsAre(HasSubstr("the board 'b' does not say it")));
  EXPECT_THAT(with_board(board("name=\"b\" arch=\"x86\"")),
              ElementsAre(HasSubstr("arch: 'x86' is not an architecture; write amd64 (x86-64) or arm64 (AArch64)")));
}

TEST(PlantReader, Interfaces_are_named_as_the_kernel_does) {
  for (const char* good : {"eth0", "enp0s31f6", "br-lan", "eth0.100"}) {
    EXPECT_THAT(with_board(board("name=\"b\" interface=\"" + std::string(good) + "\"")), IsEmpty()) << good;
  }
  for (const char* bad : {"eth 0", "eth0@if3", "sixteen_letters_", "a/b", "..", "\"&lt;"}) {
    EXPECT_THAT(with_board(board("name='b' interface='" + std::string(bad) + "'")),
                ElementsAre(HasSubstr("interface: ")))
        << bad;
  }
}

TEST(PlantReader, Rules_for_variables_are_checked) {
  EXPECT_THAT(with_board("<variable owner=\"good\"/>"), ElementsAre(HasSubstr("<variable> needs a name; write ")));
  EXPECT_THAT(with_board("<variable name=\"x\"/>"),
              ElementsAre(HasSubstr("warning: <variable> says nothing about 'x'")));
  EXPECT_THAT(with_board("<variable name=\"x\" owner=\"god\"/>"),
              ElementsAre(HasSubstr("p.xml:4:27: error: owner: there is no board 'god'; did you mean 'good'?")));
  EXPECT_THAT(with_board("<variable name=\"x\" owner=\"\"/>"), ElementsAre(HasSubstr("owner: no value given")));
  EXPECT_THAT(with_board("<variable name=\"x\" every=\"0\"/>"), ElementsAre(HasSubstr("error: every: ")));
  EXPECT_THAT(with_board("<variable name=\"x\" reliability=\"high\"/>"),
              ElementsAre(HasSubstr("write reliable or best-effort")));
  EXPECT_THAT(with_board("<variable name=\"x\" owner=\"good\">1</variable>"),
              ElementsAre(HasSubstr("text '1' inside")));
  EXPECT_THAT(with_board("<variable name=\"x\" every=\"1s\"/>\n<variable name=\"x\" owner=\"good\"/>"),
              ElementsAre(HasSubstr("p.xml:5:1: error: a second <variable> 'x', the first is in line 4")));
}

TEST(PlantReader, Type_libraries_are_files_named_once) {
  EXPECT_THAT(with_board("<types>./a.so</types><types>a.so</types>"),
              ElementsAre(HasSubstr("warning: 'a.so' is named twice")));
  EXPECT_THAT(with_board("<types>lib/</types>"), ElementsAre(HasSubstr("'lib/' is a directory")));
  EXPECT_THAT(with_board("<types/>"), ElementsAre(HasSubstr("<types> is empty")));
}

TEST(PlantReader, The_two_kinds_of_files_are_distinguished) {
  EXPECT_THAT(lines_of(root(periodic("a.so", "1ms", 1))),
              ElementsAre(AllOf(HasSubstr("the root element is <root>"), HasSubstr("this one is a module.xml"))));
  EXPECT_THAT(errors_of(plant(board("name=\"b\""))),
              ElementsAre(AllOf(HasSubstr("--board NAME"), HasSubstr("--local"), HasSubstr("indurop deploy"))));
  EXPECT_THAT(lines_of(""), ElementsAre(HasSubstr("the file is empty; a plant.xml is <plant name=\"cell\">")));
  EXPECT_THAT(lines(read_plant("/nowhere/p.xml").diagnostics),
              ElementsAre("/nowhere/p.xml: error: no such file; give the path of the plant.xml"));
}

TEST(PlantFile, Is_known_by_its_root_element_however_damaged) {
  const ModuleFolder folder;
  const auto is_plant = [&folder](const std::string& text) {
    std::ofstream(folder / "f.xml") << text;
    return is_plant_file(folder / "f.xml");
  };
  EXPECT_TRUE(is_plant(plant("")));
  EXPECT_TRUE(is_plant("\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- a <root> -->\n<plant>"));
  EXPECT_TRUE(is_plant("<plant name=\"a\"><board></plant>"));
  EXPECT_FALSE(is_plant(root("")));
  EXPECT_FALSE(is_plant(""));
  EXPECT_FALSE(is_plant("plant"));
  EXPECT_FALSE(is_plant("<plants/>"));
  EXPECT_FALSE(is_plant_file(folder / "none.xml"));
  EXPECT_FALSE(is_plant_file("/tmp"));
}

}  // namespace
}  // namespace indurop::config
