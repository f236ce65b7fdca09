// SPDX-License-Identifier: Apache-2.0
// Which modules have to keep their order on several cores, and why.

#include <algorithm>

#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SharingTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::vector<std::string>& reads, const std::vector<std::string>& writes,
             const std::vector<std::string>& imports = {}) {
    ModuleSpec spec;
    for (const auto* list : {&reads, &writes}) {
      for (const std::string& v : *list) {
        spec.schema.variables.push_back(variable(v));
      }
    }
    spec.reads = reads;
    spec.writes = writes;
    spec.imports = imports;
    write_module(folder_ / name, spec);
  }
  // "a > b: why", in the order of execution.
  std::vector<std::string> sharing(const std::string& modules, const CheckOptions& options = {}) {
    const Checked checked = check(root(modules), options, folder_ / "module.xml");
    std::vector<std::string> all;
    for (const Sharing& one : checked.result.sharing) {
      all.push_back(checked.config.modules[one.first].name + " > " + checked.config.modules[one.second].name + ": " +
                    one.why);
    }
    return all;
  }

  ModuleFolder folder_;
};

TEST_F(SharingTest, Is_between_those_that_write_a_variable_and_all_others_that_use_it) {
  write("w.so", {}, {"n::a"});
  write("r.so", {"n::a"}, {});
  write("q.so", {"n::a"}, {});
  EXPECT_THAT(sharing(periodic("r.so", "1ms", 3) + periodic("w.so", "1ms", 2) + periodic("q.so", "1ms", 1)),
              ElementsAre("q > w: n::a", "w > r: n::a"))
      << "readers have nothing to do with one another";
}

TEST_F(SharingTest, Is_between_two_writers) {
  write("a.so", {}, {"n::a"});
  write("b.so", {}, {"n::a"});
  EXPECT_THAT(sharing(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 1)), ElementsAre("a > b: n::a"));
}

TEST_F(SharingTest, With_names_known_at_run_time_only_is_with_every_module_that_has_variables) {
  write("c.so", {}, {}, {"_ZN7channel5writeE"});
  write("a.so", {"n::a"}, {});
  write("nothing.so", {}, {});
  EXPECT_THAT(sharing(periodic("c.so", "1ms", 1) + periodic("a.so", "1ms", 2) + periodic("nothing.so", "1ms", 3)),
              ElementsAre(HasSubstr("c > a: names known only at run time")));
}

TEST_F(SharingTest, Is_between_callers_and_implementers_of_functions) {
  write("c.so", {}, {}, {"indurop_call"});
  write("i.so", {}, {}, {"indurop_offer_function"});
  write("d.so", {}, {}, {"indurop_call"});
  EXPECT_THAT(sharing(periodic("c.so", "1ms", 1) + periodic("i.so", "1ms", 2) + periodic("d.so", "1ms", 3)),
              ElementsAre("c > i: shared functions", "i > d: shared functions"));
}

TEST_F(SharingTest, Is_also_what_the_configuration_says) {
  write("a.so", {}, {});
  write("b.so", {}, {});
  EXPECT_THAT(sharing(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2)), IsEmpty());
  EXPECT_THAT(sharing(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, "<after>a</after>")),
              ElementsAre("a > b: <after>"));
}

TEST_F(SharingTest, Of_a_plan_without_files_is_taken_to_be_everything) {
  const std::string modules =
      periodic("a.so", "1ms", 1, "<core>0</core>") + periodic("b.so", "1ms", 2, "<core>1</core>");
  EXPECT_THAT(sharing(modules, {.files = false}), ElementsAre(HasSubstr("its file cannot be read")));
  EXPECT_THAT(check(root(modules), {.files = false}).lines(), IsEmpty()) << "a plan needs no files";
}

TEST(After, Names_a_module_that_is_earlier_in_the_order) {
  const auto errors = [](const std::string& more) {
    return errors_of(root(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, more) + periodic("c.so", "1ms", 3) +
                          sporadic("s.so", "thread", 1)));
  };
  EXPECT_THAT(errors("<after>a</after>"), IsEmpty());
  EXPECT_THAT(errors("<after>aa</after>"), ElementsAre(HasSubstr("no module is called 'aa'; did you mean 'a'?")));
  EXPECT_THAT(errors("<after>b</after>"), ElementsAre(HasSubstr("a module does not come after itself")));
  EXPECT_THAT(errors("<after>c</after>"), ElementsAre(HasSubstr("c has priority 3 and runs after b, which has 2")));
  EXPECT_THAT(errors("<after>s</after>"), ElementsAre(HasSubstr("s is not periodic")));
}

TEST(Cores, Are_auto_or_a_number_and_by_default_keep_together_what_shares_data) {
  const auto setting = [](const std::string& text) {
    return config_of(root(text + periodic("a.so", "1ms", 1))).cores.value_or(CoresSetting{-1, false, {}, {}});
  };
  EXPECT_EQ(setting("").most, -1);
  EXPECT_EQ(setting("<cores>auto</cores>").most, 0);
  EXPECT_EQ(setting("<cores>64</cores>").most, 64);
  EXPECT_FALSE(setting("<cores>2</cores>").split_sharing);
  EXPECT_TRUE(setting("<cores sharing=\"split\">2</cores>").split_sharing);
  EXPECT_THAT(errors_of(root("<cores>65</cores>")), Contains(HasSubstr("write auto, or how many cores from 1 to 64")));
  EXPECT_THAT(errors_of(root("<cores sharing=\"no\">2</cores>")), Contains(HasSubstr("write together or split")));
  EXPECT_EQ(config_of(root("<order>total</order>" + periodic("a.so", "1ms", 1))).order, scheduler::CoreOrder::Total);
}

}  // namespace
}  // namespace indurop::config
