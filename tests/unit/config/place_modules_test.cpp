// SPDX-License-Identifier: Apache-2.0
// <cores>: which core modules get, and what a check says of it.

#include <algorithm>
#include <fstream>

#include "config/plan/plan.h"
#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class PlaceModules : public testing::Test {
 protected:
  void write(const std::string& name, const std::vector<std::string>& reads, const std::vector<std::string>& writes) {
    ModuleSpec spec;
    spec.exports = {"indurop_module_describe", "_Z9conditionv", "condition"};
    for (const auto* list : {&reads, &writes}) {
      for (const std::string& v : *list) {
        spec.schema.variables.push_back(variable(v));
      }
    }
    spec.reads = reads;
    spec.writes = writes;
    write_module(folder_ / name, spec);
  }
  Checked of(const std::string& modules, const std::string& cores = "<cores>2</cores>") {
    return check(root("<core>1</core>" + cores + modules), {.machine = false}, folder_ / "module.xml");
  }
  static int core(const Checked& checked, const std::string& name) {
    const auto& modules = checked.config.modules;
    return std::find_if(modules.begin(), modules.end(), [&](const Module& m) { return m.name == name; })->core;
  }
  static std::string wcet(const std::string& time) { return "<wcet>" + time + "</wcet>"; }

  ModuleFolder folder_;
};

TEST_F(PlaceModules, Keeps_together_what_shares_data_and_spreads_the_rest) {
  write("w.so", {}, {"n::x"});
  write("r.so", {"n::x"}, {});
  write("a.so", {}, {});
  const Checked sut = of(periodic("w.so", "1ms", 1, wcet("200us")) + periodic("r.so", "1ms", 2, wcet("200us")) +
                         periodic("a.so", "1ms", 3, wcet("300us")));
  EXPECT_TRUE(sut.result.ok());
  EXPECT_EQ(core(sut, "w"), core(sut, "r"));
  EXPECT_NE(core(sut, "w"), core(sut, "a"));
  EXPECT_THAT(plan_why(sut.config, sut.result),
              AllOf(HasSubstr("w    200 us  with r (n::x)"), HasSubstr("a    300 us  shares nothing"),
                    HasSubstr("No module waits for one of another core")));
}

TEST_F(PlaceModules, Splits_it_on_request_and_reports_what_waits) {
  write("w.so", {}, {"n::x"});
  write("q.so", {"n::x"}, {});
  write("r.so", {"n::x"}, {});
  const Checked sut = of(periodic("w.so", "1ms", 1, wcet("100us")) + periodic("q.so", "1ms", 2, wcet("400us")) +
                             periodic("r.so", "1ms", 3, wcet("400us")),
                         "<cores sharing=\"split\">2</cores>");
  EXPECT_TRUE(sut.result.ok());
  EXPECT_NE(core(sut, "q"), core(sut, "r"));
  EXPECT_THAT(plan_why(sut.config, sut.result), HasSubstr("waits for w: n::x"));
}

TEST_F(PlaceModules, What_shares_data_with_a_sporadic_module_is_on_the_nodes_core) {
  write("w.so", {}, {"n::x"});
  write("s.so", {"n::x"}, {});
  write("a.so", {}, {});
  const Checked sut = of(periodic("a.so", "1ms", 1, wcet("100us")) + periodic("w.so", "1ms", 2, wcet("10us")) +
                         sporadic("s.so", "thread", 1));
  EXPECT_EQ(core(sut, "w"), 1);
}

TEST_F(PlaceModules, A_core_that_is_given_stays) {
  write("a.so", {}, {});
  write("b.so", {}, {});
  const Checked sut = of(periodic("a.so", "1ms", 1, wcet("100us") + "<core>0</core>") +
                         periodic("b.so", "1ms", 2, wcet("300us") + "<core>0</core>"));
  EXPECT_EQ(core(sut, "a"), 0);
  EXPECT_EQ(core(sut, "b"), 0);
}

TEST_F(PlaceModules, Unknown_times_are_assumed_and_reported) {
  write("a.so", {}, {});
  write("b.so", {}, {});
  EXPECT_THAT(of(periodic("a.so", "1ms", 1, wcet("100us")) + periodic("b.so", "1ms", 2)).lines(),
              Contains(HasSubstr("note: <cores>: the execution time of b is unknown, assumed is 100 us")));
  EXPECT_THAT(of(periodic("a.so", "1ms", 1, wcet("100us")) + periodic("b.so", "1ms", 2, wcet("1us"))).lines(),
              Not(Contains(HasSubstr("not known"))));
}

TEST_F(PlaceModules, Times_may_come_from_a_report_of_a_run_before) {
  for (const char* name : {"a.so", "b.so", "c.so"}) {
    write(name, {}, {});
  }
  std::ofstream(folder_ / "report.json") << R"({"modules": [{"name": "a", "exec_ns": {"max": 500000}},
    {"name": "b", "exec_ns": {"max": 300000}}, {"name": "c", "exec_ns": {"max": 100000}}]})";
  const std::string modules =
      periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2) + periodic("c.so", "1ms", 3, wcet("150us"));
  const Checked sut = of(modules, "<cores times=\"report.json\">2</cores>");
  EXPECT_THAT(sut.lines(), Not(Contains(HasSubstr("not known"))));
  EXPECT_EQ(core(sut, "b"), core(sut, "c"));
  EXPECT_NE(core(sut, "a"), core(sut, "b"));
  EXPECT_THAT(plan_why(sut.config, sut.result), HasSubstr("c    150 us")) << "<wcet> counts first";
  EXPECT_THAT(of(modules, "<cores times=\"none.json\">2</cores>").lines(), Contains(HasSubstr("warning: <cores>: ")));
}

TEST_F(PlaceModules, More_than_this_machine_has_is_an_error_where_it_is_to_run) {
  write("a.so", {}, {});
  const std::string xml = root("<cores>64</cores>" + periodic("a.so", "1ms", 1));
  const Checked here = check(xml, {}, folder_ / "module.xml");
  if (std::filesystem::exists("/sys/devices/system/cpu/cpu63")) {
    GTEST_SKIP() << "a large machine";
  }
  EXPECT_THAT(here.lines(), Contains(HasSubstr("error: <cores>: 64 asked for, but this process may use ")));
  EXPECT_TRUE(check(xml, {.machine = false}, folder_ / "module.xml").result.ok());
}

}  // namespace
}  // namespace indurop::config
