// SPDX-License-Identifier: Apache-2.0
// What counts as a difference between two manifests, and how it is named.

#include "config/xml/manifest_difference.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "config/xml/document.h"

namespace indurop::config {
namespace {

using testing::HasSubstr;

std::string difference(const std::string& before, const std::string& after,
                       ComparedElements compared = ComparedElements::All) {
  std::vector<base::Diagnostic> diagnostics;
  const auto a = read_document(before, "plant.xml", kPlantXml, diagnostics);
  const auto b = read_document(after, "plant.xml", kPlantXml, diagnostics);
  EXPECT_TRUE(a && b);
  return a && b ? manifest_difference(*a, *b, compared) : "?";
}

std::string plant_with(const std::string& module, const std::string& more = "") {
  return "<plant name=\"p\"><board name=\"a\"><module>" + module + "</module></board>" + more + "</plant>";
}

const std::string kPress = "<name>press</name><filename>./press.so</filename><period>1ms</period>";

TEST(ManifestDifference, Spaces_comments_and_other_files_of_a_named_module_are_none) {
  EXPECT_EQ(difference(plant_with(kPress), plant_with(kPress)), "");
  EXPECT_EQ(difference(plant_with(kPress), plant_with("\n <!-- new -->" + kPress + "\n")), "");
  EXPECT_EQ(
      difference(plant_with(kPress), plant_with("<name>press</name><filename>./new/press2.so</filename><period>1ms"
                                                "</period>")),
      "");
}

TEST(ManifestDifference, Names_what_differs_and_where) {
  EXPECT_EQ(difference(plant_with(kPress),
                       plant_with("<name>press</name><filename>./press.so</filename><period>2ms</period>")),
            "board a, module press: <period> was 1ms and is 2ms");
  EXPECT_EQ(difference(plant_with(kPress), plant_with(kPress + "<core>1</core>")),
            "board a, module press: <core> is new");
  EXPECT_EQ(difference(plant_with(kPress + "<core>1</core>"), plant_with(kPress)),
            "board a, module press: <core> is gone");
  EXPECT_EQ(difference(plant_with(kPress), plant_with(kPress, "<domain>3</domain>")), "<domain> is new");
  EXPECT_EQ(difference(plant_with(kPress), plant_with(kPress, "<board name=\"b\"/>")), "board b is new");
}

TEST(ManifestDifference, A_module_without_a_name_has_that_of_its_file) {
  EXPECT_EQ(difference(plant_with("<filename>./one.so</filename>"), plant_with("<filename>./two.so</filename>")),
            "board a: module two is in place of module one");
  EXPECT_EQ(difference(plant_with("<filename>./one.so</filename>"), plant_with("<filename>lib/one.so</filename>")), "");
}

TEST(ManifestDifference, Attributes_count_in_any_order) {
  const auto board = [](const std::string& attributes) {
    return "<plant name=\"p\"><board " + attributes + "></board></plant>";
  };
  EXPECT_EQ(difference(board("name=\"a\" address=\"x\""), board("address=\"x\" name=\"a\"")), "");
  EXPECT_THAT(difference(board("name=\"a\" address=\"x\""), board("name=\"a\" address=\"y\"")),
              HasSubstr("address was 'x' and is 'y'"));
  EXPECT_NE(difference(board("name=\"a\" address=\"x\""), board("name=\"a\"")), "");
  EXPECT_NE(difference(board("name=\"a\""), board("name=\"a\" address=\"x\"")), "");
}

TEST(ManifestDifference, What_a_schedule_changes_is_none_if_it_does_not_count) {
  const auto other = [](const std::string& before, const std::string& after) {
    return difference(before, after, ComparedElements::NotSchedule);
  };
  const std::string all =
      "<offset>1ms</offset><deadline>1ms</deadline><wcet>1us</wcet><budget>off</budget><priority>3</priority>"
      "<overrun>skip</overrun><after>belt</after><after>drum</after>";
  EXPECT_EQ(other(plant_with(kPress), plant_with(kPress + all)), "");
  EXPECT_NE(difference(plant_with(kPress), plant_with(kPress + all)), "");
  EXPECT_EQ(other(plant_with(kPress + all), plant_with(kPress)), "");
  EXPECT_EQ(other(plant_with(kPress + all), plant_with(kPress + all + "<core>1</core>")),
            "board a, module press: <core> is new");
  const std::string belt = "<name>belt</name><filename>belt.so</filename>";
  const std::string two = kPress + "</module><module>" + belt;
  EXPECT_EQ(other(plant_with(two), plant_with(kPress)), "") << "it ends";
  EXPECT_EQ(other(plant_with(kPress), plant_with(two)), "") << "it is added";
  EXPECT_EQ(other(plant_with(two), plant_with(belt + "</module><module>" + kPress)), "") << "another order";
  EXPECT_EQ(other(plant_with(two), plant_with(belt + "<position>after-base</position></module><module>" + kPress)),
            "board a, module belt: <position> is new");
  EXPECT_EQ(other(plant_with(kPress), plant_with(kPress, "<domain>3</domain>")), "<domain> is new");
  EXPECT_EQ(other(plant_with(kPress), plant_with(kPress, "<board name=\"b\"/>")), "board b is new");
  EXPECT_EQ(other(plant_with(kPress, R"(<pool name="x" from="a" to="b"/>)"), plant_with(kPress)), "") << "of no node";
}

// Whatever single text or element is changed, it is found, but for names of files.
TEST(ManifestDifference, Every_changed_text_is_found) {
  const std::string whole =
      "<plant name=\"p\"><domain>5</domain><variable name=\"nt::x\"><owner>a</owner></variable>"
      "<board name=\"a\"><module><name>m</name><filename>m.so</filename><period>7ms</period>"
      "<failsafe variable=\"nt::y\">8</failsafe></module></board></plant>";
  for (const char* word : {"5", "nt::x", ">a<", "\"a\"", ">m<", "7ms", "nt::y", "8", "\"p\""}) {
    std::string changed = whole;
    changed.replace(changed.find(word) + 1, 0, "z");
    EXPECT_NE(difference(whole, changed), "") << word;
  }
  std::string file = whole;
  file.replace(file.find("m.so"), 4, "n.so");
  EXPECT_EQ(difference(whole, file), "");
}

}  // namespace
}  // namespace indurop::config
