// SPDX-License-Identifier: Apache-2.0
// indurop hz: how often a variable is written.
#include <fmt/format.h>
#include <indurop/detail/abi.h>

#include <cmath>

#include "core/rt/clock.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

struct HzOptions {
  std::string name;
  std::uint64_t count = 0;  // reports; 0: without end
  std::int64_t timeout_ns = 0;
  bool once = false;
};

constexpr std::int64_t kLookNs = 1'000'000;        // one poll per ms
constexpr std::int64_t kReportNs = 1'000'000'000;  // one line per second

// Counts updates between polls. A ring variable numbers its versions, so none is missed; of a scalar only changes
// between two polls are seen.
class Counter {
 public:
  Counter(const vars::Store& store, const Item& item)
      : store_(store), item_(item), exact_(item.entry->kind == abi::Kind::Ring) {}

  [[nodiscard]] bool exact() const noexcept { return exact_; }

  void look(std::int64_t now_ns) {
    const std::uint64_t updates = new_updates();
    if (updates > 0 && last_ns_ != 0) {
      const double each = static_cast<double>(now_ns - last_ns_) / static_cast<double>(updates);
      min_ns_ = std::min(min_ns_, each);
      max_ns_ = std::max(max_ns_, each);
      sum_ns_ += each * static_cast<double>(updates);
      squares_ += each * each * static_cast<double>(updates);
      window_ += updates;
    }
    if (updates > 0) {
      last_ns_ = now_ns;  // the first observed update begins the window
    }
  }

  [[nodiscard]] std::uint64_t window() const noexcept { return window_; }
  [[nodiscard]] double rate() const noexcept { return sum_ns_ > 0 ? static_cast<double>(window_) * 1e9 / sum_ns_ : 0; }
  [[nodiscard]] std::int64_t min_ns() const noexcept { return window_ > 0 ? static_cast<std::int64_t>(min_ns_) : 0; }
  [[nodiscard]] std::int64_t max_ns() const noexcept { return static_cast<std::int64_t>(max_ns_); }
  [[nodiscard]] std::int64_t deviation_ns() const noexcept {
    if (window_ == 0) {
      return 0;
    }
    const auto n = static_cast<double>(window_);
    const double mean = sum_ns_ / n;
    return static_cast<std::int64_t>(std::sqrt(std::max(0.0, squares_ / n - mean * mean)));
  }

 private:
  std::uint64_t new_updates() {
    if (exact_) {
      const auto* ring = static_cast<const abi::RingHeader*>(store_.entry(item_.entry->name_hash, 0));
      const std::uint64_t sequence = ring->seq.load(std::memory_order_acquire);
      const std::uint64_t updates = started_ ? sequence - sequence_ : 0;
      sequence_ = sequence;
      started_ = true;
      return updates;
    }
    auto bytes = operate::read(store_, item_);
    if (!bytes) {
      return 0;
    }
    const bool changed = started_ && *bytes != bytes_;
    bytes_ = std::move(*bytes);
    started_ = true;
    return changed ? 1 : 0;
  }

  const vars::Store& store_;
  const Item& item_;
  bool exact_;
  bool started_ = false;
  std::uint64_t sequence_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::int64_t last_ns_ = 0;
  std::uint64_t window_ = 0;
  double min_ns_ = 1e300;
  double max_ns_ = 0;
  double sum_ns_ = 0;
  double squares_ = 0;
};

void print(Context& context, const Item& item, const Counter& counter) {
  if (context.format == Format::Json) {
    JsonValue whole = document();
    whole["node"] = context.values->title();
    whole["name"] = item.name;
    whole["rate_hz"] = counter.rate();
    whole["min_ns"] = counter.min_ns();
    whole["max_ns"] = counter.max_ns();
    whole["std_dev_ns"] = counter.deviation_ns();
    whole["window"] = counter.window();
    whole["exact"] = counter.exact();
    context.out.line(whole.dump());
  } else if (counter.window() == 0) {
    context.out.line("no update yet");
  } else {
    context.out.line(fmt::format("average rate: {:.3f} Hz  min: {}  max: {}  std dev: {}  window: {}", counter.rate(),
                                 human_ns(counter.min_ns()), human_ns(counter.max_ns()),
                                 human_ns(counter.deviation_ns()), counter.window()));
  }
}

int hz(Context& context, const HzOptions& options) {
  const auto store = open_store(context, vars::Mode::ReadOnly, {options.name});
  if (!store) {
    return report(context.out, store.error());
  }
  std::vector<Item> items;
  if (const int code = select_items(context, *store, {options.name}, items); code != kOk) {
    return code;
  }
  if (items.size() != 1) {
    context.out.error(fmt::format("'{}' matches {} variables; hz takes one", options.name, items.size()));
    return kUsage;
  }
  if (context.values->here()) {
    be_gentle(context.node);
  } else {
    context.out.note(
        "values that come over the network are counted: a board sends a variable every 10 ms at most, or "
        "as <variable every> says");
  }
  Counter counter(*store, items.front());
  if (!counter.exact()) {
    context.out.note("this variable does not number its updates: changes seen at 1000 looks per second are counted");
  }
  const std::uint64_t reports = options.once ? 1 : options.count;
  const std::int64_t begin = rt::now_ns();
  std::int64_t report_at = begin + kReportNs;
  std::uint64_t done = 0;
  bool said = false;  // "no update yet" is said once
  for (std::int64_t next = begin;; next += kLookNs) {
    if (wait_until(next) == Woken::Signal && interrupted()) {
      return kOk;
    }
    const std::int64_t now = rt::now_ns();
    counter.look(now);
    next = std::max(next, now - kLookNs);
    const bool timed_out = options.timeout_ns > 0 && now - begin >= options.timeout_ns;
    if (now < report_at && !timed_out) {
      continue;
    }
    report_at += kReportNs;
    if (context.format == Format::Json || counter.window() > 0 || !said) {
      print(context, items.front(), counter);
      said = true;
    }
    if (!context.out.flush() || timed_out || (reports > 0 && ++done >= reports)) {
      return kOk;
    }
    if (context.values->here() && (store->retired() || !store_absence(context.node, store->header()).empty())) {
      context.out.error(fmt::format("node '{}' does not run any more", context.node));
      return kUnreachable;
    }
  }
}

Action declare_hz(base::Options& app, Context& context) {
  auto options = std::make_shared<HzOptions>();
  app.add("name", "NAME", options->name, "Variable").required().completes(base::Completion::Variable);
  app.add("-n,--count", "COUNT", options->count, "Stop after COUNT lines, one per second");
  app.flag("--once", options->once, "One line, after a second");
  add_time_option(app, "--timeout", options->timeout_ns, "Stop after this time");
  add_node_option(app, context);
  add_remote_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json});
  return [options](Context& c) { return hz(c, *options); };
}

}  // namespace

const Verb kHzVerb{
    "hz", "Variables", "Measure how often a variable is written",
    "Structs and arrays number their versions, so any rate is exact. Single numbers have no versions: only\n"
    "changes up to 1 kHz can be seen.\n"
    "Examples:\n"
    "  indurop hz 'station::*'\n",
    &declare_hz};

}  // namespace indurop::tools
