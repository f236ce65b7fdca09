// SPDX-License-Identifier: Apache-2.0
// The forms of the plan: well-formed for odd names and extreme schedules. Their exact text is in tests/golden/config.

#include "config/plan/plan.h"

#include <nlohmann/json.hpp>

#include "configuration.h"
#include "core/base/xml.h"

namespace indurop::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const CheckOptions kPlanOnly{.files = false, .adjust = false};

bool is_well_formed(const std::string& xml) {
  base::XmlRules rules;
  rules.max_bytes = xml.size();
  rules.max_depth = 32;
  std::vector<base::XmlMistake> mistakes;
  return base::read_xml(xml, rules, mistakes).has_value();
}

TEST(Plan, Json_has_the_promised_fields) {
  const Checked c =
      check(root(periodic("a.so", "1ms", 1) + sporadic("s.so", "thread", 1) + non_real("n.exe")), kPlanOnly);
  const auto sut = nlohmann::ordered_json::parse(plan_json(c.config, c.result));
  std::vector<std::string> keys;
  for (const auto& [key, value] : sut.items()) {
    keys.push_back(key);
  }
  EXPECT_THAT(keys, ElementsAre("basic_period_ns", "macro_period_ns", "slots", "sporadic", "non_real"));
  EXPECT_EQ(sut["basic_period_ns"], 1'000'000);
  EXPECT_EQ(sut["slots"][0], nlohmann::ordered_json::parse(R"({"slot":0,"time_ns":0,"modules":["a"]})"));
  EXPECT_EQ(sut["sporadic"][0], "s");
  EXPECT_EQ(sut["non_real"][0], "n");
}

TEST(Plan, Names_with_special_characters_stay_readable_in_every_form) {
  const Checked c = check(root(periodic("a &lt;b&gt; &quot;c&quot;, d.so", "1ms", 1)), kPlanOnly);
  EXPECT_EQ(nlohmann::json::parse(plan_json(c.config, c.result))["slots"][0]["modules"][0], "a <b> \"c\", d");
  EXPECT_THAT(plan_csv(c.config, c.result), HasSubstr("0,0,\"a <b> \"\"c\"\", d\"\n"));
  EXPECT_THAT(plan_svg(c.config, c.result), HasSubstr("a &lt;b&gt; &quot;c&quot;, d"));
  EXPECT_TRUE(is_well_formed(plan_svg(c.config, c.result)));
}

TEST(Plan, Equal_basic_periods_of_a_long_table_share_a_line) {
  const Checked c = check(root(periodic("fast.so", "1ms", 1) + periodic("slow.so", "1s", 2)), kPlanOnly);
  EXPECT_THAT(plan_table(c.config, c.result), HasSubstr("1-999"));
  EXPECT_THAT(plan_table(c.config, c.result), Not(HasSubstr("\n                  2 ")));
}

TEST(Plan, Schedules_of_any_size_are_drawn) {
  std::string many;
  for (int i = 0; i < 300; ++i) {
    many += periodic("module_number_" + std::to_string(i) + ".so", i < 150 ? "1ms" : "7ms", i);
  }
  const std::string whole_year = root(periodic("a.so", "1ms", 1) + periodic("b.so", "31536000s", 2));
  for (const std::string& xml : {root(many), whole_year, root(non_real("n.exe")), root(sporadic("s.so", "thread", 1)),
                                 root(periodic("a.so", "9223372036854775807", 1))}) {
    const Checked c = check(xml, kPlanOnly);
    EXPECT_TRUE(is_well_formed(plan_svg(c.config, c.result)));
    EXPECT_FALSE(plan_table(c.config, c.result).empty());
    EXPECT_TRUE(nlohmann::json::accept(plan_json(c.config, c.result)));
    EXPECT_LT(plan_svg(c.config, c.result).size(), 4'000'000U);
  }
}

TEST(Plan, Basic_periods_left_out_of_json_are_counted) {
  const Checked c = check(root(periodic("a.so", "1ms", 1) + periodic("b.so", "1000s", 2)), kPlanOnly);
  const auto sut = nlohmann::json::parse(plan_json(c.config, c.result));
  EXPECT_EQ(sut["slots"].size(), 100'000U);
  EXPECT_EQ(sut["slots_left_out"], 900'000U);
}

}  // namespace
}  // namespace indurop::config
