// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/layout_graph.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "control/plc/draw/columns.h"

namespace indurop::plc::draw {
namespace {

using Kind = Element::Kind;
using Role = Item::Role;

// Returns the port of a source: the outputs of a block are counted first, then its in-outs.
int port_of(const Source& source) {
  if (source.pin == nullptr) {
    return 0;
  }
  const auto& outputs = source.element->outputs;
  const auto& in_outs = source.element->in_outs;
  for (std::size_t i = 0; i < outputs.size() + in_outs.size(); ++i) {
    if (source.pin == (i < outputs.size() ? &outputs[i] : &in_outs[i - outputs.size()])) {
      return static_cast<int>(i);
    }
  }
  return 0;
}

// Returns the text of a value of the last scan at the input to which it is fed back.
std::string kept_text(const Source& source) {
  return source.pin == nullptr ? source.element->text : source.element->instance + "." + source.pin->name;
}

class Builder {
 public:
  Builder(const Network& network, const Index& index, const Order& order, bool rails)
      : network_(network), index_(index), order_(order), rails_(rails) {}

  Graph run() {
    for (const Element* element : network_.elements) {
      Item item;
      item.symbol = {element, {}, shape_of(*element), 0, 0};
      items_of_.emplace(element, add(std::move(item)));
    }
    rank();
    for (const Element* element : network_.elements) {
      inputs(*element);
      outputs(*element);
    }
    end_at_rail();
    make_nets();
    assign_columns(graph_, rails_);
    return std::move(graph_);
  }

 private:
  using Ends = std::vector<std::pair<int, int>>;  // items and their ports

  int add(Item item) {
    graph_.items.push_back(std::move(item));
    return static_cast<int>(graph_.items.size()) - 1;
  }
  int add_wire(Role role, double rank, std::vector<Source> carries) {
    Item item;
    item.role = role;
    item.symbol.shape = {0, 1, {0}, {0}};
    item.rank = rank;
    item.carries = std::move(carries);
    return add(std::move(item));
  }
  int add_text(const std::string& text, bool source, double rank) {
    Item item;
    item.symbol.text = text;
    item.symbol.shape = {text_width(text) + (source ? 1 : 2), 1, {}, {}};
    (source ? item.symbol.shape.outputs : item.symbol.shape.inputs).push_back(0);
    item.rank = rank;
    return add(std::move(item));
  }

  // Ranks each item like the first of its sources; sources one below the other in evaluation order, which follows the
  // places on the sheet if the file has them. Coils are ranked in the same way.
  void rank() {
    double next = 0;
    double last_end = 0;
    const auto goes_on = sources_of();
    std::unordered_map<const Element*, double> ranks;
    for (const Element* element : order_.elements) {
      const auto item = items_of_.find(element);
      if (item == items_of_.end()) {
        continue;
      }
      double best = -1;
      for (const Pin& pin : element->inputs) {
        for (const Connection& connection : pin.connections) {
          const auto from = ranks.find(index_.find(connection.from));
          const double rank =
              from == ranks.end() ? -1 : from->second + kBehind * (1 + port_of(index_.source(connection)));
          best = rank < 0 || (best >= 0 && best < rank) ? best : rank;
        }
      }
      next += 1;
      double rank = best < 0 ? next : best;
      if (!goes_on.contains(element)) {
        rank = last_end = std::max(rank, last_end + kBehind);
      }
      ranks[element] = rank;
      graph_.items[static_cast<std::size_t>(item->second)].rank = rank;
    }
  }

  [[nodiscard]] std::unordered_set<const Element*> sources_of() const {
    std::unordered_set<const Element*> sources;
    for (const Element* element : network_.elements) {
      for (const auto* pins : {&element->inputs, &element->in_outs}) {
        for (const Pin& pin : *pins) {
          for (const Connection& connection : pin.connections) {
            sources.insert(index_.find(connection.from));
          }
        }
      }
    }
    return sources;
  }

  void inputs(const Element& element) {
    const int item = items_of_.at(&element);
    const double rank = graph_.items[static_cast<std::size_t>(item)].rank;
    int port = 0;
    for (const auto* pins : {&element.inputs, &element.in_outs}) {
      for (const Pin& pin : *pins) {
        const double at = rank - 2 * kBehind + kPinRank * port;  // above other sources of the first pin
        Ends sources;
        for (const Connection& connection : pin.connections) {
          connect(connection, at, sources);
        }
        if (!pin.expression.empty()) {
          sources.emplace_back(add_text(pin.expression, true, at), 0);
        }
        target(std::move(sources), {item, element.kind == Kind::Block ? port : 0, {}});
        ++port;
      }
    }
  }

  void connect(const Connection& connection, double rank, Ends& sources) {
    const Source from = index_.source(connection);
    if (from.element == nullptr) {
      return;
    }
    const auto item = items_of_.find(from.element);
    if (order_.feedback.contains(&connection)) {
      sources.emplace_back(add_text(kept_text(from), true, rank), 0);
    } else if (from.element->kind == Kind::LeftRail) {
      sources.emplace_back(add_wire(Role::LeftRail, rank, {from}), 0);
    } else if (item != items_of_.end()) {
      sources.emplace_back(item->second, port_of(from));
    }
  }

  void target(Ends sources, const End& end) {
    if (!sources.empty()) {
      std::sort(sources.begin(), sources.end());
      sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
      targets_[std::move(sources)].push_back(end);
    }
  }

  // Adds the variables that some editors write at the pin of an output.
  void outputs(const Element& element) {
    const int item = items_of_.at(&element);
    int port = 0;
    for (const Pin& pin : element.kind == Kind::Block ? element.outputs : std::vector<Pin>{}) {
      if (!pin.expression.empty()) {
        const double rank = graph_.items[static_cast<std::size_t>(item)].rank + kPinRank * port;
        target({{item, port}}, {add_text(pin.expression, false, rank), 0, {}});
      }
      ++port;
    }
  }

  // Connects right rails as the file defines and, in ladders, with every coil that feeds nothing else.
  void end_at_rail() {
    std::unordered_map<int, bool> goes_on;
    for (const auto& [sources, ends] : targets_) {
      for (const auto& [item, port] : sources) {
        goes_on[item] = true;
      }
    }
    for (const Element* rail : index_.right_rails()) {
      for (const Pin& pin : rail->inputs) {
        for (const Connection& connection : pin.connections) {
          const Source from = index_.source(connection);
          const auto item = items_of_.find(from.element);
          if (item != items_of_.end()) {
            to_rail(item->second, port_of(from));
            goes_on[item->second] = true;
          }
        }
      }
    }
    for (const Element* element : network_.elements) {
      if (rails_ && element->kind == Kind::Coil && !goes_on[items_of_.at(element)]) {
        to_rail(items_of_.at(element), 0);
      }
    }
  }
  void to_rail(int item, int port) {
    const double rank = graph_.items[static_cast<std::size_t>(item)].rank;
    target({{item, port}}, {add_wire(Role::RightRail, rank, {}), 0, {}});
  }

  [[nodiscard]] std::vector<Source> carried(const std::pair<int, int>& end) const {
    const Item& item = graph_.items[static_cast<std::size_t>(end.first)];
    const Element* element = item.symbol.element;
    if (element == nullptr) {
      return item.carries;
    }
    const auto port = static_cast<std::size_t>(end.second);
    const bool of_block = element->kind == Kind::Block;
    const Pin* pin = !of_block                        ? nullptr
                     : port < element->outputs.size() ? &element->outputs[port]
                                                      : &element->in_outs[port - element->outputs.size()];
    return {{element, pin}};
  }

  // A source of several nets gets a piece of wire for each of them: joined lines always carry the same.
  void make_nets() {
    std::map<std::pair<int, int>, int> uses;
    for (const auto& [sources, ends] : targets_) {
      for (const auto& source : sources) {
        ++uses[source];
      }
    }
    std::map<std::pair<int, int>, std::size_t> split;  // nets that lead to the pieces
    for (const auto& [sources, ends] : targets_) {
      Net net;
      net.targets = ends;
      for (const auto& source : sources) {
        const std::vector<Source> carries = carried(source);
        net.carries.insert(net.carries.end(), carries.begin(), carries.end());
        if (uses[source] == 1) {
          net.sources.push_back({source.first, source.second, carries});
          continue;
        }
        const End& end = ends.front();
        const double rank = graph_.items[static_cast<std::size_t>(end.item)].rank + kPinRank * end.port;
        const int piece = add_wire(Role::Wire, rank, carries);
        const auto [at, fresh] = split.try_emplace(source, graph_.nets.size());
        if (fresh) {
          graph_.nets.push_back({{{source.first, source.second, carries}}, {}, carries});
        }
        graph_.nets[at->second].targets.push_back({piece, 0, {}});
        net.sources.push_back({piece, 0, carries});
      }
      graph_.nets.push_back(std::move(net));
    }
  }

  const Network& network_;
  const Index& index_;
  const Order& order_;
  bool rails_;
  Graph graph_;
  std::unordered_map<const Element*, int> items_of_;
  std::map<Ends, std::vector<End>> targets_;  // by their sources
};

}  // namespace

Graph make_graph(const Network& network, const Index& index, const Order& order, bool rails) {
  return Builder(network, index, order, rails).run();
}

}  // namespace indurop::plc::draw
