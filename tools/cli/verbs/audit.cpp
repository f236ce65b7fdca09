// SPDX-License-Identifier: Apache-2.0
// indurop audit: who wrote what to the boards of this host, from where and why.
#include "store/operate/audit.h"

#include <fmt/format.h>

#include <cerrno>

#include "core/base/read_file.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct AuditOptions {
  std::filesystem::path file = operate::usual_audit_file();
  std::uint64_t count = 40;
};

int show_audit(Context& context, const AuditOptions& options) {
  if (const auto opened = base::open_file(options.file); !opened && opened.error().sys_errno != ENOENT) {
    context.out.error(base::cannot_read(options.file, opened.error()) +
                      "; run this as the user of the agent or server");
    return kFailed;
  }
  Table table({{"WHEN", "wall_ns"},
               {"WHO", "who"},
               {"FROM", "from"},
               {"BOARD", "board"},
               {"ACTION", "action"},
               {"WHAT", "what"},
               {"OUTCOME", "outcome"},
               {"REASON", "reason"}});
  for (const operate::AuditEntry& entry : operate::read_audit(options.file, options.count)) {
    table.add({{local_time(entry.wall_ns), entry.wall_ns},
               {printable(entry.who), entry.who},
               {printable(entry.from), entry.from},
               {printable(entry.board), entry.board},
               {printable(entry.action), entry.action},
               {printable(entry.what), entry.what},
               {printable(entry.outcome), entry.outcome},
               {printable(entry.reason), entry.reason}});
  }
  if (table.empty()) {
    context.out.note(fmt::format("{} has no entries", options.file.string()));
  }
  print_table(context, table, JsonValue::object(), "audit");
  return kOk;
}

Action declare_audit(base::Options& app, Context& context) {
  auto options = std::make_shared<AuditOptions>();
  app.add("-n,--count", "COUNT", options->count, "Show the newest COUNT entries (default 40)");
  app.add("--file", "FILE", options->file, "The file that indurop serve --audit names (default: in the state folder)");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return show_audit(c, *options); };
}

}  // namespace

const Verb kAuditVerb{
    "audit", "A running node", "Show who changed what, from where and why",
    "Verbs that write (set, force, lock, recipe load, stop ...) and indurop serve record each action: user or\n"
    "name of the token, host, board, values and --reason.\n"
    "Examples:\n"
    "  indurop audit\n"
    "  indurop audit -n 100 -o csv\n",
    &declare_audit};

}  // namespace indurop::tools
