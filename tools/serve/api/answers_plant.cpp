// SPDX-License-Identifier: Apache-2.0
// Answers about boards of the network, from the reports of their agents, and commands to all of them.
#include <sys/mman.h>

#include <algorithm>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/program_folder.h"
#include "core/base/read_file.h"
#include "core/base/text.h"
#include "tools/client/board/plant_watch.h"
#include "tools/client/process/child.h"
#include "tools/console/serve_options.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"

namespace indurop::serve::answers {
namespace {

struct Printed {
  int code = kFailed;
  std::vector<std::string> lines;
};

// Runs in a separate process, because this one already uses the same DDS domain.
Printed roll_back(const deploy::LinkSettings& link, const std::string& id, const std::string& plant) {
  std::vector<std::string> words{base::program_folder() / "indurop", "--color", "never", "rollback", id};
  if (!plant.empty()) {
    words.insert(words.end(), {"--plant", plant});
  }
  const auto more = tools::link_words(link);
  words.insert(words.end(), more.begin(), more.end());
  const base::Descriptor output(::memfd_create("rollback", MFD_CLOEXEC));
  const auto code = tools::run_child(words, output.get());
  if (!code) {
    return {kFailed, {code.error().text}};
  }
  const auto text = base::read_file("/proc/self/fd/" + std::to_string(output.get()));
  return {*code, base::lines_of(text ? *text : std::string())};
}

// Returns true if the text is a full id, as the history has them: it becomes part of the name requested from boards.
bool is_id(const std::string& text) {
  constexpr std::size_t kDigits = 64;
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

Reply plant(Api& /*api*/, const Call& call) {
  call.plant->update();
  return json_reply(call.plant->json());
}

Reply plant_history(Api& /*api*/, const Call& call) {
  base::Json body = base::Json::object();
  body["deployments"] = call.plant->history();
  return json_reply(body);
}

Reply plant_difference(Api& /*api*/, const Call& call) {
  const std::string before = query_value(*call.request, "before").value_or("");
  const std::string after = query_value(*call.request, "after").value_or("");
  if (!is_id(before) || !is_id(after)) {
    return refusal(status::kBadRequest, "before and after are whole ids of deployments");
  }
  auto difference = call.plant->difference(before, after);
  return difference ? json_reply(*difference) : refusal(status::kNotFound, difference.error().text);
}

Reply plant_rollback(Api& api, const Call& call) {
  Write write(api, call, "rollback");
  const auto json = base::Json::parse(call.request->body);
  std::string id;
  std::string plant;
  std::string reason;
  if (!json || !base::read(*json, "deployment", id) || !is_id(id)) {
    return write.failed(status::kBadRequest, "deployment is the whole id of one that was committed before");
  }
  base::read(*json, "plant", plant);
  base::read(*json, "reason", reason);
  if (plant.starts_with('-')) {
    return write.failed(status::kBadRequest, "that is no name of a plant");
  }
  write.about(id, reason);
  if (const auto unlogged = write.begin({{}, true})) {
    return write.failed(*unlogged);
  }
  const Printed printed = roll_back(*call.link, id, plant);
  if (printed.code != kOk) {
    std::vector<std::string> why = printed.lines;
    std::reverse(why.begin(), why.end());  // the result is printed last
    return why.empty()
               ? write.failed(status::kConflict, "it was not rolled back")
               : write.failed(Refused{printed.code == kUnreachable ? status::kNoAnswer : status::kConflict, why});
  }
  base::Json body = base::Json::object();
  body["deployment"] = id;
  body["messages"] = base::Json(printed.lines);
  return write.done(body);
}

}  // namespace indurop::serve::answers
