// SPDX-License-Identifier: Apache-2.0
#include "serve/boards/board.h"

#include <fmt/format.h>

#include <algorithm>

#include "scheduler/words.h"

namespace indurop::serve {

void Board::refresh() {
  if (!store_ || store_->retired() || source_.generation() != generation_) {
    const std::uint64_t generation = source_.generation();
    auto fresh = source_.attach();
    if (fresh.ok()) {
      store_ = std::move(fresh).value();
      generation_ = generation;
      ++attachment_;
    } else if (generation == 0 && store_) {
      store_.reset();
      ++attachment_;
    }
  }
  absence_ = source_.absence(store());
}

std::string Board::layout() const {
  return store_ ? fmt::format("{:016x}", store_->header().layout_hash) : std::string();
}

std::optional<tools::RunView> Board::run() const {
  auto run = tools::RunView::open(name_);
  return run.ok() ? std::optional(std::move(run).value()) : std::nullopt;
}

std::string Board::state() const {
  if (!absence_.empty()) {
    return absence_;
  }
  const auto view = run();
  return view && view->node_alive() ? scheduler::to_text(view->block().state.load(std::memory_order_relaxed))
                                    : "starting";
}

std::vector<std::string> Boards::names() const {
  std::vector<std::string> all = vars::list_nodes();
  if (!only_.empty()) {
    std::erase_if(all, [this](const std::string& name) { return name != only_; });
  }
  return all;
}

bool Boards::listed(const std::string& name) const {
  const auto there = names();
  return std::find(there.begin(), there.end(), name) != there.end();
}

Board* Boards::find(const std::string& name) {
  if (name.empty()) {
    const auto all = names();
    return all.size() == 1 ? find(all.front()) : nullptr;
  }
  const auto known = std::find_if(boards_.begin(), boards_.end(),
                                  [&name](const std::unique_ptr<Board>& board) { return board->name() == name; });
  if (known != boards_.end()) {
    (*known)->refresh();
    return (*known)->store() != nullptr || listed(name) ? known->get() : nullptr;
  }
  if (!listed(name)) {
    return nullptr;
  }
  boards_.push_back(std::make_unique<Board>(name));
  boards_.back()->refresh();
  return boards_.back().get();
}

}  // namespace indurop::serve
