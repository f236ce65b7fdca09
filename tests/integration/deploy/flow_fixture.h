// SPDX-License-Identifier: Apache-2.0
// Two boards, of which one gets variables that the other one writes, and a judge that reads what it has by the C
// interface.

#pragma once

#include <indurop/c.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <stdexcept>
#include <thread>

#include "agents_fixture.h"
#include "flow_factor.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/mirrored_variables.h"
#include "scheduler/run_block.h"
#include "store/vars/run_file.h"
#include "store/vars/shm_file.h"

namespace indurop::test {

using testing::HasSubstr;
using xt_flow::kInverse;

// A node as a program in C sees it.
class SeenNode {
 public:
  explicit SeenNode(const std::string& name) { (void)irp_open(name.c_str(), IRP_READ, &node_); }
  SeenNode(const SeenNode&) = delete;
  SeenNode& operator=(const SeenNode&) = delete;
  ~SeenNode() { irp_close(node_); }

  std::optional<std::uint32_t> find(const char* name) {
    std::uint32_t id = 0;
    irp_code code = node_ == nullptr ? IRP_NOT_FOUND : irp_find(node_, name, &id);
    if (code == IRP_CHANGED && irp_refresh(node_) == IRP_OK) {
      code = irp_find(node_, name, &id);
    }
    return code == IRP_OK ? std::optional(id) : std::nullopt;
  }
  std::optional<std::uint64_t> number(const char* name) {
    const auto id = find(name);
    std::uint64_t value = 0;
    return id && irp_read(node_, *id, &value, sizeof value) == IRP_OK ? std::optional(value) : std::nullopt;
  }
  // IRP_REMOTE and the others; none: there is no such variable.
  std::optional<std::uint32_t> quality(const char* name) {
    const auto id = find(name);
    irp_quality quality = IRP_QUALITY_INIT;
    return id && irp_get_quality(node_, *id, &quality) == IRP_OK ? std::optional(quality.flags) : std::nullopt;
  }
  // Values of one update of the other board; none: they are not.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> together(const char* one, const char* other) {
    const auto first = find(one);
    const auto second = find(other);
    if (!first || !second) {
      return std::nullopt;
    }
    std::pair<std::uint64_t, std::uint64_t> values;
    const std::array<std::uint32_t, 2> ids{*first, *second};
    const std::array<void*, 2> to{&values.first, &values.second};
    const std::array<std::size_t, 2> sizes{8, 8};
    return irp_read_together(node_, ids.data(), 2, to.data(), sizes.data()) == IRP_OK ? std::optional(values)
                                                                                      : std::nullopt;
  }
  // The elements of xt::wide, if they are equal; none: it cannot be read. Throws if they differ.
  std::optional<std::uint64_t> wide() {
    const auto id = find("xt::wide");
    std::array<std::uint64_t, 200> all{};
    if (!id || irp_read(node_, *id, all.data(), sizeof all) != IRP_OK) {
      return std::nullopt;
    }
    if (std::any_of(all.begin(), all.end(), [&all](std::uint64_t one) { return one != all[0]; })) {
      throw std::runtime_error("half a value");
    }
    return all[0];
  }

 private:
  irp_node* node_ = nullptr;
};

// Reads what board b gets, as fast as it can, until it is stopped.
class Judge {
 public:
  explicit Judge(const std::string& node) : thread_([this, node] { run(node); }) {}
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;
  ~Judge() { stop(); }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  struct Found {
    std::uint64_t read = 0;      // values of flow that are not 0
    std::uint64_t together = 0;  // pairs of one update
    std::uint64_t never_written = 0;
    std::uint64_t older = 0;  // than one before it, of each variable
    std::uint64_t torn = 0;   // pairs of one update that source has not written in one run
  };
  Found found;  // after stop()

 private:
  void run(const std::string& name) {
    SeenNode node(name);
    std::uint64_t turns = 0;
    std::uint64_t flow = 0;
    std::uint64_t wide = 0;
    std::uint64_t pair = 0;  // flow in the last one: no version writes it before and after the trial
    while (!stop_) {
      look(node.number("xt::a_turns"), turns);
      if (const auto now = node.number("xt::flow"); now && *now != 0) {
        ++found.read;
        found.never_written += *now * kInverse > (std::uint64_t{1} << 32U) ? 1U : 0U;
        look(*now * kInverse, flow);
      }
      look(node.wide(), wide);
      if (const auto both = node.together("xt::a_turns", "xt::flow"); both && both->second != 0) {
        ++found.together;
        found.torn += both->second != pair && both->second * kInverse != both->first ? 1U : 0U;
        pair = both->second;
      }
      std::this_thread::sleep_for(1ms);
    }
  }
  void look(std::optional<std::uint64_t> now, std::uint64_t& before) {
    if (now) {
      found.older += *now < before ? 1U : 0U;
      before = *now;
    }
  }

  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class FlowTest : public AgentsTest {
 protected:
  static void bring_to(const std::filesystem::path& folder, const std::string& module, const std::string& version) {
    std::filesystem::remove(folder / (module + ".so"));
    std::filesystem::copy_file(std::filesystem::path(FLOW_FOLDER) / (module + "_" + version + ".so"),
                               folder / (module + ".so"));
  }
  void bring(const std::string& source, const std::string& sink) const {
    if (source_is_process_) {
      std::filesystem::remove(folder() / "source.exe");
      std::filesystem::copy_file(std::filesystem::path(FLOW_FOLDER) / ("source_process_" + source + ".exe"),
                                 folder() / "source.exe");
    } else {
      bring_to(folder(), "source", source);
    }
    bring_to(folder(), "sink", sink);
  }
  static std::string module(const std::string& name, int priority = 1, bool is_process = false) {
    return "<module><filename>./" + name + (is_process ? ".exe" : ".so") + "</filename><name>" + name +
           "</name><moduletype>" + (is_process ? "process" : "thread") +
           "</moduletype><operationtype>periodic</operationtype><period>10ms</period>"
           "<priority>" +
           std::to_string(priority) + "</priority><budget>1s</budget></module>";
  }
  [[nodiscard]] std::string plant() const { return plant(module("source", 1, source_is_process_)); }
  [[nodiscard]] std::string plant(const std::string& a, const std::string& b = module("sink")) const {
    std::ofstream out(folder() / "plant.xml");
    out << "<plant name=\"p" << ::getpid() << "\"><domain>" << domain() << "</domain><external>off</external>\n"
        << "<board name=\"" << board("a") << "\">" << a << "</board>\n<board name=\"" << board("b") << "\">" << b
        << "</board>\n</plant>\n";
    out.close();
    return path("plant.xml");
  }
  void SetUp() override {
    bring("first", "first");
    start_agent("a");
    start_agent("b");
    const Outcome done = deploy(plant());
    ASSERT_EQ(done.code, 0) << done.err;
    first_ = done.json()["deployment"];
    for (const char* name : {"a", "b"}) {
      pids_[name] = vars::running_node(board(name));
    }
    ASSERT_TRUE(wait_until([&] { return SeenNode(board("b")).number("xt::b_seen").value_or(0) > 20; }));
    refused_ = peer().refused;
  }

  struct Peer {
    mirror::PeerState state{};
    std::uint64_t refused = 0;
    std::uint64_t losses = 0;
  };
  // Board a as board b sees it.
  static Peer peer() {
    const auto file = vars::ShmFile::open(vars::mirror_file(board("b")), vars::Mode::ReadOnly);
    const auto* const block = file ? mirror::mirror_block_in({file.value().data(), file.value().size()}) : nullptr;
    if (block == nullptr || block->peer_count != 1) {
      return {};
    }
    return {block->peers()[0].state.load(), block->peers()[0].refused.load(), block->peers()[0].losses.load()};
  }
  // The variables that a board reads from the other one.
  static std::vector<std::string> mirrored(const std::string& name) {
    std::vector<std::string> names;
    const auto file = vars::ShmFile::open(vars::mirror_file(board(name)), vars::Mode::ReadOnly);
    if (const auto* const block = file ? mirror::mirror_block_in({file.value().data(), file.value().size()}) : nullptr;
        block != nullptr) {
      for (const auto& one : mirror::mirrored_variables(board(name), *block, rt::MonoClock::now())) {
        names.push_back(one.name);
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  static std::uint64_t skipped(const std::string& name) {
    const auto file =
        vars::RunFile::open(board(name), vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    const auto& block = *static_cast<const scheduler::RunBlock*>(file->data());
    return block.modules()[0].skipped.load() - block.lost_ticks.load();
  }
  // Neither node was started again, no run was left out, and a's values have come to b all the time.
  void expect_untouched() {
    for (const char* name : {"a", "b"}) {
      EXPECT_EQ(vars::running_node(board(name)), pids_[name]) << "the node of board " << name << " was started again";
      EXPECT_EQ(skipped(name), 0U) << name;
    }
    EXPECT_EQ(peer().state, mirror::PeerState::Alive);
    EXPECT_EQ(peer().refused, refused_);
    EXPECT_EQ(peer().losses, 0U);
  }
  // Both new variables come from a, and are those that it writes now.
  static bool flows() {
    SeenNode a(board("a"));
    SeenNode b(board("b"));
    std::optional<std::uint64_t> then;
    return wait_until([&] { return (then = a.number("xt::flow")).has_value(); }) && wait_until([&] {
             const auto flow = b.number("xt::flow");
             const auto wide = b.wide();
             return flow && wide && *flow * kInverse > *then * kInverse && *wide > *then * kInverse &&
                    b.number("xt::b_flow").value_or(0) * kInverse > *then * kInverse &&
                    b.quality("xt::flow") == std::uint32_t{IRP_REMOTE} &&
                    b.quality("xt::wide") == std::uint32_t{IRP_REMOTE};
           });
  }
  // `ways_back`: after each, source writes its turns and no flow, and the judge may have missed the run before.
  static void expect_sound(Judge& judge, std::uint64_t ways_back = 0) {
    judge.stop();
    EXPECT_GT(judge.found.read, 0U);
    EXPECT_GT(judge.found.together, 0U) << "they are sent in one update";
    EXPECT_EQ(judge.found.never_written, 0U);
    EXPECT_EQ(judge.found.older, 0U);
    EXPECT_LE(judge.found.torn, ways_back);
    EXPECT_EQ(SeenNode(board("b")).number("xt::b_wrong").value_or(0), 0U) << "as its module saw them";
  }
  bool both_run(const std::string& deployment) {
    return wait_until([&] { return runs("a", deployment) && runs("b", deployment); });
  }
  static std::string why(const Json& result, const std::string& board, const std::string& module) {
    for (const Json& one : result["plan"]) {
      for (const Json& row : one["modules"]) {
        if (one["board"] == board && row["module"] == module) {
          return row["why"];
        }
      }
    }
    return "no such module";
  }

  bool source_is_process_ = false;
  std::string first_;                  // id
  std::map<std::string, pid_t> pids_;  // of the nodes that run it
  std::uint64_t refused_ = 0;
};

}  // namespace indurop::test
