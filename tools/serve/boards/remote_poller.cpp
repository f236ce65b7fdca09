// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/remote_poller.h"

#include <algorithm>
#include <utility>

#include "core/rt/clock.h"
#include "store/vars/node_lock.h"

namespace indurop::serve {
namespace {

constexpr std::int64_t kLearnAgainNs = 2'000'000'000;  // for boards without variables so far

bool runs_here(const std::string& name) {
  return vars::running_node(name) > 0;
}

std::vector<std::string> names_of(const std::vector<std::shared_ptr<tools::ReportedBoard>>& boards) {
  std::vector<std::string> names;
  names.reserve(boards.size());
  for (const auto& board : boards) {
    names.push_back(board->name());
  }
  return names;
}

}  // namespace

RemotePoller::Some RemotePoller::all() const {
  const std::lock_guard<std::mutex> guard(mutex_);
  Some some;
  for (const auto& [name, board] : boards_) {
    some.push_back(board);
  }
  return some;
}

std::vector<std::string> RemotePoller::names() const {
  std::vector<std::string> names = names_of(all());
  std::erase_if(names, runs_here);
  return names;
}

std::shared_ptr<tools::ReportedBoard> RemotePoller::find(const std::string& name) const {
  const std::lock_guard<std::mutex> guard(mutex_);
  const auto known = boards_.find(name);
  return known != boards_.end() && !runs_here(name) ? known->second : nullptr;
}

void RemotePoller::update(const tools::PlantWatch& watch) {
  for (const base::Json& row : watch.rows()) {
    const std::string name = row["board"].text().value_or("");
    if (name.empty() || runs_here(name)) {
      continue;
    }
    std::shared_ptr<tools::ReportedBoard> board;
    {
      const std::lock_guard<std::mutex> guard(mutex_);
      auto& known = boards_[name];
      known = known != nullptr ? known : std::make_shared<tools::ReportedBoard>(name);
      board = known;
    }
    board->update(row);
    if (const auto report = board->report(); !report.heard && report.values) {
      board->silent();
    }
  }
}

void RemotePoller::learn(tools::PlantWatch& watch, const Some& boards) {
  const auto texts = watch.texts("variables", names_of(boards));
  for (const auto& board : boards) {
    const auto text = texts.find(board->name());
    if (text != texts.end()) {
      (void)board->take_variables(text->second);
    }
  }
}

void RemotePoller::ask(tools::PlantWatch& watch, const Some& boards) {
  Some others;
  const auto take = [&](const Some& asked) {
    const auto texts = watch.texts("values", names_of(asked));
    const std::int64_t now = rt::now_ns();
    others.clear();
    for (const auto& board : asked) {
      const auto text = texts.find(board->name());
      const auto taken =
          text != texts.end() ? board->take_values(text->second, now) : tools::ReportedBoard::Taken::Nonsense;
      if (taken == tools::ReportedBoard::Taken::OtherVariables) {
        others.push_back(board);
      } else if (taken == tools::ReportedBoard::Taken::Nonsense) {
        board->silent();
      }
    }
  };
  take(boards);
  if (!others.empty()) {
    learn(watch, others);
    const Some again = others;
    take(again);
  }
}

void RemotePoller::poll(tools::PlantWatch& watch) {
  update(watch);
  const std::int64_t now = rt::now_ns();
  Some due;
  for (const auto& board : all()) {
    const bool heard = board->report().heard && !runs_here(board->name());
    const bool wanted = board->knows_variables() ? board->due(now) : now >= learn_ns_[board->name()];
    if (heard && wanted) {
      learn_ns_[board->name()] = now + kLearnAgainNs;
      due.push_back(board);
    }
  }
  if (!due.empty()) {
    ask(watch, due);
  }
}

void RemotePoller::fetch(tools::PlantWatch& watch, const std::string& name) {
  update(watch);
  const auto board = find(name);
  if (board == nullptr || !board->report().heard) {
    return;
  }
  board->want(rt::now_ns());
  ask(watch, {board});
}

}  // namespace indurop::serve
