// SPDX-License-Identifier: Apache-2.0
#include "mirror/command_link.h"

#include <deploy.h>

#include "mirror/deploy_link.h"
#include "mirror/endpoint.h"
#include "mirror/lent.h"
#include "rt/signal_word.h"
#include "schema/topic_name.h"

namespace indurop::mirror {
namespace {

constexpr std::int32_t kDepth = 16;
constexpr std::int64_t kBlockNs = 100'000'000;

}  // namespace

struct CommandLink::Impl {
  Endpoint in;
  Endpoint out;
};

CommandLink::CommandLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

CommandLink::~CommandLink() = default;

std::unique_ptr<CommandLink> CommandLink::open(DeployLink& link, CommandSide side, std::string& problem) {
  const bool agent = side == CommandSide::Agent;
  const auto& in_type = agent ? indurop_deploy_Command_desc : indurop_deploy_Reply_desc;
  const auto& out_type = agent ? indurop_deploy_Reply_desc : indurop_deploy_Command_desc;
  const Qos qos = make_qos({.block_ns = kBlockNs, .for_late_ones = false, .depth = kDepth});
  const Listener listener = data_listener(
      [](dds_entity_t /*reader*/, void* word) { static_cast<rt::SignalWord*>(word)->wake(); }, &link.wake_word());
  auto impl = std::make_unique<Impl>();
  impl->in =
      make_reader(link.participant(), in_type, schema::deploy_topics() + (agent ? "command" : "reply"), qos, listener);
  impl->out = make_writer(link.participant(), out_type, schema::deploy_topics() + (agent ? "reply" : "command"), qos);
  if (!impl->in.ok() || !impl->out.ok()) {
    problem = "topics for orders cannot be made: " + (impl->in.ok() ? impl->out.why() : impl->in.why());
    return nullptr;
  }
  return std::unique_ptr<CommandLink>(new CommandLink(std::move(impl)));
}

void CommandLink::send(const deploy::Command& command) {
  indurop_deploy_Command out{};
  out.commander = command.commander;
  out.host = lent(command.host);
  out.board = lent(command.board);
  out.agent = command.agent;
  out.plant = lent(command.plant);
  out.action = static_cast<std::uint8_t>(command.action);
  out.target = lent(command.module);
  out.nonce = command.nonce;
  out.signature = lent(command.signature);
  (void)dds_write(impl_->out.get(), &out);
}

void CommandLink::send(const deploy::CommandReply& reply) {
  indurop_deploy_Reply out{};
  out.commander = reply.commander;
  out.board = lent(reply.board);
  out.agent = reply.agent;
  out.nonce = reply.nonce;
  out.outcome = static_cast<std::uint8_t>(reply.outcome);
  out.text = lent(reply.text);
  (void)dds_write(impl_->out.get(), &out);
}

std::vector<deploy::Command> CommandLink::take_commands() {
  std::vector<deploy::Command> commands;
  take_all<indurop_deploy_Command>(impl_->in.get(), [&](const auto& in, const dds_sample_info_t& info) {
    if (info.valid_data && in.action <= static_cast<std::uint8_t>(deploy::Action::RestartNode)) {
      commands.push_back({in.commander, in.host, in.board, in.agent, in.plant, static_cast<deploy::Action>(in.action),
                          in.target, in.nonce, in.signature});
    }
  });
  return commands;
}

std::vector<deploy::CommandReply> CommandLink::take_replies() {
  std::vector<deploy::CommandReply> replies;
  take_all<indurop_deploy_Reply>(impl_->in.get(), [&](const auto& in, const dds_sample_info_t& info) {
    if (info.valid_data && in.outcome <= static_cast<std::uint8_t>(deploy::Outcome::Refused)) {
      replies.push_back(
          {in.commander, in.board, in.agent, in.nonce, static_cast<deploy::Outcome>(in.outcome), in.text});
    }
  });
  return replies;
}

}  // namespace indurop::mirror
