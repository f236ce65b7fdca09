// SPDX-License-Identifier: Apache-2.0
// indurop recipe: sets of parameters, saved, compared, and loaded in one tick.
#include <fmt/format.h>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/audit.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/recipes/recipe_values.h"
#include "tools/client/text/units.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {
namespace {

struct Options {
  std::string action;
  std::string name;
  std::vector<std::string> names;
  std::string comment;
};

int show_list(Context& context) {
  Table table({{"RECIPE", "recipe"},
               {"VALUES", "values", Align::Right},
               {"SAVED", "saved_wall_ns"},
               {"WHO", "who"},
               {"COMMENT", "comment"}});
  for (const Recipe& one : list_recipes(context.node)) {
    table.add({Cell(one.name), Cell(fmt::format("{}", one.values.size()), JsonValue(one.values.size())),
               Cell(local_time(one.saved_ns), JsonValue(one.saved_ns), Style::None), Cell(printable(one.who)),
               Cell(printable(one.comment))});
  }
  if (table.empty() && context.format == Format::Table) {
    context.out.note("there are no recipes of this node");
  }
  print_table(context, table, {{"node", context.node}}, "recipes");
  return kOk;
}

int save(Context& context, const vars::Store& store, const Options& options) {
  Recipe recipe{options.name, options.comment, base::user_name(), rt::wall_ns(), {}};
  if (const auto taken = take_values(store, options.names, recipe); !taken) {
    for (const std::string& reason : taken.error()) {
      context.out.error(reason);
    }
    return kFailed;
  }
  if (const auto saved = write_recipe(context.node, recipe); !saved) {
    context.out.error(saved.error().text);
    return kFailed;
  }
  context.out.note(fmt::format("saved {} values as recipe {}", recipe.values.size(), recipe.name));
  return kOk;
}

int diff(Context& context, const vars::Store& store, const Recipe& recipe) {
  Table table({{"NAME", "name"}, {"RECIPE", "recipe", Align::Right}, {"NOW", "now", Align::Right}});
  for (const Difference& one : compare(store, recipe)) {
    if (!one.same) {
      const std::string now = one.now.is_null() ? "not there" : one.now.dump();
      table.add({Cell(one.name), Cell(one.recipe.dump(), one.recipe), Cell(now, one.now, Style::Warn)});
    }
  }
  if (table.empty() && context.format == Format::Table) {
    context.out.note(fmt::format("all values are as in recipe {}", recipe.name));
  }
  print_table(context, table, {{"node", context.node}, {"recipe", recipe.name}}, "differences");
  return kOk;
}

int load(Context& context, vars::Store& store, const Recipe& recipe) {
  AuditEntry entry;
  entry.who = base::user_name();
  entry.from = "here";
  entry.board = context.node;
  entry.action = "load recipe";
  entry.what = recipe.name;
  const auto loaded = load_values(context.node, store, recipe, who_orders(context));
  entry.wall_ns = rt::wall_ns();
  entry.outcome = loaded ? "done" : "nothing was changed";
  if (const std::string problem = append_audit(usual_audit_file(), entry); !problem.empty()) {
    context.out.note(fmt::format("{} cannot be written: {}", usual_audit_file().string(), problem));
  }
  if (!loaded) {
    return report(context, loaded.error());
  }
  context.out.note(*loaded ? fmt::format("loaded {} values in tick {}", recipe.values.size(), **loaded)
                           : fmt::format("{} values wait for the node's next start", recipe.values.size()));
  return kOk;
}

int with_recipe(Context& context, vars::Store& store, const Options& options) {
  const auto recipe = read_recipe(context.node, options.name);
  if (!recipe) {
    context.out.error(recipe.error().text);
    return kFailed;
  }
  if (options.action == "load") {
    return load(context, store, *recipe);
  }
  if (options.action == "diff") {
    return diff(context, store, *recipe);
  }
  const auto removed = remove_recipe(context.node, options.name);
  if (!removed) {
    context.out.error(removed.error().text);
  }
  return removed ? kOk : kFailed;
}

int recipe(Context& context, const Options& options) {
  const bool listing = options.action.empty() || options.action == "list";
  if (!listing && options.name.empty()) {
    context.out.error(fmt::format("name the recipe: indurop recipe {} NAME", options.action));
    return kUsage;
  }
  auto store = open_store(context, options.action == "load" ? vars::Mode::ReadWrite : vars::Mode::ReadOnly);
  if (!store) {
    return report(context.out, store.error());
  }
  context.node = context.values->title();
  if (listing) {
    return show_list(context);
  }
  return options.action == "save" ? save(context, *store, options) : with_recipe(context, *store, options);
}

Action declare(base::Options& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add("action", "ACTION", options->action, "list (usual), save, diff, load, remove")
      .choices({"list", "save", "diff", "load", "remove"});
  app.add("recipe", "NAME", options->name, "The recipe");
  app.add("names", "VAR", options->names, "save: variables, parts or globs (default: all parameters)")
      .completes(base::Completion::Variable);
  app.add("--comment", "TEXT", options->comment, "save: what it is for");
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return recipe(c, *options); };
}

}  // namespace

const Verb kRecipeVerb{
    "recipe", "Variables", "Save sets of parameters, compare them, load them in one tick",
    "A recipe is a file of values in the state folder of the node. Parameters are variables that are declared with a\n"
    "value. Loading checks all values before the first is written, says everything that is wrong, and changes all of\n"
    "them between two ticks, so that no module sees some old and some new; at most 512 values of 32 KiB together.\n"
    "Examples:\n"
    "  indurop recipe save bottles 'press::*' --comment '0.5 l, glass'\n"
    "  indurop recipe diff bottles\n"
    "  indurop recipe load bottles\n"
    "  indurop recipe list -o json\n",
    &declare};

}  // namespace indurop::tools
