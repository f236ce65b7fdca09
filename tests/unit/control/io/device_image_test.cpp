// SPDX-License-Identifier: Apache-2.0
// What becomes of values on their way between driver and variables, good and bad ones.
#include "control/io/device_image.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace indurop::io {
namespace {

using Outputs = DeviceImage::Outputs;
using Outcome = Driver::Outcome;

// Answers what the test says.
class FakeDriver final : public Driver {
 public:
  [[nodiscard]] bool in_tick() const noexcept override { return true; }
  bool open() override { return true; }
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds /*e*/) override {
    sent.assign(outputs.begin(), outputs.end());
    for (Sample& input : inputs) {
      input.quality = answer.quality;
      input.value = answer.quality == Quality::Good ? answer.value : input.value;
    }
    return outcome;
  }
  void close() noexcept override {}
  [[nodiscard]] std::string problem() const override { return "fake"; }

  std::vector<Sample> sent;
  Sample answer{0, Quality::Good};
  Outcome outcome = Outcome::Good;
};

config::BoundPoint point(schema::Base base, double scale = 1, double offset = 0) {
  config::BoundPoint b;
  b.point.scale = scale;
  b.point.offset = offset;
  b.variable.type.base = base;
  return b;
}

template <class T>
T value_of(const DeviceImage& image) {
  T value{};
  std::memcpy(&value, &image.current().inputs[0].bits, sizeof value);
  return value;
}

DeviceImage input(const config::BoundPoint& p) {
  return {std::span(&p, 1), {}};
}

TEST(DeviceImage, Good_values_are_scaled) {
  FakeDriver driver;
  DeviceImage sut = input(point(schema::Base::Double, 0.5, 10));
  EXPECT_FALSE(sut.current().inputs[0].is_set);
  driver.answer.value = 100;
  sut.exchange(driver, {}, Outputs::Unknown, {});
  EXPECT_TRUE(sut.current().inputs[0].is_set);
  EXPECT_EQ(value_of<double>(sut), 60);
  EXPECT_EQ(sut.current().inputs[0].quality, Quality::Good);
  EXPECT_EQ(sut.current().device, Quality::Good);
}

TEST(DeviceImage, A_bad_value_holds_the_last_good_one) {
  FakeDriver driver;
  DeviceImage sut = input(point(schema::Base::Int16));
  driver.answer.value = 7;
  sut.exchange(driver, {}, Outputs::Unknown, {});
  driver.answer.quality = Quality::Lost;
  driver.outcome = Outcome::Lost;
  sut.exchange(driver, {}, Outputs::Unknown, {});
  EXPECT_EQ(value_of<std::int16_t>(sut), 7);
  EXPECT_EQ(sut.current().inputs[0].quality, Quality::Lost);
  EXPECT_EQ(sut.current().device, Quality::Lost);
  EXPECT_EQ(sut.current().errors, 1U);
}

TEST(DeviceImage, A_bad_value_becomes_what_the_file_says) {
  FakeDriver driver;
  config::BoundPoint p = point(schema::Base::Int16, 10);
  p.point.bad_value = -1;
  DeviceImage sut = input(p);
  sut.lose();
  EXPECT_TRUE(sut.current().inputs[0].is_set);
  EXPECT_EQ(value_of<std::int16_t>(sut), -1) << "in the variable's own unit, not scaled";
}

TEST(DeviceImage, Without_a_good_value_a_held_one_is_not_touched) {
  DeviceImage sut = input(point(schema::Base::Int16));
  sut.lose();
  EXPECT_FALSE(sut.current().inputs[0].is_set);
  EXPECT_EQ(sut.current().inputs[0].quality, Quality::Lost);
}

TEST(DeviceImage, What_the_variable_cannot_hold_is_cut_and_marked) {
  FakeDriver driver;
  DeviceImage sut = input(point(schema::Base::Int8));
  driver.answer.value = 1000;
  sut.exchange(driver, {}, Outputs::Unknown, {});
  EXPECT_EQ(value_of<std::int8_t>(sut), 127);
  EXPECT_EQ(sut.current().inputs[0].quality, Quality::OutOfRange);
}

TEST(DeviceImage, What_is_no_number_is_bad) {
  for (const Number number : {std::numeric_limits<Number>::quiet_NaN(), std::numeric_limits<Number>::infinity(),
                              -std::numeric_limits<Number>::infinity()}) {
    FakeDriver driver;
    config::BoundPoint p = point(schema::Base::Double);
    DeviceImage held = input(p);
    driver.answer.value = number;
    held.exchange(driver, {}, Outputs::Unknown, {});
    EXPECT_FALSE(held.current().inputs[0].is_set);
    driver.answer.value = 7;
    held.exchange(driver, {}, Outputs::Unknown, {});
    driver.answer.value = number;
    held.exchange(driver, {}, Outputs::Unknown, {});
    EXPECT_EQ(value_of<double>(held), 7);
    EXPECT_EQ(held.current().inputs[0].quality, Quality::OutOfRange);
    p.point.bad_value = -1;
    DeviceImage replaced = input(p);
    replaced.exchange(driver, {}, Outputs::Unknown, {});
    EXPECT_EQ(value_of<double>(replaced), -1);
    EXPECT_EQ(replaced.current().inputs[0].quality, Quality::OutOfRange);
  }
}

TEST(DeviceImage, Rejected_points_are_distinguished_from_a_lost_device) {
  FakeDriver driver;
  DeviceImage sut = input(point(schema::Base::Int8));
  driver.answer.quality = Quality::Refused;
  driver.outcome = Outcome::Partly;
  sut.exchange(driver, {}, Outputs::Unknown, {});
  EXPECT_EQ(sut.current().device, Quality::Refused);
}

class Output : public ::testing::Test {
 protected:
  DeviceImage image(double scale = 1, std::optional<double> stop = {}) {
    config::BoundPoint p = point(schema::Base::Double, scale, 5);
    p.point.output = true;
    p.point.stop = stop;
    return {{}, std::span(&p, 1)};
  }
  static OutputImage bits(double value) {
    OutputImage all(1);
    std::memcpy(all.data(), &value, sizeof value);
    return all;
  }
  FakeDriver driver;
};

TEST_F(Output, Is_scaled_back) {
  DeviceImage sut = image(0.5);
  sut.exchange(driver, bits(10), Outputs::Fresh, {});
  EXPECT_EQ(driver.sent[0].value, 10);
  EXPECT_EQ(driver.sent[0].quality, Quality::Good);
  EXPECT_EQ(sut.current().outputs[0], Quality::Good);
}

TEST_F(Output, Is_not_sent_before_the_first_run) {
  DeviceImage sut = image();
  sut.exchange(driver, bits(10), Outputs::Unknown, {});
  EXPECT_EQ(driver.sent[0].quality, Quality::None);
}

TEST_F(Output, Takes_its_stop_value_when_the_tick_stands_still) {
  DeviceImage sut = image(0.5, 0);
  EXPECT_TRUE(sut.has_stop_values());
  sut.exchange(driver, bits(10), Outputs::Hold, {});
  EXPECT_EQ(driver.sent[0].quality, Quality::Good);
  EXPECT_EQ(driver.sent[0].value, -10);
  DeviceImage without = image();
  without.exchange(driver, bits(10), Outputs::Hold, {});
  EXPECT_EQ(driver.sent[0].quality, Quality::NotRefreshed);
  EXPECT_EQ(without.current().outputs[0], Quality::NotRefreshed);
}

TEST_F(Output, Not_a_number_is_never_sent) {
  DeviceImage sut = image();
  sut.exchange(driver, bits(12), Outputs::Fresh, {});
  sut.exchange(driver, bits(std::numeric_limits<double>::quiet_NaN()), Outputs::Fresh, {});
  EXPECT_EQ(driver.sent[0].value, 7) << "the last number";
  EXPECT_EQ(sut.current().outputs[0], Quality::OutOfRange);
}

}  // namespace
}  // namespace indurop::io
