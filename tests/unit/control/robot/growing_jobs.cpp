// SPDX-License-Identifier: Apache-2.0
// growing_jobs --list: the names and first sizes of all texts. growing_jobs NAME N: reads that job file and says what
// became of it; growth_test.py of the PLC compiler counts the instructions of that.

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "control/robot/job/job.h"

namespace {

using Size = std::size_t;

// `text` n times, with its number for each '#'.
std::string repeated(Size n, std::string_view text) {
  std::string out;
  for (Size i = 0; i < n; ++i) {
    for (const char c : text) {
      out += c == '#' ? std::to_string(i) : std::string(1, c);
    }
  }
  return out;
}

constexpr std::string_view kPoints = "POINT p# = JOINT 0 0 0 0 0 0\n";
constexpr std::string_view kFrames = "FRAME f# = POSE 0 0 0 RPY 0 0 0\n";
constexpr std::string_view kTools = "TOOL t# = POSE 0 0 0 RPY 0 0 0\n";

struct Text {
  const char* name;
  std::string (*text)(Size);
};
constexpr Text kTexts[] = {
    {"points", [](Size n) { return repeated(n, kPoints) + "TOOL FLANGE\n" + repeated(n, "MOVJ p#\n"); }},
    {"points_unknown", [](Size n) { return repeated(n, kPoints) + "TOOL FLANGE\n" + repeated(n, "MOVJ q#\n"); }},
    {"frames", [](Size n) { return repeated(n, kFrames) + repeated(n, "POINT p# = POSE 0 0 0 RPY 0 0 0 IN f#\n"); }},
    {"frames_unknown",
     [](Size n) { return repeated(n, kFrames) + repeated(n, "POINT p# = POSE 0 0 0 RPY 0 0 0 IN g#\n"); }},
    {"tools", [](Size n) { return repeated(n, kTools) + repeated(n, "TOOL t#\n"); }},
    {"tools_unknown", [](Size n) { return repeated(n, kTools) + repeated(n, "TOOL s#\n"); }},
    {"labels_unknown", [](Size n) { return repeated(n, "LABEL l#\nGOTO m#\n"); }},
    {"jobs_unknown", [](Size n) { return repeated(n, "CALL k#\n"); }},
    {"nonsense", [](Size n) { return repeated(n, "NONSENSE #\n"); }},
};
constexpr Size kFirst = 1000;

}  // namespace

int main(int argc, char** argv) {
  const std::string_view wanted = argc > 1 ? argv[1] : "";
  for (const Text& one : kTexts) {
    if (wanted == "--list") {
      std::cout << one.name << ' ' << kFirst << '\n';
    } else if (wanted == one.name && argc > 2) {
      const std::string text = one.text(std::strtoul(argv[2], nullptr, 10));
      const auto read = indurop::robot::parse_jobs({{"a.job", text}});
      std::cout << (read.diagnostics.empty() ? "fine" : "refused") << ", " << read.diagnostics.size() << " errors\n";
      if (!read.diagnostics.empty()) {
        std::cout << indurop::base::to_string(read.diagnostics.front()) << '\n';
      }
    }
  }
  return 0;
}
