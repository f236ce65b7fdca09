// SPDX-License-Identifier: Apache-2.0
// indurop scope: captures variables in every tick around a trigger.
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "core/base/replace_file.h"
#include "core/rt/clock.h"
#include "tools/cli/command/screen.h"
#include "tools/cli/pictures/chart_text.h"
#include "tools/cli/pictures/recording_svg.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/scope/save.h"
#include "tools/client/scope/scope.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kScopePauseNs = 5'000'000;

struct ScopeOptions {
  ScopeOrder order;
  std::string mode = "single";
  std::vector<std::string> files;
  std::uint64_t count = 0;      // 0: without end
  std::int64_t timeout_ns = 0;  // 0: none
};

// Returns "run-2.csv" for "run.csv" and the second capture.
std::filesystem::path numbered(const std::string& file, std::uint64_t number) {
  std::filesystem::path path = file;
  if (number > 1) {
    path.replace_filename(fmt::format("{}-{}{}", path.stem().string(), number, path.extension().string()));
  }
  return path;
}

bool has_form(const std::string& file) {
  const std::string form = std::filesystem::path(file).extension().string();
  return form == ".svg" || form == ".csv" || form == ".json" || form == ".mcap";
}

JsonValue json_document(const Capture& capture, const std::string& node) {
  JsonValue whole = document();
  whole["node"] = node;
  whole.update(json_of(capture));
  return whole;
}

bool save(Context& context, const Capture& capture, const std::string& node, const std::filesystem::path& path) {
  const std::string form = path.extension().string();
  if (form == ".mcap") {
    const auto saved = save_mcap(path, capture, node);
    if (!saved) {
      context.out.error(saved.error().text);
      return false;
    }
  } else {
    const std::string text = form == ".svg"   ? chart_svg(heading_of(capture), recording_of(capture))
                             : form == ".csv" ? csv_of(capture)
                                              : json_document(capture, node).dump() + "\n";
    if (const auto saved = base::replace_file(path, text, base::Durable::No); !saved) {
      context.out.error(base::cannot_write(path.string(), saved.error()));
      return false;
    }
  }
  context.out.note(fmt::format("wrote {}", path.string()));
  return true;
}

class Show {
 public:
  Show(Context& context, const ScopeOptions& options, Scope& scope)
      : context_(context), options_(options), scope_(scope) {
    if (context.format == Format::Table && context.out.terminal() && options.order.mode != ScopeMode::Single) {
      screen_ = std::make_unique<Screen>(context.out);
    }
  }

  int run() {
    const std::int64_t begin = rt::now_ns();
    if (screen_) {
      screen_->paint({"waiting for " + (options_.order.trigger.empty() ? "ticks" : printable(options_.order.trigger))});
      (void)context_.out.flush();
    }
    for (;;) {
      const auto capture = scope_.poll();
      if (capture && !held_) {
        ++seen_;
        if (const int code = show(*capture); code != kOk || done()) {
          return code;
        }
      }
      if (!capture) {
        if (scope_.over()) {
          return ended(fmt::format("node '{}' has ended", scope_.node()), kUnreachable);
        }
        if (options_.timeout_ns > 0 && rt::now_ns() - begin >= options_.timeout_ns) {
          return ended(fmt::format("no trigger within {}, in {} ticks", human_age(options_.timeout_ns), scope_.ticks()),
                       kUnreachable);
        }
        const Woken why = wait_until(rt::now_ns() + kScopePauseNs, screen_ ? screen_->key_file() : -1);
        if (interrupted() || (why == Woken::Readable && !keys())) {
          return kOk;
        }
      }
    }
  }

 private:
  [[nodiscard]] bool done() const {
    const std::uint64_t wanted = options_.order.mode == ScopeMode::Single ? 1 : options_.count;
    return (wanted > 0 && seen_ >= wanted) || context_.out.reader_gone();
  }

  // Ending without an error is enough if at least one capture was made.
  int ended(const std::string& why, int code) {
    if (seen_ > 0) {
      context_.out.note(why);
      return kOk;
    }
    context_.out.error(why);
    return code;
  }

  bool keys() {
    for (char c = screen_->key(); c != 0; c = screen_->key()) {
      if (c == 'q') {
        return false;
      }
      held_ = c == ' ' ? !held_ : held_;
    }
    return true;
  }

  int show(const Capture& capture) {
    if (capture.lost_runs > 0) {
      context_.out.note(fmt::format("{} runs were overwritten before they were read; values between them are missing",
                                    capture.lost_runs));
    }
    switch (context_.format) {
      case Format::Table:
        draw(capture);
        break;
      case Format::Csv:
        context_.out.write(csv_of(capture));
        break;
      case Format::Json:
        context_.out.line(json_document(capture, scope_.node()).dump());
        break;
      case Format::Svg:
        context_.out.write(chart_svg(heading_of(capture), recording_of(capture)));
        break;
    }
    bool saved = true;
    for (const std::string& file : options_.files) {
      saved = save(context_, capture, scope_.node(), numbered(file, seen_)) && saved;
    }
    (void)context_.out.flush();
    return saved ? kOk : kFailed;
  }

  void draw(const Capture& capture) {
    Output& out = context_.out;
    std::vector<std::string> lines{out.paint(Style::Bold, heading_of(capture))};
    for (std::string& line : chart_lines(recording_of(capture), out.extent().columns, out.unicode())) {
      lines.push_back(std::move(line));
    }
    if (screen_) {
      lines.push_back(out.paint(Style::Dim, fmt::format("picture {}; q quit, space hold", seen_)));
      screen_->paint(lines);
      return;
    }
    for (const std::string& line : lines) {
      out.line(line);
    }
  }

  Context& context_;
  const ScopeOptions& options_;
  Scope& scope_;
  std::unique_ptr<Screen> screen_;
  std::uint64_t seen_ = 0;
  bool held_ = false;
};

int scope(Context& context, ScopeOptions& options) {
  for (const std::string& file : options.files) {
    if (!has_form(file)) {
      context.out.error(fmt::format("'{}': the name has to end in .svg, .csv, .json or .mcap", file));
      return kUsage;
    }
  }
  options.order.mode = options.mode == "auto"     ? ScopeMode::Auto
                       : options.mode == "normal" ? ScopeMode::Normal
                                                  : ScopeMode::Single;
  auto opened = Scope::open(context.node, options.order);
  if (!opened) {
    return report(context.out, opened.error());
  }
  be_gentle(opened->node());
  const int code = Show(context, options, *opened).run();
  return interrupted() ? interrupt_code() : code;
}

Action declare_scope(base::Options& app, Context& context) {
  auto options = std::make_shared<ScopeOptions>();
  constexpr auto kMaxTicks = static_cast<double>(kMostScopeRows);
  app.add("names", "CHANNEL", options->order.channels, "Variables, parts of them, globs, or expressions")
      .required()
      .completes(base::Completion::Variable);
  app.add("--trigger", "WHEN", options->order.trigger,
          "Trigger: 'NAME rises', 'NAME falls', 'NAME changes', or an expression that becomes true");
  app.add("--pre", "TICKS", options->order.pre, "Ticks before the trigger (default 100)").range(0, kMaxTicks);
  app.add("--post", "TICKS", options->order.post, "Ticks after it (default 400)").range(0, kMaxTicks);
  app.add("--mode", "MODE", options->mode,
          "single: one picture (default); normal: one for each trigger; auto: also without one")
      .choices({"single", "normal", "auto"});
  app.flag("--past", options->order.past, "Begin with what is still on the node's tape");
  app.add("--save", "FILE", options->files, "Write each picture to FILE: .svg, .csv, .json or .mcap").one_at_a_time();
  app.add("-n,--count", "COUNT", options->count, "Stop after COUNT pictures");
  add_time_option(app, "--timeout", options->timeout_ns, "Stop if there is no trigger within this time");
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv, Format::Svg});
  return [options](Context& c) { return scope(c, *options); };
}

}  // namespace

const Verb kScopeVerb{
    "scope", "Variables", "Show variables in every tick around a trigger",
    "Shows the values of variables at the end of each tick, before and after a trigger. The node records\n"
    "everything that its modules write in a ring of shared memory; this verb reads that ring, so no tick is\n"
    "missed or disturbed.\n"
    "Expressions support + - * / %, < <= > >= == !=, and or not, brackets, abs sqrt min max; 'NAME = EXPRESSION'\n"
    "names one. Put spaces around *, or it is a glob. A value that is compared with an enumeration may be one of\n"
    "its names.\n"
    "Examples:\n"
    "  indurop scope joints --trigger 'motor_on rises' --pre 100 --post 400\n"
    "  indurop scope 'error = abs(target - actual)' --trigger 'state == Moving and not stop' --save run.svg\n"
    "  indurop scope speed --trigger 'speed > 100' --mode normal\n",
    &declare_scope};

}  // namespace indurop::tools
