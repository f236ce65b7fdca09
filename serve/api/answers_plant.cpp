// SPDX-License-Identifier: Apache-2.0
// Answers about boards elsewhere, by what their agents say.
#include <utility>

#include "serve/api/answers.h"
#include "tools/plant/plant_watch.h"

namespace indurop::serve::answers {

Reply plant(Api& /*api*/, const Call& call) {
  call.plant->look();
  return json_reply(call.plant->json());
}

Reply plant_history(Api& /*api*/, const Call& call) {
  base::Json body = base::Json::object();
  body["deployments"] = call.plant->history();
  return json_reply(body);
}

}  // namespace indurop::serve::answers
