// SPDX-License-Identifier: Apache-2.0
// Answers about a board of another host, except those about its values: by a request or command to its agent.
#include <fmt/format.h>

#include <algorithm>

#include "core/rt/clock.h"
#include "store/vars/custody.h"
#include "tools/cli/plant/board_run.h"
#include "tools/cli/plant/plant_watch.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/wish.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

using RemoteOrder = tools::PlantWatch::RemoteOrder;

// A command has one line for each value: a text of several lines would be a different command.
bool one_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

// Begins the write, sends the command to the board, and logs the result.
Reply give(Write& write, const Call& call, const Board& board, RemoteOrder order, base::Json body) {
  if (!one_line(order.reason) || !std::all_of(order.lines.begin(), order.lines.end(), one_line)) {
    return write.failed(status::kWrongValue, "names, values and reasons for a board of another host are one line each");
  }
  order.who = call.who + " at " + call.request->from;
  if (auto refused = write.begin()) {
    return *refused;
  }
  const auto done = call.plant->order(board.name(), order);
  if (!done) {
    return write.failed(done.error().code == kUnreachable ? status::kNoAnswer : status::kWrongValue, done.error().text);
  }
  body["message"] = *done;
  return write.done(body);
}

Reply write_remotely(Api& api, const Call& call, RemoteOrder::What what) {
  const bool hold = what == RemoteOrder::What::Force;
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, hold ? "force" : "set");
  const auto wish = read_wish(call.request->body);
  if (!wish || wish->values.empty()) {
    return write.failed(status::kBadRequest, wish ? "values is an object of NAME: value" : wish.error());
  }
  write.about(text_of(*wish), wish->reason);
  if (wish->lease) {
    return write.failed(status::kConflict,
                        "a lease is for boards of this host: force it for a time (for_ns), or until it is released");
  }
  RemoteOrder order{what, {}, wish->for_ns, {}, wish->reason};
  base::Json names = base::Json::array();
  for (const auto& [name, value] : wish->values) {
    if (name.empty() || name.find('=') != std::string::npos) {
      return write.failed(status::kWrongValue, fmt::format("'{}' is no name of a variable", name));
    }
    order.lines.push_back(name + "=" + value);
    names.push_back(name);
  }
  base::Json body = about(**found);
  body[hold ? "forced" : "written"] = std::move(names);
  return give(write, call, **found, std::move(order), std::move(body));
}

Reply command(Api& api, const Call& call, RemoteOrder::What what, std::string word) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& module = call.part.find("module")->second;
  Write write(api, call, std::move(word));
  std::string reason = query_value(*call.request, "reason").value_or("");
  write.about(module, reason);
  base::Json body = about(**found);
  body["module"] = module;
  body["result"] = "done";
  return give(write, call, **found, RemoteOrder{what, {module}, 0, {}, std::move(reason)}, std::move(body));
}

// Gets the run block from the agent, then answers as for a board of this host.
Reply shown(Api& api, const Call& call, Reply (*answer)(Api& api, const Call& call)) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Board& board = **found;
  if (!board.shown(rt::now_ns())) {
    const auto texts = call.plant->texts("run", {board.name()});
    const auto text = texts.find(board.name());
    if (text == texts.end()) {
      return refusal(status::kNoAnswer, fmt::format("board {} does not answer ({})", board.name(), board.state()));
    }
    auto run = tools::read_run("board " + board.name(), text->second);
    if (!run) {
      return refusal(status::kConflict, run.error().text);
    }
    board.show(std::move(run->run), rt::now_ns());
  }
  return answer(api, call);
}

}  // namespace

Reply remote_modules(Api& api, const Call& call) {
  return shown(api, call, &modules);
}

Reply remote_histograms(Api& api, const Call& call) {
  return shown(api, call, &histograms);
}

Reply remote_schedule(Api& api, const Call& call) {
  return shown(api, call, &schedule);
}

Reply remote_runs(Api& api, const Call& call) {
  return shown(api, call, &runs);
}

Reply remote_overruns(Api& api, const Call& call) {
  return shown(api, call, &overruns);
}

Reply remote_messages(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& name = (*found)->name();
  constexpr std::uint64_t kMost = 200;
  const auto count = query_number(call, "count", kMost, 1, UINT32_MAX);
  if (!count) {
    return refusal(status::kBadRequest, "count is a number of 1 on");
  }
  const auto texts = call.plant->texts("messages", {name});
  const auto text = texts.find(name);
  const auto told = text != texts.end() ? base::Json::parse(text->second) : std::nullopt;
  if (!told) {
    return refusal(
        status::kNoAnswer,
        fmt::format("board {} does not say what was printed ({}; agents of before cannot)", name, (*found)->state()));
  }
  const std::int64_t epoch = (*told)["epoch_ns"].integer().value_or(0);
  const std::int64_t period = std::max<std::int64_t>((*told)["basic_period_ns"].integer().value_or(1), 1);
  const auto& all = (*told)["messages"].values();
  base::Json list = base::Json::array();
  for (std::size_t i = all.size() - std::min<std::size_t>(all.size(), *count); i < all.size(); ++i) {
    base::Json one = all[i];
    one["tick"] = std::max<std::int64_t>(one["time_ns"].integer().value_or(0) - epoch, 0) / period;
    list.push_back(std::move(one));
  }
  base::Json body = about(**found);
  body["epoch_ns"] = epoch;
  body["messages"] = std::move(list);
  return json_reply(body);
}

Reply remote_set(Api& api, const Call& call) {
  return write_remotely(api, call, RemoteOrder::What::Set);
}

Reply remote_force(Api& api, const Call& call) {
  return write_remotely(api, call, RemoteOrder::What::Force);
}

Reply remote_release(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "release");
  const auto wish = read_wish(call.request->body);
  if (!wish || wish->names.empty() != wish->all) {
    return write.failed(status::kBadRequest, wish ? "name what to release: names, or all" : wish.error());
  }
  write.about(wish->all ? "all" : text_of(*wish), wish->reason);
  base::Json body = about(**found);
  body["released"] = base::Json(wish->names);
  return give(write, call, **found, RemoteOrder{RemoteOrder::What::Unforce, wish->names, 0, {}, wish->reason},
              std::move(body));
}

Reply remote_lock(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "lock");
  const auto json = base::Json::parse(call.request->body);
  std::string word;
  std::string reason;
  if (!json || !base::read(*json, "lock", word) || !vars::write_lock_of(word)) {
    return write.failed(status::kBadRequest, "lock is none, tune or all");
  }
  base::read(*json, "reason", reason);
  write.about(word, reason);
  base::Json body = about(**found);
  body["lock"] = word;
  return give(write, call, **found, RemoteOrder{RemoteOrder::What::Lock, {word}, 0, {}, reason}, std::move(body));
}

Reply remote_start(Api& api, const Call& call) {
  return command(api, call, RemoteOrder::What::StartModule, "start");
}

Reply remote_stop(Api& api, const Call& call) {
  return command(api, call, RemoteOrder::What::StopModule, "stop");
}

Reply remote_restart(Api& api, const Call& call) {
  return command(api, call, RemoteOrder::What::RestartModule, "restart");
}

}  // namespace indurop::serve::answers
