// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/board.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "core/rt/clock.h"
#include "history/alarms/alarm_list.h"
#include "scheduler/words.h"
#include "store/vars/nodes.h"

namespace indurop::serve {
namespace {

// A number for each store that any board attaches: a name may be on this host at one time and on another one later.
std::uint64_t next_attachment() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

void Board::want() const {
  if (remote_ != nullptr) {
    remote_->want(rt::now_ns());
  }
}

alarms::AlarmCounts Board::remote_alarms() const {
  return remote_ != nullptr ? alarms::counts_in(remote_->said().alarms) : alarms::AlarmCounts();
}

void Board::refresh_remote() {
  const auto said = remote_->said();
  if (remote_->generation() != generation_) {
    const std::uint64_t generation = remote_->generation();
    if (auto fresh = remote_->attach(reader_); fresh.ok()) {
      store_ = std::move(fresh).value();
      generation_ = generation;
      attachment_ = next_attachment();
    }
  }
  absence_ = said.running ? std::string() : said.state;
}

void Board::refresh() {
  if (remote_ != nullptr) {
    refresh_remote();
    return;
  }
  if (!store_ || store_->retired() || source_.generation() != generation_) {
    const std::uint64_t generation = source_.generation();
    auto fresh = source_.attach();
    if (fresh.ok()) {
      store_ = std::move(fresh).value();
      generation_ = generation;
      attachment_ = next_attachment();
    } else if (generation == 0 && store_) {
      store_.reset();
      attachment_ = next_attachment();
    }
  }
  absence_ = source_.absence(store());
}

std::string Board::layout() const {
  return store_ ? fmt::format("{:016x}", store_->header().layout_hash) : std::string();
}

std::optional<tools::RunView> Board::run() const {
  if (remote_ != nullptr) {
    return shown_;
  }
  auto run = tools::RunView::open(name_);
  return run.ok() ? std::optional(std::move(run).value()) : std::nullopt;
}

void Board::show(tools::RunView run, std::int64_t now_ns) {
  constexpr std::int64_t kKeepNs = 1'000'000'000;  // a few hundred kB each
  shown_ = std::move(run);
  shown_until_ns_ = now_ns + kKeepNs;
}

std::string Board::state() const {
  if (!absence_.empty()) {
    return absence_;
  }
  if (remote_ != nullptr) {
    return remote_->said().state;
  }
  const auto view = run();
  return view && view->node_alive() ? scheduler::to_text(view->block().state.load(std::memory_order_relaxed))
                                    : "starting";
}

std::vector<std::string> Boards::here() const {
  std::vector<std::string> all = vars::list_nodes(only_.empty() ? vars::Nodes::Near : vars::Nodes::All);
  std::erase_if(all, [](const std::string& name) { return name.starts_with(tools::remote_store_prefix()); });
  if (!only_.empty()) {
    std::erase_if(all, [this](const std::string& name) { return name != only_; });
  }
  return all;
}

std::vector<std::string> Boards::names() const {
  std::vector<std::string> all = here();
  if (remote_ == nullptr) {
    return all;
  }
  for (std::string& name : remote_->names()) {
    if (only_.empty() || name == only_) {
      all.push_back(std::move(name));
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool Boards::is_here(const std::string& name) const {
  return (only_.empty() || name == only_) && !name.starts_with(tools::remote_store_prefix()) &&
         vars::has_node(name, only_.empty() ? vars::Nodes::Near : vars::Nodes::All);
}

Board* Boards::find(const std::string& name) {
  if (name.empty()) {
    const auto all = names();
    return all.size() == 1 ? find(all.front()) : nullptr;
  }
  const auto remote = remote_ != nullptr && (only_.empty() || name == only_) ? remote_->find(name) : nullptr;
  const auto [first, last] = boards_.equal_range(name);
  const auto known =
      std::find_if(first, last, [&](const auto& entry) { return entry.second->remote() == remote.get(); });
  if (known != last) {
    known->second->refresh();
    return known->second->store() != nullptr || remote != nullptr || is_here(name) ? known->second.get() : nullptr;
  }
  if (remote == nullptr && !is_here(name)) {
    return nullptr;
  }
  const auto made = boards_.emplace(
      name, remote != nullptr ? std::make_unique<Board>(remote, reader_) : std::make_unique<Board>(name));
  made->second->refresh();
  return made->second.get();
}

}  // namespace indurop::serve
