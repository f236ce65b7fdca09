// SPDX-License-Identifier: Apache-2.0
// How agents of boards and deployers reach each other: their words (deploy/words/deployment_words.h) as DDS topics. No
// DDS here. One thread uses a link.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/options.h"
#include "base/problem.h"
#include "dds/network_settings.h"
#include "deploy/words/deployment_words.h"
#include "rt/clock.h"

namespace indurop::rt {
class SignalWord;
}

namespace indurop::deploy {

struct LinkSettings {
  // Not the domain of a plant: boards without any deployment are found here, and values of plants do not pass by.
  static constexpr int kDefaultDomain = 76;
  LinkSettings() { network.domain = kDefaultDomain; }
  dds::NetworkSettings network;
  std::filesystem::path keys;  // folder network.security is from; empty: none
  std::uint64_t self = 0;      // session of this agent or deployer
};

// --domain, --interface and --one-host of agents, and of who speaks to them.
void add_agent_options(base::Options& line, LinkSettings& settings);
// These and --keys, of who speaks to them.
void add_link_options(base::Options& line, LinkSettings& settings);

// A session number that no other run has.
std::uint64_t new_session();
std::string host_name();

class DeployLink {
 public:
  // Largest piece of a file in one message.
  static constexpr std::size_t kChunk = 60'000;

  struct Opened {
    std::unique_ptr<DeployLink> link;  // never null
    std::string note;                  // what the user should know; empty: nothing
  };
  // A problem if the network cannot be had now: try again later.
  static Result<Opened, base::Problem> open(const LinkSettings& settings);
  DeployLink(const DeployLink&) = delete;
  DeployLink& operator=(const DeployLink&) = delete;
  ~DeployLink();

  // What is published stays for late joiners until it is replaced, or the link is closed.
  void publish(const BoardReport& report);
  void publish(const Order& order);
  void request(const BlobRequest& request);
  enum class Sent { Yes, Later, Failed };
  // Later: the network or the receiver is not ready for it.
  Sent send(std::uint64_t requester, const BlobChunk& chunk);
  void forget(std::uint64_t requester);  // it wants no more for now

  // What has come since. `gone`: the board or deployer has left, or is not heard; only its name and number are set.
  struct BoardNews {
    BoardReport report;
    bool gone = false;
  };
  struct OrderNews {
    Order order;
    bool gone = false;
  };
  std::vector<BoardNews> take_boards();
  std::vector<OrderNews> take_orders();
  std::vector<deploy::BlobRequest> take_requests();  // to this session
  std::vector<deploy::BlobChunk> take_chunks();
  // Bytes of files that may be on their way to here, so that what comes at once finds room and is not lost.
  [[nodiscard]] std::uint64_t room() const noexcept { return room_; }

  // How much longer it takes to hear the others than on an open network: they let each other in first.
  [[nodiscard]] std::int64_t letting_in_ns() const noexcept { return letting_in_ns_; }

  // Agents in the network whose protocol is another one, as far as they are known by now.
  std::vector<deploy::OtherAgent> other_agents();

  // In a plant with keys: who reports in the name of others, as far as it was heard.
  [[nodiscard]] std::vector<deploy::Impostor> impostors() const;

  // For topics beside these (deploy/link/command_link.h): what they are made in, and what their readers wake.
  [[nodiscard]] int participant() const noexcept;
  [[nodiscard]] rt::SignalWord& wake_word() noexcept;
  // Is what `reader` got from this publication said by that board? Always in an open plant.
  [[nodiscard]] bool speaks_for(int reader, std::uint64_t publication, const std::string& board);

  // Until something came or CLOCK_MONOTONIC `deadline_ns`.
  void wait(rt::MonoTime deadline);

 private:
  struct Impl;
  DeployLink(std::unique_ptr<Impl> impl, bool secured);
  std::unique_ptr<Impl> impl_;
  std::int64_t letting_in_ns_;
  std::uint64_t room_;
};

}  // namespace indurop::deploy
