// SPDX-License-Identifier: Apache-2.0
// Starts and ends test boards, on this host or as network namespaces, and looks into their stores.

#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "network/mirror/frames/mirror_block.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"
#include "store/vars/together.h"
#include "tests/support/dds_domain.h"
#include "tests/support/program.h"
#include "tests/support/wait_until.h"

namespace indurop::test {

using namespace std::chrono_literals;

struct BoardPlan {
  std::string name;
  std::string out = "-";
  std::string in = "-";
  std::string variant = "plain";
  std::string keys{};  // folder; empty: none
};

class Boards : public ::testing::Test {
 public:
  // Tests that run at the same time do not hear each other.
  static int domain() { return dds_domain(); }

 protected:
  ~Boards() override {
    running_.clear();
    for (const std::string& node : nodes_) {
      (void)vars::remove_node(node);
    }
  }

  std::string node(const std::string& board) const { return "mt" + std::to_string(::getpid()) + "-" + board; }

  void start(const BoardPlan& plan, const std::vector<std::string>& others, const std::string& lab = "") {
    start_as(plan.name, plan, others, lab);
  }
  // At a place (namespace, and name for the other functions) that need not be called like the board.
  void start_as(const std::string& place, const BoardPlan& plan, const std::vector<std::string>& others,
                const std::string& lab) {
    std::string list;
    for (const std::string& other : others) {
      list += (list.empty() ? "" : ",") + other;
    }
    std::vector<std::string> words;
    if (!lab.empty()) {
      words = {LAB_PROGRAM, "-l", lab, "exec", place};
    }
    for (const std::string& word : {std::string(BOARD_PROGRAM), node(place), plan.name, std::to_string(domain()),
                                    std::string(lab.empty() ? "one-host" : "network"), std::to_string(kLeaseMs),
                                    plan.variant, list.empty() ? std::string("-") : list, plan.out, plan.in}) {
      words.push_back(word);
    }
    if (!plan.keys.empty()) {
      words.push_back(plan.keys);
    }
    nodes_.push_back(node(place));
    running_[place] = std::make_unique<Program>(words);
    ASSERT_TRUE(wait_until([&] { return attach(place); })) << "board " << place << " did not start";
  }

  void stop(const std::string& board, int signal = SIGTERM) {
    running_.at(board)->signal(signal);
    EXPECT_NE(running_.at(board)->wait(), -1) << "board " << board << " did not end";
    running_.erase(board);
  }

  // The board stands still as on a machine that is overloaded.
  void hold(const std::string& board) { running_.at(board)->signal(SIGSTOP); }
  void let_run(const std::string& board) { running_.at(board)->signal(SIGCONT); }

  bool attach(const std::string& board) {
    auto store = vars::Store::attach(node(board), vars::Mode::ReadWrite);
    auto file = vars::ShmFile::open(vars::mirror_file(node(board)), vars::Mode::ReadOnly);
    if (!store || !file || file.value().size() < sizeof(mirror::MirrorBlock)) {
      return false;
    }
    stores_[board] = std::make_unique<vars::Store>(std::move(store).value());
    files_[board] = std::make_unique<vars::ShmFile>(std::move(file).value());
    return block(board).magic.load() == mirror::kMirrorMagic;
  }

  const mirror::MirrorBlock& block(const std::string& board) {
    return *reinterpret_cast<const mirror::MirrorBlock*>(files_.at(board)->data());
  }
  const mirror::PeerRecord& peer(const std::string& board, const std::string& other) {
    const auto& all = block(board);
    for (std::uint32_t i = 0; i < all.peer_count; ++i) {
      if (other == all.peers()[i].name) {
        return all.peers()[i];
      }
    }
    throw std::runtime_error("no such peer");
  }
  bool sees(const std::string& board, const std::string& other, mirror::PeerState state) {
    return peer(board, other).state.load() == state;
  }

  template <class T>
  void put(const std::string& board, const std::string& variable, const T& value) {
    const auto* entry = stores_.at(board)->find(abi::fnv1a64(variable.data(), variable.size()));
    ASSERT_NE(entry, nullptr);
    std::vector<std::uint8_t> bytes(sizeof value);
    std::memcpy(bytes.data(), &value, sizeof value);
    ASSERT_TRUE(stores_.at(board)->write(*entry, 0, bytes).ok());
  }
  template <class T>
  T get(const std::string& board, const std::string& variable) {
    const auto* entry = stores_.at(board)->find(abi::fnv1a64(variable.data(), variable.size()));
    std::vector<std::uint8_t> bytes(sizeof(T));
    EXPECT_TRUE(stores_.at(board)->read(*entry, 0, bytes).ok());
    T value{};
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  // True if the values belong together.
  template <class T>
  bool get_together(const std::string& board, const std::vector<std::string>& variables, std::vector<T>& values) {
    std::vector<abi::Piece> pieces;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const auto* entry = stores_.at(board)->find(abi::fnv1a64(variables[i].data(), variables[i].size()));
      pieces.push_back({stores_.at(board)->entry(entry->name_hash, 0), &values[i], entry->kind, sizeof(T), 0, 0, 0});
    }
    return vars::read_together(pieces);
  }
  std::int64_t confirmed(const std::string& board, const std::string& variable) {
    const auto* entry = stores_.at(board)->find(abi::fnv1a64(variable.data(), variable.size()));
    return abi::confirmed_of(stores_.at(board)->entry(entry->name_hash, 0), entry->kind).load();
  }

 private:
  static constexpr int kLeaseMs = 200;

  std::map<std::string, std::unique_ptr<Program>> running_;
  std::vector<std::string> nodes_;
  std::map<std::string, std::unique_ptr<vars::Store>> stores_;
  std::map<std::string, std::unique_ptr<vars::ShmFile>> files_;
};

}  // namespace indurop::test
