// SPDX-License-Identifier: Apache-2.0
// Bars for the terminal and the picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "scheduler/statistics.h"
#include "tools/cli/pictures/histogram_bins.h"
#include "tools/cli/pictures/histogram_svg.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class HistogramPicture : public ::testing::Test {
 protected:
  scheduler::Distribution& distribution() { return *distribution_; }
  [[nodiscard]] scheduler::HistogramCounts counts() const {
    scheduler::HistogramCounts out;
    scheduler::copy_counts(distribution_->histogram, out);
    return out;
  }

 private:
  std::unique_ptr<scheduler::Distribution> distribution_ = std::make_unique<scheduler::Distribution>();
};

TEST_F(HistogramPicture, Of_nothing_has_no_bins) {
  EXPECT_TRUE(gather(counts(), 20).empty());
}

TEST_F(HistogramPicture, Bins_hold_every_sample_and_are_not_more_than_asked_for) {
  for (std::int64_t value = 1; value < 1'000'000'000; value *= 3) {
    scheduler::add_sample(distribution(), value);
  }
  const auto bins = gather(counts(), 12);
  ASSERT_FALSE(bins.empty());
  EXPECT_LE(bins.size(), 12U);
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    total += bins[i].count;
    if (i > 0) {
      EXPECT_EQ(bins[i].from_ns, bins[i - 1].to_ns);
    }
  }
  EXPECT_EQ(total, distribution().count.load());
  EXPECT_GT(bins.front().count, 0U);
  EXPECT_GT(bins.back().count, 0U);
}

TEST_F(HistogramPicture, Every_bin_with_samples_shows_a_bar) {
  for (int i = 0; i < 100'000; ++i) {
    scheduler::add_sample(distribution(), 100);
  }
  scheduler::add_sample(distribution(), 10'000'000);
  const Output plain(ColorWhen::Never);
  const auto lines = bar_lines(gather(counts(), 20), 30, plain);
  ASSERT_GE(lines.size(), 2U);
  for (const auto& line : {lines.front(), lines.back()}) {
    EXPECT_TRUE(line.find('#') != std::string::npos || line.find("\xe2\x96") != std::string::npos) << line;
  }
  EXPECT_THAT(lines.back(), HasSubstr("<0.01 %"));
}

TEST_F(HistogramPicture, Svg_marks_the_quantiles_and_escapes_names) {
  for (int i = 1; i < 1000; ++i) {
    scheduler::add_sample(distribution(), i * 100);
  }
  const HistogramPanel panel{"a<b>&\"c", "jitter", scheduler::summarize(distribution()), counts()};
  const std::string svg = histogram_svg("Node x", {&panel, 1});
  EXPECT_THAT(svg, HasSubstr("a&lt;b&gt;&amp;&quot;c"));
  EXPECT_THAT(svg, Not(HasSubstr("a<b>")));
  EXPECT_THAT(svg, HasSubstr("p99.9 "));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
}

TEST_F(HistogramPicture, Svg_of_nothing_or_of_zeros_is_still_a_picture) {
  EXPECT_THAT(histogram_svg("Node x", {}), HasSubstr("nothing measured"));
  scheduler::add_sample(distribution(), 0);
  const HistogramPanel panel{"m", "jitter", scheduler::summarize(distribution()), counts()};
  EXPECT_THAT(histogram_svg("Node x", {&panel, 1}), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace indurop::tools
