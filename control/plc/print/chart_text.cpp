// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/chart_text.h"

#include <fmt/format.h>

namespace indurop::plc {
namespace {

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!space || (!line.empty() && line.back() != ' ')) {
      line += space ? ' ' : c;
    }
  }
  while (!line.empty() && line.back() == ' ') {
    line.pop_back();
  }
  return line;
}

std::string names_of(const network::Chart& chart, const std::vector<std::size_t>& steps) {
  std::string names;
  for (const std::size_t step : steps) {
    names += (names.empty() ? "" : ", ") + chart.steps[step].name;
  }
  return names;
}

std::string action_line(const network::ActionLine& line) {
  return fmt::format("      {:<6} {:<8} {}\n", line.qualifier, line.duration, action_text(line));
}

std::string transition_line(const network::Chart& chart, std::size_t step, const network::Transition& transition,
                            bool unicode, const ChartMarks& marks) {
  const std::string values = marks.condition ? marks.condition(condition_text(*transition.element)) : std::string();
  std::string text = fmt::format("    {} {}", unicode ? "┼" : "+", condition_text(*transition.element));
  std::vector<std::size_t> others;
  for (const std::size_t from : transition.from) {
    if (from != step) {
      others.push_back(from);
    }
  }
  if (!others.empty()) {
    text += fmt::format("   (together with {})", names_of(chart, others));
  }
  return text + fmt::format("  {} {}{}\n", unicode ? "──>" : "-->", names_of(chart, transition.to), values);
}

}  // namespace

std::string action_text(const network::ActionLine& line) {
  return line.name.empty() && line.inlined != nullptr ? one_line(line.inlined->text) : line.name;
}

std::string condition_text(const network::Element& transition) {
  if (transition.inlined != nullptr && transition.inlined->language == network::Body::Language::St) {
    std::string text = one_line(transition.inlined->text);
    text = text.starts_with(":= ") ? text.substr(3) : text;
    return text.ends_with(';') ? text.substr(0, text.size() - 1) : text;
  }
  return transition.text.empty() ? "(drawn)" : transition.text;
}

std::string chart_text(const network::Chart& chart, bool unicode, const ChartMarks& marks) {
  // By step.
  std::vector<std::vector<const network::Association*>> actions(chart.steps.size());
  for (const network::Association& association : chart.actions) {
    actions[association.step].push_back(&association);
  }
  std::vector<std::vector<const network::Transition*>> transitions(chart.steps.size());
  for (const network::Transition& transition : chart.transitions) {
    if (!transition.from.empty()) {
      transitions[transition.from.front()].push_back(&transition);
    }
  }
  std::string text;
  for (std::size_t i = 0; i < chart.steps.size(); ++i) {
    const network::Step& step = chart.steps[i];
    text += fmt::format("  {0}{2}{1}{3}\n", step.initial ? "[[" : "[", step.initial ? "]]" : "]", step.name,
                        marks.step ? marks.step(step) : "");
    for (const network::Association* association : actions[i]) {
      text += action_line(*association->line);
    }
    for (const network::Transition* transition : transitions[i]) {
      text += transition_line(chart, i, *transition, unicode, marks);
    }
  }
  return text + "\n";
}

}  // namespace indurop::plc
