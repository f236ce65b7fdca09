// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "control/plc/model/elementary.h"
#include "control/plc/network/chart_reach.h"

namespace indurop::plc::network {
namespace {

using Kind = Element::Kind;

template <class Function>
void each_source(const Element& element, const Index& index, Diagnostics& diagnostics, Function&& function) {
  for (const Pin& pin : element.inputs) {
    for (const Connection& connection : pin.connections) {
      if (const Element* from = index.find(connection.from)) {
        function(*from);
      } else {
        diagnostics.error(
            connection.at,
            fmt::format("is connected to element {}, which does not exist; draw the line again", connection.from));
      }
    }
  }
}

class ChartReader {
 public:
  ChartReader(const Diagram& diagram, Diagnostics& diagnostics)
      : diagram_(diagram), index_(diagram), diagnostics_(diagnostics) {}

  Chart read() {
    collect();
    for (Transition& transition : chart_.transitions) {
      passed_.clear();
      before(*transition.element, transition.from);
      if (transition.from.empty()) {
        diagnostics_.error(transition.element->at, "no step leads to this transition; draw a line from one");
      }
    }
    for (const Element& element : diagram_.elements) {
      passed_.clear();
      if (element.kind == Kind::Step) {
        into(element, steps_.at(&element));
        for (const ActionLine& line : element.actions) {
          chart_.actions.push_back({steps_.at(&element), &line});
        }
      } else if (element.kind == Kind::JumpStep) {
        jump(element);
      } else if (element.kind == Kind::ActionBlock) {
        actions(element);
      }
    }
    for (const Transition& transition : chart_.transitions) {
      if (transition.to.empty()) {
        diagnostics_.error(transition.element->at, "this transition leads to no step; draw a line to one, or a jump");
      }
    }
    begins_once();
    if (diagnostics_.errors() == before_) {
      warn_about_reach(chart_, diagnostics_);
    }
    return std::move(chart_);
  }

 private:
  // A body may contain several charts, which run in parallel; each begins in one step.
  void begins_once() {
    std::vector<std::size_t> chart_of(chart_.steps.size());
    std::iota(chart_of.begin(), chart_of.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
      while (chart_of[i] != i) {
        chart_of[i] = chart_of[chart_of[i]];
        i = chart_of[i];
      }
      return i;
    };
    const auto join = [&](std::size_t a, std::size_t b) { chart_of[find(b)] = find(a); };
    for (const Transition& transition : chart_.transitions) {
      for (const auto* steps : {&transition.from, &transition.to}) {
        for (const std::size_t step : *steps) {
          join(transition.from.empty() ? step : transition.from.front(), step);
        }
      }
    }
    std::unordered_map<std::size_t, std::size_t> begins;  // of each chart
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      if (chart_.steps[i].initial && ++begins[find(i)] == 2) {
        diagnostics_.error(chart_.steps[i].element->at,
                           "this chart has two initial steps; it begins in one, unless they are charts of their own");
      }
    }
  }

  void collect() {
    std::vector<const Element*> transitions;
    for (const Element& element : diagram_.elements) {
      if (element.kind == Kind::Step) {
        step(element);
      } else if (element.kind == Kind::Transition) {
        transitions.push_back(&element);
      }
    }
    const auto key = [](const Element* e) {
      return std::tuple(e->priority > 0 ? e->priority : std::numeric_limits<int>::max(), e->x);
    };
    std::stable_sort(transitions.begin(), transitions.end(),
                     [&](const Element* a, const Element* b) { return key(a) < key(b); });
    for (const Element* element : transitions) {
      numbers_.emplace(element, chart_.transitions.size());
      chart_.transitions.push_back({element, {}, {}});
    }
    const auto is_initial = [](const Step& step) { return step.initial; };
    if (!chart_.steps.empty() && std::none_of(chart_.steps.begin(), chart_.steps.end(), is_initial)) {
      diagnostics_.error(chart_.steps.front().element->at, "this chart has no initial step; mark one as initial");
    }
    if (chart_.steps.empty()) {
      diagnostics_.error(diagram_.elements.empty() ? Place{} : diagram_.elements.front().at, "this chart has no step");
    }
  }

  void step(const Element& element) {
    if (element.text.empty()) {
      diagnostics_.error(element.at, "this step has no name; write one");
    }
    if (!names_.try_emplace(upper(element.text), chart_.steps.size()).second) {
      diagnostics_.error(element.at, fmt::format("a second step '{}'; steps have different names", element.text));
    }
    steps_.emplace(&element, chart_.steps.size());
    chart_.steps.push_back({&element, element.text, element.initial});
  }

  // Counts the branches that do not end in a jump.
  [[nodiscard]] std::size_t branches_of(const Element& convergence) {
    std::size_t count = 0;
    each_source(convergence, index_, diagnostics_,
                [&](const Element& from) { count += from.kind == Kind::JumpStep ? 0 : 1; });
    return count;
  }

  // Returns whether the lines around the element still have to be followed.
  bool enter(const Element& element) {
    constexpr std::size_t kMaxBranches = 500;
    if (depth_ >= kMaxBranches) {
      diagnostics_.error(element.at, fmt::format("more than {} branches in a row without a step", kMaxBranches));
      return false;
    }
    return passed_.insert(&element).second;
  }

  // Collects the steps before a transition: one, or all those of a simultaneous convergence.
  void before(const Element& element, std::vector<std::size_t>& into) {
    if (!enter(element)) {
      return;  // a circle without a step: reported as a transition without one
    }
    ++depth_;
    each_source(element, index_, diagnostics_, [&](const Element& from) {
      switch (from.kind) {
        case Kind::Step:
          into.push_back(steps_.at(&from));
          break;
        case Kind::SelectionDivergence:
        case Kind::SimultaneousConvergence:
          before(from, into);
          break;
        case Kind::JumpStep:
          if (element.kind == Kind::SelectionConvergence || element.kind == Kind::SimultaneousConvergence) {
            break;  // its branch ends there
          }
          [[fallthrough]];
        default:
          if (from.kind == Kind::SelectionConvergence && branches_of(from) == 1) {
            before(from, into);  // CODESYS draws it if all branches but one end in a jump
          } else {
            diagnostics_.error(element.at, fmt::format("{} stands before it, where a step must be", title_of(from)));
          }
      }
    });
    --depth_;
  }

  // Adds the step to transitions that lead into `element`.
  void into(const Element& element, std::size_t step) {
    if (!enter(element)) {
      return;
    }
    ++depth_;
    each_source(element, index_, diagnostics_, [&](const Element& from) {
      switch (from.kind) {
        case Kind::Transition: {
          auto& to = chart_.transitions[numbers_.at(&from)].to;
          if (std::find(to.begin(), to.end(), step) == to.end()) {
            to.push_back(step);
          }
          break;
        }
        case Kind::SelectionConvergence:
        case Kind::SimultaneousDivergence:
          into(from, step);
          break;
        case Kind::JumpStep:
          if (element.kind == Kind::SelectionConvergence) {
            break;  // CODESYS also closes branches that end in a jump
          }
          [[fallthrough]];
        default:
          diagnostics_.error(element.at,
                             fmt::format("{} stands before it, where a transition must be", title_of(from)));
      }
    });
    --depth_;
  }

  void jump(const Element& element) {
    const auto target = names_.find(upper(element.text));
    if (target == names_.end()) {
      diagnostics_.error(element.at, fmt::format("there is no step '{}' to jump to", element.text));
    } else {
      into(element, target->second);
    }
  }

  void actions(const Element& element) {
    bool connected = false;
    each_source(element, index_, diagnostics_, [&](const Element& from) {
      if (from.kind != Kind::Step) {
        diagnostics_.error(element.at, fmt::format("is connected to {}; actions belong to steps", title_of(from)));
        return;
      }
      connected = true;
      for (const ActionLine& line : element.actions) {
        chart_.actions.push_back({steps_.at(&from), &line});
      }
    });
    if (!connected) {
      diagnostics_.error(element.at, "these actions belong to no step; draw a line to one");
    }
  }

  const Diagram& diagram_;
  Index index_;
  Diagnostics& diagnostics_;
  const std::size_t before_ = diagnostics_.errors();
  Chart chart_;
  std::unordered_map<const Element*, std::size_t> steps_;
  std::unordered_map<const Element*, std::size_t> numbers_;  // of transitions
  std::unordered_map<std::string, std::size_t> names_;
  std::unordered_set<const Element*> passed_;  // in the current search
  std::size_t depth_ = 0;
};

}  // namespace

Chart read_chart(const Diagram& diagram, Diagnostics& diagnostics) {
  return ChartReader(diagram, diagnostics).read();
}

}  // namespace indurop::plc::network
