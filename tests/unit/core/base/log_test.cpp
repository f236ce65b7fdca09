// SPDX-License-Identifier: Apache-2.0
// Lines of programs in the background, about what others wrote.
#include "core/base/log.h"

#include <gtest/gtest.h>

#include "core/base/printable.h"

namespace indurop::base {
namespace {

TEST(Log, A_name_from_the_network_makes_no_line_and_no_escape_sequence) {
  testing::internal::CaptureStderr();
  const Log log("indurop-agent", "a", false);
  log.warning("an order of {} was refused", "desk\nindurop-agent[a]: all is well\x1b[1A");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "indurop-agent[a]: warning: an order of desk?indurop-agent[a]: all is well?[1A was refused\n");
}

TEST(Printable, Letters_of_all_languages_stay_and_controls_do_not) {
  EXPECT_EQ(printable("Größe 25 °C → 日本"), "Größe 25 °C → 日本");
  EXPECT_EQ(printable("a\x1b[0mb\x7f\xc2\x85\xff\n"), "a?[0mb????");
  EXPECT_EQ(printable("a\tb\n", "\t"), "a\tb?");
}

}  // namespace
}  // namespace indurop::base
