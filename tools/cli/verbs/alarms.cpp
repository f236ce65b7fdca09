// SPDX-License-Identifier: Apache-2.0
// indurop alarms: the status of a node's alarms, their history, and what operators do about them.
#include <fmt/format.h>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "history/alarms/alarm_list.h"
#include "history/alarms/alarm_orders.h"
#include "history/alarms/alarm_watch.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/node/node_trouble.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct AlarmsOptions {
  std::vector<std::string> names;
  std::string reason;
  std::int64_t for_ns = 3'600'000'000'000;
  std::uint64_t count = 20;
  bool all = false;
};

// The alarms that a node declares.
struct Listed {
  std::string node;
  std::vector<alarms::DeclaredAlarm> declared;
};

Style style_of(const alarms::ListedAlarm& alarm) {
  switch (alarm.record.state) {
    case alarms::AlarmState::Unacknowledged:
      return alarm.priority <= schema::Priority::High ? Style::Bad : Style::Warn;
    case alarms::AlarmState::Returned:
    case alarms::AlarmState::Acknowledged:
      return Style::Warn;
    case alarms::AlarmState::Shelved:
    case alarms::AlarmState::Normal:
      break;
  }
  return Style::None;
}

std::string more_of(const alarms::ListedAlarm& alarm) {
  const alarms::AlarmEntry& last = alarm.record.last;
  if (alarm.record.state == alarms::AlarmState::Shelved) {
    return fmt::format("until {}{}{}", local_time(last.until_ns), last.who.empty() ? "" : " by " + last.who,
                       last.reason.empty() ? "" : ": " + last.reason);
  }
  return last.who.empty() ? std::string()
                          : fmt::format("by {}{}", last.who, last.reason.empty() ? "" : ": " + last.reason);
}

int show_list(Context& context, const Listed& listed, const AlarmsOptions& options) {
  const auto& [node, declared] = listed;
  alarms::AlarmJournal journal(node);
  journal.refresh();
  Table table({{"PRIORITY", "priority"},
               {"STATE", "state"},
               {"SINCE", "since_wall_ns"},
               {"ALARM", "alarm"},
               {"VALUE", "value"},
               {"TEXT", "text"},
               {"MORE", "more"}});
  for (const alarms::ListedAlarm& one : alarms::list_alarms(declared, journal.book(), options.all)) {
    const std::int64_t since = one.record.since_ns;
    table.add({Cell(schema::word_of(one.priority)), Cell(word_of(one.record.state), style_of(one)),
               Cell(since != 0 ? local_time(since) : "-", since != 0 ? JsonValue(since) : JsonValue(), Style::None),
               Cell(one.name), Cell(printable(one.record.last.value)), Cell(one.text), Cell(printable(more_of(one)))});
  }
  const bool watched = journal.watched();
  if (context.format == Format::Table) {
    if (table.empty()) {
      context.out.note(declared.empty() ? "no variable of this node has an @alarm" : "all alarms are normal");
    }
    if (!watched && !declared.empty()) {
      context.out.note(fmt::format(
          "no process is evaluating the alarms of node {}: run indurop-agent, indurop serve, or indurop alarms watch",
          node));
    }
  }
  print_table(context, table, {{"node", node}, {"watched", watched}, {"counts", json_of(journal.book().counts())}},
              "alarms");
  return kOk;
}

int show_history(Context& context, const Listed& listed, const AlarmsOptions& options) {
  const alarms::AlarmJournal journal(listed.node);
  Table table({{"TIME", "wall_ns"},
               {"EVENT", "event"},
               {"PRIORITY", "priority"},
               {"ALARM", "alarm"},
               {"VALUE", "value"},
               {"TEXT", "text"},
               {"WHO", "who"},
               {"REASON", "reason"}});
  for (const alarms::AlarmEntry& one : journal.history(options.count)) {
    table.add({Cell(local_time(one.wall_ns), JsonValue(one.wall_ns), Style::None), Cell(word_of(*one.event)),
               Cell(schema::word_of(one.priority)), Cell(one.alarm), Cell(printable(one.value)), Cell(one.text),
               Cell(printable(one.who)), Cell(printable(one.reason))});
  }
  print_table(context, table, {{"node", listed.node}}, "events");
  return kOk;
}

int watch(Context& context, const Listed& listed, const AlarmsOptions& /*options*/) {
  const std::string& node = listed.node;
  constexpr std::int64_t kEveryNs = 100'000'000;
  be_gentle(node);
  alarms::AlarmWatch watched(node);
  context.out.note(fmt::format("evaluating the alarms of node {}; Ctrl-C ends it", node));
  static_cast<void>(context.out.flush());
  std::string before;
  while (!interrupted()) {
    if (std::string problem = watched.evaluate(modules_now(node)); problem != before) {
      before = std::move(problem);
      if (!before.empty()) {
        context.out.error(before);
      }
    }
    wait_until(rt::now_ns() + kEveryNs);
  }
  return interrupt_code();
}

int order(Context& context, const Listed& listed, alarms::AlarmEvent what, const char* verb,
          const AlarmsOptions& options) {
  if (options.names.empty() != options.all) {
    context.out.error(fmt::format("name the alarms to {}, or --all", verb));
    return kUsage;
  }
  alarms::AlarmJournal journal(listed.node);
  const auto done =
      alarms::carry_out(journal, listed.declared,
                        {what, options.names, options.all, options.for_ns, base::user_name(), "here", options.reason});
  if (!done) {
    for (const std::string& text : done.error().texts) {
      context.out.error(text);
    }
    return kFailed;
  }
  for (const std::string& name : *done) {
    context.out.line(fmt::format("{} {}", word_of(what), name));
  }
  if (done->empty()) {
    context.out.note(fmt::format("there was nothing to {}", verb));
  }
  return kOk;
}

Result<Listed, Failure> open_alarms(Context& context) {
  const auto store = open_store(context, vars::Mode::ReadOnly);
  if (!store) {
    return store.error();
  }
  return Listed{context.node.empty() ? context.values->title() : context.node, alarms::declared_alarms(*store)};
}

Action declare_alarms(base::Options& app, Context& context) {
  auto options = std::make_shared<AlarmsOptions>();
  auto chosen = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help, auto act) -> base::Options& {
    return app.command(name, help, [options, chosen, act] {
      *chosen = [options, act](Context& c) {
        const auto listed = open_alarms(c);
        return listed ? act(c, *listed, *options) : report(c.out, listed.error());
      };
    });
  };
  const auto ordering = [&](const char* name, const char* help, alarms::AlarmEvent what) -> base::Options& {
    base::Options& made = verb(name, help, [what, name](Context& c, const Listed& listed, const AlarmsOptions& o) {
      return order(c, listed, what, name, o);
    });
    made.add("names", "ALARM", options->names, "Alarms, the variables they evaluate, or globs");
    made.flag("--all", options->all, "All alarms");
    made.add("--reason", "TEXT", options->reason, "Reason, for the history");
    return made;
  };
  base::Options& list = verb("list", "Show the alarms that are not normal", &show_list);
  list.flag("--all", options->all, "Include normal alarms");
  base::Options& history = verb("history", "Show the history of alarms", &show_history);
  history.add("-n,--count", "COUNT", options->count, "Show the newest COUNT events (default 20)");
  ordering("ack", "Acknowledge alarms", alarms::AlarmEvent::Acknowledged);
  base::Options& shelve = ordering("shelve", "Do not raise alarms for a while", alarms::AlarmEvent::Shelved);
  add_time_option(shelve, "--for", options->for_ns, "Shelve for this duration (default 1h)");
  ordering("unshelve", "Raise shelved alarms again", alarms::AlarmEvent::Unshelved);
  verb("watch", "Evaluate the alarms until Ctrl-C", &watch);
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kAlarmsVerb{
    "alarms", "A running node", "Show, acknowledge and shelve alarms, and show their history",
    "Alarms are declared in .glb files: bool open @alarm(\"the door is open\", high, 500ms). A module that does not\n"
    "do its work for two seconds raises an alarm without a declaration: module Robot. One process on the node's\n"
    "machine evaluates the conditions: its agent, indurop serve, or indurop alarms watch. The history is in the\n"
    "state folder of the node and survives restarts. An alarm that ended before it was acknowledged stays in the\n"
    "list as 'returned'. A shelved alarm is not raised until its time is over or it is unshelved.\n"
    "Examples:\n"
    "  indurop alarms\n"
    "  indurop alarms ack press::door_open --reason 'closed it'\n"
    "  indurop alarms ack --all\n"
    "  indurop alarms shelve 'press::oil > 80' --for 8h --reason 'sensor is ordered'\n"
    "  indurop alarms history -n 100 -o csv\n",
    &declare_alarms};

}  // namespace indurop::tools
