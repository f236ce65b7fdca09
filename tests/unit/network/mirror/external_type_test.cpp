// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/external_type.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace indurop::mirror {
namespace {

schema::Type text(std::uint32_t size, std::vector<std::uint32_t> dims = {}) {
  schema::Type type;
  type.base = schema::Base::Text;
  type.text_size = type.element_size = size;
  type.dims = std::move(dims);
  return type;
}

schema::Type number() {
  schema::Type type;
  type.element_size = type.align = 4;
  return type;
}

schema::Type structure(const std::string& name, const std::vector<schema::Type>& fields) {
  schema::Type type;
  type.base = schema::Base::Struct;
  type.name = name;
  for (const schema::Type& field : fields) {
    schema::Field added;
    added.name = "f" + std::to_string(type.fields.size());
    added.type = field;
    added.offset = type.element_size;
    type.element_size += static_cast<std::uint32_t>(field.size());
    type.fields.push_back(added);
  }
  return type;
}

schema::Variable variable(const std::string& name, const schema::Type& type) {
  schema::Variable made;
  made.name = name;
  made.type = type;
  return made;
}

std::vector<std::uint8_t> bytes(const std::string& of) {
  return {of.begin(), of.end()};
}

std::string tidied(const schema::Type& type, const std::string& value) {
  std::vector<std::uint8_t> sut = bytes(value);
  tidy_texts(type, sut);
  return {sut.begin(), sut.end()};
}

TEST(External_type, Is_named_as_the_IDL_names_it) {
  EXPECT_EQ(idl_type_name(variable("knu::Robot::tick", number())), "knu::Robot::tick_");
  EXPECT_EQ(idl_type_name(variable("cell::encoder", structure("cell::Encoder", {number()}))), "cell::Encoder");
  schema::Type several = structure("cell::Encoder", {number()});
  several.dims = {2};
  EXPECT_EQ(idl_type_name(variable("cell::both", several)), "cell::both_");
  EXPECT_EQ(descriptor_symbol(variable("knu::Robot::tick", number())), "knu_Robot_tick__desc");
  EXPECT_EQ(descriptor_symbol(variable("top", number())), "top__desc");
  EXPECT_EQ(external_topic("knu::Robot::tick"), "knu/Robot/tick");
  EXPECT_EQ(external_topic("top"), "top");
}

TEST(External_type, Texts_end_in_their_last_byte_and_are_clear_behind_their_end) {
  using std::string_literals::operator""s;
  EXPECT_EQ(tidied(text(4), "abcd"), "abc\0"s);
  EXPECT_EQ(tidied(text(4), "a\0xy"s), "a\0\0\0"s);
  EXPECT_EQ(tidied(text(4), "\0\0\0\0"s), "\0\0\0\0"s);
  EXPECT_EQ(tidied(text(1), "a"), "\0"s);
  EXPECT_EQ(tidied(text(2, {3}), "ab\0bcc"s), "a\0\0\0c\0"s);
  EXPECT_EQ(tidied(number(), "abcd"), "abcd");
}

TEST(External_type, Texts_in_structs_in_arrays_are_found_and_nothing_else_is_touched) {
  using std::string_literals::operator""s;
  schema::Type inner = structure("i", {number(), text(2)});
  inner.dims = {2};
  const schema::Type outer = structure("o", {number(), inner, text(2)});
  EXPECT_TRUE(holds_text(outer));
  EXPECT_FALSE(holds_text(structure("n", {number()})));
  EXPECT_EQ(tidied(outer,
                   "1234"
                   "1234ab"
                   "1234cd"
                   "ef"),
            "1234"
            "1234a\0"
            "1234c\0"
            "e\0"s);
}

TEST(External_type, Values_that_an_enum_or_bool_cannot_have_are_named) {
  schema::Type mode = number();
  mode.base = schema::Base::Enum;
  mode.enumerators = {{"OFF", 0}, {"ON", 1}};
  schema::Type yes = number();
  yes.base = schema::Base::Bool;
  yes.element_size = 1;
  schema::Type inner = structure("i", {yes, yes});
  inner.dims = {2};
  const schema::Type outer = structure("o", {mode, inner});
  EXPECT_EQ(strange_value(outer, std::vector<std::uint8_t>{1, 0, 0, 0, 0, 1, 1, 0}), "");
  EXPECT_EQ(strange_value(outer, std::vector<std::uint8_t>{2, 0, 0, 0, 0, 1, 1, 0}), "f0: 2");
  EXPECT_EQ(strange_value(outer, std::vector<std::uint8_t>{1, 0, 0, 0, 0, 1, 1, 9}), "f1.f1: 9");
  EXPECT_EQ(strange_value(mode, std::vector<std::uint8_t>{255, 255, 255, 255}), "-1");
  EXPECT_EQ(strange_value(number(), std::vector<std::uint8_t>{255, 255, 255, 255}), "");
}

}  // namespace
}  // namespace indurop::mirror
