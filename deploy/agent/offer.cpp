// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/offer.h"

#include "deploy/agent/board_alarms.h"
#include "deploy/agent/board_recorder.h"
#include "deploy/agent/boxes_text.h"
#include "deploy/agent/mirror_text.h"
#include "deploy/agent/run_image.h"
#include "deploy/agent/trust_lists.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

std::optional<BlobServer::Blob> offer(const std::string& name, const Offered& from) {
  const auto& [board, state, values, verify, pools, users, keys] = from;
  const auto text = [](std::string what) { return BlobServer::Blob{{}, std::move(what)}; };
  if (name == kHistoryBlob) {
    return text(state.history_text());
  }
  if (name.starts_with(kUsersBlob)) {
    std::string list = users.newer_than(state.committed().plant, name.substr(kUsersBlob.size()));
    return list.empty() ? std::nullopt : std::optional(text(std::move(list)));
  }
  if (name.starts_with(kTrustBlob)) {
    std::string list = trust_list_after(keys, state.committed().plant, name.substr(kTrustBlob.size()));
    return list.empty() ? std::nullopt : std::optional(text(std::move(list)));
  }
  if (name == kMirrorBlob) {
    return text(mirror_text(board));
  }
  if (name == kRunBlob) {
    return text(run_image(board));
  }
  if (name == kVariablesBlob || name == kValuesBlob) {
    std::string what = name == kValuesBlob ? values.values(rt::MonoClock::now()) : values.variables();
    return what.empty() ? std::nullopt : std::optional(text(std::move(what)));
  }
  if (name == kMessagesBlob) {
    return text(messages_text(board));
  }
  if (name == kPoolsBlob) {
    const std::string what = pools.text();
    return text(what.empty() ? "{}" : what);
  }
  if (name == kAlarmsBlob) {
    return text(alarms_text(board));
  }
  if (name.starts_with(kVerifyBlob)) {
    return text(verify.answer(name));
  }
  if (name == kBoxesBlob) {
    return text(boxes_text(board));
  }
  if (name.starts_with(kBoxBlob)) {
    const auto file = box_file(board, name.substr(kBoxBlob.size()));
    return file ? std::optional(BlobServer::Blob{*file, {}}) : std::nullopt;
  }
  if (name == kRecordingsBlob) {
    return text(recordings_text(board));
  }
  if (name.starts_with(kRecordingBlob)) {
    const auto file = recording_file(board, name.substr(kRecordingBlob.size()));
    return file ? std::optional(BlobServer::Blob{*file, {}}) : std::nullopt;
  }
  return state.has(name) ? std::optional(BlobServer::Blob{state.file(name), {}}) : std::nullopt;
}

}  // namespace indurop::deploy
