// SPDX-License-Identifier: Apache-2.0
// FMUs of other tools as devices of a simulation: values, times and types. The yardstick is the closed form of the lag,
// an FMU that is written by hand from the text of the standard.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <indurop/testing.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>

#include "tests/integration/fmi/model.h"

namespace indurop::fmi {
namespace {

using irp::testing::Plant;

constexpr double kStep = 0.01;  // s, the module's period

class FmuImport : public ::testing::TestWithParam<int> {
 protected:
  static std::string device(const std::string& inside = {}, const std::string& name = "lag") {
    return fmt::format(R"(<device name="{0}" driver="fmu" file="{1}" variables="{0}">{2}</device>)", name,
                       lag(GetParam()), inside);
  }
};

TEST_P(FmuImport, Has_the_closed_form_at_each_tick) {
  const Model model(device(R"(<set at="T" value="0.25"/>)"));
  Plant plant(model.file());
  double u = 0;
  double expected = 0;
  for (int tick = 0; tick < 300; ++tick) {
    if (tick % 50 == 0) {
      u = tick % 100 == 0 ? 2.5 : -1.25;
      plant.set("lag::u", u);
    }
    plant.step();
    // What was set before a tick acts from the previous tick on: the model has its answer in this one.
    expected = tick == 0 ? 0 : u + (expected - u) * std::exp(-kStep / 0.25);
    ASSERT_NEAR(plant.get<double>("lag::lag_y"), expected, 1e-14) << "at tick " << tick;
    ASSERT_EQ(plant.get<int>("lag::steps"), tick);
  }
}

TEST_P(FmuImport, Is_the_same_in_every_run) {
  std::vector<std::uint64_t> bits;
  for (int run = 0; run < 2; ++run) {
    const Model model(device());
    Plant plant(model.file());
    for (int tick = 0; tick < 100; ++tick) {
      plant.set("lag::u", std::sin(tick * 0.1));
      plant.step();
      const auto value = std::bit_cast<std::uint64_t>(plant.get<double>("lag::lag_y"));
      if (run == 0) {
        bits.push_back(value);
      } else {
        ASSERT_EQ(value, bits[static_cast<std::size_t>(tick)]) << tick;
      }
    }
  }
}

TEST_P(FmuImport, Skipped_runs_are_made_up_for) {
  // Each run takes 25 ms, as if a report had measured it: two of three releases are skipped.
  const Model model(device());
  std::ofstream(model.folder() / "report.json") << R"({"modules": [{"name": "model", "exec_ns": {"max": 25000000}}]})";
  Plant plant(model.file(), {.times = model.folder() / "report.json"});
  plant.set("lag::u", 1.0);
  plant.run(std::chrono::seconds(1));
  const int steps = plant.get<int>("lag::steps");
  EXPECT_GT(plant.module("model").skipped, 50U);
  EXPECT_GT(steps, 90) << "all the time that has passed";
  EXPECT_NEAR(plant.get<double>("lag::lag_y"), 1 - std::exp(-steps * kStep / 0.1), 1e-13);
}

TEST_P(FmuImport, Parameters_texts_and_resources_are_set_before_the_start) {
  const Model model(device(R"(<set at="text" value="seven ä"/>
    <set at="choice" value="fast"/><set at="gain" value="3"/><input variable="kinds::in.i32" at="byte"/>)"),
                    types_module());
  Plant plant(model.file());
  plant.set("lag::u", 1.0);
  plant.step(2);
  EXPECT_EQ(plant.get<int>("lag::length"), 8);
  EXPECT_EQ(plant.get<int>("kinds::in.i32"), 'D') << "the first byte of resources/data.txt";
  EXPECT_EQ(plant.get<int>("lag::chosen"), 1) << "the variable has the start value of the FMU, and goes before <set>";
  EXPECT_NEAR(plant.get<double>("lag::lag_y"), 3 * (1 - std::exp(-kStep / 0.1)), 1e-15);
}

TEST_P(FmuImport, Points_have_scales_qualities_and_limits) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}" quality="kinds::in.u16">
    <set at="fault" value="6"/><set at="at" value="3"/>
    <output variable="kinds::in.f64" at="u" scale="2" quality="kinds::in.u8"/>
    <output variable="kinds::in.f32" at="gain"/>
    <output variable="kinds::in.flag" at="flag"/>
    <input variable="kinds::in.grid[1][2]" at="lag.y" offset="100" quality="kinds::in.i8" bad="-1"/>
    <input variable="kinds::in.i16" at="not_flag"/>
    <input variable="kinds::in.grid[0][0]" at="T"/></device>)",
                                lag(GetParam())),
                    types_module());
  Plant plant(model.file());
  plant.set("kinds::in.f32", 2);
  plant.set("kinds::in.f64", 6.0);  // u = 3
  plant.set("kinds::in.flag", true);
  plant.step(2);
  EXPECT_NEAR(plant.get<double>("kinds::in.grid[1][2]"), 100 + 6 * (1 - std::exp(-0.1)), 1e-12);
  EXPECT_EQ(plant.get<int>("kinds::in.u8"), 1);
  EXPECT_EQ(plant.get<int>("kinds::in.i8"), 1);
  EXPECT_EQ(plant.get<int>("kinds::in.u16"), 1);
  EXPECT_EQ(plant.get<int>("kinds::in.i16"), 0);
  EXPECT_EQ(plant.get<double>("kinds::in.grid[0][0]"), 0.1);
  plant.set("kinds::in.f64", 30.0);  // u = 15, its maximum is 10
  plant.step();
  EXPECT_EQ(plant.get<int>("kinds::in.u8"), 4);
  plant.step();
  EXPECT_EQ(plant.get<int>("kinds::in.i8"), 4) << "it is NaN";
  EXPECT_EQ(plant.get<double>("kinds::in.grid[1][2]"), -1);
}

TEST_P(FmuImport, Texts_are_points_and_are_cut_between_characters) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}">
    <output variable="kinds::in.text" at="word"/>
    <input variable="kinds::echo" at="echo" quality="kinds::in.i8"/></device>)",
                                lag(GetParam())),
                    types_module());
  Plant plant(model.file());
  plant.set("kinds::in.text", "abc");
  plant.step(2);
  EXPECT_EQ(plant.get<std::string>("kinds::echo"), "abcabc");
  EXPECT_EQ(plant.get<int>("kinds::in.i8"), 1);
  plant.set("kinds::in.text", "12345678\u00e4");
  plant.step();
  EXPECT_EQ(plant.get<std::string>("kinds::echo"), "12345678\u00e412345") << "15 bytes fit";
  EXPECT_EQ(plant.get<int>("kinds::in.i8"), 4);
  plant.set("kinds::in.text", "1234567\u00e412345");
  plant.step();
  EXPECT_EQ(plant.get<std::string>("kinds::echo"), "1234567\u00e4123451");
  plant.set("kinds::in.text", "\u00e4\u00e4\u00e4\u00e4");
  plant.step();
  EXPECT_EQ(plant.get<std::string>("kinds::echo"), "\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4")
      << "14 bytes are 7 characters";
  plant.set("kinds::in.text", "");
  plant.step();
  EXPECT_EQ(plant.get<std::string>("kinds::echo"), "");
  EXPECT_EQ(plant.get<int>("kinds::in.i8"), 1);
}

TEST_P(FmuImport, Two_instances_share_nothing) {
  const Model model(device(R"(<input variable="kinds::in.i32" at="counter"/>)", "left") +
                        device(R"(<input variable="kinds::in.i16" at="counter"/><set at="T" value="1"/>)", "right"),
                    types_module());
  Plant plant(model.file());
  plant.set("left::u", 1.0);
  plant.set("right::u", 1.0);
  plant.step(11);
  EXPECT_NEAR(plant.get<double>("left::lag_y"), 1 - std::exp(-1.0), 1e-14);
  EXPECT_NEAR(plant.get<double>("right::lag_y"), 1 - std::exp(-0.1), 1e-14);
  EXPECT_EQ(plant.get<int>("kinds::in.i32"), 1);
  EXPECT_EQ(plant.get<int>("kinds::in.i16"), 1) << "globals of the library are those of one instance, too";
}

INSTANTIATE_TEST_SUITE_P(Fmi, FmuImport, ::testing::Values(2, 3));

TEST(FmuImport3, All_types_and_arrays_are_exact) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}" variables="lag"/>)", lag(3)));
  Plant plant(model.file());
  EXPECT_EQ(plant.get<std::string>("lag::vector"), "[[0, 0, 0], [0, 0, 0]]");
  const auto copied = [&plant]<class T>(const std::string& name, T value) {
    plant.set("lag::" + name, value);
    plant.step(2);
    return plant.get<T>("lag::" + name + "_out");
  };
  const auto expect_limits = [&copied]<class T>(const std::string& name, T) {
    for (const T value : {std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max(), T{1}}) {
      EXPECT_EQ(copied(name, value), value) << name;
    }
  };
  expect_limits("int8", std::int8_t{});
  expect_limits("uint8", std::uint8_t{});
  expect_limits("int16", std::int16_t{});
  expect_limits("uint16", std::uint16_t{});
  expect_limits("int32", std::int32_t{});
  expect_limits("uint32", std::uint32_t{});
  expect_limits("int64", std::int64_t{});
  expect_limits("uint64", std::uint64_t{});
  expect_limits("small", float{});
  plant.set("lag::vector", "[[1, 2, 3], [4, 5, 6.5]]");
  plant.step(2);
  EXPECT_EQ(plant.get<std::string>("lag::twice"), "[[2, 4, 6], [8, 10, 13]]");
}

TEST(FmuImport3, Elements_count_from_one_and_others_keep_their_start_values) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}">
    <set at="vector" value="10 20 30 40 50 60"/>
    <output variable="kinds::in.f64" at="vector[2,1]"/>
    <input variable="kinds::in.grid" at="twice"/></device>)",
                                lag(3)),
                    types_module());
  Plant plant(model.file());
  plant.set("kinds::in.f64", 7.0);
  plant.step(2);
  EXPECT_EQ(plant.get<std::string>("kinds::in.grid"), "[[20, 40, 60], [14, 100, 120]]");
}

}  // namespace
}  // namespace indurop::fmi
