// SPDX-License-Identifier: Apache-2.0
#include "config/check/data_flow.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace indurop::config {
namespace {

// Nodes reachable from `from`, itself only if there is a way back.
std::vector<bool> reachable(std::size_t from, const std::vector<std::vector<std::size_t>>& next) {
  std::vector<bool> seen(next.size(), false);
  std::vector<std::size_t> open{from};
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    for (const std::size_t to : next[node]) {
      if (!seen[to]) {
        seen[to] = true;
        open.push_back(to);
      }
    }
  }
  return seen;
}

}  // namespace

Age age_between(const Release& writer, const Release& reader) {
  // The distances (reader - writer) modulo the writer's period take every value congruent to the difference of the
  // offsets modulo the common divisor of both periods.
  const base::Nanos common{std::gcd(writer.period.count(), reader.period.count())};
  base::Nanos rest = (reader.offset - writer.offset) % common;
  rest += rest < base::Nanos::zero() ? common : base::Nanos::zero();
  Age age;
  age.least = rest;
  age.most = writer.period - common + rest;
  age.meet = rest == base::Nanos::zero();
  if (age.meet) {
    age.meetings = static_cast<std::uint64_t>(writer.period / common);
    if (reader.position < writer.position) {  // where both are released, the value of the run before is read
      age.least = writer.period == common ? writer.period : common;
      age.most = writer.period;
    }
  }
  return age;
}

std::vector<std::size_t> circles(std::size_t count, const std::vector<Edge>& edges) {
  std::vector<std::vector<std::size_t>> next(count);
  for (const auto& [from, to] : edges) {
    next[from].push_back(to);
  }
  std::vector<std::vector<bool>> reach;
  reach.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    reach.push_back(reachable(i, next));
  }
  std::vector<std::size_t> group(count);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (reach[i][j] && reach[j][i]) {
        group[i] = group[j];
        break;
      }
    }
  }
  return group;
}

std::vector<std::size_t> writers_first(std::size_t count, const std::vector<Edge>& edges) {
  const std::vector<std::size_t> group = circles(count, edges);
  std::vector<std::vector<std::size_t>> next(count);
  std::vector<std::size_t> waiting(count, 0);
  for (const auto& [from, to] : std::set<Edge>(edges.begin(), edges.end())) {
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
