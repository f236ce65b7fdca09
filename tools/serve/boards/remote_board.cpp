// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/remote_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/rt/clock.h"
#include "history/alarms/alarm_list.h"
#include "store/operate/item.h"
#include "tools/client/board/board_run.h"
#include "tools/serve/door/request.h"
#include "tools/serve/leases/lease_desk.h"

namespace indurop::serve {
namespace {

using base::Json;

// A command has one line for each value: a text of several lines would be a different command.
bool one_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

std::uint64_t number_of(const Json& row, const char* what) {
  return row[what].natural().value_or(0);
}

Json newest(const Json& list, std::uint64_t count) {
  const auto all = list.values();
  Json out = Json::array();
  for (std::size_t i = all.size() - std::min<std::size_t>(all.size(), count); i < all.size(); ++i) {
    out.push_back(all[i]);
  }
  return out;
}

Refused not_done(const tools::Failure& failure) {
  return {failure.code == kUnreachable ? status::kNoAnswer : status::kWrongValue, {failure.text}};
}

// A command with the values of the request, and their names.
std::pair<tools::PlantWatch::RemoteOrder, std::vector<std::string>> order_of(tools::PlantWatch::RemoteOrder::What what,
                                                                             const WriteRequest& request) {
  std::pair<tools::PlantWatch::RemoteOrder, std::vector<std::string>> out{{what, {}, request.for_ns, {}, {}}, {}};
  for (const auto& [name, value] : request.values) {
    out.first.lines.push_back(name + "=" + value);
    out.second.push_back(name);
  }
  return out;
}

}  // namespace

RemoteBoard::RemoteBoard(std::shared_ptr<tools::ReportedBoard> reported, std::size_t reader, tools::PlantWatch* watch)
    : Board(reported->name()), reported_(std::move(reported)), reader_(reader), watch_(watch) {}

void RemoteBoard::refresh() {
  const auto report = reported_->report();
  if (reported_->generation() != generation()) {
    const std::uint64_t current = reported_->generation();
    if (auto fresh = reported_->attach(reader_); fresh.ok()) {
      attach(std::move(fresh).value(), current);
    }
  }
  set_absence(report.running ? std::string() : report.state);
}

void RemoteBoard::want() const {
  reported_->want(rt::now_ns());
}

std::string RemoteBoard::state() const {
  return absence().empty() ? reported_->report().state : absence();
}

std::string RemoteBoard::steady_state() const {
  return alive() || reported_->report().heard ? state() : "not heard";
}

std::string RemoteBoard::no_store() const {
  return fmt::format("the variables of board {} have not come yet: it is {}", name(), state());
}

Json RemoteBoard::forces() const {
  return reported_->report().forces;
}

Json RemoteBoard::lock() const {
  return reported_->report().lock;
}

std::optional<alarms::AlarmCounts> RemoteBoard::reported_alarms() const {
  return alarms::counts_in(reported_->report().alarms);
}

Json RemoteBoard::reported() const {
  const auto report = reported_->report();
  return {{"here", false},
          {"host", report.row["host"].text().value_or("")},
          {"deployment", report.row["deployment"].text().value_or("")},
          {"overruns", number_of(report.row, "overruns")},
          {"faults", number_of(report.row, "faults")},
          {"lost_ticks", number_of(report.row, "lost_ticks")}};
}

Result<Json, Refused> RemoteBoard::ask(const char* text, const char* what) {
  const auto texts = watch_->texts(text, {name()});
  const auto found = texts.find(name());
  auto answer = found != texts.end() ? Json::parse(found->second) : std::nullopt;
  if (!answer || !answer->is_object()) {
    return Refused{status::kNoAnswer,
                   {fmt::format("board {} does not report {} ({}; older agents cannot)", name(), what, state())}};
  }
  return std::move(*answer);
}

Result<tools::RunView, Refused> RemoteBoard::current_run() {
  constexpr std::int64_t kKeepNs = 1'000'000'000;  // a few hundred kB each
  if (run_ && rt::now_ns() < run_until_ns_) {
    return *run_;
  }
  const auto texts = watch_->texts("run", {name()});
  const auto text = texts.find(name());
  if (text == texts.end()) {
    return Refused{status::kNoAnswer, {fmt::format("board {} does not answer ({})", name(), state())}};
  }
  auto read = tools::read_run("board " + name(), text->second);
  if (!read) {
    return Refused{status::kConflict, {read.error().text}};
  }
  run_ = std::move(read->run);
  run_until_ns_ = rt::now_ns() + kKeepNs;
  return *run_;
}

Board::Done RemoteBoard::messages(std::uint64_t count) {
  const auto answer = ask("messages", "what was printed");
  if (!answer) {
    return answer.error();
  }
  const std::int64_t epoch = (*answer)["epoch_ns"].integer().value_or(0);
  const std::int64_t period = std::max<std::int64_t>((*answer)["basic_period_ns"].integer().value_or(1), 1);
  const Json printed = newest((*answer)["messages"], count);
  Json list = Json::array();
  for (Json one : printed.values()) {
    one["tick"] = std::max<std::int64_t>(one["time_ns"].integer().value_or(0) - epoch, 0) / period;
    list.push_back(std::move(one));
  }
  return Json{{"epoch_ns", epoch}, {"messages", std::move(list)}};
}

Board::Done RemoteBoard::alarm_status(bool all) {
  const auto answer = ask("alarms", "its alarms");
  if (!answer) {
    return answer.error();
  }
  Json list = Json::array();
  for (const Json& one : (*answer)["alarms"].values()) {
    if (all || one["state"].text() != "normal") {
      list.push_back(one);
    }
  }
  return Json{{"watched", (*answer)["watched"].boolean().value_or(false)},
              {"declared", number_of(*answer, "declared")},
              {"counts", json_of(alarms::counts_in((*answer)["counts"]))},
              {"alarms", std::move(list)}};
}

Board::Done RemoteBoard::alarm_history(std::uint64_t count) {
  const auto answer = ask("alarms", "its alarms");
  if (!answer) {
    return answer.error();
  }
  return Json{{"events", newest((*answer)["events"], count)}};
}

std::vector<std::string> RemoteBoard::full_names(const std::vector<std::string>& names) const {
  std::vector<std::string> full;
  if (store() == nullptr) {
    return names;
  }
  const auto items = operate::select(*store(), names);
  if (!items) {
    return names;
  }
  std::transform(items->begin(), items->end(), std::back_inserter(full), [](const auto& item) { return item.name; });
  return full;
}

std::optional<Refused> RemoteBoard::prepare(Order& order, const Affected& affected, ChangeNote& note) {
  const operate::Who who = note.who();
  order.who = who.name + " at " + who.from;
  order.reason = who.reason;
  if (!one_line(order.reason) || !std::all_of(order.lines.begin(), order.lines.end(), one_line)) {
    return Refused{status::kWrongValue, {"names, values and reasons for a board of another host are one line each"}};
  }
  return note.begin(affected);
}

Result<std::string, Refused> RemoteBoard::send(Order order, const Affected& affected, ChangeNote& note) {
  if (auto refused = prepare(order, affected, note)) {
    return std::move(*refused);
  }
  auto done = watch_->order(name(), order);
  if (!done) {
    return not_done(done.error());
  }
  return std::move(done).value();
}

Board::Done RemoteBoard::write(Order::What what, const WriteRequest& request, ChangeNote& note) {
  auto [order, names] = order_of(what, request);
  const auto answer = send(std::move(order), {full_names(names)}, note);
  if (!answer) {
    return answer.error();
  }
  return Json{{what == Order::What::Force ? "forced" : "written", Json(names)}, {"message", *answer}};
}

Board::Done RemoteBoard::set(const WriteRequest& request, ChangeNote& note) {
  return write(Order::What::Set, request, note);
}

Board::Done RemoteBoard::force(const WriteRequest& request, ChangeNote& note, LeaseDesk& leases) {
  if (!request.lease) {
    return write(Order::What::Force, request, note);
  }
  auto [order, names] = order_of(Order::What::Force, request);
  const std::vector<std::string> full = full_names(names);
  if (auto refused = prepare(order, {full}, note)) {
    return std::move(*refused);
  }
  const auto board = watch_->report(name());
  if (!board) {
    return not_done(board.error());
  }
  const auto lease = leases.take(*board, {note.who(), text_of(request), full}, order);
  if (!lease) {
    return not_done(lease.error());
  }
  return Json{{"forced", Json(names)}, {"lease", *lease}, {"lease_ns", LeaseDesk::kLeaseNs}};
}

Board::Done RemoteBoard::release(const WriteRequest& request, ChangeNote& note) {
  const auto answer =
      send({Order::What::Unforce, request.names, 0, {}, {}}, {full_names(request.names), request.all}, note);
  if (!answer) {
    return answer.error();
  }
  return Json{{"released", Json(request.names)}, {"message", *answer}};
}

Board::Done RemoteBoard::set_lock(vars::WriteLock lock, ChangeNote& note) {
  const auto answer = send({Order::What::Lock, {vars::word_of(lock)}, 0, {}, {}}, {{}, true}, note);
  if (!answer) {
    return answer.error();
  }
  return Json{{"lock", vars::word_of(lock)}, {"message", *answer}};
}

Board::Done RemoteBoard::command(scheduler::ModuleCommand what, const std::string& module, ChangeNote& note) {
  using scheduler::ModuleCommand;
  const auto word = what == ModuleCommand::Stop    ? Order::What::StopModule
                    : what == ModuleCommand::Start ? Order::What::StartModule
                                                   : Order::What::RestartModule;
  const auto answer = send({word, {module}, 0, {}, {}}, {{}, true, what == ModuleCommand::Stop}, note);
  if (!answer) {
    return answer.error();
  }
  return Json{{"module", module}, {"result", "done"}, {"message", *answer}};
}

Board::Done RemoteBoard::carry_out(const alarms::AlarmOrder& order, ChangeNote& note) {
  using alarms::AlarmEvent;
  const auto word = order.what == AlarmEvent::Acknowledged ? Order::What::AckAlarms
                    : order.what == AlarmEvent::Shelved    ? Order::What::ShelveAlarms
                                                           : Order::What::UnshelveAlarms;
  const auto answer = send({word, order.names, order.for_ns, {}, {}}, {order.names, order.all}, note);
  if (!answer) {
    return answer.error();
  }
  return Json{{"alarms", Json::parse(*answer).value_or(Json::array())}};
}

}  // namespace indurop::serve
