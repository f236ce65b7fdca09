// SPDX-License-Identifier: Apache-2.0
// Quantiles of a Distribution.
#include "scheduler/quantile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "scheduler/statistics.h"

namespace indurop::scheduler {
namespace {

class Quantile : public ::testing::Test {
 protected:
  std::unique_ptr<Distribution> distribution_ = std::make_unique<Distribution>();
  void add(std::int64_t value, int times = 1) {
    for (int i = 0; i < times; ++i) {
      add_sample(*distribution_, value);
    }
  }
};

TEST_F(Quantile, Of_nothing_is_zero) {
  const Summary sut = summarize(*distribution_);
  EXPECT_EQ(sut.count, 0U);
  EXPECT_EQ(sut.max, 0);
  EXPECT_EQ(sut.p99_9, 0);
}

TEST_F(Quantile, Of_one_sample_is_that_sample) {
  add(1'234'567);
  const Summary sut = summarize(*distribution_);
  EXPECT_EQ(sut.min, 1'234'567);
  EXPECT_EQ(sut.p50, 1'234'567);
  EXPECT_EQ(sut.p99_9, 1'234'567);
  EXPECT_EQ(sut.mean, 1'234'567);
}

TEST_F(Quantile, One_outlier_in_a_thousand_is_not_in_p99) {
  add(100, 999);
  add(5'000'000);
  const Summary sut = summarize(*distribution_);
  EXPECT_NEAR(static_cast<double>(sut.p50), 100, 6.25);
  EXPECT_NEAR(static_cast<double>(sut.p99), 100, 6.25);
  EXPECT_NEAR(static_cast<double>(sut.p99_9), 100, 6.25);
  EXPECT_EQ(sut.max, 5'000'000);
}

TEST_F(Quantile, Two_outliers_in_a_thousand_are_in_p99_9) {
  add(100, 998);
  add(5'000'000, 2);
  EXPECT_NEAR(static_cast<double>(summarize(*distribution_).p99_9), 5'000'000, 312'500);
}

TEST_F(Quantile, Small_values_are_exact) {
  for (int value = 1; value <= 10; ++value) {
    add(value, 10);
  }
  const Summary sut = summarize(*distribution_);
  EXPECT_EQ(sut.p50, 5);
  EXPECT_EQ(sut.p99, 10);
  EXPECT_EQ(sut.mean, 5);
}

TEST_F(Quantile, Is_within_six_percent_of_the_exact_one_for_any_shape) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> shape(9, 1.5);
  std::vector<std::int64_t> values;
  for (int i = 0; i < 20'000; ++i) {
    values.push_back(static_cast<std::int64_t>(shape(random)));
    add(values.back());
  }
  std::sort(values.begin(), values.end());
  const Summary sut = summarize(*distribution_);
  const auto exact = [&values](double part) {
    return static_cast<double>(
        values[static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size()))) - 1]);
  };
  EXPECT_NEAR(static_cast<double>(sut.p50), exact(0.5), exact(0.5) * 0.0625);
  EXPECT_NEAR(static_cast<double>(sut.p99), exact(0.99), exact(0.99) * 0.0625);
  EXPECT_NEAR(static_cast<double>(sut.p99_9), exact(0.999), exact(0.999) * 0.0625);
  EXPECT_LE(sut.min, sut.p50);
  EXPECT_LE(sut.p99_9, sut.max);
}

TEST_F(Quantile, Values_beyond_the_last_bucket_are_held_by_the_maximum) {
  add(INT64_MAX / 4, 3);
  const Summary sut = summarize(*distribution_);
  EXPECT_EQ(sut.max, INT64_MAX / 4);
  EXPECT_EQ(sut.p50, INT64_MAX / 4);
}

}  // namespace
}  // namespace indurop::scheduler
