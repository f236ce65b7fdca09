// SPDX-License-Identifier: Apache-2.0
// Answers about the PLC program: its drawings, the values that change in them, what it consists of.
#include <utility>

#include "core/base/exit_code.h"
#include "tools/client/plc/plc_pictures.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

using Ask = Result<base::Json, tools::Failure> (tools::PlcPictures::*)(const std::string& node,
                                                                       const std::string& program);

Reply ask(const Call& call, Ask what) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  auto answered = (call.plc->*what)((*found)->name(), query_value(*call.request, "program").value_or(""));
  if (!answered) {
    const int code = answered.error().code;
    const int answer = code == kCheckFailed ? status::kFailed : code == kUsage ? status::kNotFound : status::kConflict;
    return refusal(answer, answered.error().text);
  }
  base::Json body = about(**found);
  body.update(*answered);
  return json_reply(body);
}

}  // namespace

Reply plc(Api& /*api*/, const Call& call) {
  return ask(call, &tools::PlcPictures::pictures);
}

Reply plc_live(Api& /*api*/, const Call& call) {
  return ask(call, &tools::PlcPictures::live);
}

Reply plc_model(Api& /*api*/, const Call& call) {
  return ask(call, &tools::PlcPictures::model);
}

}  // namespace indurop::serve::answers
