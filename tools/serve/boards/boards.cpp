// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/boards.h"

#include <algorithm>

#include "store/vars/nodes.h"
#include "tools/serve/boards/local_board.h"
#include "tools/serve/boards/remote_board.h"

namespace indurop::serve {

std::vector<std::string> Boards::local() const {
  std::vector<std::string> all = vars::list_nodes(only_.empty() ? vars::Nodes::Near : vars::Nodes::All);
  std::erase_if(all, [](const std::string& name) { return name.starts_with(tools::remote_store_prefix()); });
  if (!only_.empty()) {
    std::erase_if(all, [this](const std::string& name) { return name != only_; });
  }
  return all;
}

std::vector<std::string> Boards::names() const {
  std::vector<std::string> all = local();
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

bool Boards::is_local(const std::string& name) const {
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
    return known->second->store() != nullptr || remote != nullptr || is_local(name) ? known->second.get() : nullptr;
  }
  if (remote == nullptr && !is_local(name)) {
    return nullptr;
  }
  std::unique_ptr<Board> made;
  if (remote != nullptr) {
    made = std::make_unique<RemoteBoard>(remote, reader_, watch_);
  } else {
    made = std::make_unique<LocalBoard>(name);
  }
  made->refresh();
  return boards_.emplace(name, std::move(made))->second.get();
}

}  // namespace indurop::serve
