// SPDX-License-Identifier: Apache-2.0
// Meaning of module.xml: every element, its defaults, and what is refused.

#include "configuration.h"

#include <csignal>

namespace indurop::config {
namespace {

using scheduler::ModuleType;
using scheduler::Operation;
using scheduler::OverrunPolicy;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Reader, Defaults_of_a_periodic_thread) {
  const Config sut = config_of(root(periodic("./build/Robot.so", "10000000", 2)));
  ASSERT_EQ(sut.modules.size(), 1U);
  const Module& m = sut.modules[0];
  EXPECT_EQ(m.name, "Robot");
  EXPECT_EQ(m.type, ModuleType::Thread);
  EXPECT_EQ(m.operation, Operation::Periodic);
  EXPECT_EQ(m.period, base::Nanos(milliseconds(10)));
  EXPECT_EQ(m.offset, base::Nanos(0));
  EXPECT_EQ(m.deadline, base::Nanos(0));
  EXPECT_EQ(m.budget, base::Nanos(0));
  EXPECT_EQ(m.priority, 2);
  EXPECT_EQ(m.core, -1);
  EXPECT_EQ(m.overrun, OverrunPolicy::Skip);
  EXPECT_EQ(m.signal, 0);
  EXPECT_EQ(m.restart.max, 3U);
  EXPECT_FALSE(sut.minimum_period.has_value());
  EXPECT_FALSE(sut.spin.has_value());
  EXPECT_EQ(sut.core, -1);
}

TEST(Reader, Every_element_reaches_the_module) {
  const Config sut = config_of(R"(<root>
  <minimum_period>20us</minimum_period> <spin>15us</spin> <core>1</core>
  <module>
    <name>vision</name>
    <filename>vision.exe</filename>
    <moduletype> process </moduletype>
    <operationtype>periodic</operationtype>
    <period>2ms</period> <offset>1ms</offset> <priority>-7</priority> <deadline>1.5ms</deadline>
    <budget>off</budget> <core>0</core> <overrun>catch-up</overrun> <signal>SIGUSR2</signal>
    <argument>--camera</argument> <argument></argument> <argument>a &amp; b</argument>
    <access><read>knu::Robot::tick</read><write>a</write><write>b[1].x</write></access>
    <restart delay="0" max="0" window="1min" escalate="stop-node"/>
    <failsafe variable="PLC_ROBOT::O0">0</failsafe> <failsafe variable="x">{y: 1}</failsafe>
    <property><value name="counter">5</value></property>
    <property><value name="empty"/><value name="text"><![CDATA[<a> & b]]></value></property>
  </module>
</root>)");
  EXPECT_EQ(sut.minimum_period, base::Nanos(microseconds(20)));
  ASSERT_TRUE(sut.spin.has_value());
  EXPECT_EQ(sut.spin->mode, SpinSetting::Mode::Fixed);
  EXPECT_EQ(sut.spin->fixed, base::Nanos(microseconds(15)));
  EXPECT_EQ(sut.core, 1);
  const Module& m = sut.modules.at(0);
  EXPECT_EQ(m.name, "vision");
  EXPECT_EQ(m.type, ModuleType::Process);
  EXPECT_EQ(m.offset, base::Nanos(milliseconds(1)));
  EXPECT_EQ(m.priority, -7);
  EXPECT_EQ(m.deadline, base::Nanos(microseconds(1500)));
  EXPECT_EQ(m.budget, kNoBudget);
  EXPECT_EQ(m.core, 0);
  EXPECT_EQ(m.overrun, OverrunPolicy::CatchUp);
  EXPECT_EQ(m.signal, SIGUSR2);
  EXPECT_THAT(m.arguments, ElementsAre("--camera", "", "a & b"));
  EXPECT_THAT(m.reads, ElementsAre("knu::Robot::tick"));
  EXPECT_THAT(m.writes, ElementsAre("a", "b[1].x"));
  EXPECT_EQ(m.restart.delay, base::Nanos(0));
  EXPECT_EQ(m.restart.max, 0U);
  EXPECT_EQ(m.restart.window, base::Nanos(seconds(60)));
  EXPECT_EQ(m.restart.escalate, Restart::Escalate::StopNode);
  ASSERT_EQ(m.failsafe.size(), 2U);
  EXPECT_EQ(m.failsafe[1].variable, "x");
  EXPECT_EQ(m.failsafe[1].value, "{y: 1}");
  ASSERT_EQ(m.properties.size(), 3U);
  EXPECT_EQ(m.properties[0].value, "5");
  EXPECT_EQ(m.properties[1].value, "");
  EXPECT_EQ(m.properties[2].value, "<a> & b");
  EXPECT_EQ(m.place.line, 3);
  EXPECT_EQ(m.place.column, 3);
}

TEST(Reader, Comments_and_entities_inside_values_do_not_matter) {
  const Config sut = config_of(root(periodic("a&#46;so", "10<!-- ten -->0us", 1)));
  EXPECT_EQ(sut.modules[0].name, "a");
  EXPECT_EQ(sut.modules[0].period, base::Nanos(microseconds(100)));
}

TEST(Reader, Schema_attributes_of_editors_are_accepted) {
  EXPECT_THAT(errors_of("<root xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
                        "xsi:noNamespaceSchemaLocation=\"module.xsd\">" +
                        periodic("a.so", "1ms", 1) + "</root>"),
              IsEmpty());
}

TEST(Reader, Sporadic_position) {
  const Config sut =
      config_of(root(sporadic("a.so", "thread", 1, "<position>after-base</position>") + sporadic("b.so", "thread", 2)));
  EXPECT_TRUE(sut.modules[0].after_base);
  EXPECT_FALSE(sut.modules[1].after_base);
}

TEST(Reader, Names_tell_modules_apart) {
  const auto names = [](const std::string& xml) {
    std::vector<std::string> all;
    for (const Module& m : config_of(xml).modules) {
      all.push_back(m.name);
    }
    return all;
  };
  EXPECT_THAT(names(root(periodic("x/a.so", "1ms", 1) + non_real("b.tar.exe"))), ElementsAre("a", "b.tar"));
  EXPECT_THAT(names(root(periodic("a.so", "1ms", 1) + non_real("a.exe") + non_real("c"))),
              ElementsAre("a.so", "a.exe", "c"));
  EXPECT_THAT(
      names(root(periodic("a.so", "1ms", 1, "<name>left</name>") + periodic("a.so", "1ms", 2, "<name>right</name>"))),
      ElementsAre("left", "right"));
  EXPECT_THAT(names(root(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, "<name>a</name>"))),
              ElementsAre("a.so", "a"));
  EXPECT_THAT(names(root(periodic("\xEB\xA1\x9C\xEB\xB4\x87.so", "1ms", 1))), ElementsAre("\xEB\xA1\x9C\xEB\xB4\x87"));
}

TEST(Reader, Names_that_do_not_are_refused) {
  EXPECT_THAT(errors_of(root(periodic("a.so", "1ms", 1) + periodic("a.so", "1ms", 2))),
              ElementsAre(AllOf(StartsWith("m.xml:3:19: error: a second module named 'a.so'"),
                                HasSubstr("different <name>s"))));
  EXPECT_THAT(errors_of(root(periodic("x/a.so", "1ms", 1) + periodic("y/a.so", "1ms", 2))),
              ElementsAre(HasSubstr("another <name>")));
  EXPECT_THAT(
      errors_of(root(periodic("a.so", "1ms", 1, "<name>n</name>") + periodic("b.so", "1ms", 2, "<name>n</name>"))),
      ElementsAre(HasSubstr("a second module named 'n'")));
  EXPECT_THAT(errors_of(root(periodic("a.so", "1ms", 1, "<name>a b</name>"))),
              ElementsAre(HasSubstr("not a module name")));
  EXPECT_THAT(errors_of(root(periodic("a.so", "1ms", 1, "<name>" + std::string(96, 'x') + "</name>"))),
              ElementsAre(HasSubstr("longer than 95 bytes")));
  EXPECT_THAT(errors_of(root(periodic(std::string(96, 'x') + ".so", "1ms", 1))),
              ElementsAre(HasSubstr("short <name>")));
}

TEST(Reader, Values_out_of_range_are_refused) {
  const auto with = [](const std::string& more) { return errors_of(root(periodic("a.so", "1ms", 1, more))); };
  EXPECT_THAT(with("<offset>1ms</offset>"), ElementsAre(HasSubstr("not shorter than the period")));
  EXPECT_THAT(with("<offset>0</offset>"), IsEmpty());
  EXPECT_THAT(with("<deadline>2ms</deadline>"), ElementsAre(HasSubstr("warning: the deadline 2 ms is longer")));
  EXPECT_THAT(with("<budget>none</budget>"), ElementsAre(HasSubstr("<budget>: 'none' is not a duration")));
  EXPECT_THAT(with("<core>-1</core>"), ElementsAre(HasSubstr("not a processor number")));
  EXPECT_THAT(with("<core>4096</core>"), ElementsAre(HasSubstr("not a processor number")));
  EXPECT_THAT(with("<overrun>stop</overrun>"),
              ElementsAre(HasSubstr("write skip, catch-up, stop-module or stop-node")));
  EXPECT_THAT(with("<failsafe>0</failsafe>"), ElementsAre(HasSubstr("<failsafe> needs a variable")));
  EXPECT_THAT(with("<failsafe variable=\"x\"/>"), ElementsAre(HasSubstr("has no value")));
  EXPECT_THAT(with("<access><reads>x</reads></access>"), ElementsAre(HasSubstr("did you mean 'read'?")));
  EXPECT_THAT(with("<access><read/></access>"), ElementsAre(HasSubstr("<read> is empty")));
  EXPECT_THAT(with("<name/>"), ElementsAre(HasSubstr("<name> is empty")));
  EXPECT_THAT(errors_of(root(periodic("a.so", "1ms", 1) + "<spin>0</spin>")),
              ElementsAre(HasSubstr("write auto, off")));
  EXPECT_THAT(errors_of(root(periodic("lib/", "1ms", 1))), ElementsAre(HasSubstr("is a directory")));
  EXPECT_THAT(errors_of(root(periodic("..", "1ms", 1))), ElementsAre(HasSubstr("is a directory")));
}

TEST(Reader, Any_32_bit_priority_is_accepted_and_no_other) {
  const auto with = [](const std::string& priority) {
    return errors_of(
        "<root><module><filename>a.so</filename><moduletype>thread</moduletype><operationtype>periodic"
        "</operationtype><period>1ms</period><priority>" +
        priority + "</priority></module></root>");
  };
  EXPECT_THAT(with("-2147483648"), IsEmpty());
  EXPECT_THAT(with("2147483647"), IsEmpty());
  EXPECT_THAT(with("+3"), IsEmpty());
  for (const char* bad : {"2147483648", "-2147483649", "1.5", "high", "1 2", "0x1", "+-1"}) {
    EXPECT_THAT(with(bad), ElementsAre(HasSubstr("not a whole number"))) << bad;
  }
}

TEST(Reader, Elements_without_effect_are_warnings) {
  EXPECT_THAT(
      errors_of(root(periodic("a.so", "1ms", 1, "<signal>USR1</signal><argument>x</argument><restart max=\"1\"/>"))),
      ElementsAre(HasSubstr("warning: <signal>"), HasSubstr("warning: <argument>"), HasSubstr("warning: <restart>")));
  EXPECT_THAT(errors_of(root(sporadic("a.so", "thread", 1, "<period>1ms</period>"))),
              ElementsAre(HasSubstr("warning: <period> has no effect on a sporadic module")));
  EXPECT_THAT(errors_of(root(non_real("a.exe", "<priority>1</priority>"))),
              ElementsAre(HasSubstr("warning: <priority> has no effect on a non-real-time module")));
  EXPECT_THAT(errors_of(root(periodic("a.so", "1ms", 1, "<position>after-base</position>"))),
              ElementsAre(HasSubstr("warning: <position>")));
  EXPECT_THAT(errors_of(root(sporadic("a.exe", "process", 1, "<position>after-base</position><core>0</core>"))),
              ElementsAre(HasSubstr("warning: <position> has no effect on a sporadic process")));
  EXPECT_THAT(errors_of(root(sporadic("a.so", "thread", 1, "<core>0</core>"))),
              ElementsAre(HasSubstr("warning: <core> has no effect on a sporadic thread")));
}

TEST(Reader, Non_real_time_thread_may_have_a_period) {
  const Config sut = config_of(
      "<root><module><filename>a.so</filename><moduletype>thread</moduletype><operationtype>non-real</operationtype>"
      "<period>1s</period></module></root>");
  EXPECT_EQ(sut.modules[0].period, base::Nanos(seconds(1)));
  EXPECT_THAT(errors_of(root(non_real("a.exe", "<period>1s</period>"))),
              ElementsAre(HasSubstr("warning: <period> has no effect on a non-real-time process")));
}

TEST(Reader, Forgotten_end_of_an_element_is_recognised) {
  EXPECT_THAT(errors_of("<root><module><filename>a.so<period>1</period></filename></module></root>"),
              Contains(HasSubstr("is </filename> missing before it?")));
}

TEST(Reader, Root_of_another_name_or_without_modules_is_refused) {
  EXPECT_THAT(errors_of("<modules/>"), ElementsAre(StartsWith("m.xml:1:1: error: the root element is <modules>")));
  EXPECT_THAT(errors_of("<root/>"), ElementsAre(HasSubstr("has no <module>")));
}

}  // namespace
}  // namespace indurop::config
