// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/reply_inbox.h"

#include <utility>

#include "deploy/link/wire_words.h"
#include "network/dds/entity.h"

namespace indurop::deploy {

dds::Listener ReplyInbox::listener() {
  return dds::data_listener([](dds::Handle reader, void* of) { static_cast<ReplyInbox*>(of)->receive(reader); }, this);
}

void ReplyInbox::receive(dds::Handle reader) {
  {
    const std::lock_guard lock(mutex_);
    dds::take_all<indurop_deploy_Reply>(reader, [&](const auto& sample, const dds::SampleInfo& info) {
      if (!info.valid || !wire::known<Outcome>(sample.outcome)) {
        return;
      }
      std::deque<CommandReply>& of_writer = received_[info.publication];
      of_writer.push_back(wire::word_of<CommandReply>(sample));
      if (of_writer.size() > kMaxOfWriter) {
        of_writer.pop_front();
      }
    });
  }
  wake_.wake();
}

std::vector<ReplyInbox::Received> ReplyInbox::take() {
  std::map<dds::InstanceHandle, std::deque<CommandReply>> received;
  {
    const std::lock_guard lock(mutex_);
    received.swap(received_);
  }
  std::vector<Received> all;
  for (auto& [publication, replies] : received) {
    for (CommandReply& reply : replies) {
      all.push_back({publication, std::move(reply)});
    }
  }
  return all;
}

}  // namespace indurop::deploy
