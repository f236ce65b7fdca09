// SPDX-License-Identifier: Apache-2.0
// indurop watch: shows values as they change; repainted in place on a terminal, lines in a pipe.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/base/csv_row.h"
#include "core/rt/clock.h"
#include "tools/cli/command/rounds.h"
#include "tools/cli/command/screen.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"
#include "tools/client/values/watch_source.h"
#include "tools/console/table_text.h"

namespace indurop::tools {
namespace {

struct WatchOptions {
  std::vector<std::string> names;
  std::vector<std::string> lists;
  double hz = 10;
  std::uint64_t count = 0;  // 0: without end
  bool once = false;
  bool units = false;
  std::int64_t timeout_ns = 0;  // 0: none
};

constexpr std::size_t kAllItems = SIZE_MAX;
constexpr std::size_t kAlignUpTo = 24;  // longer values extend to the right

std::string text_of(const WatchedValue& value) {
  return value.gone ? "gone" : schema::format_value(value.item.place.type, value.bytes);
}

// ---- lines for a pipe

void print_changes(Context& context, const WatchSource& source, const Rounds& rounds) {
  const double seconds = static_cast<double>(rounds.elapsed_ns()) / 1e9;
  for (const auto& value : source.values()) {
    if (value.changed && !value.gone) {
      const std::string unit = value.item.place.unit.empty() ? "" : " " + value.item.place.unit;
      context.out.line(fmt::format("{:.3f}  {} = {}{}", seconds, value.item.name, text_of(value), printable(unit)));
    }
  }
}

void print_csv_heading(Context& context, const WatchSource& source, bool with_units) {
  std::string line = "time_ns";
  for (const auto& value : source.values()) {
    const std::string& unit = value.item.place.unit;
    line += "," + base::csv_field(with_units && !unit.empty() ? fmt::format("{} [{}]", value.item.name, unit)
                                                              : value.item.name);
  }
  context.out.line(line);
}

void print_csv(Context& context, const WatchSource& source) {
  std::string line = std::to_string(rt::wall_ns());
  for (const auto& value : source.values()) {
    line += "," + (value.gone ? "" : csv_value(raw_value(value.item.place.type, value.bytes)));
  }
  context.out.line(line);
}

void print_json(Context& context, const WatchSource& source) {
  JsonValue values = JsonValue::object();
  for (const auto& value : source.values()) {
    values[value.item.name] = value.gone ? JsonValue() : raw_value(value.item.place.type, value.bytes);
  }
  JsonValue whole = document();
  whole["node"] = source.node();
  whole["running"] = source.alive();
  whole["time_ns"] = rt::wall_ns();
  whole["values"] = std::move(values);
  context.out.line(whole.dump());
}

int stream(Context& context, WatchSource& source, const WatchOptions& options) {
  Rounds rounds(options.hz, options.once ? 1 : options.count, options.timeout_ns);
  if (context.format == Format::Csv) {
    print_csv_heading(context, source, options.units);
  }
  std::string absence;
  bool first = true;
  bool key = false;
  while (rounds.wait(-1, key)) {
    source.sample(context, 0, kAllItems);
    const bool was_gone = !absence.empty();
    if (source.alive() == was_gone) {
      absence = source.absence();
      context.out.note(source.alive() ? context.values->back() : context.values->gone(absence));
    }
    switch (context.format) {
      case Format::Json:
        print_json(context, source);
        break;
      case Format::Csv:
        print_csv(context, source);
        break;
      case Format::Table:
      case Format::Svg:
        print_changes(context, source, rounds);
        break;
    }
    rounds.done();
    if (!context.out.flush()) {
      break;
    }
    first = false;
  }
  return first && !interrupted() ? kUnreachable : kOk;
}

// ---- the terminal

class WatchView {
 public:
  WatchView(Context& context, WatchSource& source, const WatchOptions& options)
      : context_(context), source_(source), options_(options), screen_(context.out) {}

  int run() {
    Rounds rounds(options_.hz, options_.once ? 1 : options_.count, options_.timeout_ns);
    bool key = false;
    while (rounds.wait(screen_.key_file(), key)) {
      if (key && !handle_keys()) {
        break;
      }
      if (!rounds.due() && !key) {
        continue;
      }
      if (!paused_) {
        source_.sample(context_, first_, visible());
      }
      if (!key) {
        rounds.done();
      }
      screen_.paint(lines());
      if (!context_.out.flush()) {
        break;
      }
    }
    return kOk;
  }

 private:
  // Heading and footer take three lines, and the line of the cursor must not scroll.
  [[nodiscard]] std::size_t visible() const {
    constexpr int kOtherLines = 4;
    return static_cast<std::size_t>(std::max(1, context_.out.extent().rows - kOtherLines));
  }

  // Returns false if the user wants to quit.
  bool handle_keys() {
    const std::size_t page = visible();
    const std::size_t total = source_.values().size();
    const std::size_t last = total > page ? total - page : 0;
    for (char c = screen_.key(); c != 0; c = screen_.key()) {
      switch (c) {
        case 'q':
          return false;
        case ' ':
          paused_ = !paused_;
          break;
        case 'j':
          first_ = std::min(first_ + 1, last);
          break;
        case 'k':
          first_ -= first_ > 0 ? 1 : 0;
          break;
        case 'f':
          first_ = std::min(first_ + page, last);
          break;
        case 'b':
          first_ -= std::min(first_, page);
          break;
        case 'g':
          first_ = 0;
          break;
        case 'G':
          first_ = last;
          break;
        default:
          break;
      }
    }
    return true;
  }

  [[nodiscard]] std::vector<std::string> lines() {
    const Output& out = context_.out;
    const auto values = source_.values();
    const std::size_t end = std::min(values.size(), first_ + visible());
    std::vector<std::string> texts;
    for (std::size_t i = first_; i < end; ++i) {
      texts.push_back(printable(text_of(values[i])));
      name_width_ = std::max(name_width_, display_width(values[i].item.name));
      if (display_width(texts.back()) <= kAlignUpTo) {
        value_width_ = std::max(value_width_, display_width(texts.back()));
      }
    }
    std::vector<std::string> out_lines;
    out_lines.push_back(
        out.paint(Style::Bold, (context_.values->here() ? "node " : "") + source_.node()) + "  " +
        (source_.alive() ? out.paint(Style::Good, "running") : out.paint(Style::Bad, source_.absence())) +
        (paused_ ? "  " + out.paint(Style::Warn, "paused") : ""));
    out_lines.push_back(
        out.paint(Style::Bold, fmt::format("  {:<{}}  {:>{}}  UNIT", "NAME", name_width_, "VALUE", value_width_)));
    for (std::size_t i = first_; i < end; ++i) {
      const auto& value = values[i];
      const bool mark = value.changed && !paused_;
      out_lines.push_back(fmt::format(
          "{} {:<{}}  {}  {}", mark ? out.paint(Style::Accent, "*") : " ", value.item.name, name_width_,
          out.paint(mark ? Style::Accent : Style::None, fmt::format("{:>{}}", texts[i - first_], value_width_)),
          printable(value.item.place.unit)));
    }
    std::string footer = screen_.key_file() >= 0 ? "q quit, space pause" : "Ctrl-C quits";
    if (values.size() > end - first_) {
      footer = fmt::format("{} to {} of {}, j k f b scroll, ", first_ + 1, end, values.size()) + footer;
    }
    out_lines.push_back(out.paint(Style::Dim, footer));
    return out_lines;
  }

  Context& context_;
  WatchSource& source_;
  const WatchOptions& options_;
  Screen screen_;
  std::size_t first_ = 0;
  bool paused_ = false;
  // Columns only become wider: nothing moves when a value has fewer digits.
  std::size_t name_width_ = 4;
  std::size_t value_width_ = 5;
};

void print_once(Context& context, WatchSource& source) {
  source.sample(context, 0, kAllItems);
  if (!source.alive()) {
    context.out.note(context.values->gone(source.absence()) + ": these are the last values");
  }
  Table table({{"NAME", ""}, {"VALUE", "", Align::Right, 0, kAlignUpTo}, {"UNIT", ""}});
  for (const auto& value : source.values()) {
    table.add({Cell(value.item.name), Cell(text_of(value)), Cell(value.item.place.unit)});
  }
  context.out.write(table_text(table, context.out));
}

int watch(Context& context, const WatchOptions& options) {
  std::vector<std::string> names = options.names;
  for (const std::string& list : options.lists) {
    if (!read_watch_list(context.out, list, names)) {
      return kFailed;
    }
  }
  if (names.empty()) {
    context.out.error("which variables? Name them, or give a list with -f; '*' means all (see: indurop help watch)");
    return kUsage;
  }
  WatchSource source(context.node, names);
  if (const auto opened = source.open(context); !opened) {
    return report(context.out, opened.error());
  }
  if (context.values->here()) {
    be_gentle(source.node());
  }
  if (context.format == Format::Table && options.once) {
    print_once(context, source);
    return kOk;
  }
  if (context.format == Format::Table && context.out.terminal()) {
    return WatchView(context, source, options).run();
  }
  return stream(context, source, options);
}

Action declare_watch(base::Options& app, Context& context) {
  auto options = std::make_shared<WatchOptions>();
  constexpr double kMostHz = 1000;
  constexpr double kLeastHz = 0.001;
  app.add("names", "GLOB", options->names, "Variables, parts of them, or globs").completes(base::Completion::Variable);
  app.add("-f,--file", "LIST.watch", options->lists, "Watch list: one name or glob per line, # comments");
  app.add("--hz", "RATE", options->hz, "Rounds per second (default 10, at most 1000)").range(kLeastHz, kMostHz);
  app.add("-n,--count", "COUNT", options->count, "Stop after COUNT rounds");
  app.flag("--once", options->once, "One round");
  app.flag("--units", options->units, "With -o csv: headings as \"NAME [unit]\", for chart");
  add_time_option(app, "--timeout", options->timeout_ns, "Stop after this time");
  add_node_option(app, context);
  add_remote_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return watch(c, *options); };
}

}  // namespace

const Verb kWatchVerb{
    "watch", "Variables", "Follow variables as they change",
    "On a terminal the values are updated in place, and '*' marks what changed since the last round; q quits,\n"
    "space pauses. In a pipe it prints one line per changed variable, with -o csv or json one line per round. The\n"
    "node is only read and does no work for this. If it stops, the last values stay; the view continues when the\n"
    "node is back.\n"
    "Examples:\n"
    "  indurop watch 'knu::Robot::*'\n"
    "  indurop watch -f arm.watch --hz 2\n"
    "  indurop watch tick 'joints[0]' -o csv -n 1000 > run.csv\n",
    &declare_watch};

}  // namespace indurop::tools
