// SPDX-License-Identifier: Apache-2.0
// What a scope may be asked: expressions, triggers, channels; and what it captured.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "tools/client/scope/channels.h"
#include "tools/client/scope/formula.h"
#include "tools/client/scope/save.h"
#include "tools/client/scope/trigger.h"

namespace indurop::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

const std::vector<schema::Enumerator> kModes{{"Idle", 0}, {"Moving", 2}};

Result<Operand, base::Problem> find(std::string_view name) {
  const std::map<std::string_view, Operand> known{{"a", {0, "mm", nullptr}},
                                                  {"b", {1, "mm", nullptr}},
                                                  {"knu::Robot::joints[1].y", {2, "rad", nullptr}},
                                                  {"mode", {3, "", &kModes}}};
  const auto found = known.find(name);
  return found != known.end() ? Result<Operand, base::Problem>(found->second)
                              : base::Problem{"there is no variable '" + std::string(name) + "'"};
}

double value(std::string_view text, std::vector<double> inputs = {3, 4, 5, 2}) {
  const auto formula = Formula::parse(text, find);
  EXPECT_TRUE(formula) << text << ": " << formula.error().text;
  return formula ? formula->value(inputs) : std::nan("");
}
std::string scope_problem(std::string_view text) {
  const auto formula = Formula::parse(text, find);
  EXPECT_FALSE(formula) << text;
  return formula ? "" : formula.error().text;
}
std::string unit(std::string_view text) {
  return Formula::parse(text, find).value().unit();
}

TEST(ScopeFormula, Binds_as_in_other_languages) {
  EXPECT_EQ(value("a + b * 2"), 11);
  EXPECT_EQ(value("(a+b)*2"), 14);
  EXPECT_EQ(value("-a - -b"), 1);
  EXPECT_EQ(value("a < b and not b < a or false"), 1);
  EXPECT_EQ(value("!(a>=3) || b != 4"), 0);
  EXPECT_EQ(value("7 % 4 / 2"), 1.5);
  EXPECT_EQ(value("max(a, b) + min(a, b) + abs(a - b) + sqrt(16)"), 12);
  EXPECT_EQ(value("knu::Robot::joints[1].y == 5"), 1);
  EXPECT_EQ(value("1e3"), 1000);
}

TEST(ScopeFormula, Knows_the_names_of_an_enumeration) {
  EXPECT_EQ(value("mode == Moving"), 1);
  EXPECT_EQ(value("mode != Idle and a > 0"), 1);
  EXPECT_THAT(scope_problem("a == Moving"), HasSubstr("no variable 'Moving'"));
}

TEST(ScopeFormula, What_is_not_known_is_not_true) {
  EXPECT_EQ(value("a < b", {std::nan(""), 4, 0, 0}), 0);
  EXPECT_EQ(value("a != b", {std::nan(""), 4, 0, 0}), 0);
  EXPECT_TRUE(std::isnan(value("a + b", {std::nan(""), 4, 0, 0})));
}

TEST(ScopeFormula, Takes_units_along) {
  EXPECT_EQ(unit("a - b"), "mm");
  EXPECT_EQ(unit("a + 2"), "mm");
  EXPECT_EQ(unit("2 * abs(a)"), "mm");
  EXPECT_EQ(unit("a / b"), "");
  EXPECT_EQ(unit("a / knu::Robot::joints[1].y"), "mm/rad");
  EXPECT_EQ(unit("a > b"), "");
  EXPECT_THAT(scope_problem("a + knu::Robot::joints[1].y"), HasSubstr("mm and rad do not go together"));
}

TEST(ScopeFormula, What_is_wrong_is_named_with_its_place) {
  EXPECT_THAT(scope_problem(""), HasSubstr("a name or a number is missing"));
  EXPECT_THAT(scope_problem("a +"), HasSubstr("place 4: a name or a number is missing"));
  EXPECT_THAT(scope_problem("a b"), HasSubstr("place 3: an operator is missing"));
  EXPECT_THAT(scope_problem("(a"), HasSubstr("')' is missing"));
  EXPECT_THAT(scope_problem("sin(a)"), HasSubstr("there is no function 'sin'; there are abs, sqrt, min, max"));
  EXPECT_THAT(scope_problem("min(a)"), HasSubstr("',' is missing"));
  EXPECT_THAT(scope_problem("a $ b"), HasSubstr("place 3"));
  EXPECT_THAT(scope_problem("missing > 1"), HasSubstr("there is no variable 'missing'"));
  EXPECT_THAT(scope_problem(std::string(2000, '(')), HasSubstr("too long"));
  EXPECT_THAT(scope_problem(std::string(900, '(')), HasSubstr("too many brackets"));
  EXPECT_THAT(scope_problem("joints[1"), HasSubstr("no variable"));
}

std::vector<int> fires(std::string_view text, const std::vector<double>& samples) {
  auto trigger = Trigger::parse(text, find);
  EXPECT_TRUE(trigger) << text;
  std::vector<int> out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (trigger->evaluate(std::vector<double>{samples[i], 0, 0, samples[i]})) {
      out.push_back(static_cast<int>(i));
    }
  }
  return out;
}

TEST(ScopeTrigger, Edges_and_conditions_fire_once_each_time) {
  const std::vector<double> samples{1, 0, 0, 1, 2, std::nan(""), 0, 3};
  EXPECT_THAT(fires("a rises", samples), ElementsAre(3, 7));
  EXPECT_THAT(fires("a falls", samples), ElementsAre(1, 6));
  EXPECT_THAT(fires("a changes", samples), ElementsAre(1, 3, 4, 6, 7));
  EXPECT_THAT(fires("a > 1", samples), ElementsAre(4, 7));
  EXPECT_THAT(fires("mode == Moving", samples), ElementsAre(4));
  EXPECT_THAT(fires("mode == Moving falls", samples), ElementsAre(5)) << "a comparison with what is not known is false";
}

TEST(ScopeTrigger, What_is_wrong_is_said_with_all_that_can_be_written) {
  const auto sut = Trigger::parse("a raises", find);
  ASSERT_FALSE(sut);
  EXPECT_THAT(sut.error().text, HasSubstr("rises, falls or changes"));
  EXPECT_THAT(sut.error().text, HasSubstr("=="));
}

schema::Type scalar(schema::Base base) {
  schema::Type type;
  type.base = base;
  type.element_size = schema::size_of(base);
  type.align = type.element_size;
  return type;
}

schema::Schema plant() {
  schema::Schema schema;
  schema::Variable joints;
  joints.name = "knu::Robot::joints";
  joints.type = scalar(schema::Base::Double);
  joints.type.dims = {3};
  joints.unit = "rad";
  schema::Variable on;
  on.name = "knu::Robot::on";
  on.type = scalar(schema::Base::Bool);
  schema::Variable label;
  label.name = "knu::label";
  label.type.base = schema::Base::Text;
  label.type.text_size = label.type.element_size = 16;
  schema::Variable pose;
  pose.name = "knu::pose";
  pose.type.base = schema::Base::Struct;
  pose.type.element_size = 16;
  pose.type.fields.push_back({"x", scalar(schema::Base::Double), 0, "mm", "", {}, {}});
  pose.type.fields.push_back({"y", scalar(schema::Base::Double), 8, "mm", "", {}, {}});
  schema.variables = {joints, on, label, pose};
  return schema;
}

std::vector<std::string> names(const ScopePlan& plan) {
  std::vector<std::string> out;
  for (const ScopeChannel& channel : plan.channels) {
    for (const ScopeLine& line : channel.lines) {
      out.push_back(channel.name + "/" + line.name + " " + channel.unit);
    }
  }
  return out;
}

TEST(ScopeChannels, Are_names_parts_globs_and_expressions) {
  const schema::Schema schema = plant();
  const auto plan =
      plan_scope(schema, {"joints", "pose", "knu::Robot::*", "d = joints[1] - joints[0]", "joints[0] * 2"}, "on rises");
  ASSERT_TRUE(plan) << plan.error().text;
  EXPECT_THAT(
      names(*plan),
      ElementsAre("joints/joints[0] rad", "joints/joints[1] rad", "joints/joints[2] rad", "pose.x/pose.x mm",
                  "pose.y/pose.y mm", "knu::Robot::joints/knu::Robot::joints[0] rad",
                  "knu::Robot::joints/knu::Robot::joints[1] rad", "knu::Robot::joints/knu::Robot::joints[2] rad",
                  "knu::Robot::on/knu::Robot::on ", "d/d rad", "joints[0] * 2/joints[0] * 2 rad"));
  EXPECT_THAT(plan->inputs, SizeIs(6)) << "each number is read once";
  EXPECT_TRUE(plan->trigger);
}

TEST(ScopeChannels, What_has_no_picture_is_refused) {
  const schema::Schema schema = plant();
  const auto wrong = [&](const std::string& channel, const std::string& trigger = "") {
    const auto plan = plan_scope(schema, {channel}, trigger);
    EXPECT_FALSE(plan);
    return plan ? "" : plan.error().text;
  };
  EXPECT_THAT(wrong("label"), HasSubstr("is text"));
  EXPECT_THAT(wrong("jonts"), HasSubstr("did you mean"));
  EXPECT_THAT(wrong("missing::*"), HasSubstr("no variable with numbers matches"));
  EXPECT_THAT(wrong("joints + 1"), HasSubstr("an expression needs a number of it"));
  EXPECT_THAT(wrong("on", "label rises"), StartsWith("trigger: 'label' is char[16]"));
  EXPECT_THAT(wrong("on", "on ="), StartsWith("trigger: "));
}

Capture picture() {
  Capture out;
  const auto plan = plan_scope(plant(), {"on", "joints"}, "on rises");
  out.channels = plan->channels;
  out.lines = {{0, 0, 1, 1}, {0.5, 1.5, std::nan(""), 3.5}, {0, 0, 0, 0}, {1, 1, 1, 1}};
  out.first_tick = 100;
  out.trigger_row = 2;
  out.trigger = "on rises";
  out.period_ns = 1'000'000;
  out.first_wall_ns = 5'000'000'000;
  return out;
}

TEST(ScopePicture, Has_its_trigger_at_0_s) {
  const Capture sut = picture();
  EXPECT_EQ(heading_of(sut), "on rises at tick 102, 2 ticks before and 1 after, every 1.00 ms");
  EXPECT_THAT(recording_of(sut).time_s, ElementsAre(-0.002, -0.001, 0, 0.001));
}

TEST(ScopePicture, As_csv_is_what_a_chart_reads) {
  const std::string csv = csv_of(picture());
  EXPECT_THAT(csv, StartsWith("time_ns,on,joints[0],joints[1],joints[2]\n5000000000,false,0.5,0,1\n"));
  EXPECT_THAT(csv, HasSubstr("5002000000,true,,0,1\n"));
  EXPECT_TRUE(read_recording(csv, "scope.csv"));
}

TEST(ScopePicture, As_json_says_what_is_not_known) {
  const base::Json json = json_of(picture());
  EXPECT_EQ(json["trigger_row"].natural(), 2U);
  EXPECT_EQ(json["first_tick"].natural(), 100U);
  EXPECT_EQ(json["lines"].values()[1]["values"].dump(), "[0.5,1.5,null,3.5]");
  EXPECT_EQ(json["lines"].values()[1]["name"].text(), "joints[0]");
  EXPECT_EQ(json["lines"].values()[1]["unit"].text(), "rad");
}

}  // namespace
}  // namespace indurop::tools
