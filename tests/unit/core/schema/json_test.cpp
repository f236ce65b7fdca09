// SPDX-License-Identifier: Apache-2.0
// Schema text: what is written is read back, and any other text is rejected.

#include <gmock/gmock.h>

#include <limits>

#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

Schema sample() {
  Schema schema;
  Variable joints = variable("knu::Robot::joints", joints_type());
  joints.unit = "mm";
  joints.description = "tool, \"quoted\" \xC2\xB0 \\ \n";
  joints.retain = true;
  joints.view = true;
  joints.optional = true;
  joints.maxage_ns = 5'000'000'000'000;
  joints.initial.assign(240, 0xA5);
  joints.fallback.assign(240, 0x01);
  joints.source = "knuRobot.glb:3";
  joints.type.fields[1].unit = "rad";
  joints.type.fields[1].range = Range{-3.25, 3.25};
  joints.type.fields[1].alarms.push_back({"too far", Priority::Critical, Comparison::GreaterEqual, 3.5, 0.25, 7});
  joints.alarms.push_back({"odd", Priority::Low, Comparison::NotEqual, 0, 0, 0});
  schema.variables.push_back(joints);
  Variable mode = variable("knu::Robot::mode", mode_type());
  mode.range = Range{-std::numeric_limits<double>::infinity(), 2};
  schema.variables.push_back(mode);
  schema.variables.push_back(variable("names", text(16, {4, 2})));
  schema.variables.push_back(variable("big", number(Base::UInt64)));
  Function add;
  add.name = "knu::Robot::add";
  add.arguments = structure("knu::Robot::add_args", {{"a", number(Base::Double)}, {"n", number(Base::Int8)}});
  add.result = number(Base::Double, {3});
  add.deadline_ns = 5'000'000;
  add.description = "adds";
  add.source = "knuRobot.glb:9";
  schema.functions.push_back(add);
  Function stop;
  stop.name = "stop";
  stop.arguments = structure("stop_args", {});
  stop.result = structure("", {});
  schema.functions.push_back(stop);
  return schema;
}

Errc code_of(std::string_view text) {
  const Result<Schema> read = from_json(text);
  return read.ok() ? Errc::Ok : read.error().code;
}

std::string with_type(const std::string& type) {
  return R"({"schema":1,"variables":[{"name":"a::v","kind":"ring","type":)" + type + "}]}";
}

TEST(Json, Everything_written_comes_back) {
  const std::string text = to_json(sample());
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto sut = from_json(text);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(to_json(sut.value()), text);
  ASSERT_EQ(sut.value().variables.size(), 4U);
  const Variable& joints = sut.value().variables[0];
  EXPECT_EQ(joints.description, sample().variables[0].description);
  EXPECT_EQ(joints.type_hash, hash_of(joints_type()));
  EXPECT_EQ(joints.initial, sample().variables[0].initial);
  EXPECT_EQ(joints.maxage_ns, 5'000'000'000'000);
  ASSERT_TRUE(joints.type.fields[1].range);
  EXPECT_EQ(joints.type.fields[1].range->min, -3.25);
  ASSERT_EQ(joints.type.fields[1].alarms.size(), 1U);
  EXPECT_EQ(joints.type.fields[1].alarms[0].deadband, 0.25);
  EXPECT_EQ(joints.type.fields[1].alarms[0].comparison, Comparison::GreaterEqual);
  EXPECT_EQ(joints.alarms.at(0).priority, Priority::Low);
  EXPECT_EQ(sut.value().variables[1].range->min, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(sut.value().functions[0].type_hash, hash_of(sample().functions[0]));
}

TEST(Json, Begins_with_the_versions) {
  EXPECT_EQ(to_json({}), R"({"schema":1,"abi":5})");
  EXPECT_EQ(abi_of_json(to_json(sample())), abi::kVersion);
  EXPECT_EQ(abi_of_json("{\"schema\":1}"), 0U);
  EXPECT_EQ(abi_of_json(""), 0U);
  EXPECT_EQ(abi_of_json("{\"abi\":"), 0U);
}

TEST(Json, Description_that_is_not_UTF8_is_mended) {
  Schema schema = sample();
  schema.variables[0].description = "\xFF\xFE";
  EXPECT_EQ(code_of(to_json(schema)), Errc::Ok);
}

TEST(Json, Lines_are_merged_and_blank_ones_skipped) {
  const std::string line = to_json(sample());
  const auto sut = from_json("\n" + line + "\n\n" + line + "\n" + to_json({}) + "\n");
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(to_json(sut.value()), line);
  const auto none = from_json("");
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(none.value().variables.empty());
}

TEST(Json, Two_types_for_one_variable_are_a_type_mismatch) {
  Schema other;
  other.variables.push_back(variable("big", number(Base::Double)));
  EXPECT_EQ(code_of(to_json(sample()) + "\n" + to_json(other)), Errc::TypeMismatch);
}

TEST(Json, Another_schema_version_is_distinguished_from_garbage) {
  EXPECT_EQ(code_of(R"({"schema":2,"variables":"whatever"})"), Errc::VersionMismatch);
  for (const char* garbage : {"{", "[]", "null", "1", "{}", "\"schema\"", R"({"schema":"1"})", R"({"schema":1)",
                              "\xFF\xFF", R"({"schema":1,"variables":{}})", R"({"schema":1,"variables":[1]})",
                              R"({"schema":1,"functions":[{}]})", R"({"schema":1}{"schema":1})"}) {
    EXPECT_EQ(code_of(garbage), Errc::Corrupt) << garbage;
  }
  EXPECT_EQ(code_of(std::string(100'000, '\0')), Errc::Corrupt);
}

TEST(Json, Every_truncation_is_corrupt) {
  const std::string text = to_json(sample());
  for (std::size_t length = 1; length < text.size(); ++length) {
    ASSERT_EQ(code_of(std::string_view(text).substr(0, length)), Errc::Corrupt) << length;
  }
}

// Whatever is let through must be fit for use: names found, values formatted, without leaving their bytes.
TEST(Json, Flipped_bytes_never_give_an_unsound_schema) {
  const std::string text = to_json(sample());
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const char change : {'\x01', '\x10', '\x7F'}) {
      std::string broken = text;
      broken[at] = static_cast<char>(broken[at] ^ change);
      const auto sut = from_json(broken);
      if (!sut.ok()) {
        continue;
      }
      for (const Variable& variable : sut.value().variables) {
        const std::vector<std::uint8_t> bytes(variable.type.size(), 0x7F);
        EXPECT_FALSE(format_value(variable.type, bytes).empty());
        EXPECT_TRUE(variable.initial.empty() || variable.initial.size() == bytes.size());
      }
    }
  }
}

TEST(Json, Types_that_cannot_be_are_corrupt) {
  EXPECT_EQ(code_of(with_type("\"double\"")), Errc::Ok);
  for (
      const char* type : {
          "\"text\"",
          "\"struct\"",
          "\"enum\"",
          "\"decimal\"",
          "3",
          "null",
          "[]",
          "{}",
          R"({"base":7})",
          R"({"base":"double","dims":[0]})",
          R"({"base":"double","dims":[-1]})",
          R"({"base":"double","dims":[1.5]})",
          R"({"base":"double","dims":[4294967296]})",
          R"({"base":"double","dims":[65536,65536]})",
          R"({"base":"double","dims":[4294967295,4294967295,4294967295,4294967295]})",
          R"({"base":"double","dims":[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]})",
          R"({"base":"double","dims":3})",
          R"({"base":"text"})",
          R"({"base":"text","size":0})",
          R"({"base":"text","size":-1})",
          R"({"base":"text","size":18446744073709551615})",
          R"({"base":"text","size":1e3})",
          R"({"base":"enum"})",
          R"({"base":"enum","values":[]})",
          R"({"base":"enum","values":[["A",2147483648]]})",
          R"({"base":"enum","values":[["1A",0]]})",
          R"({"base":"enum","values":[["A"]]})",
          R"({"base":"struct","size":8,"align":8})",
          R"({"base":"struct","size":8,"align":8,"fields":[]})",
          R"({"base":"struct","size":8,"align":3,"fields":[{"name":"x","offset":0,"type":"double"}]})",
          R"({"base":"struct","size":8,"align":0,"fields":[{"name":"x","offset":0,"type":"double"}]})",
          R"({"base":"struct","size":4,"align":4,"fields":[{"name":"x","offset":0,"type":"double"}]})",
          R"({"base":"struct","size":8,"align":8,"fields":[{"name":"x","offset":4,"type":"double"}]})",
          R"({"base":"struct","size":8,"align":8,"fields":[{"name":"x","offset":4294967288,"type":"double"}]})",
          R"({"base":"struct","size":16,"align":8,"fields":[{"name":"x","offset":0,"type":"double"},{"name":"y","offset":0,"type":"double"}]})",
          R"({"base":"struct","size":16,"align":8,"fields":[{"name":"x","offset":0,"type":"double"},{"name":"x","offset":8,"type":"double"}]})",
          R"({"base":"struct","size":8,"align":8,"fields":[{"name":"a b","offset":0,"type":"double"}]})",
          R"({"base":"struct","size":8,"align":8,"fields":[{"offset":0,"type":"double"}]})",
          R"({"base":"struct","size":8,"align":8,"fields":[{"name":"x","type":"double"}]})",
      }) {
    EXPECT_EQ(code_of(with_type(type)), Errc::Corrupt) << type;
  }
}

TEST(Json, Variables_that_cannot_be_are_corrupt) {
  const auto with = [](const std::string& members) {
    return code_of(R"({"schema":1,"variables":[{)" + members + "}]}");
  };
  EXPECT_EQ(with(R"("name":"a::b","type":"int32","kind":"scalar")"), Errc::Ok);
  for (const char* members : {
           R"("type":"int32","kind":"scalar")",
           R"("name":"","type":"int32","kind":"scalar")",
           R"("name":"a:b","type":"int32","kind":"scalar")",
           R"("name":"::a","type":"int32","kind":"scalar")",
           R"("name":"a\u001b","type":"int32","kind":"scalar")",
           R"("name":3,"type":"int32","kind":"scalar")",
           R"("name":"a","kind":"scalar")",
           R"("name":"a","type":"int32")",
           R"("name":"a","type":"int32","kind":"block")",
           R"("name":"a","type":"int32","kind":0)",
           R"("name":"a","type":{"base":"int32","dims":[3]},"kind":"scalar")",
           R"("name":"a","type":"int32","kind":"scalar","initial":"0000")",
           R"("name":"a","type":"int32","kind":"scalar","initial":"0000000g")",
           R"("name":"a","type":"int32","kind":"scalar","initial":"000000-1")",
           R"("name":"a","type":"int32","kind":"scalar","fallback":[0,0,0,0])",
           R"("name":"a","type":"int32","kind":"scalar","maxage_ns":-1)",
           R"("name":"a","type":"int32","kind":"scalar","maxage_ns":18446744073709551615)",
           R"("name":"a","type":"int32","kind":"scalar","retain":1)",
           R"("name":"a","type":"int32","kind":"scalar","range":[1])",
           R"("name":"a","type":"int32","kind":"scalar","range":["a","b"])",
           R"("name":"a","type":"int32","kind":"scalar","unit":5)",
       }) {
    EXPECT_EQ(with(members), Errc::Corrupt) << members;
  }
}

TEST(Json, Depth_and_number_of_values_are_bounded) {
  std::string nested = "\"double\"";
  for (int i = 0; i < 300; ++i) {
    nested = R"({"base":"struct","size":8,"align":8,"fields":[{"name":"x","offset":0,"type":)" + nested + "}]}";
    if (i == 20) {
      EXPECT_EQ(code_of(with_type(nested)), Errc::Ok);
    }
  }
  EXPECT_EQ(code_of(with_type(nested)), Errc::Corrupt);
  EXPECT_EQ(code_of(std::string(1'000'000, '[')), Errc::Corrupt);
  EXPECT_EQ(code_of(std::string(3'000'000, '[')), Errc::Corrupt);
  std::string list = R"({"schema":1,"variables":[1)";
  for (int i = 0; i < 2'000'000; ++i) {
    list += ",1";
  }
  EXPECT_EQ(code_of(list + "]}"), Errc::Corrupt);
  EXPECT_EQ(code_of(std::string((std::size_t{64} << 20U) + 1, ' ')), Errc::Corrupt);
}

TEST(Json, Ten_thousand_variables_fit) {
  Schema schema;
  for (int i = 0; i < 10'000; ++i) {
    schema.variables.push_back(variable("plant::v" + std::to_string(i), joints_type()));
  }
  const auto sut = from_json(to_json(schema));
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut.value().variables.size(), 10'000U);
}

}  // namespace
}  // namespace indurop::schema
