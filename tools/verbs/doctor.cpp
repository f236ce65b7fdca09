// SPDX-License-Identifier: Apache-2.0
// indurop doctor: is this machine fit for real time, and what to do if not.
#include <fmt/format.h>

#include <algorithm>

#include "scheduler/quantile.h"
#include "tools/command/interrupt.h"
#include "tools/doctor/doctor_checks.h"
#include "tools/doctor/doctor_latency.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  LatencyTest test;
  bool no_test = false;
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

int doctor(Context& context, const Options& options) {
  auto findings = examine_machine();
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

Action declare(base::Options& app, Context& context) {
  auto options = std::make_shared<Options>();
  add_time_option(app, "--duration", options->test.duration_ns, "Length of the wake-up test (default 2 s)");
  app.flag("--no-test", options->no_test, "Without the wake-up test");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return doctor(c, *options); };
}

}  // namespace

const Verb kDoctorVerb{
    "doctor", "Before it runs", "Show whether this machine is fit for real time, and what to do if not",
    "Looks at the kernel, clocks, cores, rights, memory and disk, then measures for two seconds how late a thread is\n"
    "woken up every millisecond. What a running node was really granted is in `indurop status`.\n"
    "Exit code 0 if nothing is marked FAIL, else 1.\n"
    "Examples:\n"
    "  indurop doctor\n"
    "  indurop doctor -o json\n",
    &declare};

}  // namespace indurop::tools
