// SPDX-License-Identifier: Apache-2.0
// Random schedules and where place() puts them, a line of JSON each, for placement_solver.py.
// Usage: placement_sets FIRST_SEED COUNT

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "scheduler/placement.h"

namespace {

using indurop::scheduler::Nanos;
using indurop::scheduler::Placeable;
using indurop::scheduler::Placement;
using indurop::scheduler::PlacementProblem;
using std::chrono::microseconds;

constexpr int kBasicUs = 1000;

PlacementProblem random_problem(unsigned seed) {
  std::mt19937 random(seed);
  const auto upto = [&random](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
  PlacementProblem problem;
  problem.basic_period = microseconds(kBasicUs);
  problem.cores = upto(1, 4);
  problem.split_sharing = upto(0, 2) == 0;
  const bool one_period = problem.split_sharing || upto(0, 1) == 0;
  const int count = upto(2, problem.split_sharing ? 7 : 8);
  const int load = upto(50, 110);  // percent of the cores
  for (int i = 0; i < count; ++i) {
    Placeable module;
    const int ticks = one_period ? 1 : 1 << upto(0, 2);
    module.period = problem.basic_period * ticks;
    module.execution =
        microseconds(std::clamp(kBasicUs * problem.cores * load / 100 / count * upto(40, 160) / 100, 5, kBasicUs));
    module.deadline = microseconds(upto(0, 2) == 0 ? upto(300, kBasicUs) : kBasicUs);
    for (int other = 0; other < i; ++other) {
      if (upto(0, problem.split_sharing ? 3 : 7) == 0) {
        module.shares.push_back(static_cast<std::uint32_t>(other));
      }
    }
    problem.modules.push_back(module);
  }
  return problem;
}

long us(Nanos time) {
  return static_cast<long>(std::chrono::duration_cast<microseconds>(time).count());
}

template <class List, class Shown>
std::string list(const List& values, const Shown& shown) {
  std::string text;
  for (const auto& value : values) {
    text += (text.empty() ? "" : ",") + shown(value);
  }
  return "[" + text + "]";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  const auto first = static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10));
  const auto count = static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10));
  const auto number = [](auto value) { return std::to_string(value); };
  for (unsigned seed = first; seed < first + count; ++seed) {
    const PlacementProblem problem = random_problem(seed);
    const Placement placement = indurop::scheduler::place(problem);
    const std::string modules = list(problem.modules, [&](const Placeable& module) {
      return "[" + std::to_string(module.period / problem.basic_period) + "," + std::to_string(us(module.execution)) +
             "," + std::to_string(us(module.deadline)) + "," + list(module.shares, number) + "]";
    });
    std::printf(
        "{\"seed\":%u,\"cores\":%d,\"split\":%s,\"modules\":%s,\"core\":%s,\"shift\":%s,\"order\":%s,"
        "\"holds\":%s,\"busiest\":%ld}\n",
        seed, problem.cores, problem.split_sharing ? "true" : "false", modules.c_str(),
        list(placement.core, number).c_str(),
        list(placement.offset, [&](Nanos offset) { return std::to_string(offset / problem.basic_period); }).c_str(),
        list(placement.order, number).c_str(), placement.holds ? "true" : "false", us(placement.busiest));
  }
  return 0;
}
