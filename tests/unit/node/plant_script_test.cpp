// SPDX-License-Identifier: Apache-2.0
#include "node/plant_script.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace indurop::node {
namespace {

using namespace std::chrono_literals;
using What = PlantEvent::What;

PlantScript read(const std::string& text) {
  return read_script_text(text, "s.txt", {"sensor", "control"});
}

std::string errors(const std::string& text) {
  std::string out;
  for (const base::Diagnostic& one : read(text).diagnostics) {
    out += base::to_string(one) + "\n";
  }
  return out;
}

TEST(PlantScript, Is_read_and_sorted_by_time) {
  const PlantScript sut = read("# what happens\n1s return sensor\n\n500ms kill sensor   # power\n2s\tcut control\n");
  EXPECT_TRUE(sut.diagnostics.empty());
  ASSERT_EQ(sut.events.size(), 3U);
  EXPECT_EQ(sut.events[0].at, 500ms);
  EXPECT_EQ(sut.events[0].what, What::Kill);
  EXPECT_EQ(sut.events[0].board, 0U);
  EXPECT_EQ(sut.events[1].what, What::Return);
  EXPECT_EQ(sut.events[2].what, What::Cut);
  EXPECT_EQ(sut.events[2].board, 1U);
  EXPECT_EQ(sut.events[2].text, "cut control");
}

TEST(PlantScript, Says_all_that_is_wrong_with_its_lines) {
  const std::string said = errors("1s kil sensor\n2s cut control now\nsoon kill sensor\n3s kill sensr\n");
  EXPECT_NE(said.find("s.txt:1:1: error: 'kil' befalls no board; did you mean 'kill'?"), std::string::npos) << said;
  EXPECT_NE(said.find("s.txt:2:1: error: this is no line of a script"), std::string::npos) << said;
  EXPECT_NE(said.find("s.txt:3:1: error: "), std::string::npos) << said;
  EXPECT_NE(said.find("s.txt:4:1: error: the plant has no board 'sensr'; did you mean 'sensor'?"), std::string::npos)
      << said;
}

}  // namespace
}  // namespace indurop::node
