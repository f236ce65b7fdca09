// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/chart_layout.h"

#include <algorithm>

namespace indurop::plc {
namespace {

// Steps first, then transitions, numbered together. Walked depth first from the initial step: a node found for the
// first time is placed below, in columns of its own; a known one is joined from the side or, if it is above, by a jump.
class Layout {
 public:
  explicit Layout(const network::Chart& chart) : chart_(chart), nodes_(chart.steps.size() + chart.transitions.size()) {
    std::size_t number = chart.steps.size();
    for (const network::Transition& transition : chart.transitions) {
      for (const std::size_t step : transition.from) {
        nodes_[step].next.push_back(number);
      }
      nodes_[number++].next = transition.to;
    }
  }

  ChartLayout run() {
    for (const bool initial : {true, false}) {
      for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
        if (nodes_[i].state == State::New && (chart_.steps[i].initial || !initial)) {
          columns_ += walk(i, columns_);
        }
      }
    }
    for (auto node = finished_.rbegin(); node != finished_.rend(); ++node) {
      for (std::size_t k = 0; k < nodes_[*node].next.size(); ++k) {
        Node& to = nodes_[nodes_[*node].next[k]];
        if (!nodes_[*node].upwards[k]) {
          to.row = std::max(to.row, nodes_[*node].row + 1);
        }
      }
    }
    return result();
  }

 private:
  enum class State : std::uint8_t { New, Open, Done };
  struct Node {
    std::vector<std::size_t> next;
    std::vector<bool> upwards;  // for each of them: it is open, that is above
    State state = State::New;
    std::size_t row = 0;
    std::size_t column = 0;
  };

  // Returns the number of columns of the node and the nodes below it.
  std::size_t walk(std::size_t number, std::size_t column) {
    nodes_[number].state = State::Open;
    nodes_[number].column = column;
    std::size_t width = 0;
    for (const std::size_t next : nodes_[number].next) {
      nodes_[number].upwards.push_back(nodes_[next].state == State::Open);
      if (nodes_[next].state == State::New) {
        width += walk(next, column + width);
      } else if (nodes_[number].next.size() > 1) {
        ++width;  // the line to it has its own column
      }
    }
    nodes_[number].state = State::Done;
    finished_.push_back(number);
    return std::max<std::size_t>(width, 1);
  }

  ChartLayout result() {
    ChartLayout out;
    out.columns = columns_;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      out.rows = std::max(out.rows, node.row + 1);
      (i < chart_.steps.size() ? out.steps : out.transitions).push_back({node.row, node.column});
      if (i >= chart_.steps.size()) {
        // A transition without a step before it was not walked.
        out.jumps.push_back(node.upwards);
        out.jumps.back().resize(node.next.size(), true);
      }
    }
    return out;
  }

  const network::Chart& chart_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> finished_;
  std::size_t columns_ = 0;
};

}  // namespace

ChartLayout lay_out_chart(const network::Chart& chart) {
  return Layout(chart).run();
}

}  // namespace indurop::plc
