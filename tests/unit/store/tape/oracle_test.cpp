// SPDX-License-Identifier: Apache-2.0
// Random modules whose runs overlap, against a plain log of what they saw and did: the tape has to give it back. The
// log knows bytes only, and nothing of versions, rings and entries.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tape_fixture.h"

namespace indurop::tape {
namespace {

using test::Plant;
using Bytes = std::vector<std::uint8_t>;
using Values = std::map<std::uint32_t, Bytes>;

constexpr std::array<const char*, 5> kNames = {"a", "b", "c", "d", "e"};

struct Logged {
  Values before, after;
  std::vector<std::int64_t> clock;
  std::vector<std::pair<std::int64_t, Bytes>> answers;
  RunTail tail;
  std::uint32_t flags = 0;
};

struct Module {
  std::string reads, writes;
  std::vector<Logged> log;
  std::optional<Logged> running;
};

class Oracle : public testing::TestWithParam<unsigned> {
 protected:
  std::uint32_t random(std::uint32_t below) { return static_cast<std::uint32_t>(engine_()) % below; }
  std::string some_names() {
    std::string names;
    for (const char* name : kNames) {
      names += random(3) == 0 ? name : "";
    }
    return names;
  }
  std::vector<Module> some_modules() {
    std::vector<Module> modules(1 + random(4));
    for (Module& module : modules) {
      module.reads = some_names();
      module.writes = some_names();
    }
    return modules;
  }
  void change(Plant& plant) {
    const auto value = random(4);  // often the same bytes again
    switch (random(5)) {
      case 0:
        return plant.put("a", static_cast<std::uint8_t>(value));
      case 1:
        return plant.put("b", value);
      case 2:
        return plant.put("c", static_cast<double>(value));
      case 3:
        return plant.put("d", static_cast<double>(value), 8 * random(30));
      default:
        return plant.put("e", static_cast<std::uint8_t>(value), random(5));
    }
  }
  static Values values_of(Plant& plant) {
    Values values;
    for (const char* name : kNames) {
      values[plant.index(name)] = plant.bytes(name);
    }
    return values;
  }
  void begin(Plant& plant, std::uint32_t index, Module& module) {
    plant.track(index).begin();
    module.running.emplace();
    module.running->before = values_of(plant);
    module.running->tail.number = module.log.size();
    module.running->tail.order = orders_++;
  }
  void ask(Track& track, Logged& run) {
    if (random(2) == 0) {
      run.clock.push_back(random(1000));
      track.clock(run.clock.back());
    } else {
      run.answers.emplace_back(random(9), Bytes(random(20), static_cast<std::uint8_t>(random(256))));
      track.record_answer(run.answers.back().first, run.answers.back().second);
    }
  }
  void end(Plant& plant, std::uint32_t index, Module& module) {
    Logged& run = *module.running;
    const auto time = static_cast<std::int64_t>(random(1'000'000));
    run.tail.tick = tick_;
    run.tail.release_ns = time;
    run.tail.start_ns = time + 3;
    run.tail.end_ns = time + 8;
    run.flags = random(10) == 0 ? std::uint32_t{kFaulted} : 0U;
    run.after = values_of(plant);
    plant.track(index).end({0, 0, tick_, time, time + 3, time + 8}, run.flags);
    module.log.push_back(std::move(run));
    module.running.reset();
  }
  // One step of the plant: a module begins, reads, or ends, or another process changes a variable.
  void step(Plant& plant, std::vector<Module>& modules) {
    ++tick_;
    const std::uint32_t index = random(static_cast<std::uint32_t>(modules.size()));
    Module& module = modules[index];
    if (random(2) == 0) {
      change(plant);
    } else if (!module.running) {
      begin(plant, index, module);
    } else if (random(2) == 0) {
      ask(plant.track(index), *module.running);
    } else {
      end(plant, index, module);
    }
  }

  std::mt19937 engine_{GetParam()};
  std::uint64_t orders_ = 0;
  std::uint64_t tick_ = 0;
};

bool has(Plant& plant, const std::string& names, std::uint32_t variable) {
  return std::any_of(names.begin(), names.end(), [&](char name) { return plant.index({name}) == variable; });
}

// What a reader of one track knows of the module's variables.
struct Reader {
  Values believed;

  void check(Plant& plant, const Module& module, const Logged& log, const Run& run) {
    std::size_t again = 0;
    for (const Value& value : run.values) {
      const Bytes bytes(value.bytes.begin(), value.bytes.end());
      const bool before = value.kind == EntryKind::Before;
      ASSERT_EQ(bytes, (before ? log.before : log.after).at(value.variable));
      ASSERT_TRUE(has(plant, module.reads + module.writes, value.variable));
      ASSERT_TRUE(!before || has(plant, module.reads, value.variable));
      ASSERT_EQ(value.kind == EntryKind::After,
                value.kind != EntryKind::Again && !before && has(plant, module.writes, value.variable));
      again += value.kind == EntryKind::Again ? 1U : 0U;
    }
    ASSERT_LE(again, 1U);
    take(run, true);
    for (const char name : module.reads) {
      ASSERT_EQ(believed[plant.index({name})], log.before.at(plant.index({name}))) << "began with " << name;
    }
    take(run, false);
    for (const char name : module.reads + module.writes) {
      ASSERT_EQ(believed[plant.index({name})], log.after.at(plant.index({name}))) << "left " << name;
    }
  }
  void take(const Run& run, bool before) {
    for (const Value& value : run.values) {
      if ((value.kind == EntryKind::Before) == before) {
        believed[value.variable].assign(value.bytes.begin(), value.bytes.end());
      }
    }
  }
};

void check_rest(const Logged& log, const Run& run) {
  std::vector<std::pair<std::int64_t, Bytes>> answers;
  for (const Answer& one : run.answers) {
    answers.emplace_back(one.code, Bytes(one.bytes.begin(), one.bytes.end()));
  }
  EXPECT_EQ(run.clock, log.clock);
  EXPECT_EQ(answers, log.answers);
  EXPECT_EQ(run.flags, log.flags);
  EXPECT_EQ(run.tail.number, log.tail.number);
  EXPECT_EQ(run.tail.order, log.tail.order);
  EXPECT_EQ(run.tail.tick, log.tail.tick);
  EXPECT_EQ(run.tail.release_ns, log.tail.release_ns);
  EXPECT_EQ(run.tail.start_ns, log.tail.start_ns);
  EXPECT_EQ(run.tail.end_ns, log.tail.end_ns);
}

// Tracks are in the order of the modules.
TEST_P(Oracle, What_is_read_back_is_the_log) {
  std::vector<Module> modules = some_modules();
  std::vector<std::pair<std::string, std::string>> accesses;
  for (const Module& module : modules) {
    accesses.emplace_back(module.reads, module.writes);
  }
  Plant plant("oracle", accesses);
  Follower follower = plant.follow();
  std::vector<Reader> readers(modules.size());
  std::vector<std::uint64_t> read(modules.size());
  tape::Run run;
  for (int steps = 0; steps < 3000; ++steps) {
    step(plant, modules);
    for (std::size_t i = 0; random(7) == 0 && i < modules.size(); ++i) {
      while (follower.next(i, run)) {
        ASSERT_LT(read[i], modules[i].log.size());
        const Logged& log = modules[i].log[read[i]++];
        ASSERT_NO_FATAL_FAILURE(readers[i].check(plant, modules[i], log, run)) << "run " << run.tail.number;
        check_rest(log, run);
      }
      ASSERT_EQ(read[i], modules[i].log.size());
      ASSERT_EQ(follower.lost(i), 0U);
    }
  }
}

// A reader who comes late begins somewhere; from there on it reads the log to its end, and each run as it was.
TEST_P(Oracle, A_late_reader_finds_the_end_of_the_log) {
  std::vector<Module> modules = some_modules();
  std::vector<std::pair<std::string, std::string>> accesses;
  for (const Module& module : modules) {
    accesses.emplace_back(module.reads, module.writes);
  }
  Plant plant("late", accesses, 16 * 1024);
  for (int steps = 0; steps < 5000; ++steps) {
    step(plant, modules);
  }
  Follower follower = plant.follow();
  tape::Run run;
  for (std::size_t i = 0; i < modules.size(); ++i) {
    std::optional<std::uint64_t> last;
    while (follower.next(i, run)) {
      ASSERT_TRUE(!last || run.tail.number == *last + 1);
      last = run.tail.number;
      ASSERT_LT(*last, modules[i].log.size());
      check_rest(modules[i].log[*last], run);
      for (const Value& value : run.values) {
        const Values& truth =
            value.kind == EntryKind::Before ? modules[i].log[*last].before : modules[i].log[*last].after;
        ASSERT_EQ(Bytes(value.bytes.begin(), value.bytes.end()), truth.at(value.variable));
      }
    }
    ASSERT_TRUE(modules[i].log.empty() || last == modules[i].log.size() - 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Oracle, testing::Range(1U, 26U));

}  // namespace
}  // namespace indurop::tape
