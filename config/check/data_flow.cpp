// SPDX-License-Identifier: Apache-2.0
#include "config/check/data_flow.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>

namespace indurop::config {
namespace {

// Tarjan's algorithm (1972): strongly connected components in one walk over nodes and edges. Without recursion, because
// chains may be as long as there are modules.
class Components {
 public:
  Components(std::size_t count, const std::vector<Edge>& edges) : next_(count), nodes_(count) {
    for (const auto& [from, to] : edges) {
      next_[from].push_back(to);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (nodes_[i].found == 0) {
        walk(i);
      }
    }
  }
  // Returns for each node the smallest one of its component.
  [[nodiscard]] std::vector<std::size_t> smallest() const {
    std::vector<std::size_t> smallest;
    smallest.reserve(nodes_.size());
    for (const Node& node : nodes_) {
      smallest.push_back(node.group);
    }
    return smallest;
  }

 private:
  struct Node {
    std::size_t found = 0;  // number in the order of discovery, from 1
    std::size_t low = 0;    // smallest `found` reachable from it
    std::size_t edge = 0;   // to be followed next
    std::size_t group = 0;
    bool open = false;  // found, but its component is not complete
  };

  void enter(std::size_t node) {
    nodes_[node].found = nodes_[node].low = ++count_;
    nodes_[node].open = true;
    open_.push_back(node);
    path_.push_back(node);
  }

  void walk(std::size_t from) {
    enter(from);
    while (!path_.empty()) {
      const std::size_t at = path_.back();
      Node& node = nodes_[at];
      if (node.edge < next_[at].size()) {
        const std::size_t to = next_[at][node.edge++];
        if (nodes_[to].found == 0) {
          enter(to);
        } else if (nodes_[to].open) {
          node.low = std::min(node.low, nodes_[to].found);
        }
        continue;
      }
      path_.pop_back();
      if (!path_.empty()) {
        nodes_[path_.back()].low = std::min(nodes_[path_.back()].low, node.low);
      }
      if (node.low == node.found) {
        complete(at);
      }
    }
  }

  void complete(std::size_t root) {
    const auto first = std::prev(std::find(open_.rbegin(), open_.rend(), root).base());
    const std::size_t smallest = *std::min_element(first, open_.end());
    for (auto each = first; each != open_.end(); ++each) {
      nodes_[*each].group = smallest;
      nodes_[*each].open = false;
    }
    open_.erase(first, open_.end());
  }

  std::vector<std::vector<std::size_t>> next_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> open_;
  std::vector<std::size_t> path_;
  std::size_t count_ = 0;
};

}  // namespace

Age age_between(const Release& writer, const Release& reader) {
  // The time differences (reader - writer) modulo the writer's period take every value congruent to the difference of
  // the offsets modulo the common divisor of both periods.
  const base::Nanos common{std::gcd(writer.period.count(), reader.period.count())};
  base::Nanos rest = (reader.offset - writer.offset) % common;
  rest += rest < base::Nanos::zero() ? common : base::Nanos::zero();
  Age age;
  age.least = rest;
  age.most = writer.period - common + rest;
  age.meet = rest == base::Nanos::zero();
  if (age.meet) {
    age.meetings = static_cast<std::uint64_t>(writer.period / common);
    if (reader.position < writer.position) {  // where both are released, the reader gets the value of the previous run
      age.least = writer.period == common ? writer.period : common;
      age.most = writer.period;
    }
  }
  return age;
}

std::vector<std::size_t> circles(std::size_t count, const std::vector<Edge>& edges) {
  return Components(count, edges).smallest();
}

std::vector<std::size_t> writers_first(std::size_t count, const std::vector<Edge>& edges) {
  const std::vector<std::size_t> group = circles(count, edges);
  std::vector<std::vector<std::size_t>> next(count);
  std::vector<std::size_t> waiting(count, 0);
  std::vector<Edge> distinct = edges;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  for (const auto& [from, to] : distinct) {
    if (group[from] != group[to]) {
      next[from].push_back(to);
      ++waiting[to];
    }
  }
  std::set<std::size_t> ready;
  for (std::size_t i = 0; i < count; ++i) {
    if (waiting[i] == 0) {
      ready.insert(i);
    }
  }
  std::vector<std::size_t> order;
  while (!ready.empty()) {
    const std::size_t node = *ready.begin();
    ready.erase(ready.begin());
    order.push_back(node);
    for (const std::size_t to : next[node]) {
      if (--waiting[to] == 0) {
        ready.insert(to);
      }
    }
  }
  return order;
}

}  // namespace indurop::config
