// SPDX-License-Identifier: Apache-2.0
// indurop explain: why a module was late, a value is old or a board is gone, in plain words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "history/explain/facts_json.h"
#include "history/explain/questions.h"
#include "store/vars/nodes.h"
#include "tools/cli/explain/gather.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/text/suggest.h"

namespace indurop::tools {
namespace {

using explain::Answer;
using explain::Facts;

struct ExplainOptions {
  std::string what;
  std::uint64_t tick = explain::kNone;
  std::vector<std::string> files;
};

struct ExplainAsked {
  std::string question;
  Answer answer;
};

// Returns the variables that may be meant.
std::vector<std::string> variables_meant(const std::vector<Facts>& plant, const std::string& what) {
  std::vector<std::string> names;
  for (const Facts& facts : plant) {
    for (const explain::VariableFact& variable : facts.variables) {
      if (std::find(names.begin(), names.end(), variable.name) == names.end()) {
        names.push_back(variable.name);
      }
    }
  }
  return variables_named(what, names);
}

bool knows(const Facts& facts, const std::string& what) {
  return facts.find_module(what) != nullptr || !variables_meant({facts}, what).empty() || facts.board == what ||
         std::any_of(facts.boards.begin(), facts.boards.end(),
                     [&](const explain::BoardFact& board) { return board.name == what; });
}

// Returns the node that is asked: a chosen one; else the usual one, if it runs and knows the subject; else the only one
// that knows it, of those that run, and of those that ended if none runs.
Result<ChosenRun, Failure> whom(const Context& context, const std::string& what) {
  auto usual = open_run(context.node);
  if (!context.node.empty() || !vars::node_of_environment().empty()) {
    return usual;
  }
  const std::vector<std::string> all = vars::list_nodes();
  const bool any_runs = !vars::running_nodes().empty();
  std::vector<std::string> knowing;
  for (const std::string& node : all) {
    auto run = RunView::open(node);
    if (run && run->node_alive() == any_runs && knows(facts_here({node, std::move(run).value()}, ""), what)) {
      knowing.push_back(node);
    }
  }
  if (knowing.empty() ||
      (any_runs && usual && std::find(knowing.begin(), knowing.end(), usual->node) != knowing.end())) {
    return usual;
  }
  return knowing.size() == 1 ? open_run(knowing.front())
                             : Failure{kUsage, fmt::format("several nodes know '{}'; say which with --node: {}", what,
                                                           fmt::join(knowing, ", "))};
}

Result<std::vector<Facts>, Failure> gather_facts(const Context& context, const ExplainOptions& options,
                                                 const std::string& variable) {
  std::vector<Facts> plant;
  for (const std::string& file : options.files) {
    auto facts = facts_recorded(file, variable);
    if (!facts) {
      return Failure{kFailed, facts.error().text};
    }
    for (Facts& one : *facts) {
      const auto same = [&one](const Facts& other) { return other.board == one.board && other.node == one.node; };
      if (std::any_of(plant.begin(), plant.end(), same)) {
        return Failure{kUsage, two_recordings(one.board.empty() ? one.node : one.board, file)};
      }
      plant.push_back(std::move(one));
    }
  }
  if (plant.empty()) {
    const auto chosen = whom(context, options.what);
    if (!chosen) {
      return chosen.error();
    }
    plant.push_back(facts_here(*chosen, variable));
  }
  return plant;
}

// Describes the end of a node that does not run any more, if it is known.
std::string how_it_ended(const Facts& facts) {
  if (facts.alive || facts.closed) {
    return {};
  }
  return facts.stop_reason.empty()
             ? "; there the data ends without a reason: the node or its recorder was killed or lost its power"
             : "; then the node ended: " + facts.stop_reason;
}

std::vector<ExplainAsked> ask_module(const Facts& facts, const ExplainOptions& options) {
  std::uint64_t tick = options.tick;
  if (tick == explain::kNone) {
    tick = explain::last_trouble(facts, options.what);
  }
  if (tick == explain::kNone && facts.runs.empty()) {
    return {{fmt::format("{}: was it late?", options.what), explain::not_known("no run of the node is known")}};
  }
  if (tick == explain::kNone) {
    return {{fmt::format("{}: was it late?", options.what),
             {explain::Cause::AllIsWell,
              {},
              fmt::format("from tick {} to {}, {} ran whenever it was due and was not late{}", facts.first_tick,
                          facts.tick > 0 ? facts.tick - 1 : 0, options.what, how_it_ended(facts)),
              {}}}};
  }
  return {{fmt::format("why did {} not run, or end late, in tick {}?", options.what, tick),
           explain::why_late(facts, options.what, tick)}};
}

std::vector<ExplainAsked> ask_variable(const std::vector<Facts>& plant, std::size_t asked, const std::string& name,
                                       const ExplainOptions& options) {
  const Facts& facts = plant[asked];
  const explain::VariableFact& variable = *facts.find_variable(name);
  const auto owner =
      std::find_if(plant.begin(), plant.end(), [&](const Facts& one) { return one.board == variable.owner; });
  const Facts& its = variable.owner.empty() || owner == plant.end() ? facts : *owner;
  // For a node that has ended: at that time.
  const std::int64_t latest = facts.alive ? facts.now_ns : std::min(facts.now_ns, facts.release_of(facts.tick));
  const std::int64_t at = options.tick == explain::kNone ? latest : facts.release_of(options.tick);
  return {{fmt::format("why is {} as old as it is?", name), explain::why_old(plant, asked, name, at)},
          {fmt::format("who changed {} last?", name),
           explain::who_changed(its, name, at + facts.wall_minus_node_ns - its.wall_minus_node_ns)}};
}

// Returns the last time for which data of a node is available, on the common clock.
std::int64_t end_of(const Facts& facts) {
  const std::int64_t end = facts.alive ? facts.now_ns : std::min(facts.now_ns, facts.release_of(facts.tick));
  return end + facts.wall_minus_node_ns;
}

// Returns the node that receives the variable from another board and ran longest; if it ended before the writer, it
// cannot tell about the end of the writer, which is returned instead. Else returns the first node that knows the
// variable.
std::optional<std::size_t> where_it_is_old(const std::vector<Facts>& plant, const std::string& name) {
  constexpr std::int64_t kAlike = 1'000'000'000;  // difference between the ends of recordings that were stopped
                                                  // together
  std::optional<std::size_t> reader;
  std::optional<std::size_t> writer;
  std::optional<std::size_t> known;
  for (std::size_t i = 0; i < plant.size(); ++i) {
    const explain::VariableFact* const variable = plant[i].find_variable(name);
    if (variable == nullptr) {
      continue;
    }
    known = known.value_or(i);
    if (variable->owner.empty()) {
      continue;
    }
    std::optional<std::size_t>& better = variable->owner == plant[i].board ? writer : reader;
    better = !better || end_of(plant[i]) > end_of(plant[*better]) ? i : better;
  }
  if (reader && (!writer || end_of(plant[*reader]) + kAlike >= end_of(plant[*writer]))) {
    return reader;
  }
  return writer ? writer : known;
}

// Asks the first of the nodes that knows the subject; for a board another node is asked.
Result<std::vector<ExplainAsked>, Failure> ask(const std::vector<Facts>& plant, const ExplainOptions& options,
                                               const std::string& variable) {
  std::vector<std::string> names;
  for (const Facts& facts : plant) {
    if (facts.find_module(options.what) != nullptr) {
      return ask_module(facts, options);
    }
    for (const explain::ModuleFact& module : facts.modules) {
      names.push_back(module.name);
    }
  }
  if (const auto asked = where_it_is_old(plant, variable)) {
    return ask_variable(plant, *asked, variable, options);
  }
  for (const Facts& facts : plant) {
    for (const explain::VariableFact& one : facts.variables) {
      names.push_back(one.name);
    }
  }
  for (std::size_t i = 0; i < plant.size(); ++i) {
    for (const explain::BoardFact& board : plant[i].boards) {
      if (board.name == options.what) {
        return std::vector<ExplainAsked>{
            {fmt::format("why is board {} silent?", options.what), explain::why_gone(plant, i, options.what)}};
      }
      names.push_back(board.name);
    }
  }
  for (const Facts& facts : plant) {
    if (!facts.board.empty() && facts.board == options.what) {
      return std::vector<ExplainAsked>{{fmt::format("why did board {} end?", options.what), explain::why_ended(facts)}};
    }
  }
  return Failure{kFailed, fmt::format("there is no module, variable or board '{}'.{}", options.what,
                                      did_you_mean(options.what, names))};
}

// `node`: which one was asked; empty: recordings.
void print(Context& context, const std::vector<ExplainAsked>& all, const std::string& node) {
  if (context.format == Format::Json) {
    JsonValue list = JsonValue::array();
    for (const ExplainAsked& one : all) {
      JsonValue json{{"question", one.question}};
      json.update(explain::json_of(one.answer));
      list.push_back(std::move(json));
    }
    JsonValue whole = document();
    whole["node"] = node.empty() ? JsonValue() : JsonValue(node);
    whole["answers"] = std::move(list);
    context.out.line(whole.dump(2));
    return;
  }
  for (const ExplainAsked& one : all) {
    context.out.line(context.out.paint(Style::Bold, one.question));
    context.out.line("  " + one.answer.text);
    for (const std::string& line : one.answer.evidence) {
      context.out.line("    " + line);
    }
  }
}

int explain_it(Context& context, const ExplainOptions& options) {
  // The full name of the variable is known only after the configuration was read.
  auto plant = gather_facts(context, options, options.what);
  if (!plant) {
    return report(context.out, plant.error());
  }
  const auto meant = variables_meant(*plant, options.what);
  const bool module = std::any_of(plant->begin(), plant->end(),
                                  [&](const Facts& one) { return one.find_module(options.what) != nullptr; });
  if (meant.size() > 1 && !module) {
    return report(context.out, Failure{kFailed, which_variable(options.what, meant)});
  }
  const std::string variable = meant.size() == 1 ? meant.front() : options.what;
  if (variable != options.what) {
    plant = gather_facts(context, options, variable);
    if (!plant) {
      return report(context.out, plant.error());
    }
  }
  const auto answers = ask(*plant, options, variable);
  if (!answers) {
    return report(context.out, answers.error());
  }
  if (options.files.empty() && context.format == Format::Table) {
    const Facts& facts = plant->front();
    context.out.note(fmt::format("of node '{}'{}", facts.node, facts.alive ? "" : ", which does not run any more"));
  }
  print(context, *answers, options.files.empty() ? plant->front().node : "");
  return kOk;
}

Action declare_explain(base::Options& app, Context& context) {
  auto options = std::make_shared<ExplainOptions>();
  app.add("what", "NAME", options->what, "A module, a variable or a board").required();
  app.add("--tick", "N", options->tick, "Explain this tick (default: the last one in which something was wrong)");
  app.add("--from", "FILE.mcap", options->files,
          "Use a recording or a black box instead of a node; for a plant, one file of each board, or one of all boards")
      .completes(base::Completion::File);
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json});
  return [options](Context& c) { return explain_it(c, *options); };
}

}  // namespace

const Verb kExplainVerb{
    "explain", "Timing", "Explain why a module was late, a value is old or a board is lost",
    "For a module it explains why it did not run in a tick, or ended late; for a variable, why its value is old,\n"
    "and who wrote, set or forced it last; for a board, why it is silent. The answer names a cause only if there\n"
    "is evidence for it, and shows that evidence; otherwise it explains why the cause is not known.\n"
    "Examples:\n"
    "  indurop explain control\n"
    "  indurop explain control --tick 48213\n"
    "  indurop explain cell::encoder --from run.control.mcap --from run.sensor.mcap\n",
    &declare_explain};

}  // namespace indurop::tools
