// SPDX-License-Identifier: Apache-2.0
// Two boards whose schedules are changed by deployments, and an oracle that reads the text of the manifest alone: which
// modules a board runs at which time. It shares no code with the scheduler.

#pragma once

#include <regex>
#include <set>

#include "core/rt/clock.h"
#include "exchange_fixture.h"

namespace indurop::test {

class ScheduleTest : public ExchangeTest {
 protected:
  struct Part {
    std::string module;
    std::string file;  // without folder and ending
    std::string period = "10ms";
    std::string offset = "0ms";
    int priority = 1;
    std::string more{};  // further elements
  };
  using Parts = std::vector<Part>;

  // The press of a board, and what comes after it and misses no run.
  static Part press_of(const std::string& name, const std::string& period = "10ms", const std::string& offset = "0ms") {
    return {"press", "press_" + name, period, offset, 1, ""};
  }
  static Part ticks_of(const std::string& name, int priority = 2) {
    return {"ticks", "ticks_" + name, "10ms", "0ms", priority, ""};
  }
  // The manifest of these modules, as it is deployed next.
  std::string plant_of(const Parts& a, const Parts& b) {
    text_ = "<plant name=\"p" + std::to_string(::getpid()) + "\"><domain>" + std::to_string(domain()) +
            "</domain><external>off</external>\n";
    for (const auto& [name, parts] : {std::pair{"a", &a}, std::pair{"b", &b}}) {
      text_ += "<board name=\"" + board(name) + "\">\n";
      for (const Part& part : *parts) {
        text_ += "<module><name>" + part.module + "</name><filename>./" + part.file +
                 ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>" +
                 part.period + "</period><offset>" + part.offset + "</offset><priority>" +
                 std::to_string(part.priority) + "</priority><budget>1s</budget>" + part.more + "</module>\n";
      }
      text_ += "</board>\n";
    }
    text_ += "</plant>\n";
    std::ofstream(folder() / "plant.xml") << text_;
    return path("plant.xml");
  }
  // The number xt::NAME as a board has it.
  std::int64_t value(const std::string& on, const std::string& name) {
    const auto store = vars::Store::attach(board(on), vars::Mode::ReadOnly);
    schema::Variable variable;
    variable.name = "xt::" + name;
    std::int64_t read = 0;
    const auto* const entry = store.ok() ? store.value().find(variable.name_hash()) : nullptr;
    const bool known =
        entry != nullptr && store.value().read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&read), sizeof read}).ok();
    return known ? read : 0;
  }
  // Brings a file that no board has yet.
  void add_file(const std::string& name, const std::string& version) const {
    std::filesystem::copy_file(std::filesystem::path(EXCHANGED_FOLDER) / (version + ".so"), folder() / (name + ".so"));
  }
  void start_with(const Parts& a, const Parts& b, const std::string& press_b = "press_b_first") {
    for (const std::string name : {"a", "b"}) {
      add_file("ticks_" + name, "ticks_" + name);
      start_agent(name);
    }
    bring("a", "press_a_first");
    bring("b", press_b);
    const Outcome done = deploy(plant_of(a, b));
    ASSERT_EQ(done.code, 0) << done.err;
    first_ = done.json()["deployment"];
    for (const char* name : {"a", "b"}) {
      pids_[name] = vars::running_node(board(name));
      ASSERT_TRUE(wait_until([&] { return number(name, "turns") > 5; }));
    }
  }

  // What runs on a board: names by the number of the 10 ms of wall time, which the boards of a plant share, in the
  // order in which they began.
  struct Seen {
    std::map<std::int64_t, std::vector<std::string>> ran;
    std::int64_t first = 0;  // of the schedule that counts
    std::uint64_t schedule = 0;
    std::uint64_t left_out = 0;  // runs of all modules
    std::uint64_t overruns = 0;  // of all modules; each leaves one run out
    std::uint64_t lost = 0;      // ticks of the node
    std::set<std::string> ended;
    std::map<std::string, std::int64_t> periods;
  };
  Seen seen(const std::string& name) {
    Seen all;
    const auto file =
        vars::RunFile::open(board(name), vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    if (!file) {
      return all;
    }
    const auto& block = *static_cast<const scheduler::RunBlock*>(file->data());
    const std::int64_t begin = block.epoch_ns + rt::wall_ns() - rt::now_ns();
    const std::int64_t zero = (begin + block.basic_period_ns / 2) / block.basic_period_ns;
    const std::uint64_t since = block.schedule_tick;
    all.first = zero + static_cast<std::int64_t>(since);
    all.schedule = block.schedule;
    all.lost = block.lost_ticks;
    for (std::uint32_t i = 0; i < block.module_count; ++i) {
      const scheduler::ModuleRecord& module = block.modules()[i];
      all.left_out += module.skipped;
      all.overruns += module.overruns;
      all.periods[module.name] = module.period_ns;
      if (module.ended) {
        all.ended.insert(module.name);
      }
    }
    struct One {
      std::int64_t start = 0;
      std::int64_t at = 0;
      std::string module;
    };
    std::vector<One> runs;
    const auto* entries = block.at<scheduler::SlotEntry>(block.slot_log_offset);
    const std::uint64_t next = block.slot_log_next;
    for (std::uint64_t n = next > block.slot_log_capacity ? next - block.slot_log_capacity : 0; n < next; ++n) {
      const auto& entry = entries[n & (block.slot_log_capacity - 1)];
      if (entry.sequence == n + 1 && entry.tick >= since) {
        runs.push_back(
            {entry.start_ns, zero + static_cast<std::int64_t>(entry.tick), block.modules()[entry.module].name});
      }
    }
    std::sort(runs.begin(), runs.end(), [](const One& x, const One& y) { return x.start < y.start; });
    for (const One& run : runs) {
      all.ran[run.at].push_back(run.module);
    }
    return all;
  }

  // What the text says of it: periods and offsets in 10 ms.
  std::vector<std::string> said(const std::string& name, std::int64_t at) const {
    std::vector<std::pair<int, std::string>> due;
    const std::size_t from = text_.find("<board name=\"" + board(name));
    const std::string own = text_.substr(from, text_.find("</board>", from) - from);
    const std::regex one(
        "<name>(\\w+)</name>[^]*?<period>(\\d+)0ms</period><offset>(\\d*)0?ms</offset><priority>(\\d+)<");
    for (std::sregex_iterator it(own.begin(), own.end(), one), end; it != end; ++it) {
      const std::string offset = (*it)[3];
      const std::int64_t after = offset.empty() || offset == "0" ? 0 : std::stoll(offset) / 10;
      if ((at - after) % std::stoll((*it)[2]) == 0) {
        due.emplace_back(std::stoi((*it)[4]), (*it)[1]);
      }
    }
    std::stable_sort(due.begin(), due.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    std::vector<std::string> names;
    for (const auto& [priority, module] : due) {
      names.push_back(module);
    }
    return names;
  }
  // From the first tick of its schedule on, the board has run what the text says, in its order. What a busy machine
  // held up is counted.
  void expect_as_said(const std::string& name, std::int64_t ticks = 40) {
    Seen sut;
    ASSERT_TRUE(wait_until([&] {
      sut = seen(name);
      return !sut.ran.empty() && sut.ran.rbegin()->first > sut.first + ticks;
    }));
    std::uint64_t missing = 0;
    for (std::int64_t at = sut.first; at < sut.first + ticks; ++at) {
      const std::vector<std::string> due = said(name, at);
      const std::vector<std::string> ran = sut.ran[at];
      auto next = due.begin();
      for (const std::string& module : ran) {
        const auto found = std::find(next, due.end(), module);
        ASSERT_NE(found, due.end()) << name << " ran " << testing::PrintToString(ran) << " instead of "
                                    << testing::PrintToString(due) << " " << at - sut.first
                                    << " ticks after the change";
        next = found + 1;
      }
      missing += due.size() - ran.size();
    }
    EXPECT_LE(missing, sut.left_out) << name;
  }
  void expect_not_restarted() {
    for (const char* name : {"a", "b"}) {
      EXPECT_EQ(vars::running_node(board(name)), pids_[name]) << "the node of board " << name << " was started again";
    }
  }

  std::string text_;  // of the manifest
};

}  // namespace indurop::test
