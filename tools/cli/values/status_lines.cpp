// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/values/status_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <map>

#include "core/base/duration.h"
#include "deploy/words/deployment_words.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

constexpr double kNanosInMicro = 1000;

Style style_of(const std::string& state) {
  return state == "alive" ? Style::Good : state == "absent" ? Style::Warn : Style::Bad;
}

// Tells whether this board leads the variables that a standby sends too.
std::string lead_of(const MirrorView& view, const std::string& board) {
  std::map<std::string, int> owners;
  for (const mirror::MirroredVariable& one : view.variables) {
    ++owners[one.name];
  }
  int shared = 0;
  int led = 0;
  for (const mirror::MirroredVariable& one : view.variables) {
    if (one.owner == board && owners[one.name] > 1) {
      ++shared;
      led += one.leads ? 1 : 0;
    }
  }
  if (shared == 0) {
    return "";
  }
  if (led == 0) {
    return fmt::format("  standby of {} variable{}", shared, shared == 1 ? "" : "s");
  }
  return fmt::format("  leads {} variable{} with a standby", led, led == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> header_lines(const NodeReport& report, const Output& output) {
  std::vector<std::string> lines;
  std::string first = output.paint(Style::Bold, report.node) + "  " +
                      output.paint(report.alive && !report.hung() ? Style::Good : Style::Bad, report.state);
  if (report.alive) {
    first += fmt::format("  pid {}", report.pid);
    if (report.uptime_ns > 0) {
      first += "  up " + human_age(report.uptime_ns);
    }
  }
  lines.push_back(first + "  " + printable(report.config_file));
  if (!report.deployment.empty()) {
    lines.push_back("  deployed  " + deploy::shown_id(report.deployment));
  }
  if (!report.stop_reason.empty()) {
    lines.push_back("  reason    " + printable(report.stop_reason));
  }
  if (report.basic_period_ns > 0) {
    lines.push_back(fmt::format("  schedule  basic period {}, macro period {}, tick {}, {}",
                                base::format_duration(base::Nanos(report.basic_period_ns)),
                                base::format_duration(base::Nanos(report.macro_period_ns)), report.ticks,
                                counted(report.lost_ticks, "lost tick")));
  }
  if (report.schedule > 1) {
    lines.push_back(fmt::format("            schedule {} since tick {}: {}", report.schedule, report.schedule_tick,
                                printable(report.schedule_file)));
  }
  if (report.lateness.count > 0) {
    lines.push_back(fmt::format("  lateness  p50 {}, p99 {}, max {}", human_ns(report.lateness.p50),
                                human_ns(report.lateness.p99), human_ns(report.lateness.max)));
  }
  if (report.pulse_wanted_ns > 0) {
    lines.push_back(fmt::format("  pulse     SYNC0 {:.3f} us after the frames of a tick, {:+.3f} us off",
                                static_cast<double>(report.pulse_after_ns) / kNanosInMicro,
                                static_cast<double>(report.pulse_after_ns - report.pulse_wanted_ns) / kNanosInMicro));
  }
  lines.push_back("  obtained  " + output.paint(report.rt.fifo != 0 ? Style::None : Style::Warn, rt_text(report.rt)));
  if (!report.same_core.empty()) {
    const std::string others = fmt::format(
        "shares core {} with {}: their ticks delay each other; choose another with "
        "--core",
        report.rt.tick_core, fmt::join(report.same_core, ", "));
    lines.push_back("            " + output.paint(Style::Warn, others));
  }
  const std::string why = fixed_text(report.rt.why);
  if (!why.empty()) {
    lines.push_back("            " + output.paint(Style::Warn, printable(why)));
  }
  return lines;
}

std::vector<std::string> mirror_lines(const MirrorView& view, const Output& output) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "  plant     {}, board {}, DDS domain {}, {}; sends {} in {} of up to 1300 bytes, {} so far",
      printable(view.plant), printable(view.board), view.domain,
      view.up ? output.paint(Style::Good, "in the network") : output.paint(Style::Bad, "not in the network yet"),
      counted(view.outgoing, "variable"), counted(view.parts, "frame"), counted(view.frames, "frame")));
  if (!view.problem.empty()) {
    lines.push_back("            " + output.paint(Style::Warn, printable(view.problem)));
  }
  for (const PeerView& peer : view.peers) {
    std::string line =
        fmt::format("  board     {}  {}", printable(peer.name), output.paint(style_of(peer.state), peer.state));
    if (peer.wanted > 0) {
      line += fmt::format("  {} from it, {}, {}, {} lost", counted(peer.wanted, "variable"),
                          peer.heard_ns < 0 ? std::string("never heard") : "heard " + human_ns(peer.heard_ns) + " ago",
                          counted(peer.frames, "frame"), counted(peer.lost_updates, "update"));
    }
    line += lead_of(view, peer.name);
    if (peer.clock_known) {
      line += fmt::format("  clocks {} apart (+-{}){}", human_ns(std::abs(peer.clock_offset_ns)),
                          human_ns(peer.clock_bound_ns),
                          view.clock_synchronised && peer.clock_synchronised ? "" : ", not synchronized");
    }
    lines.push_back(line);
    if (!peer.problem.empty()) {
      lines.push_back("            " + output.paint(Style::Bad, printable(peer.problem)));
    }
  }
  return lines;
}

std::vector<std::string> external_lines(const ExternalView& view, const Output& output) {
  std::vector<std::string> lines;
  std::string line = fmt::format("other tools: DDS domain {}, {}, {} with readers", view.domain,
                                 counted(view.topics, "topic"), view.read);
  if (view.writable > 0) {
    line += fmt::format(", {} can be set ({} taken, {} refused)", view.writable, counted(view.received, "value"),
                        view.refused);
  }
  if (!view.up) {
    line += output.paint(Style::Bad, ", not in the network yet");
  }
  lines.push_back(line);
  if (!view.problem.empty()) {
    lines.push_back("            " + output.paint(Style::Warn, printable(view.problem)));
  }
  return lines;
}

}  // namespace indurop::tools
