// SPDX-License-Identifier: Apache-2.0
// Pools that a manifest sends between boards: what is read, what is found between modules and manifest, and what
// indurop-pools is started with.

#include "config/check/check_plant.h"
#include "config/pool_arguments.h"
#include "config/xml/plant_reader.h"
#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kTake = "indurop_pool_take";
constexpr const char* kLatest = "indurop_pool_latest";

std::string plant_text(const std::string& content) {
  return "<plant name=\"cell\">\n" + content + "</plant>\n";
}
std::string board_text(const std::string& attributes, const std::string& file = "") {
  return "<board " + attributes + ">" + (file.empty() ? "" : periodic(file, "1ms", 1)) + "</board>\n";
}
const std::string kThreeBoards = board_text("name=\"a\" address=\"10.0.0.1\" interface=\"eth1\"") +
                                 board_text("name=\"b\" address=\"10.0.0.2\"") + board_text("name=\"c\"");

Plant plant_with_pools(const std::string& content) {
  ReadPlant read = read_plant_text(plant_text(content), "/cell/p.xml");
  EXPECT_TRUE(read.ok()) << testing::PrintToString(lines(read.diagnostics));
  return std::move(read.plant);
}

TEST(PlantPools, Every_attribute_reaches_the_plant) {
  const Plant sut = plant_with_pools(kThreeBoards + "<pool name=\"n::eye\" from=\"a\" to=\"b\n c \" every=\"10Hz\"/>");
  ASSERT_EQ(sut.pools.size(), 1U);
  const PoolRoute& route = sut.pools[0];
  EXPECT_EQ(route.name, "n::eye");
  EXPECT_EQ(route.from, "a");
  EXPECT_THAT(route.to, ElementsAre("b", "c"));
  EXPECT_EQ(route.every, std::chrono::milliseconds(100));
  EXPECT_EQ(route.to_places[0].column, 34);
}

TEST(PlantPools, Boards_that_cannot_be_are_reported_all_at_once) {
  const auto read =
      read_plant_text(plant_text(board_text("name=\"vision\"", "a.so") + board_text("name=\"cell\"", "b.so") +
                                 "<pool name=\"x\" from=\"vison\" to=\"cel\"/>\n"
                                 "<pool name=\"y\" from=\"cell\" to=\"vision cell vision\"/>\n"
                                 "<pool name=\"x\" from=\"vision\" to=\"cell\"/>\n"),
                      "p.xml");
  EXPECT_THAT(lines(read.diagnostics),
              ElementsAre(HasSubstr("error: from: there is no board 'vison'; did you mean 'vision'?"),
                          HasSubstr("error: to: there is no board 'cel'; did you mean 'cell'?"),
                          HasSubstr("error: to: 'cell' is the board that the chunks come from"),
                          HasSubstr("error: to: 'vision' is named twice; remove one"),
                          HasSubstr("error: a second <pool> 'x', the first is in line ")));
}

class PlantPoolCheck : public testing::Test {
 protected:
  static schema::Pool pool(const std::string& name, schema::Base pixel) {
    schema::Pool made;
    made.name = name;
    made.type.base = schema::Base::Struct;
    made.type.name = name + "_t";
    made.type.dims = {4};
    made.type.element_size = 8;
    made.type.align = 8;
    schema::Field field;
    field.name = "pixel";
    field.type = variable("n::x", pixel).type;
    made.type.fields.push_back(field);
    made.type_hash = schema::hash_of(made.type);
    return made;
  }
  void write(const std::string& name, const std::vector<std::string>& pools, const std::string& import,
             schema::Base pixel = schema::Base::Double) const {
    ModuleSpec spec;
    for (const std::string& one : pools) {
      spec.schema.pools.push_back(pool(one, pixel));
    }
    if (!import.empty()) {
      spec.imports.push_back(import);
    }
    write_module(folder_ / name, spec);
  }
  std::vector<std::string> check_lines(const std::string& content) {
    ReadPlant read =
        read_plant_text(plant_text(board_text("name=\"a\"", "w.so") + board_text("name=\"b\"", "r.so") + content),
                        folder_ / "plant.xml");
    EXPECT_TRUE(read.ok()) << testing::PrintToString(lines(read.diagnostics));
    std::vector<std::string> all = lines(check_plant(read.plant, {}).diagnostics);
    std::erase_if(all, [](const std::string& line) { return line.find("the plant is open") != std::string::npos; });
    plant_ = std::move(read.plant);
    return all;
  }

  ModuleFolder folder_;
  Plant plant_;
};

TEST_F(PlantPoolCheck, A_pool_that_both_boards_have_is_sent_under_its_full_name) {
  write("w.so", {"n::eye"}, kTake);
  write("r.so", {"n::eye"}, kLatest);
  EXPECT_THAT(check_lines("<pool name=\"eye\" from=\"a\" to=\"b\"/>"), IsEmpty());
  EXPECT_EQ(plant_.pools[0].name, "n::eye");
}

TEST_F(PlantPoolCheck, A_pool_that_does_not_exist_is_reported_with_what_was_probably_meant) {
  write("w.so", {"n::eye", "m::left", "n::left"}, kTake);
  write("r.so", {"n::eye"}, kLatest);
  EXPECT_THAT(check_lines("<pool name=\"n::eya\" from=\"a\" to=\"b\"/>\n<pool name=\"left\" from=\"a\" to=\"b\"/>\n"),
              ElementsAre(AllOf(HasSubstr("plant.xml:"), HasSubstr("13: error: <pool>: no module declares a pool "
                                                                   "'n::eya'; did you mean 'n::eye'?")),
                          HasSubstr("error: <pool>: 'left' may be m::left and n::left; write the name in full")));
  write("w.so", {}, "");
  write("r.so", {}, "");
  EXPECT_THAT(check_lines("<pool name=\"eye\" from=\"a\" to=\"b\"/>"),
              ElementsAre(HasSubstr("no module declares a pool 'eye'; pools are declared in .glb files")));
}

TEST_F(PlantPoolCheck, Both_ends_must_have_it_with_the_same_type) {
  write("w.so", {"n::eye"}, kTake);
  write("r.so", {"n::other"}, kLatest);
  EXPECT_THAT(check_lines("<pool name=\"n::eye\" from=\"a\" to=\"b\"/>\n<pool name=\"other\" from=\"a\" to=\"b\"/>"),
              ElementsAre(HasSubstr("error: to: no module of board 'b' declares 'n::eye', only modules of 'a'"),
                          HasSubstr("error: from: no module of board 'a' declares 'n::other', only modules of 'b'")));
  write("r.so", {"n::eye"}, kLatest, schema::Base::Int32);
  EXPECT_THAT(check_lines("<pool name=\"n::eye\" from=\"a\" to=\"b\"/>"),
              ElementsAre(AllOf(HasSubstr("error: pool 'n::eye' differs between board 'a' and board 'b': "),
                                HasSubstr("build the modules of both boards with the same .glb file"))));
}

TEST_F(PlantPoolCheck, Two_senders_of_one_pool_are_refused_by_whatever_name) {
  write("w.so", {"n::eye"}, kTake);
  write("r.so", {"n::eye"}, kLatest);
  EXPECT_THAT(check_lines("<pool name=\"eye\" from=\"a\" to=\"b\"/>\n<pool name=\"n::eye\" from=\"b\" to=\"a\"/>"),
              ElementsAre(HasSubstr("error: a second <pool> for 'n::eye', the first is in line ")));
}

TEST_F(PlantPoolCheck, A_pool_that_no_module_fills_or_reads_is_noted) {
  write("w.so", {"n::eye"}, kLatest);
  write("r.so", {"n::eye"}, kTake);
  EXPECT_THAT(check_lines("<pool name=\"eye\" from=\"a\" to=\"b\"/>"),
              ElementsAre(HasSubstr("note: no module of board 'a' that declares 'n::eye' fills chunks of it"),
                          HasSubstr("note: no module of board 'b' that declares 'n::eye' reads chunks of it")));
}

TEST_F(PlantPoolCheck, A_module_that_cannot_be_read_is_the_only_error) {
  write("w.so", {"n::eye"}, kTake);
  EXPECT_THAT(check_lines("<pool name=\"eye\" from=\"a\" to=\"b\"/>"), ElementsAre(HasSubstr("no such file")));
}

TEST(PoolArguments, Both_ends_get_what_they_need_and_others_nothing) {
  const Plant sut = plant_with_pools(kThreeBoards +
                                     "<pool name=\"n::eye\" from=\"a\" to=\"b c\" every=\"100ms\"/>"
                                     "<pool name=\"n::left\" from=\"b\" to=\"a\"/>");
  EXPECT_THAT(pool_arguments(sut, "a", false), ElementsAre("--node", "a", "--plant", "cell", "--domain", "0", "--send",
                                                           "n::eye@100000000ns", "--receive", "n::left", "--interface",
                                                           "eth1", "--address", "10.0.0.1", "--peer", "10.0.0.2"));
  EXPECT_THAT(pool_arguments(sut, "c", false), ElementsAre("--node", "c", "--plant", "cell", "--domain", "0",
                                                           "--receive", "n::eye", "--peer", "10.0.0.1"));
  EXPECT_THAT(pool_arguments(sut, "b", true), ElementsAre("--node", "b", "--plant", "cell", "--domain", "0",
                                                          "--receive", "n::eye", "--send", "n::left", "--one-host"));
  EXPECT_THAT(pool_arguments(sut, "d", false), IsEmpty());
  EXPECT_THAT(pools_of(sut, "a"), ElementsAre(BoardPool{"n::eye", "sent to b and c, at most every 100 ms"},
                                              BoardPool{"n::left", "received from b"}));
}

TEST(PoolArguments, Without_an_external_domain_pools_are_in_that_of_the_boards) {
  const Plant sut =
      plant_with_pools("<external>off</external>" + kThreeBoards + "<pool name=\"x\" from=\"a\" to=\"b\"/>");
  EXPECT_EQ(pool_arguments(sut, "a", true)[5], "77");
  const Plant other =
      plant_with_pools("<external>5</external>" + kThreeBoards + "<pool name=\"x\" from=\"a\" to=\"b\"/>");
  EXPECT_EQ(pool_arguments(other, "a", true)[5], "5");
}

}  // namespace
}  // namespace indurop::config
