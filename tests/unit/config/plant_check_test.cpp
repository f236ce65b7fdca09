// SPDX-License-Identifier: Apache-2.0
// What is found between the boards of a plant: owners, routes, types, age of data.

#include <elf.h>

#include "config/check/check_plant.h"
#include "config/xml/plant_reader.h"
#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct CheckedPlant {
  Plant plant;
  PlantCheck result;
  // Without the note that the plant is open.
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all = config::lines(result.diagnostics);
    std::erase_if(all, [](const std::string& line) { return line.find("the plant is open") != std::string::npos; });
    return all;
  }
};

std::vector<std::string> names_of(const schema::Schema& schema) {
  std::vector<std::string> names;
  for (const schema::Variable& v : schema.variables) {
    names.push_back(v.name);
  }
  return names;
}

class CheckPlant : public testing::Test {
 protected:
  using Names = std::vector<std::string>;
  // A thread module that reads and writes the given variables, all of them of one type in namespace n.
  void write(const std::string& name, const Names& reads, const Names& writes, std::int64_t maxage_ns = 0,
             schema::Base base = schema::Base::Double) {
    ModuleSpec spec;
    std::set<std::string> known;
    for (const auto* list : {&reads, &writes}) {
      for (const std::string& v : *list) {
        if (known.insert(v).second) {
          spec.schema.variables.push_back(variable(v, base));
          spec.schema.variables.back().maxage_ns = maxage_ns;
        }
      }
    }
    spec.reads = reads;
    spec.writes = writes;
    write_module(folder_ / name, spec);
  }
  // A process that uses variables by names known at run time only.
  void write_channel(const std::string& name, const Names& declares, const std::string& verb) {
    ModuleSpec spec{
        .program = true, .exports = {}, .imports = {"_ZN3irp10waitPeriodEv", "_ZN7channel" + verb + "ERNS_6HandleE"}};
    for (const std::string& v : declares) {
      spec.schema.variables.push_back(variable(v));
    }
    write_module(folder_ / name, spec);
  }
  static std::string board(const std::string& name, const std::string& content) {
    return "<board name=\"" + name + "\">" + content + "</board>\n";
  }
  static std::string process(const std::string& file, const std::string& more = "") {
    return sporadic(file, "process", 1, more);
  }
  CheckedPlant checked(const std::string& content, const CheckOptions& options = {}) {
    ReadPlant read = read_plant_text("<plant name=\"cell\">\n" + content + "</plant>\n", folder_ / "plant.xml");
    EXPECT_TRUE(read.ok()) << testing::PrintToString(lines(read.diagnostics));
    CheckedPlant checked{std::move(read.plant), {}};
    checked.result = check_plant(checked.plant, options);
    return checked;
  }
  // Diagnostics without the notes on age.
  std::vector<std::string> check_lines(const std::string& content) {
    std::vector<std::string> all = checked(content).lines();
    std::erase_if(all, [](const std::string& line) { return line.find(" gets ") != std::string::npos; });
    return all;
  }
  // Board a with w.so, which writes n::x, and board b with r.so, which reads it.
  std::string writer_and_reader(const std::string& period = "1ms", std::int64_t maxage_ns = 0) {
    write("w.so", {}, {"n::x"}, maxage_ns);
    write("r.so", {"n::x"}, {}, maxage_ns);
    return board("a", periodic("w.so", period, 1)) + board("b", periodic("r.so", "2ms", 1));
  }

  ModuleFolder folder_;
};

TEST_F(CheckPlant, What_is_written_on_one_board_and_read_on_another_travels) {
  write("w.so", {}, {"n::x", "n::y", "n::local"});
  write("r.so", {"n::x"}, {});
  write("q.so", {"n::x", "n::y"}, {});
  write("l.so", {"n::local", "n::x"}, {});
  const CheckedPlant sut = checked(board("a", periodic("w.so", "1ms", 1) + periodic("l.so", "1ms", 2)) +
                                   board("b", periodic("r.so", "1ms", 1)) + board("c", periodic("q.so", "1ms", 1)));
  EXPECT_TRUE(sut.result.ok());
  ASSERT_EQ(sut.result.boards.size(), 3U);
  ASSERT_EQ(sut.result.routes.size(), 2U);
  const Route& x = sut.result.routes[0];
  EXPECT_EQ(x.variable, "n::x");
  EXPECT_EQ(x.owner, 0U);
  EXPECT_THAT(x.readers, ElementsAre(1U, 2U));
  EXPECT_EQ(x.every, base::Nanos(0));
  EXPECT_FALSE(x.best_effort);
  EXPECT_EQ(sut.result.routes[1].variable, "n::y");
  EXPECT_THAT(sut.result.routes[1].readers, ElementsAre(2U));
  EXPECT_THAT(names_of(sut.result.boards[1].schema), ElementsAre("n::x"));
}

TEST_F(CheckPlant, A_standby_writes_the_same_variables_and_owns_none) {
  write("w.so", {"n::in"}, {"n::x"});
  write("r.so", {"n::x"}, {"n::in"});
  const CheckedPlant sut = checked(board("a", periodic("w.so", "1ms", 1, "<standby>b</standby>")) +
                                   board("b", periodic("q.so", "1ms", 2)) + board("c", periodic("r.so", "1ms", 1)));
  ASSERT_EQ(sut.plant.boards[1].config.modules.size(), 2U);
  EXPECT_TRUE(sut.plant.boards[1].config.modules[1].is_standby);
  ASSERT_EQ(sut.result.routes.size(), 2U);
  const Route& in = sut.result.routes[0];
  EXPECT_EQ(in.owner, 2U);
  EXPECT_THAT(in.readers, ElementsAre(0U, 1U)) << "both need the inputs";
  const Route& x = sut.result.routes[1];
  EXPECT_EQ(x.owner, 0U);
  EXPECT_THAT(x.standbys, ElementsAre(1U));
  EXPECT_THAT(x.readers, ElementsAre(2U));
}

TEST_F(CheckPlant, A_writer_on_another_board_is_a_writer) {
  EXPECT_THAT(check_lines(writer_and_reader()), IsEmpty());
}

TEST_F(CheckPlant, Read_everywhere_and_written_nowhere_is_one_warning) {
  write("r.so", {"n::x"}, {});
  const std::string reader = periodic("r.so", "1ms", 1);
  EXPECT_THAT(check_lines(board("a", reader) + board("b", reader)),
              ElementsAre(HasSubstr("warning: 'n::x' is read by r@a and r@b but no module writes it")));
}

TEST_F(CheckPlant, Written_and_read_nowhere_is_one_note) {
  write("w.so", {}, {"n::x"});
  EXPECT_THAT(check_lines(board("a", periodic("w.so", "1ms", 1)) + board("b", "")),
              ElementsAre(HasSubstr("note: 'n::x' is written by w@a but no module reads it")));
}

TEST_F(CheckPlant, Two_writing_boards_are_an_error_naming_modules_and_boards) {
  write("w.so", {}, {"n::x"});
  write("v.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {});
  const std::string plant = board("a", periodic("w.so", "1ms", 1)) + board("b", periodic("v.so", "1ms", 1)) +
                            board("c", periodic("r.so", "1ms", 1));
  EXPECT_THAT(check_lines(plant),
              ElementsAre(AllOf(HasSubstr("plant.xml:4:"), HasSubstr("error: 'n::x' is written by w@a and v@b"),
                                HasSubstr("<variable name=\"n::x\" owner=\"a\"/>"))));
  const CheckedPlant sut = checked(plant + "<variable name=\"x\" owner=\"b\"/>");
  EXPECT_THAT(sut.lines(), Contains(HasSubstr("warning: 'n::x' is owned by board 'b'; what w@a writes stays on its")));
  ASSERT_EQ(sut.result.routes.size(), 1U);
  EXPECT_EQ(sut.result.routes[0].owner, 1U);
  EXPECT_THAT(sut.result.routes[0].readers, ElementsAre(2U));
  EXPECT_EQ(sut.plant.variables[0].name, "n::x");
}

TEST_F(CheckPlant, What_a_reading_board_writes_to_a_variable_of_another_is_replaced) {
  write("w.so", {"n::x"}, {"n::x"});
  const std::string module = periodic("w.so", "1ms", 1);
  const CheckedPlant sut = checked(board("a", module) + board("b", module) + "<variable name=\"n::x\" owner=\"a\"/>");
  EXPECT_THAT(sut.lines(), Contains(HasSubstr("what w@b writes is replaced there by the owner's value")));
  ASSERT_EQ(sut.result.routes.size(), 1U);
  EXPECT_THAT(sut.result.routes[0].readers, ElementsAre(1U));
}

TEST_F(CheckPlant, The_owner_must_have_the_variable_and_should_write_it) {
  const std::string plant = writer_and_reader();
  EXPECT_THAT(check_lines(plant + "<variable name=\"n::x\" owner=\"b\"/>"),
              ElementsAre(AllOf(HasSubstr("plant.xml:6:30: error: owner: no module of board 'b' writes 'n::x'"),
                                HasSubstr("but w@a does; write owner=\"a\""))));
  EXPECT_THAT(
      check_lines(plant + board("c", "") + "<variable name=\"n::x\" owner=\"c\"/>"),
      ElementsAre(AllOf(HasSubstr("error: owner: no module of board 'c' has 'n::x'"), HasSubstr("write owner=\"a\""))));
}

TEST_F(CheckPlant, A_value_set_by_hand_travels_from_the_board_named_as_owner) {
  write("r.so", {"n::x"}, {});
  const std::string reader = periodic("r.so", "1ms", 1);
  const CheckedPlant sut = checked(board("a", reader) + board("b", reader) + "<variable name=\"n::x\" owner=\"a\"/>");
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("unless set by hand on board 'a'")));
  ASSERT_EQ(sut.result.routes.size(), 1U);
  EXPECT_EQ(sut.result.routes[0].owner, 0U);
}

TEST_F(CheckPlant, Rules_reach_the_route) {
  const CheckedPlant sut =
      checked(writer_and_reader() + "<variable name=\"x\" every=\"10ms\" reliability=\"best-effort\"/>");
  ASSERT_EQ(sut.result.routes.size(), 1U);
  EXPECT_EQ(sut.result.routes[0].every, milliseconds(10));
  EXPECT_TRUE(sut.result.routes[0].best_effort);
}

TEST_F(CheckPlant, Rules_are_for_whole_variables_that_exist_and_travel) {
  write("l.so", {"n::local"}, {"n::local"});
  const std::string plant = writer_and_reader() + board("c", periodic("l.so", "1ms", 1));
  EXPECT_THAT(check_lines(plant + "<variable name=\"n::xx\" every=\"1s\"/>"),
              ElementsAre(AllOf(HasSubstr("plant.xml:8:17: error: <variable>: "), HasSubstr("n::x"))));
  EXPECT_THAT(check_lines(plant + "<variable name=\"local\" every=\"1s\"/>"),
              ElementsAre(HasSubstr("warning: 'n::local' does not leave its board")));
  EXPECT_THAT(check_lines(plant + "<variable name=\"x\" every=\"1s\"/>\n<variable name=\"n::x\" owner=\"a\"/>"),
              ElementsAre(HasSubstr("plant.xml:9:17: error: a second <variable> for 'n::x', the first is in line 8")));
  ModuleSpec array;
  array.schema.variables.push_back(variable("n::z"));
  array.schema.variables[0].kind = abi::Kind::Ring;
  array.schema.variables[0].type.dims = {3};
  array.schema.variables[0].type_hash = schema::hash_of(array.schema.variables[0].type);
  array.reads = {"n::z"};
  array.writes = {"n::z"};
  write_module(folder_ / "z.so", array);
  EXPECT_THAT(check_lines(board("a", periodic("z.so", "1ms", 1)) + "<variable name=\"z[1]\" every=\"1s\"/>"),
              ElementsAre(AllOf(HasSubstr("'z[1]' is a part of a variable"), HasSubstr("write name=\"n::z\""))));
}

TEST_F(CheckPlant, Layouts_that_differ_between_boards_are_an_error_naming_both) {
  write("w.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {}, 0, schema::Base::Float);
  EXPECT_THAT(check_lines(board("a", periodic("w.so", "1ms", 1)) + board("b", periodic("r.so", "1ms", 1))),
              ElementsAre(AllOf(HasSubstr("plant.xml:4:"), HasSubstr("error: variable 'n::x' differs between w@a ("),
                                HasSubstr(") and r@b ("), HasSubstr("double"), HasSubstr("float"))));
}

TEST_F(CheckPlant, Layouts_that_differ_on_one_board_are_reported_once) {
  write("w.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {}, 0, schema::Base::Float);
  EXPECT_THAT(check_lines(board("a", periodic("w.so", "1ms", 1) + periodic("r.so", "1ms", 2))),
              ElementsAre(HasSubstr("error: variable 'n::x' differs between w@a")));
}

TEST_F(CheckPlant, Processes_and_declared_names_count) {
  write("w.so", {}, {"n::x"});
  write_channel("p.exe", {}, "4read");
  const CheckedPlant sut = checked(board("a", periodic("w.so", "1ms", 1)) +
                                   board("b", process("p.exe", "<access><read>n::x</read></access>")));
  EXPECT_THAT(sut.lines(), IsEmpty());
  ASSERT_EQ(sut.result.routes.size(), 1U);
  EXPECT_EQ(sut.result.routes[0].oldest, base::Nanos(0));  // the reader is not periodic
  EXPECT_THAT(names_of(sut.result.boards[1].schema), ElementsAre("n::x"));
  EXPECT_THAT(check_lines(board("a", periodic("w.so", "1ms", 1)) +
                          board("b", process("p.exe", "<access><read>n::z</read></access>"))),
              Contains(HasSubstr("error: <read>: ")));
}

TEST_F(CheckPlant, Readers_by_unknown_names_get_nothing_from_other_boards_and_are_warned) {
  write("w.so", {}, {"n::x"});
  write_channel("p.exe", {"n::x"}, "4read");
  EXPECT_THAT(check_lines(board("a", periodic("w.so", "1ms", 1)) + board("b", process("p.exe"))),
              ElementsAre(AllOf(HasSubstr("warning: p@b reads by name"), HasSubstr("such as n::x")),
                          HasSubstr("note: p reads variables by name")));
}

TEST_F(CheckPlant, Writers_by_unknown_names_must_be_declared_for_their_values_to_travel) {
  write("r.so", {"n::x"}, {});
  write_channel("p.exe", {"n::x"}, "5write");
  const std::string reader = board("b", periodic("r.so", "1ms", 1));
  EXPECT_THAT(check_lines(board("a", process("p.exe")) + reader),
              ElementsAre(AllOf(HasSubstr("warning: 'n::x' is read by r@b but no module is known to write it"),
                                HasSubstr("perhaps p@a does: name it there in <access><write>")),
                          HasSubstr("note: p writes variables by name")));
  EXPECT_EQ(checked(board("a", process("p.exe", "<access><write>x</write></access>")) + reader).result.routes.size(),
            1U);
  const CheckedPlant owned = checked(board("a", process("p.exe")) + reader + "<variable name=\"x\" owner=\"a\"/>");
  EXPECT_EQ(owned.result.routes.size(), 1U);
  EXPECT_THAT(owned.lines(), ElementsAre(HasSubstr("note: p writes variables by name")));
}

TEST_F(CheckPlant, Age_is_a_cycle_of_the_writer_plus_the_network) {
  const CheckedPlant sut = checked(writer_and_reader());
  EXPECT_THAT(
      sut.lines(),
      ElementsAre(HasSubstr("note: r@b gets n::x from w@a up to 2 ms old (0 to 1 cycle of w plus up to 1 ms ")));
  EXPECT_EQ(sut.result.routes[0].oldest, milliseconds(2));
  const CheckedPlant limited = checked(writer_and_reader("4ms") + "<variable name=\"x\" every=\"10ms\"/>");
  EXPECT_THAT(limited.lines(), ElementsAre(HasSubstr("from w@a up to 13 ms old (0 to 3 cycles of w plus ")));
}

TEST_F(CheckPlant, Age_beyond_maxage_is_a_warning_with_the_reason) {
  EXPECT_THAT(check_lines(writer_and_reader("10ms", 11'000'000)), IsEmpty());
  EXPECT_THAT(check_lines(writer_and_reader("10ms", 10'000'000)),
              ElementsAre(AllOf(HasSubstr("warning: 'n::x' is up to 11 ms old when r@b reads it, its maxage is 10 ms"),
                                HasSubstr("let w@a run more often"))));
  EXPECT_THAT(check_lines(writer_and_reader("1ms", 10'000'000) + "<variable name=\"x\" every=\"10ms\"/>"),
              ElementsAre(AllOf(HasSubstr("plant.xml:6:17: warning: 'n::x' is sent every 10 ms at most"),
                                HasSubstr("invalid in between"))));
  EXPECT_THAT(check_lines(writer_and_reader("500us", 1'000'000)),
              ElementsAre(AllOf(HasSubstr("its maxage is 1 ms, but the network alone may take 1 ms"))));
}

TEST_F(CheckPlant, A_missing_file_with_an_absolute_name_was_not_deployed) {
  const std::string boards = board("a", periodic("/nosuch/a.so", "1ms", 1)) + board("b", periodic("b.so", "1ms", 1));
  write_module(folder_ / "b.so", {});
  EXPECT_THAT(
      checked(boards, {.board = "b"}).lines(),
      ElementsAre(AllOf(HasSubstr("no such file: '/nosuch/a.so'"), HasSubstr("is not deployed: copy it to every"))));
  EXPECT_THAT(checked(boards).lines(), ElementsAre(Not(HasSubstr("deployed"))));
}

TEST_F(CheckPlant, Type_libraries_are_checked) {
  write("lib_types.so", {}, {});
  write_channel("p.exe", {}, "4read");
  EXPECT_THAT(check_lines("<types>lib_types.so</types>" + board("a", "")), IsEmpty());
  EXPECT_THAT(check_lines("<types>lib_type.so</types>" + board("a", "")),
              ElementsAre(AllOf(HasSubstr("plant.xml:2:8: error: no such file: 'lib_type.so'"),
                                HasSubstr("did you mean 'lib_types.so'?"))));
  EXPECT_THAT(check_lines("<types>p.exe</types>" + board("a", "")),
              ElementsAre(HasSubstr("'p.exe' is a program, not a library of types")));
}

TEST_F(CheckPlant, Each_board_has_its_own_schedule_and_its_own_errors) {
  write("a.so", {}, {});
  const CheckedPlant sut =
      checked(board("a", periodic("a.so", "1ms", 1)) +
              board("b", periodic("a.so", "130us", 1) + periodic("a.so", "300us", 2, "<name>c</name>")) +
              board("c", "<minimum_period>10us</minimum_period>" + periodic("a.so", "30us", 1) +
                             periodic("none.so", "20us", 1)));
  EXPECT_EQ(sut.result.boards[0].table.basic_period, milliseconds(1));
  EXPECT_TRUE(sut.result.boards[0].ok());
  EXPECT_FALSE(sut.result.boards[1].ok());
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("error: the basic period (GCD of the periods) is 10 us"),
                                       HasSubstr("error: no such file: 'none.so'")));
  EXPECT_FALSE(sut.result.ok());
}

TEST_F(CheckPlant, Without_files_only_schedules_are_checked) {
  const CheckedPlant sut =
      checked(board("a", periodic("none.so", "1ms", 1)) + "<variable name=\"x\" owner=\"a\"/>", {.files = false});
  EXPECT_THAT(sut.lines(), IsEmpty());
  EXPECT_EQ(sut.result.boards[0].table.macro_period, milliseconds(1));
}

}  // namespace
}  // namespace indurop::config
