// SPDX-License-Identifier: Apache-2.0
// Every type goes through an FMU unchanged: a module copies what is set.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "tests/integration/fmi/fmu.h"
#include "tests/integration/fmi/master.h"
#include "tests/integration/fmi/running2.h"
#include "tests/support/program.h"

namespace indurop::fmi {
namespace {

using ::testing::HasSubstr;

const std::string kAll = TYPES;

class Running3 {
 public:
  explicit Running3(const Fmu& fmu) : fmu_(fmu) {
    const char* const missing = open_master3(&master, fmu.library().c_str());
    EXPECT_EQ(missing, nullptr) << missing << fmu.message();
    if (missing == nullptr) {
      instance = master.instantiate("test", fmu.token().c_str(), (fmu.resources() + "/").c_str(), false, false, false,
                                    false, nullptr, 0, this, &note3, nullptr);
    }
  }
  Running3(const Running3&) = delete;
  Running3& operator=(const Running3&) = delete;
  ~Running3() {
    if (instance != nullptr) {
      master.free_instance(instance);
    }
  }
  void initialize() {
    ASSERT_NE(instance, nullptr) << log;
    ASSERT_EQ(master.enter_initialization(instance, false, 0, 2, true, 3), fmi3OK) << log;
    ASSERT_EQ(master.exit_initialization(instance), fmi3OK) << log;
  }
  fmi3Status step(double at, double size) {
    bool event = true;
    bool terminate = true;
    bool early = true;
    double last = 0;
    const fmi3Status status = master.step(instance, at, size, true, &event, &terminate, &early, &last);
    EXPECT_FALSE(event || terminate || early);
    EXPECT_EQ(last, at + size) << log;
    return status;
  }
  // Sets kinds::in.PART and returns kinds::out.PART after a step.
  template <class T, class Set, class Get>
  T copied(const std::string& part, T value, Set set, Get get) {
    const unsigned int in = fmu_.reference("kinds::in." + part);
    const unsigned int out = fmu_.reference("kinds::out." + part);
    T result{};
    EXPECT_EQ(set(instance, &in, 1, &value, 1), fmi3OK) << part << log;
    EXPECT_EQ(step(now_, 1e-3), fmi3OK) << log;
    now_ += 1e-3;
    EXPECT_EQ(get(instance, &out, 1, &result, 1), fmi3OK) << part << log;
    return result;
  }

  Master3 master{};
  fmi3Instance instance = nullptr;
  std::string log;

 private:
  static void note3(void* environment, fmi3Status status, fmi3String category, fmi3String message) {
    static_cast<Running3*>(environment)->log += fmt::format("{} {}: {}\n", static_cast<int>(status), category, message);
  }
  const Fmu& fmu_;
  double now_ = 2;
};

template <class T, class Set, class Get>
void expect_copies(Running3& fmu, const std::string& part, Set set, Get get) {
  for (const T value : {std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max(), T{1}}) {
    const T result = fmu.copied<T>(part, value, set, get);
    EXPECT_EQ(std::memcmp(&result, &value, sizeof value), 0) << part << ": " << +result << ", not " << +value;
  }
}

TEST(FmuTypes, All_of_FMI_3_are_exact) {
  const Fmu about(kAll, "types.xml", 3);
  Running3 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  const Master3& m = fmu.master;
  expect_copies<std::int8_t>(fmu, "i8", m.set_int8, m.get_int8);
  expect_copies<std::uint8_t>(fmu, "u8", m.set_uint8, m.get_uint8);
  expect_copies<std::uint8_t>(fmu, "letter", m.set_uint8, m.get_uint8);
  expect_copies<std::int16_t>(fmu, "i16", m.set_int16, m.get_int16);
  expect_copies<std::uint16_t>(fmu, "u16", m.set_uint16, m.get_uint16);
  expect_copies<std::int32_t>(fmu, "i32", m.set_int32, m.get_int32);
  expect_copies<std::uint32_t>(fmu, "u32", m.set_uint32, m.get_uint32);
  expect_copies<std::int64_t>(fmu, "i64", m.set_int64, m.get_int64);
  expect_copies<std::uint64_t>(fmu, "u64", m.set_uint64, m.get_uint64);
  expect_copies<float>(fmu, "f32", m.set_float32, m.get_float32);
  expect_copies<double>(fmu, "f64", m.set_float64, m.get_float64);
  expect_copies<double>(fmu, "grid[1][2]", m.set_float64, m.get_float64);
  const double nan = fmu.copied<double>("f64", std::numeric_limits<double>::quiet_NaN(), m.set_float64, m.get_float64);
  EXPECT_TRUE(std::isnan(nan));
  EXPECT_TRUE(fmu.copied<bool>("flag", true, m.set_boolean, m.get_boolean));
  EXPECT_FALSE(fmu.copied<bool>("flag", false, m.set_boolean, m.get_boolean));
  EXPECT_EQ(fmu.copied<std::int64_t>("mode", 2, m.set_int64, m.get_int64), 2);
  EXPECT_STREQ(fmu.copied<const char*>("text", "k\u00e4se & more", m.set_string, m.get_string), "k\u00e4se & more");
  EXPECT_STREQ(fmu.copied<const char*>("text", "", m.set_string, m.get_string), "");
}

TEST(FmuTypes, The_description_says_what_the_declarations_say) {
  const Fmu two(kAll, "types.xml", 2);
  const Fmu three(kAll, "types.xml", 3);
  const std::vector<std::array<std::string, 4>> expected{
      {"flag", "Boolean", "Boolean", "false"}, {"letter", "Integer", "UInt8", "0"},
      {"i8", "Integer", "Int8", "0"},          {"u8", "Integer", "UInt8", "0"},
      {"i16", "Integer", "Int16", "0"},        {"u16", "Integer", "UInt16", "0"},
      {"i32", "Integer", "Int32", "0"},        {"u32", "Real", "UInt32", "0"},
      {"i64", "Real", "Int64", "0"},           {"u64", "Real", "UInt64", "0"},
      {"f32", "Real", "Float32", "0"},         {"f64", "Real", "Float64", "0"},
      {"text", "String", "String", ""},        {"mode", "Enumeration", "Enumeration", "0"},
      {"grid[0][1]", "Real", "Float64", "0"}};
  for (const auto& [part, type2, type3, start] : expected) {
    const Described* const in2 = two.find("kinds::in." + part);
    const Described* const in3 = three.find("kinds::in." + part);
    ASSERT_TRUE(in2 != nullptr && in3 != nullptr) << part;
    EXPECT_EQ(in2->type, type2) << part;
    EXPECT_EQ(in3->type, type3) << part;
    EXPECT_EQ(in2->causality, "input") << part;
    EXPECT_EQ(in2->attributes.at("start"), start) << part;
    EXPECT_EQ(in3->attributes.contains("start"), type3 != "String") << part;
    EXPECT_EQ(two.find("kinds::out." + part)->causality, "output") << part;
    EXPECT_FALSE(two.find("kinds::out." + part)->attributes.contains("start")) << part;
  }
  const Described* const limited = three.find("kinds::limited");
  ASSERT_NE(limited, nullptr);
  EXPECT_EQ(limited->attributes.at("min"), "-1.5");
  EXPECT_EQ(limited->attributes.at("max"), "4");
  EXPECT_EQ(limited->attributes.at("start"), "2.5");
  EXPECT_EQ(limited->attributes.at("unit"), "furlong");
  EXPECT_EQ(three.variables().front().name, "time");
}

TEST(FmuTypes, Calls_of_FMI_3_are_checked_too) {
  const Fmu about(kAll, "types.xml", 3);
  Running3 fmu(about);
  const Master3& m = fmu.master;
  EXPECT_EQ(m.instantiate_exchange("test", about.token().c_str(), "", false, false, nullptr, nullptr), nullptr);
  ASSERT_NE(fmu.instance, nullptr) << fmu.log;
  const unsigned int reference = about.reference("kinds::in.f64");
  const unsigned int time = 0;
  double value = 1;
  EXPECT_EQ(m.get_float64(fmu.instance, &reference, 1, &value, 1), fmi3Error);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  EXPECT_EQ(m.get_float64(fmu.instance, &time, 1, &value, 1), fmi3OK);
  EXPECT_EQ(value, 2);
  EXPECT_EQ(m.get_float64(fmu.instance, &reference, 1, &value, 2), fmi3Error);
  EXPECT_THAT(fmu.log, HasSubstr("nValues has to be nValueReferences"));
  EXPECT_EQ(m.set_float64(fmu.instance, &time, 1, &value, 1), fmi3Error);
  EXPECT_EQ(m.set_float32(fmu.instance, &reference, 1, nullptr, 1), fmi3Error);
  EXPECT_EQ(m.get_clock(fmu.instance, &reference, 1, nullptr), fmi3Error);
  EXPECT_EQ(m.step(fmu.instance, 2, 1e-3, true, nullptr, nullptr, nullptr, nullptr), fmi3Error);
  EXPECT_EQ(fmu.step(2, 1e-3), fmi3OK) << fmu.log;
  EXPECT_EQ(m.terminate(fmu.instance), fmi3OK);
  EXPECT_EQ(m.reset(fmu.instance), fmi3OK) << fmu.log;
}

TEST(FmuOptions, Inputs_and_outputs_are_chosen) {
  const Fmu chosen(kAll, "types.xml", 2, {"--inputs", "kinds::in.f*", "--outputs", "kinds::out.grid[1][2]"});
  std::vector<std::string> names;
  for (const Described& one : chosen.variables()) {
    names.push_back(one.name + " " + one.causality);
  }
  EXPECT_THAT(names, ::testing::ElementsAre("kinds::in.flag input", "kinds::in.f32 input", "kinds::in.f64 input",
                                            "kinds::out.grid[1][2] output"));
  const Fmu written(kAll, "types.xml", 2, {"--inputs", "kinds::runs"});
  EXPECT_THAT(written.message(), HasSubstr("kinds::runs is an input although types_copy writes it"));
  const Fmu none(kAll, "types.xml", 2, {"--outputs", "nothing*"});
  EXPECT_THAT(none.message(), HasSubstr("--outputs 'nothing*': no shared variable"));
  EXPECT_TRUE(none.variables().empty());
}

TEST(FmuSchema, Accepts_every_description) {
  const char* const data = std::getenv("INDUROP_FMI_DATA");  // NOLINT(concurrency-mt-unsafe): read only
  if (data == nullptr) {
    GTEST_SKIP() << "INDUROP_FMI_DATA names no folder with fmi2/fmi2ModelDescription.xsd and fmi3/";
  }
  for (const int version : {2, 3}) {
    const std::string schema = fmt::format("{0}/fmi{1}/fmi{1}ModelDescription.xsd", data, version);
    for (const auto& [project, file] : {std::pair<std::string, std::string>(kAll, "types.xml"),
                                        std::pair<std::string, std::string>(CHAPTER, "module.xml"),
                                        std::pair<std::string, std::string>(TWO_BOARDS, "plant.xml")}) {
      const Fmu fmu(project, file, version);
      test::Program judge({"/usr/bin/env", "xmllint", "--noout", "--schema", schema, fmu.description_file().string()});
      const test::Outcome verdict = judge.finish();
      EXPECT_EQ(verdict.code, 0) << verdict.err << fmu.message();
    }
    const std::string by_hand = fmt::format("{}/lag{}.xml", LAG_SOURCES, version);
    test::Program judge({"/usr/bin/env", "xmllint", "--noout", "--schema", schema, by_hand});
    const test::Outcome verdict = judge.finish();
    EXPECT_EQ(verdict.code, 0) << verdict.err;
  }
}

}  // namespace
}  // namespace indurop::fmi
