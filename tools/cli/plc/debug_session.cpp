// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/debug_session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "control/plc/print/expression_text.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr int kLookMs = 50;
constexpr const char* kHelp =
    "  break LINE   stand there: 12, motor.st:12, rung 3, main rung 3, or the name of a POU; also: b\n"
    "  delete LINE  remove it, without LINE all; breaks lists them\n"
    "  until LINE   go on until that line\n"
    "  continue     go on to the next breakpoint (c)\n"
    "  step         the next line, also inside of calls (s)\n"
    "  next         the next line of this body (n)\n"
    "  out          back to the caller (o)\n"
    "  scan [N]     one scan on, or N\n"
    "  back         to the line before, with the values of then\n"
    "  print [NAME ...]  values, without NAME all of this body (p)\n"
    "  globals      shared variables as this scan sees them\n"
    "  where        the calls that lead here; up and down choose one\n"
    "  list         the lines around (l)\n"
    "  set NAME=VALUE  writes a shared variable, for the next scan\n"
    "  quit         end the simulation (q)";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

DebugSession::DebugSession(Context& context, const plc::Compiled& compiled, DebugLink& link, DebuggedNode& node,
                           bool ends)
    : context_(context), code_(compiled), link_(link), node_(node), prompts_(::isatty(STDIN_FILENO) == 1), ends_(ends) {
  for (const plc::ModuleText& module : compiled.modules) {
    for (const plc::DebugTable::Line& line : module.debug.lines) {
      if (first_file_.empty() && line.at.file != nullptr) {
        first_file_ = *line.at.file;
      }
    }
  }
}

int DebugSession::run() {
  bool met = false;
  for (;;) {
    if (const auto stop = link_.wait(kLookMs)) {
      met = true;
      if (!meet(*stop)) {
        return kOk;
      }
      continue;
    }
    if (const auto code = node_.ended()) {
      context_.out.note(met ? "the simulation has ended" : "the simulation has ended before the program ran");
      return *code;
    }
    if (interrupted()) {  // interrupted, and no module runs
      return interrupt_code();
    }
  }
}

bool DebugSession::meet(const DebugStop& stop) {
  const plc::ModuleText* module = code_.module(stop.module);
  if (module == nullptr || module->debug.mark != stop.mark ||
      (stop.kind != DebugStop::Kind::Begin && stop.line >= module->debug.lines.size())) {
    context_.out.error(
        fmt::format("module {} is not of these files: build it again with indurop plc build --debug", stop.module));
    return false;
  }
  if (!began_ns_) {
    began_ns_ = stop.time_ns;
  }
  if (stop.kind == DebugStop::Kind::Begin) {
    begin_of_scan(stop);
    return true;
  }
  if (aim_ != Aim::Run && aim_ != Aim::Scan && !stop_line_.empty() && is_same_line(stop_, stop)) {
    stop_.line = stop.line;
    go_on(mode_of_aim());
    return true;
  }
  std::erase_if(breakpoints_, [](const Breakpoint& one) { return one.once; });
  stand_at(stop);
  return prompt();
}

void DebugSession::stand_at(const DebugStop& stop) {
  stop_ = stop;
  stop_line_ = code_.line(table(), stop_.line).name;
  frame_ = 0;
  print_place();
}

void DebugSession::begin_of_scan(const DebugStop& stop) {
  stop_.module = stop.module;
  bool stand = aim_ == Aim::Into || aim_ == Aim::Over || aim_ == Aim::Out || interrupted();
  if (aim_ == Aim::Scan && scans_left_ > 0) {
    stand = --scans_left_ == 0;
  }
  stop_line_.clear();
  history_.note_scan();
  go_on(stand ? DebugMode::Into : DebugMode::ToBreakpoint);
}

// Returns true for a further statement of the same line, but not for the same line again in a loop.
bool DebugSession::is_same_line(const DebugStop& before, const DebugStop& next) {
  return next.kind == DebugStop::Kind::Line && next.module == before.module && next.time_ns == before.time_ns &&
         next.frames.size() == before.frames.size() && next.line > before.line &&
         code_.line(table(), next.line).name == code_.line(table(), before.line).name;
}

DebugMode DebugSession::mode_of_aim() const {
  return aim_ == Aim::Into ? DebugMode::Into : aim_ == Aim::Over ? DebugMode::Over : DebugMode::Out;
}

void DebugSession::go_on(DebugMode mode) {
  std::vector<std::uint32_t> numbers;
  for (const Breakpoint& one : breakpoints_) {
    const auto found = one.at.numbers.find(stop_.module);
    if (found != one.at.numbers.end()) {
      numbers.insert(numbers.end(), found->second.begin(), found->second.end());
    }
  }
  std::sort(numbers.begin(), numbers.end());
  link_.answer(mode, numbers);
  history_.add({mode, std::move(numbers)});
}

std::string DebugSession::time_of(const DebugStop& stop) const {
  return plc::duration_text(stop.time_ns - *began_ns_);
}

void DebugSession::print_place() {
  Output& out = context_.out;
  if (stop_.kind == DebugStop::Kind::Fault) {
    out.line(out.paint(Style::Bad, fmt::format("{}  fault: {}", time_of(stop_), stop_.why)));
  }
  if (stop_.line < table().lines.size()) {
    const CodeLine line = code_.line(table(), stop_.line);
    const std::string code = line.text.empty() ? std::string()  // a drawing
                                               : fmt::format(" in {}  {}", table().lines[stop_.line].pou->title(),
                                                             out.paint(Style::Bold, trimmed(line.text)));
    out.line(fmt::format("{}  {}{}", out.paint(Style::Dim, time_of(stop_)), line.name, code));
  }
}

bool DebugSession::prompt() {
  for (std::string line;;) {
    if (prompts_) {
      context_.out.write("(plc) ");
    }
    context_.out.flush();
    if (!std::getline(std::cin, line)) {
      return false;
    }
    if (const auto done = obey(trimmed(line))) {
      return *done;
    }
  }
}

// Returns true if the program continues.
bool DebugSession::aim(Aim aim) {
  aim_ = aim;
  const bool free = aim == Aim::Run || aim == Aim::Scan;
  go_on(free ? DebugMode::ToBreakpoint : mode_of_aim());
  return true;
}

std::optional<bool> DebugSession::obey(const std::string& line) {
  const std::size_t space = std::min(line.find(' '), line.size());
  const std::string verb = line.substr(0, space);
  const std::string rest = trimmed(line.substr(space));
  if (verb == "q" || verb == "quit") {
    return false;
  }
  if (verb == "back") {
    return go_back() ? std::nullopt : std::optional(false);
  }
  if (const auto gone = travel(verb, rest)) {
    return gone;
  }
  show_values(verb, rest);
  return std::nullopt;
}

// Nothing: the program remains stopped.
std::optional<bool> DebugSession::travel(const std::string& verb, const std::string& rest) {
  if ((verb == "c" || verb == "continue") && can_stop()) {
    return aim(Aim::Run);
  }
  if (verb == "s" || verb == "step") {
    return aim(Aim::Into);
  }
  if (verb == "n" || verb == "next") {
    return aim(Aim::Over);
  }
  if (verb == "o" || verb == "out") {
    return aim(Aim::Out);
  }
  if (verb == "scan") {
    std::istringstream(rest.empty() ? "1" : rest) >> scans_left_;
    scans_left_ = std::max<std::uint64_t>(scans_left_, 1);
    return aim(Aim::Scan);
  }
  if (verb == "until") {
    const std::size_t before = breakpoints_.size();
    add_breakpoint(rest, true);
    return breakpoints_.size() > before ? std::optional(aim(Aim::Run)) : std::nullopt;
  }
  return std::nullopt;
}

// Returns false if the program cannot be brought anywhere.
bool DebugSession::go_back() {
  DebugBack back(node_, link_, history_,
                 [this](const DebugStop& before, const DebugStop& next) { return is_same_line(before, next); });
  if (const auto stop = back.line_before()) {
    stand_at(*stop);
  } else {
    context_.out.error(back.is_lost() ? "the simulation did not take the same way again: start it again"
                                      : "the program has not run an earlier line");
  }
  return !back.is_lost();
}

void DebugSession::show_values(const std::string& verb, const std::string& rest) {
  if (verb == "b" || verb == "break") {
    add_breakpoint(rest, false);
  } else if (verb == "d" || verb == "delete") {
    remove_breakpoint(rest);
  } else if (verb == "breaks") {
    for (const Breakpoint& one : breakpoints_) {
      context_.out.line(fmt::format("{}  {}", one.at.line.name, trimmed(one.at.line.text)));
    }
  } else if (verb == "p" || verb == "print") {
    print(rest);
  } else if (verb == "globals") {
    for (const std::string& one : debug_values(table().globals, stop_.globals)) {
      context_.out.line(one);
    }
  } else if (verb == "w" || verb == "where") {
    where();
  } else if ((verb == "up" && frame_ + 1 < stop_.frames.size()) || (verb == "down" && frame_ > 0)) {
    frame_ = verb == "up" ? frame_ + 1 : frame_ - 1;
    where();
  } else if (verb == "l" || verb == "list") {
    for (const std::string& one : code_.around(table(), stop_.line)) {
      context_.out.line(one);
    }
  } else if (verb == "set") {
    set(rest);
  } else if (verb == "c" || verb == "continue") {
    context_.out.error(
        "nothing would stop the program again: set a breakpoint before (break LINE), or end the simulation with "
        "--until 10s");
  } else if (verb == "h" || verb == "help") {
    context_.out.line(kHelp);
  } else if (!verb.empty() && verb.front() != '#') {  // '#' begins a comment in a script
    context_.out.error(fmt::format("'{}' is not possible here; help says what is", verb));
  }
}

void DebugSession::print(const std::string& names) {
  if (names.empty()) {
    if (frame_ >= stop_.frames.size()) {
      return;
    }
    const DebugStop::Frame& frame = stop_.frames[frame_];
    for (const std::string& one : debug_values(table().frames.at(frame.number).layout, frame.values)) {
      context_.out.line(one);
    }
    return;
  }
  std::istringstream stream(names);
  for (std::string name; stream >> name;) {
    const std::string value = debug_value(table(), stop_, frame_, name);
    if (value.empty()) {
      context_.out.error(fmt::format("there is no '{}' here with a value to show; print shows what there is", name));
    } else {
      context_.out.line(fmt::format("{} = {}", name, value));
    }
  }
}

void DebugSession::where() {
  for (std::size_t i = 0; i < stop_.frames.size(); ++i) {
    context_.out.line(
        fmt::format("{} {}", i == frame_ ? ">" : " ", table().frames.at(stop_.frames[i].number).pou->title()));
  }
}

void DebugSession::add_breakpoint(const std::string& what, bool once) {
  const bool here = stop_.line < table().lines.size() && table().lines[stop_.line].at.file != nullptr;
  const auto found = code_.find(what, here ? *table().lines[stop_.line].at.file : first_file_);
  if (!found) {
    context_.out.error(
        fmt::format("there is no code at '{}'; write 12, motor.st:12, rung 3 or the name of a POU", what));
    return;
  }
  if (!once) {
    context_.out.line(fmt::format("{}  {}", found->line.name, trimmed(found->line.text)));
  }
  breakpoints_.push_back({*found, once});
}

void DebugSession::remove_breakpoint(const std::string& what) {
  const auto found = what.empty() ? std::nullopt : code_.find(what, first_file_);
  const auto gone = std::erase_if(breakpoints_, [&](const Breakpoint& one) {
    return what.empty() || one.at.asked == what || (found && one.at.line.name == found->line.name);
  });
  if (gone == 0) {
    context_.out.error("there is no such breakpoint; breaks lists them");
  }
}

void DebugSession::set(const std::string& assignment) {
  context_.out.flush();
  const std::size_t space = assignment.find(' ');
  const bool pair = assignment.find('=') == std::string::npos && space != std::string::npos;
  const std::string text = pair ? assignment.substr(0, space) + "=" + trimmed(assignment.substr(space)) : assignment;
  if (const std::string problem = node_.set(text, false); !problem.empty()) {
    context_.out.error(problem);
  }
  history_.add_set(text);
}

}  // namespace indurop::tools
