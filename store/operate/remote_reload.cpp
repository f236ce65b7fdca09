// SPDX-License-Identifier: Apache-2.0
#include "store/operate/remote_reload.h"

#include <algorithm>
#include <array>

namespace indurop::operate {
namespace {

using base::Json;
using Reply = RemoteReloadReply::Result;

struct ResultWord {
  Reply result;
  std::string_view word;
};
constexpr std::array kWords{ResultWord{Reply::Done, "done"}, ResultWord{Reply::Unchanged, "unchanged"},
                            ResultWord{Reply::Refused, "refused"}, ResultWord{Reply::Failed, "failed"},
                            ResultWord{Reply::Returned, "returned"}};

}  // namespace

std::string text_of(const RemoteReload& reload) {
  Json json = json_of(reload.request);
  json["back"] = reload.back;
  json["digest"] = reload.digest;
  json["size"] = reload.size;
  return json.dump();
}

std::optional<RemoteReload> parse_remote_reload(std::string_view text) {
  const auto json = Json::parse(text);
  RemoteReload reload;
  if (!json || !base::read(*json, "back", reload.back) || !base::read(*json, "digest", reload.digest) ||
      !base::read(*json, "size", reload.size)) {
    return std::nullopt;
  }
  reload.request = request_of(*json);
  return reload;
}

std::string text_of(const RemoteReloadReply& reply) {
  const auto* const found =
      std::find_if(kWords.begin(), kWords.end(), [&](const ResultWord& one) { return one.result == reply.result; });
  return Json{{"result", found->word}, {"report", json_of(reply.report)}}.dump();
}

std::optional<RemoteReloadReply> parse_remote_reload_reply(std::string_view text) {
  const auto json = Json::parse(text);
  std::string word;
  if (!json || !base::read(*json, "result", word)) {
    return std::nullopt;
  }
  const auto* const found =
      std::find_if(kWords.begin(), kWords.end(), [&](const ResultWord& one) { return one.word == word; });
  return found == kWords.end() ? std::nullopt
                               : std::optional(RemoteReloadReply{found->result, report_of((*json)["report"])});
}

}  // namespace indurop::operate
