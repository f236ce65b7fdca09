// SPDX-License-Identifier: Apache-2.0
// indurop doctor: checks whether this machine is fit for real time, and gives advice.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "core/rt/machine.h"
#include "core/rt/thread.h"
#include "scheduler/quantile.h"
#include "store/vars/retain.h"
#include "tools/cli/doctor/bus_interface.h"
#include "tools/cli/doctor/doctor_checks.h"
#include "tools/cli/doctor/doctor_latency.h"
#include "tools/cli/doctor/interrupts.h"
#include "tools/cli/doctor/tuning.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/run_report.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"
#include "tools/console/table_text.h"

namespace indurop::tools {
namespace {

struct DoctorOptions {
  LatencyTest test;
  bool no_test = false;
  bool apply = false;
  std::vector<std::string> buses;
  std::optional<int> core;
};

Style style_of(Grade grade) {
  switch (grade) {
    case Grade::Ok:
      return Style::Good;
    case Grade::Warn:
      return Style::Warn;
    case Grade::Fail:
      return Style::Bad;
  }
  return Style::None;
}

// Breaks `text` into lines of at most `width` characters at spaces.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines;
}

void print_finding(Context& context, const Finding& finding) {
  constexpr std::size_t kIndent = 23;
  context.out.line(fmt::format("{}{}  {:<15}  {}", context.out.paint(style_of(finding.grade), to_text(finding.grade)),
                               finding.grade == Grade::Ok ? "  " : "", finding.name, finding.found));
  if (finding.advice.empty()) {
    return;
  }
  const auto columns = static_cast<std::size_t>(std::clamp(context.out.extent().columns, 60, 110));
  for (const std::string& line : wrapped(finding.advice, columns - kIndent)) {
    context.out.line(std::string(kIndent, ' ') + context.out.paint(Style::Dim, line));
  }
}

int verdict(Context& context, const std::vector<Finding>& findings) {
  const auto count = [&findings](Grade grade) {
    return std::count_if(findings.begin(), findings.end(), [grade](const Finding& f) { return f.grade == grade; });
  };
  const bool fit = count(Grade::Fail) == 0;
  if (context.format == Format::Table) {
    context.out.line();
    context.out.line(fmt::format("{}  {} OK, {} WARN, {} FAIL: {}",
                                 context.out.paint(fit ? Style::Good : Style::Bad, fit ? "FIT" : "NOT FIT"),
                                 count(Grade::Ok), count(Grade::Warn), count(Grade::Fail),
                                 fit ? "InduRoP runs here with real-time priority" : "see what is marked FAIL"));
    return fit ? kOk : kFailed;
  }
  Table table({{"CHECK", "name"}, {"GRADE", "grade"}, {"FOUND", "found"}, {"ADVICE", "advice"}});
  for (const Finding& finding : findings) {
    table.add({Cell(finding.name), Cell(to_text(finding.grade)), Cell(finding.found), Cell(finding.advice)});
  }
  print_table(context, table, {{"fit", fit}}, "checks");
  return fit ? kOk : kFailed;
}

// One record for all boards of this machine, not of one node.
std::filesystem::path tuning_record() {
  return vars::state_directory("machine") / "tuning.json";
}

// Returns "p50 12 us, p99 40 us, at worst 90 us".
std::string wake_up_test(const DoctorOptions& options) {
  const LatencyResult result = measure_latency(options.test);
  const auto summary = scheduler::summarize(*result.lateness);
  return fmt::format("p50 {}, p99 {}, at worst {}", human_ns(summary.p50), human_ns(summary.p99),
                     human_ns(summary.max));
}

void print_tuning(Context& context, const Tuning& tuning, int core) {
  Table table({{"SETTING", "file"}, {"NOW", "now"}, {"WANTED", "wanted"}, {"WHY", "why"}});
  for (const Setting& setting : tuning.settings) {
    table.add({Cell(setting.file), Cell(setting.now), Cell(setting.wanted), Cell(setting.why)});
  }
  if (context.format != Format::Table) {
    print_table(context, table, {{"core", core}, {"boot", tuning.boot}, {"hints", tuning.hints}}, "settings");
    return;
  }
  if (table.empty()) {
    context.out.line("nothing to set while the machine runs");
  } else {
    context.out.write(table_text(table, context.out));
  }
  if (!tuning.boot.empty()) {
    context.out.line(
        fmt::format("for the kernel's command line, if core {} is the node's alone (GRUB_CMDLINE_LINUX in "
                    "/etc/default/grub, then update-grub): {}",
                    core, fmt::join(tuning.boot, " ")));
  }
  for (const std::string& hint : tuning.hints) {
    context.out.line(hint);
  }
}

int report_refused(Context& context, const std::vector<std::string>& refused) {
  for (const std::string& line : refused) {
    context.out.note("refused: " + line);
  }
  return kOk;
}

int undo(Context& context, const DoctorOptions& /*options*/) {
  const auto undone = undo_tuning(tuning_record());
  if (!undone) {
    context.out.error(undone.error().text);
    return kFailed;
  }
  context.out.note(fmt::format("{} settings restored", undone->settings));
  return report_refused(context, undone->refused);
}

int apply(Context& context, const DoctorOptions& options, const Tuning& tuning) {
  if (::geteuid() != 0) {
    context.out.error("settings of the kernel need root: sudo indurop doctor tune --apply");
    return kFailed;
  }
  const std::string before = options.no_test ? "" : wake_up_test(options);
  const auto refused = apply_tuning(tuning, tuning_record());
  if (!refused) {
    context.out.error(refused.error().text);
    return kFailed;
  }
  context.out.note(fmt::format("{} settings made; indurop doctor undo or a reboot restores the previous ones",
                               tuning.settings.size() - refused->size()));
  if (!options.no_test) {
    context.out.note(fmt::format("wake-ups were late by {} before, {} now", before, wake_up_test(options)));
  }
  return report_refused(context, *refused);
}

int core_of_a_node(const DoctorOptions& options) {
  const auto cores = rt::allowed_cores();
  return options.core.value_or(cores.empty() ? 0 : cores.back());
}

// Returns the cores of the running nodes; if none runs: the core that a new node would use.
std::vector<int> cores_of_ticks(const DoctorOptions& options) {
  std::set<int> cores;
  for (const std::string& node : options.core ? std::vector<std::string>() : vars::list_nodes()) {
    const auto run = RunView::open(node);
    if (const NodeReport report = run.ok() ? report_of(node, run.value()) : NodeReport();
        report.alive && report.rt.pinned != 0) {
      cores.insert(report.rt.tick_core);
      for (std::uint32_t i = 0; i < run.value().module_count(); ++i) {
        cores.insert(run.value().module(i).core);
      }
    }
  }
  cores.erase(-1);  // not pinned
  return cores.empty() ? std::vector<int>{core_of_a_node(options)} : std::vector<int>(cores.begin(), cores.end());
}

int tune(Context& context, const DoctorOptions& options) {
  const int core = core_of_a_node(options);
  const Tuning tuning = examine_tuning(core);
  print_tuning(context, tuning, core);
  return options.apply ? apply(context, options, tuning) : kOk;
}

int check(Context& context, const DoctorOptions& options) {
  auto findings = examine_machine();
  findings.push_back(examine_interrupts(cores_of_ticks(options)));
  for (const std::string& bus : options.buses) {
    const auto more = examine_interface(bus, facts_of_interface(bus), rt::kernel_is_preempt_rt());
    findings.insert(findings.end(), more.begin(), more.end());
  }
  if (context.format == Format::Table) {
    for (const Finding& finding : findings) {
      print_finding(context, finding);
    }
    context.out.flush();
  }
  if (!options.no_test) {
    const LatencyResult result = measure_latency(options.test);
    if (interrupted()) {
      return kOk;
    }
    const auto summary = scheduler::summarize(*result.lateness);
    findings.push_back(grade_latency(summary.p50, summary.p99, summary.max, summary.count, result.real_time));
    if (context.format == Format::Table) {
      print_finding(context, findings.back());
    }
  }
  return verdict(context, findings);
}

Action declare_doctor(base::Options& app, Context& context) {
  auto options = std::make_shared<DoctorOptions>();
  auto chosen = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help,
                        int (*act)(Context&, const DoctorOptions&)) -> base::Options& {
    return app.command(name, help,
                       [options, chosen, act] { *chosen = [options, act](Context& c) { return act(c, *options); }; });
  };
  const auto with_test = [&](base::Options& made) {
    add_time_option(made, "--duration", options->test.duration_ns, "Length of the wake-up test (default 2 s)");
    made.flag("--no-test", options->no_test, "Skip the wake-up test");
  };
  base::Options& checking = verb("check", "Check the machine and measure how late threads are woken", &check);
  with_test(checking);
  checking.add("--core", "N", options->core, "Core that interrupts must not reach (default: those of running nodes)");
  checking.add("--bus", "INTERFACE ...", options->buses,
               "Network interfaces of an EtherCAT bus, to be checked as well");
  base::Options& tuning =
      verb("tune", "Show kernel settings that real time needs and that differ on this machine", &tune);
  tuning.flag("--apply", options->apply, "Apply these settings until the next reboot (needs root)");
  tuning.add("--core", "N", options->core, "Core to keep free of interrupts (default: the last)");
  with_test(tuning);
  verb("undo", "Restore the settings that tune --apply has changed (needs root)", &undo);
  app.usual_command("check");
  app.moved("--tune", "indurop doctor tune");
  app.moved("--apply", "indurop doctor tune --apply");
  app.moved("--undo", "indurop doctor undo");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kDoctorVerb{
    "doctor", "Before it runs", "Show whether this machine is fit for real time, and what to do if not",
    "Checks the kernel, clocks, cores, privileges, memory and disk, then measures for two seconds how late\n"
    "a thread is woken every millisecond. `indurop status` shows what a running node was granted. Exit code\n"
    "0 if nothing is marked FAIL, else 1.\n"
    "Examples:\n"
    "  indurop doctor\n"
    "  indurop doctor -o json\n"
    "  indurop doctor check --bus eth1\n"
    "  indurop doctor tune\n"
    "  sudo indurop doctor tune --apply\n"
    "  sudo indurop doctor undo\n",
    &declare_doctor};

}  // namespace indurop::tools
