// SPDX-License-Identifier: Apache-2.0
#include "tools/plc/plc_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "plc/print/live.h"
#include "plc/print/print.h"
#include "tools/command/gentle.h"
#include "tools/command/rounds.h"
#include "tools/command/screen.h"
#include "tools/command/units.h"
#include "tools/plc/plc_file.h"
#include "tools/values/watch_source.h"

namespace indurop::tools {
namespace {

using plc::draw::Run;

struct Request {
  std::string file;
  std::string pou;
  std::string space;
  int rung = 0;  // 0: all
  double hz = 10;
  std::uint64_t count = 0;
  bool once = false;
  std::int64_t timeout_ns = 0;
};

// Reads the variables of the programs and draws them.
class Ladder {
 public:
  Ladder(Context& context, const Request& request, std::vector<plc::LiveProgram>& programs)
      : context_(context), request_(request), programs_(programs), source_(context.node, names()) {}

  Result<void, Failure> open() {
    if (auto opened = source_.open(context_); !opened) {
      const int code = report(context_.out, opened.error());
      context_.out.note("was the module built with `indurop plc build --watch`?");
      return Failure{code, {}};
    }
    be_gentle(source_.node());
    return check_sizes();
  }

  void sample() { source_.sample(context_, 0, SIZE_MAX); }

  [[nodiscard]] std::string heading() const {
    const Output& out = context_.out;
    return out.paint(Style::Bold, "node " + source_.node()) + "  " +
           (source_.alive() ? out.paint(Style::Good, "running") : out.paint(Style::Bad, source_.absence()));
  }

  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const plc::LiveProgram& program : programs_) {
      for (std::size_t n = 0; n < program.pictures.size(); ++n) {
        if (request_.rung == 0 || request_.rung == program.sheet.networks[n].number) {
          network(program, n, lines);
        }
      }
    }
    return lines;
  }

 private:
  [[nodiscard]] std::string full_name(const std::string& name) const {
    return request_.space.empty() ? name : request_.space + "::" + name;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const plc::LiveProgram& program : programs_) {
      if (!program.flow_variable.empty()) {
        names.push_back(full_name(program.flow_variable));
      }
      for (const plc::LiveValue& value : program.values) {
        names.push_back(full_name(value.variable));
      }
    }
    return names;
  }

  // The values come in the order of the names.
  Result<void, Failure> check_sizes() {
    std::size_t next = 0;
    for (const plc::LiveProgram& program : programs_) {
      const auto values = source_.values();
      if (!program.flow_variable.empty()) {
        if (values[next].bytes.size() != program.flow_bytes) {
          return Failure{
              kSchemaMismatch,
              fmt::format("the program that runs is not the one in {}; build it again and restart", request_.file)};
        }
        flow_[&program] = next++;
      }
      for (const plc::LiveValue& value : program.values) {
        shown_[{value.source.element, value.source.pin}] = {next++, value.type};
      }
    }
    return {};
  }

  [[nodiscard]] bool bit(const plc::LiveProgram& program, std::size_t number) const {
    const auto& bytes = source_.values()[flow_.at(&program)].bytes;
    return (static_cast<unsigned>(bytes[number / 8]) >> (number % 8) & 1U) != 0;
  }

  [[nodiscard]] plc::draw::Live live(const plc::LiveProgram& program) const {
    plc::draw::Live live;
    live.powered = [this, &program](const plc::network::Source& source) {
      const auto found = program.power.find({source.element, source.pin});
      return source.element->kind == plc::network::Element::Kind::LeftRail ||
             (found != program.power.end() && bit(program, found->second));
    };
    live.closed = [this, &program](const plc::network::Element& element) {
      const auto contact = program.closed.find(&element);
      const auto coil = program.power.find({&element, nullptr});
      return contact != program.closed.end() ? bit(program, contact->second)
                                             : coil != program.power.end() && bit(program, coil->second);
    };
    live.value = [this](const plc::network::Source& source) { return text_of(source); };
    return live;
  }

  [[nodiscard]] std::string text_of(const plc::network::Source& source) const {
    const auto found = shown_.find({source.element, source.pin});
    if (found == shown_.end()) {
      return {};
    }
    const WatchedValue& value = source_.values()[found->second.first];
    if (found->second.second == plc::Elementary::Time && value.bytes.size() == sizeof(std::int64_t)) {
      std::int64_t ns = 0;
      std::memcpy(&ns, value.bytes.data(), sizeof ns);
      return human_ns(ns);
    }
    return printable(schema::format_value(value.item.place.type, value.bytes));
  }

  void network(const plc::LiveProgram& program, std::size_t n, std::vector<std::string>& lines) const {
    const auto& drawn = program.sheet.networks[n];
    const auto remarks = plc::remarks_of(drawn);
    lines.push_back(context_.out.paint(
        Style::Dim, fmt::format("{} {} {}{}{}", program.pou, plc::network::word_of(program.language), drawn.number,
                                remarks.empty() ? "" : ": ", remarks.empty() ? "" : printable(remarks.front()))));
    for (const auto& row : plc::draw::draw_text(program.pictures[n], context_.out.unicode(), live(program))) {
      std::string line = "  ";
      for (const Run& run : row) {
        line += context_.out.paint(style_of(run.look), run.text);
      }
      lines.push_back(std::move(line));
    }
    lines.emplace_back();
  }

  static Style style_of(Run::Look look) {
    switch (look) {
      case Run::Look::Powered:
        return Style::Good;
      case Run::Look::Value:
        return Style::Accent;
      case Run::Look::Plain:
      case Run::Look::Name:
        break;
    }
    return Style::None;
  }

  Context& context_;
  const Request& request_;
  std::vector<plc::LiveProgram>& programs_;
  WatchSource source_;
  std::map<const plc::LiveProgram*, std::size_t> flow_;
  std::map<plc::LiveProgram::Key, std::pair<std::size_t, plc::Elementary>> shown_;
};

// On a terminal: as many lines as fit, painted in place.
class View {
 public:
  View(Context& context, Ladder& ladder) : context_(context), ladder_(ladder), screen_(context.out) {}

  void run(Rounds rounds) {
    bool key = false;
    while (rounds.wait(screen_.key_file(), key)) {
      if (key && !handle_keys()) {
        return;
      }
      if (!rounds.due() && !key) {
        continue;
      }
      if (!key) {
        rounds.done();
      }
      ladder_.sample();
      screen_.paint(page());
      if (!context_.out.flush()) {
        return;
      }
    }
  }

 private:
  [[nodiscard]] std::size_t room() const {
    constexpr int kOtherLines = 3;  // heading, footer, the cursor's
    return static_cast<std::size_t>(std::max(1, context_.out.extent().rows - kOtherLines));
  }

  std::vector<std::string> page() {
    const std::vector<std::string> all = ladder_.lines();
    last_ = all.size() > room() ? all.size() - room() : 0;
    first_ = std::min(first_, last_);
    std::vector<std::string> lines{ladder_.heading()};
    lines.insert(lines.end(), all.begin() + static_cast<std::ptrdiff_t>(first_),
                 all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), first_ + room())));
    lines.push_back(context_.out.paint(Style::Dim, last_ == 0 ? "q quit" : "j k f b scroll, q quit"));
    return lines;
  }

  // False if the user wants to end.
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
  Ladder& ladder_;
  Screen screen_;
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

int watch(Context& context, const Request& request) {
  std::string bytes;
  if (!read_plc_file(context, request.file, bytes)) {
    return kFailed;
  }
  plc::Diagnostics diagnostics;
  plc::plcopen::Document document = plc::plcopen::read_document(bytes, request.file, diagnostics);
  auto programs = plc::live_programs(document, request.pou, diagnostics);
  if (diagnostics.failed()) {
    print_diagnostics(context, diagnostics.list());
    return kCheckFailed;
  }
  if (programs.empty()) {
    context.out.error(fmt::format("{} has no program in LD or FBD{}", request.file,
                                  request.pou.empty() ? "" : " named " + request.pou));
    return kFailed;
  }
  Ladder ladder(context, request, programs);
  if (const auto opened = ladder.open(); !opened) {
    return report(context.out, opened.error());
  }
  const bool live = context.out.terminal() && !request.once;
  Rounds rounds(request.hz, live ? request.count : std::max<std::uint64_t>(request.count, 1), request.timeout_ns);
  if (live) {
    View(context, ladder).run(rounds);
    return kOk;
  }
  for (bool key = false; rounds.wait(-1, key); rounds.done()) {
    ladder.sample();
    context.out.line(ladder.heading());
    for (const std::string& line : ladder.lines()) {
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
  auto request = std::make_shared<Request>();
  constexpr int kMostRungs = 1'000'000;
  base::Options& made =
      app.command("watch", "Show a running ladder or function block diagram with its power flow",
                  [request, chosen] { *chosen = [request](Context& c) { return watch(c, *request); }; });
  made.add("file", "FILE.xml", request->file, "The PLCopen XML file it was built from, with --watch").required();
  made.add("--pou", "NAME", request->pou, "This program only");
  made.add("--rung", "N", request->rung, "This rung or network only").range(1, kMostRungs);
  made.add("--namespace", "NAME", request->space,
           "Namespace of its shared variables, where several have such a program");
  constexpr double kMostHz = 100;
  constexpr double kLeastHz = 0.001;
  made.add("--hz", "RATE", request->hz, "Rounds per second (default 10)").range(kLeastHz, kMostHz);
  made.add("-n,--count", "COUNT", request->count, "Stop after COUNT rounds (in a pipe: 1)");
  made.flag("--once", request->once, "One round");
  add_time_option(made, "--timeout", request->timeout_ns, "Stop after this time");
  add_node_option(made, context);
}

}  // namespace indurop::tools
