// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/pou.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_set>

#include "control/plc/library/standard.h"
#include "control/plc/lower/chart.h"
#include "control/plc/lower/flow.h"
#include "control/plc/lower/foreign_action.h"
#include "control/plc/lower/inner_charts.h"
#include "control/plc/lower/list.h"
#include "control/plc/lower/networks.h"
#include "control/plc/model/make.h"
#include "control/plc/st/parser.h"
#include "core/base/text.h"

namespace indurop::plc::lower {
namespace {

using base::trimmed;
using network::Body;
using network::NamedBody;
using network::PouCode;
using Language = Body::Language;

// Returns x AND y for ":= x AND y;", as editors write conditions.
std::string_view condition_text(std::string_view text) {
  text = trimmed(text);
  if (text.ends_with(';')) {
    text = trimmed(text.substr(0, text.size() - 1));
  }
  if (text.starts_with(":=")) {
    text = trimmed(text.substr(2));
  }
  return text;
}

// Returns a statement that leaves the body.
const ast::Statement* leaving(const ast::Body& body) {
  for (const ast::Statement& statement : body) {
    if (statement.kind == ast::Statement::Kind::Label || statement.kind == ast::Statement::Kind::Jump ||
        statement.kind == ast::Statement::Kind::Return) {
      return &statement;
    }
    for (const ast::Branch& branch : statement.branches) {
      if (const ast::Statement* found = leaving(branch.body)) {
        return found;
      }
    }
    if (const ast::Statement* found = leaving(statement.body)) {
      return found;
    }
  }
  return nullptr;
}

class PouLowering {
 public:
  PouLowering(PouCode& pou_code, const ReadOptions& read_options, Project& project, ast::Pou& pou,
              Diagnostics& diagnostics)
      : pou_code_(pou_code),
        read_options_(read_options),
        project_(project),
        pou_(pou),
        diagnostics_(diagnostics),
        what_("POU " + pou.name),
        charts_(pou_code, pou) {}

  void run() {
    once(pou_code_.actions);
    once(pou_code_.transitions);
    Lowered code =
        pou_code_.body.language == Language::Sfc ? chart(pou_code_.body, what_) : lower(pou_code_.body, what_, "");
    keep(code);
    pou_.body = std::move(code.body);
    const bool callable = pou_.kind == ast::Pou::Kind::Program || pou_.kind == ast::Pou::Kind::FunctionBlock;
    for (std::size_t i = 0; callable && i < pou_code_.actions.size(); ++i) {
      outer_action(pou_code_.actions[i], fmt::format("a{}_", i));
    }
  }

 private:
  // Reports duplicates: a name must refer to one of them.
  void once(std::vector<NamedBody>& bodies) {
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const auto known = std::find_if(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(i),
                                      [&](const NamedBody& one) { return same_name(one.name, bodies[i].name); });
      if (known != bodies.begin() + static_cast<std::ptrdiff_t>(i)) {
        diagnostics_.error(bodies[i].at, fmt::format("'{}' is already declared at {}, rename one of them",
                                                     bodies[i].name, to_string(known->at)));
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i--));
      }
    }
  }

  // Adds variables of the translation to those of the POU.
  void keep(Lowered& code) {
    for (ast::Variable& one : code.variables) {
      one.of_instance = pou_.kind == ast::Pou::Kind::Method && one.section == ast::Section::Local;
      pou_.variables.push_back(std::move(one));
    }
  }

  // Translates an action for other POUs to call. Its errors were reported already if the POU itself calls it.
  void outer_action(NamedBody& named, const std::string& prefix) {
    const bool known = lowered_actions_.contains(&named.body);
    Diagnostics again;
    Lowered code;
    {
      Diagnostics& said = known ? again : diagnostics_;
      PouLowering inner(pou_code_, read_options_, project_, pou_, said);
      inner.shown_ = shown_;
      std::swap(inner.charts_, charts_);
      code = inner.action(named.body, prefix);
      std::swap(inner.charts_, charts_);
      shown_ = std::move(inner.shown_);
    }
    ast::Pou made;
    made.kind = ast::Pou::Kind::Method;
    made.at = named.at;
    made.name = named.name;
    made.body = std::move(code.body);
    for (ast::Variable& one : code.variables) {
      if (is_flow(one.name)) {  // shared by all its callers
        pou_.variables.push_back(std::move(one));
        continue;
      }
      one.of_instance = one.section == ast::Section::Local;  // kept between calls
      made.variables.push_back(std::move(one));
    }
    pou_.actions.push_back(std::move(made));
  }

  Lowered lower(Body& body, const std::string& what, const std::string& prefix, ListUse use = ListUse::Statements) {
    Lowered code;
    switch (body.language) {
      case Language::None:
        break;
      case Language::St:
        code.body = st::parse_body({body.text, body.text_at}, pou_.c_code, diagnostics_);
        call_actions(code.body, code.variables);
        break;
      case Language::Il:
        code = lower_list(
            {body.text, body.text_at}, prefix,
            [this](std::string_view instance, std::string_view input) { return has_input(instance, input); }, use,
            diagnostics_);
        break;
      case Language::Ld:
      case Language::Fbd: {
        const Sheet sheet = network::make_sheet(body, what, diagnostics_);
        NetworkOptions options;
        options.prefix = prefix;
        options.project = &project_;
        const std::optional<std::string> shown = watched_as(body);
        options.flow = shown.has_value();
        LoweredNetworks lowered = lower_networks(sheet, options, diagnostics_);
        if (shown) {
          add_flow(lowered, *shown, pou_.at, shown_.insert(&body).second);
        }
        code = {std::move(lowered.body), std::move(lowered.variables), std::nullopt};
        break;
      }
      case Language::Sfc:
        code = inner_chart(body);
        break;
    }
    return code;
  }

  // Returns the variable with the power in its networks, for bodies that have a name and keep their variables.
  [[nodiscard]] std::optional<std::string> watched_as(const Body& body) const {
    if (!read_options_.watch || pou_.kind == ast::Pou::Kind::Function) {
      return std::nullopt;
    }
    if (&body == &pou_code_.body) {
      return flow_variable("");
    }
    for (const NamedBody& one : pou_code_.actions) {
      if (&one.body == &body) {
        return flow_variable(one.name);
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has_input(std::string_view instance, std::string_view input) const {
    const auto variable = std::find_if(pou_.variables.begin(), pou_.variables.end(),
                                       [&](const ast::Variable& one) { return same_name(one.name, instance); });
    if (variable == pou_.variables.end() || variable->type.kind != ast::TypeSpec::Kind::Named) {
      return false;
    }
    const std::string& type = variable->type.name;
    for (const ast::Pou& other : project_.pous) {
      if (same_name(other.name, type)) {
        return std::any_of(other.variables.begin(), other.variables.end(), [&](const ast::Variable& one) {
          return one.section == ast::Section::Input && same_name(one.name, input);
        });
      }
    }
    const LibraryBlock* block = find_block(type);
    return block != nullptr && block->input(input) != nullptr;
  }

  // Replaces "Open();" of an action of this POU by its code.
  void call_actions(ast::Body& body, std::vector<ast::Variable>& variables) {
    for (ast::Statement& statement : body) {
      call_actions(statement.body, variables);
      for (ast::Branch& branch : statement.branches) {
        call_actions(branch.body, variables);
      }
      if (statement.kind != ast::Statement::Kind::Call || !statement.value->arguments.empty() ||
          statement.value->operands[0].kind != ast::Expression::Kind::Name) {
        continue;
      }
      const std::string& name = statement.value->operands[0].name;
      Body* called = find(pou_code_.actions, name);
      if (called == nullptr) {
        continue;
      }
      if (!open_actions_.insert(called).second) {
        diagnostics_.error(statement.at, fmt::format("recursion is not possible: action {} calls itself", name));
        continue;
      }
      Lowered code = action(*called, fmt::format("c{}_", ++calls_));
      open_actions_.erase(called);
      std::move(code.variables.begin(), code.variables.end(), std::back_inserter(variables));
      statement = make::when(make::truth(statement.at, true), std::move(code.body));
    }
  }

  Lowered inner_chart(Body& body) {
    if (!open_charts_.insert(&body).second) {
      diagnostics_.error(body.at, "recursion is not possible: this chart is an action of itself");
      return {};
    }
    Lowered code = charts_.use(body, [this, &body] { return chart(body, what_of(body)); });
    open_charts_.erase(&body);
    return code;
  }

  // Translates a chart; its contacts and boxes are conditions of transitions.
  Lowered chart(Body& body, const std::string& what) {
    const Sheet sheet = network::make_sheet(body, what, diagnostics_);
    const network::Chart read = network::read_chart(body.diagram, diagnostics_);
    NetworkOptions options;
    options.project = &project_;
    for (const Element& element : body.diagram.elements) {
      if (element.condition) {
        options.wanted.push_back({&element, &*element.condition});
      }
    }
    LoweredNetworks drawn = lower_networks(sheet, options, diagnostics_);
    ChartSurroundings around;
    around.action = [this](const std::string& name) { return find(pou_code_.actions, name); };
    around.transition = [this](const std::string& name) { return find(pou_code_.transitions, name); };
    around.foreign_action = [this](const std::string& name) { return names_foreign_action(project_, pou_, name); };
    around.declared = [this](const std::string& name) { return declares(name); };
    for (const char* ignored : {"SFCInit", "SFCPause", "SFCTip", "SFCTipMode", "SFCEnableLimit"}) {
      if (declares(ignored)) {
        diagnostics_.warning(pou_.at,
                             fmt::format("{} is an ordinary variable here; charts obey SFCReset only", ignored));
      }
    }
    around.action_code = [this](Body& code, const std::string& prefix) { return action(code, prefix); };
    around.condition_code = [this](Body& code, const std::string& name, const std::string& prefix) {
      return condition(code, name, prefix);
    };
    around.drawn_condition = [&](const Element& element) {
      const auto wanted = std::find_if(options.wanted.begin(), options.wanted.end(),
                                       [&](const auto& each) { return each.element == &element; });
      return drawn.wanted[static_cast<std::size_t>(wanted - options.wanted.begin())];
    };
    Lowered code = lower_chart(read, around, diagnostics_);
    std::move(drawn.variables.begin(), drawn.variables.end(), std::back_inserter(code.variables));
    code.body.insert(code.body.begin(), std::make_move_iterator(drawn.body.begin()),
                     std::make_move_iterator(drawn.body.end()));
    return code;
  }

  static Body* find(std::vector<NamedBody>& bodies, const std::string& name) {
    const auto found =
        std::find_if(bodies.begin(), bodies.end(), [&](const NamedBody& each) { return same_name(each.name, name); });
    return found == bodies.end() ? nullptr : &found->body;
  }

  [[nodiscard]] bool declares(const std::string& name) const {
    return std::any_of(pou_.variables.begin(), pou_.variables.end(),
                       [&](const ast::Variable& variable) { return same_name(variable.name, name); });
  }

  [[nodiscard]] std::string what_of(const Body& body) const {
    return body.at.within == nullptr ? what_ : *body.at.within;
  }

  Lowered action(Body& body, const std::string& prefix) {
    lowered_actions_.insert(&body);
    if (!may_copy(body)) {
      return {};
    }
    ++depth_;
    Lowered code = lower(body, what_of(body), prefix);
    --depth_;
    stays_inside(code);
    return code;
  }

  // An action is copied to each of its calls.
  bool may_copy(const Body& body) {
    constexpr std::size_t kMostInside = 32;
    constexpr std::size_t kMaxCopiedBytes = std::size_t{16} << 20U;
    constexpr std::size_t kElement = 100;  // size of an element, in bytes
    if (depth_ >= kMostInside) {
      diagnostics_.error(
          body.at, fmt::format("more than {} actions call each other, make function blocks of some", kMostInside));
      return false;
    }
    const bool before = project_.copied_actions <= kMaxCopiedBytes;
    project_.copied_actions += before ? kElement + body.text.size() + kElement * body.diagram.elements.size() : 0;
    if (before && project_.copied_actions > kMaxCopiedBytes) {
      diagnostics_.error(body.at,
                         "actions are copied to where they are called, and these copies become more than 16 MiB; "
                         "make function blocks of some");
    }
    return project_.copied_actions <= kMaxCopiedBytes;
  }

  void stays_inside(const Lowered& code) {
    if (const ast::Statement* found = leaving(code.body)) {
      diagnostics_.error(found->at, "labels, jumps and RETURN are not possible in actions and transitions; use IF");
    }
  }

  // `name`: of the transition; its networks write this variable.
  Lowered condition(Body& body, const std::string& name, const std::string& prefix) {
    if (body.language == Language::St) {
      Lowered code;
      code.value = st::parse_expression({condition_text(body.text), body.text_at}, diagnostics_);
      return code;
    }
    Lowered code = lower(body, what_of(body), prefix, ListUse::Condition);
    stays_inside(code);
    if (code.value) {
      return code;
    }
    if (name.empty()) {
      diagnostics_.error(body.at, "a drawn condition has a name, which its coil or output writes; give it one");
      return code;
    }
    if (!declares(name) && conditions_.insert(upper(name)).second) {
      code.variables.push_back(make::variable(ast::Section::Temp, name, make::type(body.at, Elementary::Bool)));
    }
    code.value = make::name(body.at, name);
    return code;
  }

  PouCode& pou_code_;
  const ReadOptions& read_options_;
  Project& project_;
  ast::Pou& pou_;
  std::size_t depth_ = 0;  // nesting of actions
  Diagnostics& diagnostics_;
  std::string what_;
  InnerCharts charts_;
  std::unordered_set<std::string> conditions_;
  std::unordered_set<const Body*> open_actions_;
  std::unordered_set<const Body*> open_charts_;
  std::unordered_set<const Body*> lowered_actions_;
  std::unordered_set<const Body*> shown_;
  int calls_ = 0;
};

}  // namespace

void lower_pou(PouCode& pou_code, const ReadOptions& options, Project& project, ast::Pou& pou,
               Diagnostics& diagnostics) {
  PouLowering(pou_code, options, project, pou, diagnostics).run();
}

}  // namespace indurop::plc::lower
