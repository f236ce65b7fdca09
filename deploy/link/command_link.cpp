// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/command_link.h"

#include <utility>

#include "core/rt/signal_word.h"
#include "core/schema/topic_name.h"
#include "deploy/link/deploy_link.h"
#include "deploy/link/reply_inbox.h"
#include "deploy/link/wire_words.h"
#include "network/dds/endpoint.h"

namespace indurop::deploy {
namespace {

constexpr std::int32_t kCommandDepth = 16;
constexpr std::int64_t kCommandBlockNs = 100'000'000;

}  // namespace

struct CommandLink::Impl {
  explicit Impl(DeployLink& by) : link(by), replies(by.wake_word()) {}
  DeployLink& link;
  ReplyInbox replies;  // used by the listener of a commander's reader until that is gone
  dds::Endpoint in;
  dds::Endpoint out;
};

CommandLink::CommandLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

CommandLink::~CommandLink() = default;

Result<std::unique_ptr<CommandLink>, base::Problem> CommandLink::open(DeployLink& link, CommandSide side) {
  const bool agent = side == CommandSide::Agent;
  const auto& in_type = agent ? indurop_deploy_Command_desc : indurop_deploy_Reply_desc;
  const auto& out_type = agent ? indurop_deploy_Reply_desc : indurop_deploy_Command_desc;
  const dds::Qos qos = dds::make_qos({.block_ns = kCommandBlockNs, .for_late_ones = false, .depth = kCommandDepth});
  auto impl = std::make_unique<Impl>(link);
  const dds::Listener listener = agent ? dds::wake_listener(link.wake_word()) : impl->replies.listener();
  impl->in = dds::make_reader(link.participant(), in_type, schema::deploy_topics() + (agent ? "command" : "reply"), qos,
                              listener);
  impl->out =
      dds::make_writer(link.participant(), out_type, schema::deploy_topics() + (agent ? "reply" : "command"), qos);
  const auto usable = [](const dds::Endpoint& end) { return end.ok() || end.forbidden(); };  // as in DeployLink
  if (!usable(impl->in) || !usable(impl->out)) {
    return base::Problem{"topics for commands cannot be made: " + (impl->in.ok() ? impl->out.why() : impl->in.why())};
  }
  return std::unique_ptr<CommandLink>(new CommandLink(std::move(impl)));
}

void CommandLink::send(const Command& command) {
  const wire::Lent lent(command);
  (void)dds::write(impl_->out.get(), lent.sample());
}

void CommandLink::send(const CommandReply& reply) {
  const wire::Lent lent(reply);
  (void)dds::write(impl_->out.get(), lent.sample());
}

std::vector<deploy::Command> CommandLink::take_commands() {
  std::vector<deploy::Command> commands;
  dds::take_all<indurop_deploy_Command>(impl_->in.get(), [&](const auto& in, const dds::SampleInfo& info) {
    if (info.valid && wire::known<Action>(in.action)) {
      commands.push_back(wire::word_of<Command>(in));
    }
  });
  return commands;
}

std::vector<deploy::CommandReply> CommandLink::take_replies() {
  std::vector<deploy::CommandReply> replies;
  for (ReplyInbox::Received& one : impl_->replies.take()) {
    if (impl_->link.speaks_for(impl_->in.get(), one.publication, one.reply.board)) {
      replies.push_back(std::move(one.reply));
    }
  }
  return replies;
}

}  // namespace indurop::deploy
