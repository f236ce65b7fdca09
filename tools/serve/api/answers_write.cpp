// SPDX-License-Identifier: Apache-2.0
// Answers that change something: values, forces, the write lock, modules.
#include <fmt/format.h>

#include <functional>
#include <utility>

#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

using Change = std::function<Board::Done(Board& board, const WriteRequest& request, ChangeNote& note)>;

// Returns what is wrong with the names of the values; else nothing.
std::vector<std::string> wrong_names(const WriteRequest& request) {
  std::vector<std::string> wrong;
  for (const auto& [name, value] : request.values) {
    if (name.empty() || name.find('=') != std::string::npos) {
      wrong.push_back(fmt::format("'{}' is no name of a variable", name));
    }
  }
  return wrong;
}

Reply answer(Write& write, const Board& board, Board::Done done) {
  if (!done) {
    return write.failed(done.error());
  }
  base::Json body = about(board);
  body.update(*done);
  return write.done(body);
}

Reply write_values(Api& api, const Call& call, const char* action, const Change& change) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, action);
  const auto request = read_write_request(call.request->body);
  if (!request || request->values.empty()) {
    return write.failed(status::kBadRequest, request ? "values is an object of NAME: value" : request.error());
  }
  write.about(text_of(*request), request->reason);
  if (const auto wrong = wrong_names(*request); !wrong.empty()) {
    return write.failed(Refused{status::kWrongValue, wrong});
  }
  return answer(write, **found, change(**found, *request, write));
}

Reply command(Api& api, const Call& call, scheduler::ModuleCommand what, const char* word) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& module = call.part.find("module")->second;
  Write write(api, call, word);
  write.about(module, query_value(*call.request, "reason").value_or(""));
  return answer(write, **found, (*found)->command(what, module, write));
}

}  // namespace

Reply set(Api& api, const Call& call) {
  return write_values(api, call, "set", [](Board& board, const WriteRequest& request, ChangeNote& note) {
    return board.set(request, note);
  });
}

Reply force(Api& api, const Call& call) {
  return write_values(api, call, "force", [&api](Board& board, const WriteRequest& request, ChangeNote& note) {
    return board.force(request, note, api.leases());
  });
}

Reply release(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "release");
  const auto request = read_write_request(call.request->body);
  if (!request || request->names.empty() != request->all) {
    return write.failed(status::kBadRequest, request ? "name what to release: names, or all" : request.error());
  }
  write.about(request->all ? "all" : text_of(*request), request->reason);
  return answer(write, **found, (*found)->release(*request, write));
}

Reply set_lock(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "lock");
  const auto json = base::Json::parse(call.request->body);
  std::string word;
  std::string reason;
  const bool read = json && base::read(*json, "lock", word);
  const auto lock = read ? vars::write_lock_of(word) : std::nullopt;
  if (!lock) {
    return write.failed(status::kBadRequest, "lock is none, tune or all");
  }
  base::read(*json, "reason", reason);
  write.about(word, reason);
  return answer(write, **found, (*found)->set_lock(*lock, write));
}

Reply start_module(Api& api, const Call& call) {
  return command(api, call, scheduler::ModuleCommand::Start, "start");
}

Reply stop_module(Api& api, const Call& call) {
  return command(api, call, scheduler::ModuleCommand::Stop, "stop");
}

Reply restart_module(Api& api, const Call& call) {
  return command(api, call, scheduler::ModuleCommand::Restart, "restart");
}

}  // namespace indurop::serve::answers
