// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/repeat.h"

#include <chrono>
#include <string>

#include "core/base/duration.h"
#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::chrono::milliseconds kShortest{10};

}  // namespace

void add_repeat_options(base::Options& app, Repeat& repeat) {
  app.flag("-w,--watch", repeat.on, "Repeat every second until Ctrl-C");
  app.flag("--once", repeat.once, "Print once (the default without -w)");
  app.add("-n,--count", "COUNT", repeat.count, "COUNT rounds");
  add_time_option(app, "--interval", repeat.interval_ns, "With -w: time between rounds, at least 10 ms (default 1 s)")
      .check([](const std::string& text) {
        const base::DurationText read = base::read_duration(text, true, base::PlainNumber::Seconds);
        return read.value && *read.value < kShortest ? "'" + text + "' is too short; 10 ms is the shortest" : "";
      });
  add_time_option(app, "--timeout", repeat.timeout_ns, "With -w: stop after this time");
}

int repeat_rounds(Context& context, const Repeat& repeat, const std::function<int()>& round) {
  const bool repeated = repeat.on || repeat.count > 0;
  if (!repeated || repeat.once) {
    return round();
  }
  const std::int64_t interval = repeat.interval_ns;
  const std::int64_t begin = rt::now_ns();
  const bool repaint = context.out.terminal() && context.format == Format::Table;
  int code = kOk;
  for (std::uint64_t n = 1;; ++n) {
    if (repaint) {
      context.out.write("\x1b[H\x1b[J");
    }
    code = round();
    if (!context.out.flush() || (repeat.count > 0 && n >= repeat.count)) {
      return code;
    }
    const std::int64_t next = begin + static_cast<std::int64_t>(n) * interval;
    if (repeat.timeout_ns > 0 && next > begin + repeat.timeout_ns) {
      return code;
    }
    if (wait_until(next) == Woken::Signal && interrupted()) {
      return code;
    }
  }
}

}  // namespace indurop::tools
