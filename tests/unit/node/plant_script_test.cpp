// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/plant_script.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace indurop::node {
namespace {

using namespace std::chrono_literals;
using What = PlantEvent::What;

PlantScript read(const std::string& text, std::optional<std::chrono::nanoseconds> end = {}) {
  return read_script_text(text, "s.txt", {"sensor", "control"}, end);
}

std::string errors(const std::string& text, std::optional<std::chrono::nanoseconds> end = {}) {
  std::string out;
  for (const base::Diagnostic& one : read(text, end).diagnostics) {
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
  EXPECT_NE(said.find("s.txt:1:1: error: 'kil' cannot happen to a board; did you mean 'kill'?"), std::string::npos)
      << said;
  EXPECT_NE(said.find("s.txt:2:1: error: this is not a line of a script"), std::string::npos) << said;
  EXPECT_NE(said.find("s.txt:3:1: error: "), std::string::npos) << said;
  EXPECT_NE(said.find("s.txt:4:1: error: the plant has no board 'sensr'; did you mean 'sensor'?"), std::string::npos)
      << said;
}

TEST(PlantScript, A_time_has_a_unit) {
  EXPECT_EQ(errors("500 kill sensor\n"), "s.txt:1:1: error: write the unit of the time: 500ms or 500s\n");
  EXPECT_EQ(errors("0 kill sensor\n"), "");
}

TEST(PlantScript, What_comes_behind_the_end_is_left_out_and_said) {
  const std::string text = "999ms cut sensor\n1s kill control\n5s return sensor\n";
  EXPECT_EQ(read(text, 1s).events.size(), 1U);
  EXPECT_EQ(errors(text, 1s),
            "s.txt:2:1: warning: 'kill control' never happens: the run ends after 1 s\n"
            "s.txt:3:1: warning: 'return sensor' never happens: the run ends after 1 s\n");
  EXPECT_EQ(errors(text), "");
}

TEST(PlantScript, What_changes_nothing_is_said) {
  EXPECT_EQ(errors("1s return sensor\n2s kill sensor\n3s kill sensor\n4s cut sensor\n5s cut sensor\n6s return sensor\n"
                   "7s return sensor\n8s cut control\n9s kill control\n"),
            "s.txt:1:1: warning: 'return sensor' changes nothing: the board is there then\n"
            "s.txt:3:1: warning: 'kill sensor' changes nothing: the board is down already then\n"
            "s.txt:5:1: warning: 'cut sensor' changes nothing: the board is cut off already then\n"
            "s.txt:7:1: warning: 'return sensor' changes nothing: the board is there then\n");
}

}  // namespace
}  // namespace indurop::node
