// SPDX-License-Identifier: Apache-2.0
// What the access map tells: writers, readers, order and age, fail-safe values.

#include <algorithm>
#include <fstream>

#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CheckAccess : public testing::Test {
 protected:
  // A thread module that reads and writes the given variables, all of them doubles in namespace n.
  void write(const std::string& name, const std::vector<std::string>& reads, const std::vector<std::string>& writes,
             std::int64_t maxage_ns = 0) {
    ModuleSpec spec;
    for (const auto* list : {&reads, &writes}) {
      for (const std::string& v : *list) {
        schema::Variable made = variable(v);
        made.maxage_ns = maxage_ns;
        const bool known = std::any_of(spec.schema.variables.begin(), spec.schema.variables.end(),
                                       [&](const schema::Variable& other) { return other.name == v; });
        if (!known) {
          spec.schema.variables.push_back(made);
        }
      }
    }
    spec.reads = reads;
    spec.writes = writes;
    write_module(folder_ / name, spec);
  }
  Checked checked(const std::string& modules) { return check(root(modules), CheckOptions{}, folder_ / "module.xml"); }
  // Diagnostics without the notes on age, which nearly every test has.
  std::vector<std::string> check_lines(const std::string& modules) {
    std::vector<std::string> all = checked(modules).lines();
    std::erase_if(all, [](const std::string& line) { return line.find(" gets ") != std::string::npos; });
    return all;
  }

  ModuleFolder folder_;
};

TEST_F(CheckAccess, Uses_are_listed_by_name_with_modules_in_order_of_execution) {
  write("w.so", {}, {"n::b", "n::a"});
  write("r.so", {"n::a", "n::b"}, {});
  write("q.so", {"n::a"}, {});
  const Checked sut = checked(periodic("r.so", "1ms", 3) + periodic("w.so", "1ms", 1) + periodic("q.so", "1ms", 2));
  ASSERT_EQ(sut.result.uses.size(), 2U);
  EXPECT_EQ(sut.result.uses[0].name, "n::a");
  EXPECT_THAT(sut.result.uses[0].writers, ElementsAre("w"));
  EXPECT_THAT(sut.result.uses[0].readers, ElementsAre("q", "r"));
  EXPECT_TRUE(sut.result.ok());
}

TEST_F(CheckAccess, Two_writers_are_a_warning_naming_both) {
  write("a.so", {}, {"n::x"});
  write("b.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {});
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2) + periodic("r.so", "1ms", 3)),
              ElementsAre(AllOf(HasSubstr("warning: 'n::x' is written by a and b"))));
}

TEST_F(CheckAccess, Read_but_never_written_is_a_warning_and_the_reverse_a_note) {
  write("a.so", {"n::in"}, {"n::out"});
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1)),
              ElementsAre(HasSubstr("warning: 'n::in' is read by a but no module writes it"),
                          HasSubstr("note: 'n::out' is written by a but no module reads it")));
}

TEST_F(CheckAccess, Read_but_never_written_with_a_value_of_its_own_is_a_parameter) {
  ModuleSpec spec;
  spec.schema.variables.push_back(variable("n::gain"));
  spec.schema.variables.back().initial = {0, 0, 0, 0, 0, 0, 0, 0x40};
  spec.reads = {"n::gain"};
  write_module(folder_ / "a.so", spec);
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1)),
              ElementsAre(HasSubstr("note: 'n::gain' is read by a but no module writes it: a parameter")));
}

TEST_F(CheckAccess, Optional_variables_need_no_writer) {
  ModuleSpec spec;
  spec.schema.variables.push_back(variable("n::button"));
  spec.schema.variables.back().optional = true;
  spec.reads = {"n::button"};
  write_module(folder_ / "a.so", spec);
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1)), IsEmpty());
}

TEST_F(CheckAccess, For_sensor_control_and_motor_in_the_wrong_order_a_message_says_what_to_swap) {
  write("RS.so", {}, {"n::sensor"});
  write("GC.so", {"n::sensor"}, {"n::command"});
  write("WM.so", {"n::command"}, {});
  EXPECT_THAT(check_lines(periodic("RS.so", "1ms", 2) + periodic("GC.so", "1ms", 1) + periodic("WM.so", "1ms", 3)),
              ElementsAre(AllOf(HasSubstr("warning: GC runs before RS and reads the n::sensor it wrote 1 ms before"),
                                HasSubstr("swap their priorities: RS 1, GC 2"))));
  EXPECT_THAT(check_lines(periodic("RS.so", "1ms", 1) + periodic("GC.so", "1ms", 2) + periodic("WM.so", "1ms", 3)),
              IsEmpty());
}

TEST_F(CheckAccess, Order_that_no_swap_repairs_is_proposed_as_a_whole) {
  write("RS.so", {}, {"n::sensor"});
  write("GC.so", {"n::sensor"}, {"n::command"});
  write("WM.so", {"n::command"}, {});
  EXPECT_THAT(check_lines(periodic("WM.so", "1ms", 1) + periodic("GC.so", "1ms", 2) + periodic("RS.so", "1ms", 3)),
              ElementsAre(HasSubstr("in the order RS > GC > WM"), HasSubstr("in the order RS > GC > WM")));
}

TEST_F(CheckAccess, Equal_priorities_cannot_be_swapped) {
  write("w.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {});
  EXPECT_THAT(check_lines(periodic("r.so", "1ms", 1) + periodic("w.so", "1ms", 1)),
              ElementsAre(HasSubstr("give them priorities in the order w > r")));
}

TEST_F(CheckAccess, Loops_are_noted_not_warned_of) {
  write("a.so", {"n::y"}, {"n::x"});
  write("b.so", {"n::x"}, {"n::y"});
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2)),
              ElementsAre(AllOf(HasSubstr("note: a runs before b"), HasSubstr("they exchange values in a cycle"))));
}

TEST_F(CheckAccess, Modules_never_released_together_have_no_wrong_order) {
  write("w.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {});
  EXPECT_THAT(check_lines(periodic("r.so", "2ms", 1) + periodic("w.so", "2ms", 2, "<offset>1ms</offset>")), IsEmpty());
}

TEST_F(CheckAccess, The_age_is_reported_for_every_pair) {
  write("w.so", {}, {"n::x", "n::y"});
  write("r.so", {"n::x", "n::y"}, {});
  EXPECT_THAT(checked(periodic("w.so", "500us", 1) + periodic("r.so", "100us", 2)).lines(),
              ElementsAre(HasSubstr("note: r gets n::x and n::y from w up to 400 us old (0 to 4 basic periods)")));
}

TEST_F(CheckAccess, Age_beyond_maxage_is_a_warning) {
  write("w.so", {}, {"n::x"}, 200'000);
  write("r.so", {"n::x"}, {}, 200'000);
  EXPECT_THAT(check_lines(periodic("w.so", "500us", 1) + periodic("r.so", "100us", 2)),
              ElementsAre(AllOf(HasSubstr("'n::x' is up to 400 us old"), HasSubstr("its maxage is 200 us"))));
}

TEST_F(CheckAccess, Names_in_access_count_and_must_exist) {
  write("w.so", {}, {"n::x"});
  ModuleSpec user{
      .program = true, .exports = {}, .imports = {"_ZN3irp10waitPeriodEv", "_ZN7channel4readERNS_6HandleE"}};
  write_module(folder_ / "p.exe", user);
  EXPECT_THAT(
      check_lines(periodic("w.so", "1ms", 1) + sporadic("p.exe", "process", 1, "<access><read>x</read></access>")),
      IsEmpty());
  EXPECT_THAT(
      check_lines(periodic("w.so", "1ms", 1) + sporadic("p.exe", "process", 1, "<access><read>n::y</read></access>")),
      Contains(AllOf(HasSubstr("module.xml:3:"), HasSubstr("error: <read>: "))));
}

TEST_F(CheckAccess, Access_by_name_that_is_not_declared_is_noted_and_weakens_conclusions) {
  write("a.so", {"n::in"}, {"n::out"});
  ModuleSpec user{
      .program = true,
      .exports = {},
      .imports = {"_ZN3irp10waitPeriodEv", "_ZN7channel4readERNS_6HandleE", "_ZN7channel5writeERNS_6HandleE"}};
  write_module(folder_ / "p.exe", user);
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1) + sporadic("p.exe", "process", 1)),
              ElementsAre(HasSubstr("note: p reads and writes variables by name"),
                          HasSubstr("note: 'n::in' is read by a but no module is known to write it; perhaps p does")));
}

TEST_F(CheckAccess, Fail_safe_values_must_fit_their_variable) {
  write("w.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {});
  const std::string r = periodic("r.so", "1ms", 2);
  EXPECT_THAT(check_lines(periodic("w.so", "1ms", 1, "<failsafe variable=\"x\">1.5</failsafe>") + r), IsEmpty());
  EXPECT_THAT(check_lines(periodic("w.so", "1ms", 1, "<failsafe variable=\"n::z\">0</failsafe>") + r),
              ElementsAre(HasSubstr("error: <failsafe>: ")));
  EXPECT_THAT(check_lines(periodic("w.so", "1ms", 1, "<failsafe variable=\"x\">fast</failsafe>") + r),
              ElementsAre(HasSubstr("error: <failsafe>: ")));
}

TEST_F(CheckAccess, Fail_safe_values_keep_the_range_of_their_variable) {
  ModuleSpec spec;
  spec.schema.variables.push_back(variable("n::x"));
  spec.schema.variables.back().range = schema::Range{-1, 1};
  spec.reads = spec.writes = {"n::x"};
  write_module(folder_ / "w.so", spec);
  EXPECT_THAT(check_lines(periodic("w.so", "1ms", 1, "<failsafe variable=\"x\">1</failsafe>")), IsEmpty());
  EXPECT_THAT(check_lines(periodic("w.so", "1ms", 1, "<failsafe variable=\"x\">1.5</failsafe>")),
              ElementsAre(HasSubstr("error: <failsafe>: 1.5 is outside -1..1")));
}

TEST_F(CheckAccess, Recorded_values_are_read_as_the_node_would) {
  write("reader.so", {"n::a"}, {});
  ModuleSpec io;
  io.exports.emplace_back("indurop_io_format");
  write_module(folder_ / "io.so", io);
  std::ofstream(folder_ / "ioconfig.xml") << "<ioconfig><device name='rec' driver='csv' file='run.csv'>"
                                             "<input variable='n::a' at='a'/></device></ioconfig>";
  const std::string modules =
      periodic("io.so", "1ms", 1, "<property><value name='config'>ioconfig.xml</value></property>") +
      periodic("reader.so", "1ms", 2);
  EXPECT_THAT(checked(modules).lines(), Contains(HasSubstr("run.csv: error: cannot be read: No such file")));
  CheckOptions elsewhere;
  elsewhere.machine = false;  // what is not here may be there
  EXPECT_THAT(check(root(modules), elsewhere, folder_ / "module.xml").lines(), Not(Contains(HasSubstr("run.csv"))));
  std::ofstream(folder_ / "run.csv") << "time,a\n0,1\n1,one\n";
  EXPECT_THAT(checked(modules).lines(), Contains(HasSubstr("run.csv:3:3: error: 'one' is not a number")));
  std::ofstream(folder_ / "run.csv") << "time,b\n0,1\n";
  EXPECT_THAT(checked(modules).lines(), Contains(HasSubstr("run.csv:1:1: error: there is no column 'a'; there are b")));
  std::ofstream(folder_ / "run.csv") << "time,a\n0,1\n";
  EXPECT_THAT(checked(modules).lines(), Not(Contains(HasSubstr("run.csv"))));
}

}  // namespace
}  // namespace indurop::config
