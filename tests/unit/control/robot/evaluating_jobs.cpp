// SPDX-License-Identifier: Apache-2.0
// Reads expressions, one a line, and prints their values as a job computes them, "none" without a value;
// expressions_test.py compares them with its own. Variables: n = 7, half = 0.5, a[4] = 2, -3, 0, 10; I4 is 5.

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

#include "job_world.h"

int main() {
  using namespace indurop::robot;
  for (std::string line; std::getline(std::cin, line);) {
    const auto [book, errors] =
        parse_jobs({{"a.job", "VAR n = 7\nVAR half = 0.5\nVAR a[4] = 2, -3, 0, 10\nSET OUT = " + line + "\n"}});
    if (!errors.empty()) {
      const std::string text = indurop::base::to_text(errors);
      const bool constant = text.find("has no value") != std::string::npos ||
                            text.find("divides by 0") != std::string::npos ||
                            text.find("no such element") != std::string::npos;
      std::cout << (constant ? "none\n" : text);
      continue;
    }
    World world(book.signals);
    world.values["I4"] = 5;
    if (run(book, world).state == JobState::Ended) {
      std::printf("%.17g\n", world.values["OUT"]);
    } else {
      std::puts("none");
    }
  }
}
