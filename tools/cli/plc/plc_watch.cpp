// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "control/plc/front/watch_plan.h"
#include "control/plc/print/live.h"
#include "tools/cli/command/rounds.h"
#include "tools/cli/command/screen.h"
#include "tools/cli/plc/plc_file.h"
#include "tools/cli/plc/plc_sources.h"
#include "tools/cli/plc/plc_view_text.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct PlcWatchRequest {
  plc::CompileOptions compile;
  ViewChoice choice;
  double hz = 10;
  std::uint64_t count = 0;
  bool once = false;
  std::int64_t timeout_ns = 0;
};

// The view on a terminal: as many lines as fit, repainted in place.
class PlcWatchView {
 public:
  PlcWatchView(Context& context, PlcView& view) : context_(context), view_(view), screen_(context.out) {}

  Result<void, Failure> run(Rounds rounds) {
    bool key = false;
    while (rounds.wait(screen_.key_file(), key)) {
      if (key && !handle_keys()) {
        break;
      }
      if (!rounds.due() && !key) {
        continue;
      }
      if (!key) {
        rounds.done();
      }
      if (auto sampled = view_.sample(); !sampled) {
        return sampled;
      }
      screen_.paint(page());
      if (!context_.out.flush()) {
        break;
      }
    }
    return {};
  }

 private:
  [[nodiscard]] std::size_t room() const {
    constexpr int kOtherLines = 3;  // heading, footer, and the line of the cursor
    return static_cast<std::size_t>(std::max(1, context_.out.extent().rows - kOtherLines));
  }

  std::vector<std::string> page() {
    const std::vector<std::string> all = lines_of(view_, context_.out);
    last_ = all.size() > room() ? all.size() - room() : 0;
    first_ = std::min(first_, last_);
    std::vector<std::string> lines{heading_of(view_, context_.out)};
    lines.insert(lines.end(), all.begin() + static_cast<std::ptrdiff_t>(first_),
                 all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), first_ + room())));
    lines.push_back(context_.out.paint(Style::Dim, last_ == 0 ? "q quit" : "j k f b scroll, q quit"));
    return lines;
  }

  // Returns false if the user wants to quit.
  bool handle_keys() {
    for (char c = screen_.key(); c != 0; c = screen_.key()) {
      if (c == 'q') {
        return false;
      }
      const std::size_t step = c == 'f' || c == 'b' ? room() : 1;
      if (c == 'j' || c == 'f') {
        first_ = std::min(first_ + step, last_);
      } else if (c == 'k' || c == 'b') {
        first_ -= std::min(first_, step);
      }
    }
    return true;
  }

  Context& context_;
  PlcView& view_;
  Screen screen_;
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

int watch(Context& context, PlcWatchRequest& request) {
  const auto files = with_project_files(context, request.compile.files);
  if (!files) {
    return kCheckFailed;
  }
  request.compile.files = *files;
  std::optional<EndsAtOnce> ends(std::in_place);
  plc::WatchPlan plan = plc::watch_plan(request.compile);
  ends.reset();
  if (!plan.ok) {
    print_diagnostics(context, plan.diagnostics);
    return kCheckFailed;
  }
  plc::Diagnostics quiet;  // errors were reported already
  auto bodies = plc::live_bodies(plan.document, "", quiet);
  PlcView view(context, plan, std::move(bodies), request.choice);
  if (const auto opened = view.open(); !opened) {
    return report(context.out, opened.error());
  }
  const bool live = context.out.terminal() && !request.once;
  Rounds rounds(request.hz, live ? request.count : std::max<std::uint64_t>(request.count, 1), request.timeout_ns);
  if (live) {
    const auto done = PlcWatchView(context, view).run(rounds);
    return done ? kOk : report(context.out, done.error());
  }
  for (bool key = false; rounds.wait(-1, key); rounds.done()) {
    if (const auto sampled = view.sample(); !sampled) {
      return report(context.out, sampled.error());
    }
    context.out.line(heading_of(view, context.out));
    for (const std::string& line : lines_of(view, context.out)) {
      context.out.line(line);
    }
    if (!context.out.flush()) {
      break;
    }
  }
  return kOk;
}

}  // namespace

void add_plc_watch(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen) {
  auto request = std::make_shared<PlcWatchRequest>();
  constexpr int kMostRungs = 1'000'000;
  base::Options& made =
      app.command("watch", "Show a running program with its values, active steps and power flow",
                  [request, chosen] { *chosen = [request](Context& c) { return watch(c, *request); }; });
  add_plc_sources(made, request->compile);
  made.add("--pou", "NAME", request->choice.pou, "This program or function block only");
  made.add("--instance", "NAME", request->choice.instance, "Only this instance of it, e.g. main.motor");
  made.add("--rung", "N", request->choice.rung, "This rung or network only").range(1, kMostRungs);
  constexpr double kMostHz = 100;
  constexpr double kLeastHz = 0.001;
  made.add("--hz", "RATE", request->hz, "Rounds per second (default 10)").range(kLeastHz, kMostHz);
  made.add("-n,--count", "COUNT", request->count, "Stop after COUNT rounds (in a pipe: 1)");
  made.flag("--once", request->once, "One round");
  add_time_option(made, "--timeout", request->timeout_ns, "Stop after this time");
  add_node_option(made, context);
}

}  // namespace indurop::tools
