// SPDX-License-Identifier: Apache-2.0
// indurop recipe: sets of parameters, saved, compared, and loaded in one tick.
#include <fmt/format.h>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "store/operate/audit.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/recipes/recipe_values.h"
#include "tools/client/text/units.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {
namespace {

struct RecipeOptions {
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

int save(Context& context, const vars::Store& store, const RecipeOptions& options) {
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
  operate::AuditEntry entry;
  entry.who = base::user_name();
  entry.from = "here";
  entry.board = context.node;
  entry.action = "load recipe";
  entry.what = recipe.name;
  const auto loaded = load_values(context.node, store, recipe, who_orders(context));
  entry.wall_ns = rt::wall_ns();
  entry.outcome = loaded ? "done" : "nothing was changed";
  if (const std::string problem = operate::append_audit(operate::usual_audit_file(), entry); !problem.empty()) {
    context.out.note(fmt::format("{} cannot be written: {}", operate::usual_audit_file().string(), problem));
  }
  if (!loaded) {
    return report(context, loaded.error());
  }
  context.out.note(*loaded ? fmt::format("loaded {} values in tick {}", recipe.values.size(), **loaded)
                           : fmt::format("{} values wait for the node's next start", recipe.values.size()));
  return kOk;
}

int remove(Context& context, const Recipe& recipe) {
  const auto removed = remove_recipe(context.node, recipe.name);
  if (!removed) {
    context.out.error(removed.error().text);
  }
  return removed ? kOk : kFailed;
}

// Opens the values of the node for a command.
template <class Act>
int with_store(Context& context, vars::Mode mode, Act act) {
  auto store = open_store(context, mode);
  if (!store) {
    return report(context.out, store.error());
  }
  context.node = context.values->title();
  return act(*store);
}

// Reads the named recipe, too.
template <class Act>
int with_recipe(Context& context, vars::Mode mode, const std::string& name, Act act) {
  return with_store(context, mode, [&](vars::Store& store) {
    const auto recipe = read_recipe(context.node, name);
    if (!recipe) {
      context.out.error(recipe.error().text);
      return int{kFailed};
    }
    return int{act(store, *recipe)};
  });
}

Action declare_recipe(base::Options& app, Context& context) {
  auto options = std::make_shared<RecipeOptions>();
  auto chosen = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help, const Action& act) -> base::Options& {
    return app.command(name, help, [chosen, act] { *chosen = act; });
  };
  const auto named = [&](const char* name, const char* help, const Action& act) -> base::Options& {
    base::Options& made = verb(name, help, act);
    made.add("recipe", "NAME", options->name, "The recipe").required();
    return made;
  };
  verb("list", "Show the recipes of a node", [](Context& c) {
    return with_store(c, vars::Mode::ReadOnly, [&](vars::Store& /*store*/) { return show_list(c); });
  });
  base::Options& saving = named("save", "Save values of the node", [options](Context& c) {
    return with_store(c, vars::Mode::ReadOnly, [&](vars::Store& store) { return save(c, store, *options); });
  });
  saving.add("names", "VAR", options->names, "Variables, parts or globs (default: all parameters)")
      .completes(base::Completion::Variable);
  saving.add("--comment", "TEXT", options->comment, "Description of the recipe");
  named("diff", "Show the values that differ from a recipe", [options](Context& c) {
    return with_recipe(c, vars::Mode::ReadOnly, options->name,
                       [&](vars::Store& store, const Recipe& recipe) { return diff(c, store, recipe); });
  });
  named("load", "Set all values of a recipe in one tick", [options](Context& c) {
    return with_recipe(c, vars::Mode::ReadWrite, options->name,
                       [&](vars::Store& store, const Recipe& recipe) { return load(c, store, recipe); });
  });
  named("remove", "Delete a recipe", [options](Context& c) {
    return with_recipe(c, vars::Mode::ReadOnly, options->name,
                       [&](vars::Store& /*store*/, const Recipe& recipe) { return remove(c, recipe); });
  });
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kRecipeVerb{
    "recipe", "Variables", "Save and compare sets of parameters, and load them in one tick",
    "A recipe is a file of values in the state folder of the node. Parameters are variables that are declared\n"
    "with a value. Before loading, all values are checked and all errors are reported at once. All values then\n"
    "change between two ticks, so that no module sees a mixture of old and new; at most 512 values of 32 KiB in\n"
    "total.\n"
    "Examples:\n"
    "  indurop recipe save bottles 'press::*' --comment '0.5 l, glass'\n"
    "  indurop recipe diff bottles\n"
    "  indurop recipe load bottles\n"
    "  indurop recipe list -o json\n",
    &declare_recipe};

}  // namespace indurop::tools
