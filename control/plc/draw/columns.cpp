// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/columns.h"

#include <algorithm>
#include <limits>

namespace indurop::plc::draw {
namespace {

using Kind = Element::Kind;
using Role = Item::Role;

class Columns {
 public:
  Columns(Graph& graph, bool rails) : graph_(graph), rails_(rails) {}

  void run() {
    longest_paths();
    pull_values();
    push_ends();
    if (wires() > kMostWires) {
      graph_.too_large = true;
      return;
    }
    const std::size_t nets = graph_.nets.size();
    for (std::size_t i = 0; i < nets; ++i) {
      bridge(i);
    }
    for (const Item& item : graph_.items) {
      graph_.columns = std::max(graph_.columns, item.column + 1);
    }
  }

 private:
  Item& item(int i) { return graph_.items[static_cast<std::size_t>(i)]; }

  static bool is_end(const Item& each) {
    return each.role == Role::Symbol && each.symbol.shape.outputs.empty() &&
           (each.symbol.element == nullptr || each.symbol.element->kind == Kind::OutVariable);
  }

  // Items whose outputs go into variables as well as elsewhere: these get a column of their own.
  std::vector<bool> with_values_and_others() {
    std::vector<bool> found(graph_.items.size(), false);
    for (const Net& net : graph_.nets) {
      const bool end = std::any_of(net.targets.begin(), net.targets.end(),
                                   [&](const End& target) { return is_end(item(target.item)); });
      for (const End& source : net.sources) {
        found[static_cast<std::size_t>(source.item)] = found[static_cast<std::size_t>(source.item)] || end;
      }
    }
    return found;
  }

  void longest_paths() {
    // A net is done when all of its sources have their column.
    std::vector<int> missing;
    std::vector<std::vector<std::size_t>> leaves(graph_.items.size());
    std::vector<int> waits(graph_.items.size(), 0);
    for (std::size_t n = 0; n < graph_.nets.size(); ++n) {
      missing.push_back(static_cast<int>(graph_.nets[n].sources.size()));
      for (const End& end : graph_.nets[n].sources) {
        leaves[static_cast<std::size_t>(end.item)].push_back(n);
      }
      for (const End& end : graph_.nets[n].targets) {
        ++waits[static_cast<std::size_t>(end.item)];
      }
    }
    const std::vector<bool> crowded = with_values_and_others();
    std::vector<int> ready;
    for (std::size_t i = 0; i < graph_.items.size(); ++i) {
      item(static_cast<int>(i)).column = graph_.items[i].role == Role::LeftRail || !rails_ ? 0 : 1;
      if (waits[i] == 0) {
        ready.push_back(static_cast<int>(i));
      }
    }
    while (!ready.empty()) {
      const int done = ready.back();
      ready.pop_back();
      for (const std::size_t n : leaves[static_cast<std::size_t>(done)]) {
        for (const End& end : graph_.nets[n].targets) {
          const int step = crowded[static_cast<std::size_t>(done)] && !is_end(item(end.item)) ? 2 : 1;
          item(end.item).column = std::max(item(end.item).column, item(done).column + step);
          if (missing[n] == 1 && --waits[static_cast<std::size_t>(end.item)] == 0) {
            ready.push_back(end.item);
          }
        }
        --missing[n];
      }
    }
  }

  // Constants and variables are placed next to the pin they feed.
  void pull_values() {
    for (const Net& net : graph_.nets) {
      int nearest = std::numeric_limits<int>::max();
      for (const End& end : net.targets) {
        nearest = std::min(nearest, item(end.item).column);
      }
      for (const End& end : net.sources) {
        Item& source = item(end.item);
        const bool value = source.role == Role::Symbol && source.symbol.shape.inputs.empty();
        const bool of_block = source.symbol.element != nullptr && source.symbol.element->kind == Kind::Block;
        if (value && !of_block) {
          source.column = std::max(source.column, nearest - 1);
        }
      }
    }
  }

  void push_ends() {
    int last = 0;
    for (const Item& each : graph_.items) {
      last = each.role == Role::RightRail ? last : std::max(last, each.column);
    }
    std::vector<bool> goes_on(graph_.items.size(), false);
    for (const Net& net : graph_.nets) {
      const bool to_rail = std::all_of(net.targets.begin(), net.targets.end(),
                                       [&](const End& end) { return item(end.item).role == Role::RightRail; });
      for (const End& end : net.sources) {
        goes_on[static_cast<std::size_t>(end.item)] = goes_on[static_cast<std::size_t>(end.item)] || !to_rail;
      }
    }
    for (std::size_t i = 0; i < graph_.items.size(); ++i) {
      Item& each = graph_.items[i];
      const Element* element = each.symbol.element;
      const bool end = element != nullptr &&
                       (element->kind == Kind::Coil || element->kind == Kind::Jump || element->kind == Kind::Return);
      if (each.role == Role::RightRail) {
        each.column = last + 1;
      } else if (rails_ && end && !goes_on[i]) {
        each.column = last;
      }
    }
  }

  End add_wire(const std::vector<Source>& carries, double rank, int column) {
    Item wire;
    wire.role = Role::Wire;
    wire.symbol.shape = {0, 1, {0}, {0}};
    wire.rank = rank;
    wire.column = column;
    wire.carries = carries;
    graph_.items.push_back(std::move(wire));
    return {static_cast<int>(graph_.items.size()) - 1, 0, carries};
  }
  // Adds wires in the columns `from` to `to` after `end`; returns the last of them.
  End extend(End end, double rank, int from, int to) {
    for (int column = from; column <= to; ++column) {
      Net piece;
      piece.carries = end.carries;
      piece.sources = {end};
      end = add_wire(end.carries, rank, column);
      piece.targets = {end};
      graph_.nets.push_back(std::move(piece));
    }
    return end;
  }

  // Returns how many wires bridge() will add, by the sources that each carries.
  [[nodiscard]] std::size_t wires() const {
    const auto column_of = [&](const End& end) { return graph_.items[static_cast<std::size_t>(end.item)].column; };
    std::size_t count = 0;
    for (const Net& net : graph_.nets) {
      int last = 0;
      for (const End& end : net.targets) {
        last = std::max(last, column_of(end));
      }
      int before = 0;
      for (const End& end : net.sources) {
        before = std::max(before, column_of(end));
      }
      for (const End& end : net.sources) {
        count += static_cast<std::size_t>(before - column_of(end));
      }
      count += static_cast<std::size_t>(std::max(last - before - 1, 0)) * net.carries.size();
    }
    return count;
  }

  void bridge(std::size_t n) {
    Net net = graph_.nets[n];
    int before = 0;
    int behind = std::numeric_limits<int>::max();
    double rank = std::numeric_limits<double>::max();
    for (const End& end : net.sources) {
      before = std::max(before, item(end.item).column);
      rank = std::min(rank, item(end.item).rank);
    }
    for (const End& end : net.targets) {
      behind = std::min(behind, item(end.item).column);
    }
    if (net.targets.size() == 1 && item(net.sources.front().item).role != Role::LeftRail) {
      rank = item(net.targets.front().item).rank + kPinRank * net.targets.front().port;
    }
    for (End& end : net.sources) {
      end = extend(end, item(end.item).rank, item(end.item).column + 1, before);
    }
    if (behind - before > 1) {
      Net joined;
      joined.carries = net.carries;
      joined.sources = net.sources;
      const End first = add_wire(net.carries, rank, before + 1);
      joined.targets = {first};
      graph_.nets.push_back(std::move(joined));
      net.sources = {extend(first, rank, before + 2, behind - 1)};
    }
    std::vector<Net> pieces = share_wire(std::move(net), behind);
    graph_.nets[n] = std::move(pieces.front());
    graph_.nets.insert(graph_.nets.end(), std::next(pieces.begin()), pieces.end());
  }

  // Leads a net with targets in `column` and later ones to all of them by one wire, which branches before each column.
  // Returns its pieces.
  std::vector<Net> share_wire(Net net, int column) {
    std::vector<End> targets = std::move(net.targets);
    const auto column_of = [&](const End& end) { return item(end.item).column; };
    std::stable_sort(targets.begin(), targets.end(),
                     [&](const End& a, const End& b) { return column_of(a) < column_of(b); });
    std::vector<double> ranks(targets.size(), 0);  // the first rank of each and all after it
    for (std::size_t i = targets.size(); i-- > 0;) {
      const double rank = item(targets[i].item).rank + kPinRank * targets[i].port;
      ranks[i] = i + 1 == targets.size() ? rank : std::min(rank, ranks[i + 1]);
    }
    std::vector<Net> pieces{{std::move(net.sources), {}, net.carries}};
    for (std::size_t i = 0; true; ++column) {
      for (; i < targets.size() && column_of(targets[i]) == column; ++i) {
        pieces.back().targets.push_back(targets[i]);
      }
      if (i == targets.size()) {
        return pieces;
      }
      const End wire = add_wire(net.carries, ranks[i], column);
      pieces.back().targets.push_back(wire);
      pieces.push_back({{wire}, {}, net.carries});
    }
  }

  Graph& graph_;
  bool rails_;
};

}  // namespace

void assign_columns(Graph& graph, bool rails) {
  Columns(graph, rails).run();
}

}  // namespace indurop::plc::draw
