// SPDX-License-Identifier: Apache-2.0
// The table of standard functions and blocks: look-up by name, parameters, types, and that all of it exists in C++ and
// in the documentation.

#include "control/plc/library/standard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

void call_everything();  // written by plc_library_calls

namespace indurop::plc {
namespace {

const LibraryFunction& only(std::string_view name) {
  const auto found = find_functions(name);
  EXPECT_EQ(found.size(), 1U) << name;
  return *found.at(0);
}

TEST(PlcTable, Every_row_has_an_implementation_for_every_type_it_accepts) {
  EXPECT_NO_THROW(call_everything());
}

TEST(PlcTable, Names_are_found_in_any_case) {
  EXPECT_EQ(only("limit").cpp, "iec::limit");
  EXPECT_EQ(only("Int_To_Real").cpp, "iec::to<float>");
  EXPECT_EQ(find_block("ton")->cpp, "iec::Ton");
  EXPECT_TRUE(find_functions("FROBNICATE").empty());
  EXPECT_TRUE(find_functions("").empty());
  EXPECT_TRUE(find_functions("INT_TO_INT").empty());
  EXPECT_EQ(find_block("FROBNICATE"), nullptr);
}

TEST(PlcTable, Conversions_know_both_names_of_a_type) {
  EXPECT_EQ(only("DT_TO_TOD").name, "DATE_AND_TIME_TO_TIME_OF_DAY");
  EXPECT_EQ(only("DATE_AND_TIME_TO_TIME_OF_DAY").cpp, "iec::to<iec::TimeOfDay>");
  EXPECT_EQ(only("TIME_OF_DAY_TO_STRING").cpp, "iec::to_string");
  EXPECT_EQ(only("TOD_TO_STRING").cpp, "iec::to_string");
  EXPECT_EQ(only("LTIME_TO_DINT").name, "TIME_TO_DINT");
  EXPECT_EQ(only("TO_TIME").cpp, "iec::to<iec::Time>");
  EXPECT_EQ(only("WORD_BCD_TO_UINT").cpp, "iec::from_bcd<std::uint16_t>");
  EXPECT_EQ(only("UINT_TO_BCD_WORD").cpp, "iec::to_bcd<std::uint16_t>");
  EXPECT_EQ(only("BCD_TO_UINT").inputs[0].type, LibraryType(Elementary::Word));
  EXPECT_EQ(only("UINT_TO_BCD").result, LibraryType(Elementary::Word));
  EXPECT_EQ(only("LREAL_TRUNC_LINT").cpp, "iec::trunc<std::int64_t>");
}

TEST(PlcTable, Overloads_are_found_together) {
  const auto found = find_functions("SUB");
  ASSERT_EQ(found.size(), 7U);
  EXPECT_EQ(found[0]->result, LibraryType(Generic::AnyNum));
  EXPECT_EQ(found[2]->inputs[0].type, LibraryType(Elementary::Date));
}

TEST(PlcTable, What_may_fault_says_so) {
  for (const char* name : {"DIV", "MOD", "MUX", "DIVTIME"}) {
    for (const LibraryFunction* function : find_functions(name)) {
      EXPECT_TRUE(function->faults) << name;
    }
  }
  EXPECT_FALSE(only("EXPT").faults);
}

TEST(PlcTable, Inputs_are_found_by_name_and_extensible_functions_have_any_number) {
  const LibraryFunction& mux = only("MUX");
  EXPECT_TRUE(mux.extensible);
  EXPECT_EQ(mux.position("k"), 0U);
  EXPECT_EQ(mux.position("IN0"), 1U);
  EXPECT_EQ(mux.position("IN1"), 2U);
  EXPECT_EQ(mux.position("in12"), 13U);
  EXPECT_EQ(mux.position("IN02"), std::nullopt);
  EXPECT_EQ(mux.position("IN"), std::nullopt);
  EXPECT_EQ(mux.position("OUT2"), std::nullopt);
  EXPECT_EQ(mux.position(""), std::nullopt);
  EXPECT_EQ(mux.input(13).type, LibraryType(Generic::Any));
  EXPECT_EQ(only("LIMIT").position("MX"), 2U);
  EXPECT_EQ(only("LIMIT").position("IN3"), std::nullopt);
}

TEST(PlcTable, Blocks_have_members_and_the_names_that_other_editors_give_them) {
  const LibraryBlock* ctud = find_block("CTUD_DINT");
  ASSERT_NE(ctud, nullptr);
  EXPECT_EQ(ctud->cpp, "iec::Ctud<std::int32_t>");
  EXPECT_EQ(ctud->input("RESET"), ctud->input("r"));
  EXPECT_EQ(ctud->input("PV")->type, LibraryType(Elementary::Dint));
  EXPECT_EQ(ctud->output("CV")->type, LibraryType(Elementary::Dint));
  EXPECT_EQ(ctud->output("PV"), nullptr);
  EXPECT_EQ(find_block("PID")->input("AUTO")->cpp, "automatic");
  EXPECT_EQ(find_block("CTU")->cpp, find_block("CTU_INT")->cpp);
}

TEST(PlcTable, Generic_types_accept_their_members) {
  EXPECT_TRUE(accepts(Generic::AnyNum, Elementary::Real));
  EXPECT_FALSE(accepts(Generic::AnyNum, Elementary::Word));
  EXPECT_TRUE(accepts(Generic::AnyBit, Elementary::Bool));
  EXPECT_FALSE(accepts(Generic::AnyInt, Elementary::Lreal));
  EXPECT_TRUE(accepts(Generic::AnyElementary, Elementary::String));
  EXPECT_FALSE(accepts(Elementary::Int, Elementary::Dint));
  EXPECT_EQ(name_of(Generic::AnyReal), "ANY_REAL");
}

TEST(PlcTable, The_documentation_names_all_functions_and_blocks) {
  std::ifstream file(PLC_LIBRARY_PAGE);
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ASSERT_FALSE(page.empty());
  const auto named = [&page](const std::string& name) { return page.find("`" + name + "`") != std::string::npos; };
  for (const LibraryFunction& function : library_functions()) {
    const bool made_of_types =
        function.name.find("_TO_") != std::string::npos || function.name.find("TRUNC_") != std::string::npos;
    EXPECT_TRUE(made_of_types || function.name.starts_with("TO_") || named(function.name)) << function.name;
  }
  for (const LibraryBlock& block : library_blocks()) {
    EXPECT_TRUE(named(block.name) || named(block.name.substr(0, block.name.find('_')))) << block.name;
  }
}

}  // namespace
}  // namespace indurop::plc
