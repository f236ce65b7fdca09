// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tools/solids/bodies.h"

namespace indurop::solids {
namespace {

using ::testing::HasSubstr;

TEST(Pictures, Have_three_views_of_each_mesh_with_all_its_solids) {
  const Surface surface = box_surface({0.2, 0.3, 0.4});
  const std::string svg = draw({{"upper arm <1>", surface, {robot::Solid::box({0.2, 0.3, 0.4}, {})}},
                                {"forearm", surface, {robot::Solid::ball(0.3, {}), robot::Solid::ball(0.2, {})}}});
  const auto count = [&svg](const std::string& what) {
    int found = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count("class=\"mesh\""), 6);
  EXPECT_EQ(count("class=\"solid\""), 9);
  EXPECT_THAT(svg, HasSubstr("upper arm &lt;1&gt;"));
}

TEST(Pictures, Are_the_same_each_time) {
  const std::vector<DrawnMesh> one = {{"link", cylinder_surface(0.1, 0.2), {robot::Solid::cylinder(0.1, 0.2, {})}}};
  EXPECT_EQ(draw(one), draw(one));
}

}  // namespace
}  // namespace indurop::solids
