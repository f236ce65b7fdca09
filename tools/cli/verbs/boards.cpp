// SPDX-License-Identifier: Apache-2.0
// indurop boards: all boards of the network that have an agent, and what they run.
#include <fmt/format.h>

#include "core/rt/clock.h"
#include "tools/cli/command/repeat.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/board/board_table.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct BoardsOptions {
  deploy::LinkSettings link;
  std::int64_t wait_ns = 1'000'000'000;
  Repeat repeat;
  std::unique_ptr<deploy::DeployLink> open;
  BoardRoster roster;
};

int show(Context& context, BoardsOptions& options) {
  if (options.open == nullptr) {
    options.open = open_link(context.out, options.link);
    if (options.open == nullptr) {
      return kUnreachable;
    }
    options.roster.gather(*options.open, options.wait_ns, [&] { return options.roster.complete(); });
  }
  const std::int64_t now = rt::now_ns();
  options.roster.listen(*options.open, now);
  const Table table = board_table(options.roster, now);
  if (table.empty()) {
    context.out.note(
        fmt::format("no board was heard on domain {} within {}; agents are started with indurop-agent "
                    "--board NAME{}",
                    options.link.network.domain, human_age(options.wait_ns), keys_hint(options.link)));
  }
  note_others(context.out, options.roster);
  print_table(context, table,
              {{"domain", options.link.network.domain},
               {"other_releases", json_of_others(options.roster)},
               {"impostors", json_of_impostors(options.roster)}},
              "boards");
  return table.empty() ? kUnreachable : kOk;
}

Action declare_boards(base::Options& app, Context& context) {
  auto options = std::make_shared<BoardsOptions>();
  deploy::add_link_options(app, options->link);
  add_time_option(app, "--wait", options->wait_ns,
                  "Maximum time to wait for boards before the first table (default: 1s)");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  add_repeat_options(app, options->repeat);
  return [options](Context& c) { return repeat_rounds(c, options->repeat, [&] { return show(c, *options); }); };
}

}  // namespace

const Verb kBoardsVerb{
    "boards", "Plants", "Show all boards of the network and what they run",
    "HEARD is the time since the last report of the board; agents report twice a second. Exit code 6 if no board\n"
    "reports.\n"
    "Examples:\n"
    "  indurop boards\n"
    "  indurop boards -w\n"
    "  indurop boards --one-host -o json\n",
    &declare_boards};

}  // namespace indurop::tools
