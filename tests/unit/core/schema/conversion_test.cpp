// SPDX-License-Identifier: Apache-2.0
// What remains of a variable whose declaration changes. The oracle compares the declarations as they are written.
#include "core/schema/conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/unit/glb2idl/compile_helper.h"

namespace indurop::schema {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;

Variable declared_as(const std::string& text) {
  return glb2idl::test::variable(glb2idl::test::compile_text("namespace n;\n" + text), "n::v");
}

Conversion between(const std::string& before, const std::string& after) {
  return convert(declared_as(before), declared_as(after));
}

TEST(Conversion, Fields_are_found_by_name_in_any_order) {
  const Conversion sut =
      between("struct { double x; int32_t n; float gone; } v;", "struct { int64_t n; bool more; double x; } v;");
  EXPECT_THAT(sut.carried, ElementsAre("n::v.n", "n::v.x"));
  EXPECT_THAT(sut.added, ElementsAre("n::v.more"));
  EXPECT_THAT(sut.lost, ElementsAre("n::v.gone: is no longer declared"));
}

TEST(Conversion, A_shorter_array_loses_elements_and_a_longer_one_does_not) {
  EXPECT_THAT(between("double v[3];", "double v[5];").lost, IsEmpty());
  const Conversion sut = between("double v[5];", "float v[3];");
  EXPECT_THAT(sut.carried, ElementsAre("n::v"));
  EXPECT_THAT(sut.lost, ElementsAre("n::v: was double[5], is float[3]: it has fewer elements"));
}

TEST(Conversion, Text_is_no_number_and_a_unit_is_part_of_a_value) {
  EXPECT_THAT(between("char v[8];", "int32_t v;").lost, ElementsAre("n::v: was char[8], is int32_t"));
  const Conversion sut = between("double v @unit(\"mm\");", "double v @unit(\"m\");");
  EXPECT_THAT(sut.lost, ElementsAre("n::v: its unit was 'mm', is 'm'"));
  EXPECT_THAT(sut.carried, IsEmpty());
}

// Fields of one level and of a second one, each with a type as it is written.
using Fields = std::map<std::string, std::string>;

Fields random_fields(std::mt19937& random) {
  static const std::vector<std::string> kTypes{"int32_t", "double", "bool", "uint8_t", "char[6]", "char[9]"};
  Fields fields;
  for (const char* name : {"a", "b", "c", "in.d", "in.e", "in.f"}) {
    if (random() % 3 != 0) {
      fields[name] = kTypes[random() % kTypes.size()];
    }
  }
  fields["in.always"] = "int32_t";
  return fields;
}

std::string field_text(const std::string& type, const std::string& name) {
  const std::size_t bracket = type.find('[');
  return bracket == std::string::npos ? type + " " + name + "; "
                                      : type.substr(0, bracket) + " " + name + type.substr(bracket) + "; ";
}

std::string text_of_fields(const Fields& fields) {
  std::string outer;
  std::string inner;
  for (const auto& [name, type] : fields) {
    if (name.starts_with("in.")) {
      inner += field_text(type, name.substr(3));
    } else {
      outer += field_text(type, name);
    }
  }
  return "struct I { " + inner + "};\nstruct { " + outer + "I in; } v;";
}

bool is_text(const std::string& type) {
  return type.starts_with("char");
}

TEST(Conversion, Random_declarations_are_compared_as_they_are_written) {
  std::mt19937 random(7);
  for (int round = 0; round < 400; ++round) {
    const Fields before = random_fields(random);
    const Fields after = random_fields(random);
    std::vector<std::string> carried;
    std::vector<std::string> added;
    std::set<std::string> lost;
    for (const auto& [name, type] : after) {
      const auto was = before.find(name);
      if (was == before.end()) {
        added.push_back("n::v." + name);
      } else if (is_text(was->second) == is_text(type)) {
        carried.push_back("n::v." + name);
      } else {
        lost.insert("n::v." + name);
      }
    }
    for (const auto& [name, type] : before) {
      if (!after.contains(name)) {
        lost.insert("n::v." + name);
      }
    }
    const Conversion sut = between(text_of_fields(before), text_of_fields(after));
    ASSERT_THAT(sut.carried, UnorderedElementsAreArray(carried)) << text_of_fields(before) << text_of_fields(after);
    ASSERT_THAT(sut.added, UnorderedElementsAreArray(added)) << text_of_fields(before) << text_of_fields(after);
    std::set<std::string> named;
    for (const std::string& line : sut.lost) {
      named.insert(line.substr(0, line.find(": ")));
    }
    ASSERT_EQ(named, lost) << text_of_fields(before) << text_of_fields(after);
  }
}

}  // namespace
}  // namespace indurop::schema
