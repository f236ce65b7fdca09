// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "control/plc/lower/chart_actions.h"
#include "control/plc/model/make.h"

namespace indurop::plc::lower {
namespace {

class ChartLowering {
 public:
  ChartLowering(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics)
      : chart_(chart), around_(around), diagnostics_(diagnostics) {}

  Lowered run() {
    declare_steps();
    reset();
    measure();
    evaluate();
    clear();
    measure();
    Lowered actions = lower_actions(chart_, around_, diagnostics_);
    std::move(actions.variables.begin(), actions.variables.end(), std::back_inserter(code_.variables));
    std::move(actions.body.begin(), actions.body.end(), std::back_inserter(code_.body));
    finish_scan();
    return std::move(code_);
  }

 private:
  void add(ast::Statement statement) { code_.body.push_back(std::move(statement)); }
  void declare(ast::Section section, std::string name, ast::TypeSpec type) {
    code_.variables.push_back(make::variable(section, std::move(name), std::move(type)));
  }

  void declare_steps() {
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const Step& step = chart_.steps[i];
      const Place& at = step.element->at;
      ast::Variable variable = make::variable(ast::Section::Local, step.name, make::type(at, std::string(kStepType)));
      if (step.initial) {
        ast::InitialElement field;
        field.field = "X";
        field.value.at = at;
        field.value.value = make::truth(at, true);
        variable.initial.emplace();
        variable.initial->kind = ast::Initial::Kind::Struct;
        variable.initial->at = at;
        variable.initial->elements.push_back(std::move(field));
      }
      code_.variables.push_back(std::move(variable));
      declare(ast::Section::Local, step_timer(i), make::type(at, std::string(kTimerType)));
      declare(ast::Section::Local, step_before(i), make::type(at, Elementary::Bool));
    }
    const Place at = chart_.steps.empty() ? Place{} : chart_.steps.front().element->at;
    declare(ast::Section::Local, kRunning, make::type(at, Elementary::Bool));
  }

  // SFCReset of CODESYS: while it is true the chart starts again.
  void reset() {
    if (chart_.steps.empty() || !around_.declared(kReset)) {
      return;
    }
    const Place& begin = chart_.steps.front().element->at;
    ast::Body body;
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const Place& at = chart_.steps[i].element->at;
      body.push_back(make::assign(active(chart_, i, at), make::truth(at, chart_.steps[i].initial)));
    }
    body.push_back(make::assign(make::name(begin, kRunning), make::truth(begin, false)));
    add(make::when(make::name(begin, kReset), std::move(body)));
  }

  static std::string fired(std::size_t i) { return fmt::format("_f{}", i); }

  void evaluate() {
    std::vector<std::vector<std::size_t>> leaving(chart_.steps.size());  // transitions so far, by step
    for (std::size_t i = 0; i < chart_.transitions.size(); ++i) {
      const Transition& transition = chart_.transitions[i];
      const Place& at = transition.element->at;
      std::vector<ast::Expression> ready{make::name(at, kRunning)};
      for (const std::size_t step : transition.from) {
        ready.push_back(active(chart_, step, at));
      }
      std::set<std::size_t> others;
      for (const std::size_t step : transition.from) {
        others.insert(leaving[step].begin(), leaving[step].end());
      }
      for (const std::size_t other : others) {
        ready.push_back(make::negation(make::name(at, fired(other))));
      }
      for (const std::size_t step : transition.from) {
        leaving[step].push_back(i);
      }
      ast::Expression value = condition(transition, i);
      declare(ast::Section::Temp, fired(i), make::type(at, Elementary::Bool));
      ast::Expression fires = make::both(make::all_of(std::move(ready)), std::move(value));
      fires.guards = true;
      add(make::assign(make::name(at, fired(i)), std::move(fires)));
    }
  }

  ast::Expression condition(const Transition& transition, std::size_t number) {
    const network::Element& element = *transition.element;
    if (element.condition && !element.condition->connections.empty()) {
      return around_.drawn_condition(element);
    }
    network::Body* body = element.inlined.get();
    if (body == nullptr && !element.text.empty()) {
      body = around_.transition(element.text);
      if (body == nullptr) {
        return make::name(element.at, element.text);  // a variable
      }
    }
    if (body == nullptr || body->language == network::Body::Language::None) {
      diagnostics_.error(element.at, "this transition has no condition; write one, TRUE for always");
      return make::truth(element.at, false);
    }
    Lowered code = around_.condition_code(*body, element.text, fmt::format("f{}_", number));
    std::move(code.variables.begin(), code.variables.end(), std::back_inserter(code_.variables));
    std::move(code.body.begin(), code.body.end(), std::back_inserter(code_.body));
    return code.value ? std::move(*code.value) : make::truth(element.at, false);
  }

  // First clears all steps before the transitions, then activates all steps after them: a step that is both stays
  // active.
  void clear() {
    for (const bool activate : {false, true}) {
      for (std::size_t i = 0; i < chart_.transitions.size(); ++i) {
        const Transition& transition = chart_.transitions[i];
        const Place& at = transition.element->at;
        ast::Body body;
        for (const std::size_t step : activate ? transition.to : transition.from) {
          body.push_back(make::assign(active(chart_, step, at), make::truth(at, activate)));
        }
        add(make::when(make::name(at, fired(i)), std::move(body)));
      }
    }
  }

  // Measures the time for which a step is active; it is kept when the step is left. Transitions see the current time;
  // after them it is measured again, so that it begins with the step.
  void measure() {
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const Place& at = chart_.steps[i].element->at;
      std::vector<ast::Argument> arguments;
      arguments.push_back(make::argument("IN", active(chart_, i, at)));
      arguments.push_back(make::argument("PT", forever(at)));
      add(make::call_statement(make::call(at, make::name(at, step_timer(i)), std::move(arguments))));
      ast::Body body;
      body.push_back(make::assign(make::member(at, chart_.steps[i].name, "T"), make::member(at, step_timer(i), "ET")));
      add(make::when(active(chart_, i, at), std::move(body)));
    }
  }

  void finish_scan() {
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const Place& at = chart_.steps[i].element->at;
      add(make::assign(make::name(at, step_before(i)), active(chart_, i, at)));
    }
    if (!chart_.steps.empty()) {
      const Place& at = chart_.steps.front().element->at;
      add(make::assign(make::name(at, kRunning), make::truth(at, true)));
    }
  }

  static std::string step_timer(std::size_t i) { return fmt::format("_st{}", i); }
  static ast::Expression forever(const Place& at) {
    constexpr std::int64_t kYearNs = 31'536'000'000'000'000;
    ast::Expression literal;
    literal.at = at;
    literal.value = 100 * kYearNs;
    literal.value_type = Elementary::Time;
    return literal;
  }

  static constexpr const char* kRunning = "_running";
  static constexpr const char* kReset = "SFCReset";

  const Chart& chart_;
  const ChartSurroundings& around_;
  Diagnostics& diagnostics_;
  Lowered code_;
};

}  // namespace

ast::TypeDeclaration step_type() {
  ast::TypeDeclaration declared;
  declared.name = kStepType;
  declared.type.kind = ast::TypeSpec::Kind::Struct;
  declared.type.fields.push_back(make::variable(ast::Section::Local, "X", make::type({}, Elementary::Bool)));
  declared.type.fields.push_back(make::variable(ast::Section::Local, "T", make::type({}, Elementary::Time)));
  return declared;
}

bool has_chart(const network::PouCode& code) {
  using Language = network::Body::Language;
  return code.body.language == Language::Sfc ||
         std::any_of(code.actions.begin(), code.actions.end(),
                     [](const network::NamedBody& one) { return one.body.language == Language::Sfc; });
}

Lowered lower_chart(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics) {
  return ChartLowering(chart, around, diagnostics).run();
}

}  // namespace indurop::plc::lower
