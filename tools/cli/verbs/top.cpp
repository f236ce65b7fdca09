// SPDX-License-Identifier: Apache-2.0
// indurop top: running nodes of this host, repainted in place.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "core/rt/clock.h"
#include "store/vars/nodes.h"
#include "store/vars/store.h"
#include "tools/cli/top/top_page.h"
#include "tools/cli/top/top_screen.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kPage = 10;

struct TopOptions {
  double seconds = 1;
  std::uint64_t count = 0;  // 0: without end
};

class Top {
 public:
  Top(Context& context, const TopOptions& options) : context_(context), options_(options), node_(context.node) {}

  // For a pipe: prints pages of text.
  int print() {
    const std::uint64_t rounds = std::max<std::uint64_t>(options_.count, 1);
    for (std::uint64_t i = 0; i < rounds && !interrupted(); ++i) {
      if (i > 0) {
        wait_until(rt::now_ns() + interval_ns());
      }
      update();
      constexpr int kRows = 24;
      for (const TopLine& line : page(context_.out.extent().columns, kRows)) {
        context_.out.line(context_.out.paint(line.style, line.text));
      }
      if (!context_.out.flush()) {
        break;
      }
    }
    return interrupted() ? interrupt_code() : sample_ ? kOk : kUnreachable;
  }

  int show() {
    TopScreen screen;
    std::int64_t next = rt::now_ns();
    for (std::uint64_t rounds = 0; !interrupted();) {
      const std::int64_t now = rt::now_ns();
      if (now >= next) {
        if (options_.count > 0 && rounds++ >= options_.count) {
          return kOk;
        }
        if (!look_.paused) {
          update();
        }
        next = now + interval_ns();
      }
      screen.paint(page(screen.extent().columns, screen.extent().rows));
      constexpr std::int64_t kMsNs = 1'000'000;
      constexpr std::int64_t kMostMs = 200;  // maximum wait, to notice signals
      const auto wait = std::clamp<std::int64_t>((next - rt::now_ns()) / kMsNs, 1, kMostMs);
      if (!obey(screen.key(static_cast<int>(wait)))) {
        return kOk;
      }
    }
    return interrupt_code();
  }

 private:
  [[nodiscard]] std::int64_t interval_ns() const { return static_cast<std::int64_t>(options_.seconds * 1e9); }

  void update() {
    look_.nodes = vars::running_nodes();
    auto run = open_run(node_);
    if (!run) {
      why_ = run.error().text;
      sample_.reset();
      return;
    }
    if (watched_ != run->node) {
      be_gentle(run->node);
      watched_ = run->node;
    }
    const bool same = sample_ && sample_->report.node == run->node;
    sample_ = take_sample(run->node, run->run, same ? &*sample_ : nullptr);
  }

  [[nodiscard]] std::vector<TopLine> page(int columns, int rows) const {
    return sample_ ? top_page(*sample_, look_, columns, rows) : top_nothing(why_, columns, rows);
  }

  void next_node() {
    if (look_.nodes.empty()) {
      return;
    }
    const auto at = std::find(look_.nodes.begin(), look_.nodes.end(), sample_ ? sample_->report.node : node_);
    node_ = at == look_.nodes.end() || at + 1 == look_.nodes.end() ? look_.nodes.front() : *(at + 1);
    look_.first = 0;
    update();
  }

  // Returns false if the user wants to quit.
  bool obey(TopScreen::Key key) {
    const std::size_t most = sample_ && !sample_->modules.empty() ? sample_->modules.size() - 1 : 0;
    switch (key) {
      case TopScreen::Key::Quit:
        return false;
      case TopScreen::Key::Node:
        next_node();
        break;
      case TopScreen::Key::Sort:
        look_.order = next_order(look_.order);
        break;
      case TopScreen::Key::Pause:
        look_.paused = !look_.paused;
        break;
      case TopScreen::Key::Up:
        look_.first -= look_.first > 0 ? 1 : 0;
        break;
      case TopScreen::Key::Down:
        look_.first = std::min(look_.first + 1, most);
        break;
      case TopScreen::Key::PageUp:
        look_.first -= std::min(look_.first, kPage);
        break;
      case TopScreen::Key::PageDown:
        look_.first = std::min(look_.first + kPage, most);
        break;
      case TopScreen::Key::None:
      case TopScreen::Key::Other:
        break;
    }
    return true;
  }

  Context& context_;
  const TopOptions& options_;
  std::string node_;
  std::string watched_;
  std::optional<TopSample> sample_;
  std::string why_;
  TopLook look_;
};

int top(Context& context, const TopOptions& options) {
  Top view(context, options);
  return context.out.terminal() ? view.show() : view.print();
}

Action declare_top(base::Options& app, Context& context) {
  auto options = std::make_shared<TopOptions>();
  constexpr double kLeastSeconds = 0.1;
  constexpr double kMostSeconds = 3600;
  app.add("-d,--delay", "SECONDS", options->seconds, "Update interval (default 1)").range(kLeastSeconds, kMostSeconds);
  app.add("-n,--count", "COUNT", options->count, "Stop after COUNT updates (in a pipe: 1)");
  add_node_option(app, context);
  return [options](Context& c) { return top(c, *options); };
}

}  // namespace

const Verb kTopVerb{
    "top", "A running node", "Show a node and its modules on the whole screen, the busiest first",
    "LOAD% is the share of a core that a module used since the last update, JIT 99% the jitter that 99 of 100\n"
    "runs do not exceed.\n"
    "Keys: q (F10) quits, n (Tab) goes to the next node, s (F6) sorts by load, name, overruns or jitter, the\n"
    "space bar pauses, arrows scroll. In a pipe it prints a page of text.\n"
    "Examples:\n"
    "  indurop top\n"
    "  indurop top -d 0.5 --node cell\n",
    &declare_top};

}  // namespace indurop::tools
