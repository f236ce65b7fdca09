// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/order.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace indurop::plc::network {
namespace {

using Kind = Element::Kind;

struct Edge {
  const Connection* connection;  // null: from a connector to its continuation
  const Element* from;
};

// Walks depth first along the sources, without recursion: rungs may be long. A circle is cut after an element that
// keeps its value; if that is not where the circle was found, the walk starts again with the cut.
class OrderWalk {
 public:
  OrderWalk(const Index& index, Order& order) : index_(index), order_(order) {}

  // Returns false if it must start again.
  bool run(const std::vector<const Element*>& roots) {
    order_.elements.clear();
    return std::all_of(roots.begin(), roots.end(), [&](const Element* root) { return visit(root); });
  }

 private:
  enum class State : std::uint8_t { Fresh, Open, Done };
  struct Level {
    const Element* element;
    std::vector<Edge> edges;
    std::size_t next = 0;
  };

  std::vector<Edge> edges_of(const Element& element) {
    std::vector<Edge> edges;
    for (const auto* pins : {&element.inputs, &element.in_outs}) {
      for (const Pin& pin : *pins) {
        const std::size_t first = edges.size();
        for (const Connection& connection : pin.connections) {
          const Element* from = index_.find(connection.from);
          if (from != nullptr && !order_.feedback.contains(&connection)) {
            edges.push_back({&connection, from});
          }
        }
        std::stable_sort(edges.begin() + static_cast<std::ptrdiff_t>(first), edges.end(),
                         [](const Edge& a, const Edge& b) { return a.from->y < b.from->y; });
      }
    }
    if (element.kind == Kind::Continuation) {
      if (const Element* from = index_.connector(element.text)) {
        edges.push_back({nullptr, from});
      }
    }
    return edges;
  }

  bool visit(const Element* root) {
    if (states_[root] != State::Fresh) {
      return true;
    }
    open(root);
    while (!stack_.empty()) {
      Level& level = stack_.back();
      if (level.next == level.edges.size()) {
        close(level.element);
        continue;
      }
      const Edge edge = level.edges[level.next++];
      const State state = states_[edge.from];
      if (state == State::Fresh) {
        open(edge.from);
      } else if (state == State::Open && !cut(edge)) {
        return false;
      }
    }
    return true;
  }

  void open(const Element* element) {
    states_[element] = State::Open;
    stack_.push_back({element, edges_of(*element), 0});
  }
  void close(const Element* element) {
    states_[element] = State::Done;
    order_.elements.push_back(element);
    stack_.pop_back();
  }

  // Cuts the circle on the stack: from the level of closing.from, which is evaluated first, to the top. Returns true if
  // the walk can continue.
  bool cut(const Edge& closing) {
    std::size_t level = stack_.size() - 1;
    while (stack_[level].element != closing.from) {
      --level;
    }
    for (; level < stack_.size(); ++level) {
      const Edge& edge = stack_[level].edges[stack_[level].next - 1];
      if (keeps_its_value(*edge.from) && edge.connection != nullptr) {
        order_.feedback.insert(edge.connection);
        return level + 1 == stack_.size();
      }
    }
    order_.circles.push_back(closing.from);
    if (closing.connection != nullptr) {
      order_.feedback.insert(closing.connection);
    }
    return true;
  }

  const Index& index_;
  Order& order_;
  std::unordered_map<const Element*, State> states_;
  std::vector<Level> stack_;
};

}  // namespace

bool keeps_its_value(const Element& element) noexcept {
  return (element.kind == Kind::Block && !element.instance.empty()) || element.kind == Kind::InOutVariable;
}

Order order_of(const std::vector<Network>& networks, const Index& index) {
  std::vector<const Element*> roots;
  std::unordered_map<const Element*, int> number;
  bool numbered = false;
  for (const Network& network : networks) {
    for (const Element* element : network.elements) {
      roots.push_back(element);
      number.emplace(element, network.number);
      numbered = numbered || element->order > 0;
    }
  }
  const auto key = [&](const Element* e) {
    const int given = e->order > 0 ? e->order : std::numeric_limits<int>::max();
    return std::tuple(numbered ? given : 0, number.at(e), e->y, e->x);
  };
  std::stable_sort(roots.begin(), roots.end(), [&](const Element* a, const Element* b) { return key(a) < key(b); });
  Order order;
  for (const Element* element : numbered ? roots : std::vector<const Element*>{}) {
    for (const Pin& pin : element->inputs) {
      for (const Connection& connection : pin.connections) {
        const Element* from = index.find(connection.from);
        if (from != nullptr && from->order > element->order && element->order > 0 && keeps_its_value(*from)) {
          order.feedback.insert(&connection);
        }
      }
    }
  }
  while (!OrderWalk(index, order).run(roots)) {
    order.circles.clear();
  }
  return order;
}

}  // namespace indurop::plc::network
