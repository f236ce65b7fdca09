// SPDX-License-Identifier: Apache-2.0
// Answers about shared functions, and their calls. Clients see, and may call, only those that `--call` names.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/st/value_literal.h"
#include "core/base/hexadecimal.h"
#include "core/rt/clock.h"
#include "store/operate/call.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/local_board.h"
#include "tools/serve/boards/variable.h"

namespace indurop::serve::answers {
namespace {

bool may_be_called(const Api& api, const schema::Function& function) {
  return std::ranges::any_of(api.facts().calls, [&function](const std::string& pattern) {
    return schema::glob_match(pattern, function.name);
  });
}

base::Json parameter_json(const schema::Field& parameter) {
  base::Json out = base::Json::object();
  out["name"] = parameter.name;
  out["type"] = schema::display_name(parameter.type);
  out["form"] = form_of(parameter.type);
  out["unit"] = parameter.unit;
  out["range"] = range_of(parameter.range);
  out["description"] = parameter.description;
  return out;
}

base::Json function_json(const vars::Store& store, const schema::Function& function) {
  base::Json parameters = base::Json::array();
  for (const schema::Field& parameter : function.arguments.fields) {
    parameters.push_back(parameter_json(parameter));
  }
  base::Json out = base::Json::object();
  out["name"] = function.name;
  out["description"] = function.description;
  out["arguments"] = std::move(parameters);
  out["result"] = operate::is_void(function) ? base::Json() : form_of(function.result);
  out["served"] = operate::is_served(store, function);
  return out;
}

struct CallBody {
  std::vector<std::pair<std::string, std::string>> arguments;  // name, and value in the syntax of `indurop set`
  std::string reason;
  bool bytes = false;  // how the result is written
};

Result<CallBody, std::string> read_call_body(const std::string& text) {
  const auto json = base::Json::parse(text.empty() ? "{}" : text);
  if (!json || !json->is_object()) {
    return std::string("the body is no JSON object");
  }
  CallBody body;
  base::read(*json, "reason", body.reason);
  std::string values = "json";
  base::read(*json, "values", values);
  body.bytes = values == "bytes";
  if (values != "json" && values != "bytes") {
    return std::string("values is json or bytes");
  }
  if (const base::Json* const arguments = json->find("arguments")) {
    if (!arguments->is_object()) {
      return std::string("arguments is an object of NAME: value");
    }
    std::size_t i = 0;
    for (const std::string& name : arguments->keys()) {
      const base::Json& value = arguments->values()[i++];
      body.arguments.emplace_back(name, value.is_text() ? *value.text() : value.dump());
    }
  }
  return body;
}

std::string text_of_call(const std::string& function, const CallBody& body) {
  std::string text = function;
  for (const auto& [name, value] : body.arguments) {
    text += fmt::format(" {}={}", name, value);
  }
  return text;
}

base::Json result_json(const schema::Function& function, const std::vector<std::uint8_t>& bytes, bool as_bytes) {
  if (operate::is_void(function)) {
    return {};
  }
  return as_bytes ? base::Json(base::in_hexadecimal(bytes)) : base::Json(tools::raw_value(function.result, bytes));
}

}  // namespace

Reply functions(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const Board& board = **found;
  if (board.store() == nullptr) {
    return refusal(status::kConflict, board.no_store());
  }
  base::Json list = base::Json::array();
  for (const schema::Function& function : board.store()->schema().functions) {
    if (may_be_called(api, function)) {
      list.push_back(function_json(*board.store(), function));
    }
  }
  base::Json body = about(board);
  body["layout"] = board.layout();
  body["functions"] = std::move(list);
  return json_reply(body);
}

Reply call_function(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& name = call.part.find("function")->second;
  Write write(api, call, "call");
  const auto body = read_call_body(call.request->body);
  if (!body) {
    return write.failed(status::kBadRequest, body.error());
  }
  write.about(text_of_call(name, *body), body->reason);
  if (!(*found)->alive()) {
    return write.failed(status::kConflict, fmt::format("board {} is not running", (*found)->name()));
  }
  auto store = open_to_write((*found)->name(), false);
  if (!store) {
    return write.failed(store.error());
  }
  const schema::Function* const function = operate::find_function(*store, name);
  if (function == nullptr || !may_be_called(api, *function)) {
    return write.failed(status::kNotFound, fmt::format("there is no shared function '{}' that clients may call", name));
  }
  const auto prepared = operate::prepare_call(*function, body->arguments, &plc::read_value_literal);
  if (!prepared) {
    return write.failed(prepared.error());
  }
  if (!api.calls().begin(rt::now_ns())) {
    return write.failed(status::kUnavailable,
                        fmt::format("at most {} calls a second; try again later", CallPace::kMostInASecond));
  }
  if (const auto unlogged = write.begin({{}, true})) {
    return write.failed(*unlogged);
  }
  const auto result = operate::call((*found)->name(), *store, *prepared, write.who());
  if (!result) {
    return write.failed(result.error());
  }
  base::Json answer = about(**found);
  answer["function"] = function->name;
  answer["result"] = result_json(*function, *result, body->bytes);
  return write.done(answer);
}

}  // namespace indurop::serve::answers
