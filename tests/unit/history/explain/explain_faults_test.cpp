// SPDX-License-Identifier: Apache-2.0
// Faults at known places in random schedules: the answer names the one that was injected, says that it does not know,
// and never names another one. Who suffered is found by comparing with the same run without the fault.

#include <gmock/gmock.h>

#include <cstdio>
#include <map>
#include <optional>

#include "history/explain/questions.h"
#include "injected.h"

namespace indurop::explain {
namespace {

using What = Injection::What;

struct Victim {
  std::uint32_t module = 0;
  std::uint64_t tick = 0;
};

std::map<std::pair<std::uint32_t, std::uint64_t>, std::int64_t> responses_of(const Facts& facts) {
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::int64_t> all;
  for (const RunFact& run : facts.runs) {
    all[{run.module, run.tick}] = run.end_ns - run.release_ns;
  }
  return all;
}

// Runs that are missing or ended much later, because of the fault.
std::vector<Victim> victims_of(const Facts& without, const Facts& with) {
  const auto now = responses_of(with);
  std::vector<Victim> victims;
  for (const auto& [run, response] : responses_of(without)) {
    const auto same = now.find(run);
    const std::int64_t worth = with.modules[run.first].period_ns / 10;
    if (same == now.end() || same->second > response + worth) {
      victims.push_back({run.first, run.second});
    }
  }
  return victims;
}

struct Score {
  int right = 0;
  int unknown = 0;
  int wrong = 0;
};

struct Case {
  const char* name;
  What what;
  bool itself;  // the module asked about is the one that is at fault
  int least_us;
  int most_us;
};

bool is_right(const Answer& answer, const Injection& injection) {
  switch (injection.what) {
    case What::Longer:
    case What::Event:
      return answer.cause == Cause::OwnTime && answer.culprit == "m" + std::to_string(injection.module);
    case What::Throws:
      return answer.cause == Cause::Fault && answer.culprit == "m" + std::to_string(injection.module);
    case What::Stopped:
      return answer.cause == Cause::Stopped && answer.culprit == injection.by;
    case What::MachineStands:
      return answer.cause == Cause::Machine;
    case What::PageFault:
      return answer.cause == Cause::Machine && answer.culprit == "page fault";
    case What::Nothing:
      return answer.cause == Cause::AllIsWell;
  }
  return false;
}

Injection injection_of(const Case& fault, const std::vector<scheduler::Task>& tasks, Random& random) {
  Injection injection;
  injection.what = fault.what;
  const int last = static_cast<int>(tasks.size()) - 1;
  injection.module = static_cast<std::uint32_t>(fault.what == What::Event ? last : random.upto(0, last - 1));
  injection.tick = static_cast<std::uint64_t>(random.upto(60, 90));
  injection.for_ns = std::int64_t{random.upto(fault.least_us, fault.most_us)} * 1000;
  injection.by = "ana";
  return injection;
}

// Nothing: the fault affected no other module.
std::optional<Answer> ask(const Case& fault, Random& random, Injection& injection, Victim& victim) {
  const auto tasks = random_schedule(random);
  injection = injection_of(fault, tasks, random);
  const Facts without = run_schedule(tasks, {});
  const Facts with = run_schedule(tasks, injection);
  std::vector<Victim> victims = victims_of(without, with);
  std::erase_if(victims, [&](const Victim& one) { return (one.module == injection.module) != fault.itself; });
  if (victims.empty()) {
    return std::nullopt;
  }
  victim = victims[static_cast<std::size_t>(random.upto(0, static_cast<int>(victims.size()) - 1))];
  return why_late(with, "m" + std::to_string(victim.module), victim.tick);
}

Score score_of(const Case& fault, int wanted) {
  Score score;
  for (unsigned seed = 0; score.right + score.unknown + score.wrong < wanted && seed < 100'000; ++seed) {
    Random random{std::mt19937(seed)};
    Injection injection;
    Victim victim;
    const auto answer = ask(fault, random, injection, victim);
    if (!answer) {
      continue;
    }
    if (is_right(*answer, injection)) {
      ++score.right;
    } else if (answer->cause == Cause::NotKnown || answer->cause == Cause::AllIsWell) {
      ++score.unknown;
    } else {
      ++score.wrong;
    }
    if (!is_right(*answer, injection)) {
      std::printf("%s, seed %u, asked m%u at %lu, fault m%u at %lu for %ld: %s (%s)\n", fault.name, seed, victim.module,
                  static_cast<unsigned long>(victim.tick), injection.module, static_cast<unsigned long>(injection.tick),
                  static_cast<long>(injection.for_ns), answer->text.c_str(), answer->culprit.c_str());
      for (const std::string& line : answer->evidence) {
        std::printf("    %s\n", line.c_str());
      }
    }
  }
  return score;
}

TEST(ExplainFaults, The_injected_culprit_is_named_and_never_another_one) {
  constexpr int kEach = 30;
  const std::vector<Case> faults = {
      {"itself a little longer", What::Longer, true, 700, 1500},
      {"itself much longer", What::Longer, true, 3000, 20'000},
      {"another one a little longer", What::Longer, false, 700, 1500},
      {"another one much longer", What::Longer, false, 3000, 20'000},
      {"an event", What::Event, false, 500, 3000},
      {"a fault", What::Throws, true, 0, 0},
      {"stopped by a user", What::Stopped, true, 0, 0},
      {"a page that came from the disk", What::PageFault, true, 700, 5000},
      {"the machine stands still for a moment", What::MachineStands, false, 700, 1500},
      {"the machine stands still for long", What::MachineStands, false, 3000, 20'000},
  };
  Score all;
  for (const Case& fault : faults) {
    SCOPED_TRACE(fault.name);
    const Score score = score_of(fault, kEach);
    EXPECT_EQ(score.wrong, 0);
    EXPECT_EQ(score.right + score.unknown + score.wrong, kEach);
    all.right += score.right;
    all.unknown += score.unknown;
  }
  std::printf("%d right, %d not known\n", all.right, all.unknown);
  EXPECT_GE(all.right * 100, 95 * static_cast<int>(faults.size()) * kEach);
}

}  // namespace
}  // namespace indurop::explain
