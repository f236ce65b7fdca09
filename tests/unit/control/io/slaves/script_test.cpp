// SPDX-License-Identifier: Apache-2.0
// Scripts of faults: what is read, and what is said of lines that are wrong.
#include "control/io/slaves/script.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace indurop::io::slaves {
namespace {

using ethercat::FaultKind;

TEST(Script, Lines_say_when_what_to_which_slave_and_for_how_long) {
  const Script sut = read_script(
      "# a plant on a bad day\n"
      "\n"
      "0s frames_lost for=5ms\n"
      "  2.5s  power_off slave=1 for=400ms   # pulled\n"
      "3s frames_late for=5ms by=2ms\n"
      "4s emergency slave=0 code=0x8611\n"
      "5s value slave=1 at=6000:1a to=1\n"
      "6s state_slow slave=0 for=1s by=300ms\n"
      "7s clock_drifts slave=1 for=2s ppm=100\n",
      "faults", 2);
  EXPECT_EQ(base::to_text(sut.diagnostics), "");
  ASSERT_EQ(sut.faults.size(), 7U);
  EXPECT_EQ(sut.faults[5].value, 300'000'000U);
  EXPECT_EQ(sut.faults[6].value, 100U);
  EXPECT_EQ(sut.faults[4].object, 0x60001AU);
  EXPECT_EQ(sut.faults[4].value, 1U);
  EXPECT_EQ(sut.faults[0].kind, FaultKind::FramesLost);
  EXPECT_EQ(sut.faults[0].at, ethercat::Time(0));
  EXPECT_EQ(sut.faults[1].kind, FaultKind::PowerOff);
  EXPECT_EQ(sut.faults[1].at, std::chrono::milliseconds(2500));
  EXPECT_EQ(sut.faults[1].duration, std::chrono::milliseconds(400));
  EXPECT_EQ(sut.faults[1].slave, 1U);
  EXPECT_EQ(sut.faults[2].value, 2'000'000U);
  EXPECT_EQ(sut.faults[3].value, 0x8611U);
}

TEST(Script, Each_form_in_its_help_is_read) {
  const Script sut = read_script(script_help(), "help", 1);
  EXPECT_EQ(base::to_text(sut.diagnostics), "");
  ASSERT_EQ(sut.faults.size(), std::size_t{ethercat::kFaultKinds});
  for (std::uint8_t kind = 0; kind < ethercat::kFaultKinds; ++kind) {
    EXPECT_TRUE(std::any_of(sut.faults.begin(), sut.faults.end(), [kind](const auto& fault) {
      return fault.kind == static_cast<FaultKind>(kind);
    })) << int{kind};
  }
}

TEST(Script, Wrong_lines_are_named_with_their_place_and_what_to_write) {
  const auto said = [](const std::string& line) { return base::to_text(read_script(line, "faults", 2).diagnostics); };
  EXPECT_EQ(said("soon power_off"), "faults:1:1: error: 'soon' is no time; write 0s, 500ms, 2s\n");
  EXPECT_EQ(said("2s"), "faults:1:1: error: there is no fault after the time; write 2s frames_lost for=5ms\n");
  EXPECT_EQ(said("2s poweroff slave=0"),
            "faults:1:4: error: there is no fault 'poweroff'; did you mean 'power_off'?\n");
  EXPECT_EQ(said("2s power_off slave=0"), "faults:1:4: error: power_off is written so: power_off slave=0 for=5ms\n");
  EXPECT_EQ(said("2s power_off slave=2 for=5ms"),
            "faults:1:14: error: 'slave=2' is not possible here; power_off is written so: power_off slave=0 for=5ms, "
            "with a slave from 0 to 1\n");
  EXPECT_EQ(said("2s cable_cut slave=2 for=5ms"), "") << "behind the last one";
  EXPECT_EQ(said("2s clock_drifts slave=0 for=1s ppm=20000"),
            "faults:1:32: error: 'ppm=20000' is not possible here; clock_drifts is written so: clock_drifts slave=0 "
            "for=5ms ppm=50\n");
  EXPECT_EQ(said("2s value slave=0 to=1"), "faults:1:4: error: value is written so: value slave=0 at=6000:1 to=1\n");
  EXPECT_EQ(said("2s frames_lost for=5x"),
            "faults:1:16: error: 'for=5x' is not possible here; frames_lost is written so: frames_lost for=5ms\n");
}

}  // namespace
}  // namespace indurop::io::slaves
