// SPDX-License-Identifier: Apache-2.0
// The messages between agents of boards and deployers (deploy/words/deployment_words.h) as DDS topics. Without DDS. One
// thread uses a link.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/problem.h"
#include "core/rt/clock.h"
#include "deploy/words/deployment_words.h"
#include "network/dds/network_settings.h"

namespace indurop::rt {
class SignalWord;
}

namespace indurop::deploy {

// What a link is about: the plants of the boards, or the platform that runs them.
enum class Subject : std::uint8_t { Plant, Platform };

struct LinkSettings {
  // Differs from the domain of plants: boards without any deployment are found in it, and values of plants are not sent
  // in it.
  static constexpr int kDefaultDomain = 76;
  LinkSettings() { network.domain = kDefaultDomain; }
  dds::NetworkSettings network;
  std::filesystem::path keys;  // folder of network.security; empty: none
  std::uint64_t self = 0;      // session of this agent or deployer
  Subject subject = Subject::Plant;
};

// Adds --domain, --interface and --one-host, for agents and their clients.
void add_agent_options(base::Options& line, LinkSettings& settings);
// Adds these and --keys, for clients of agents.
void add_link_options(base::Options& line, LinkSettings& settings);

// Returns a session number that no other run has.
std::uint64_t new_session();
std::string host_name();

class DeployLink {
 public:
  // Maximum size of a piece of a file in one message.
  static constexpr std::size_t kChunk = 60'000;

  struct Opened {
    std::unique_ptr<DeployLink> link;  // never null
    std::string note;                  // note for the user; empty: none
  };
  // Returns a problem if the network is not available now: try again later.
  static Result<Opened, base::Problem> open(const LinkSettings& settings);
  // Opens a link about the platform in the participant of this one, which must not end before it.
  Result<std::unique_ptr<DeployLink>, base::Problem> open_platform() const;
  DeployLink(const DeployLink&) = delete;
  DeployLink& operator=(const DeployLink&) = delete;
  ~DeployLink();

  // The last published message stays for late joiners until it is replaced, or the link is closed.
  void publish(const BoardReport& report);
  void publish(const Order& order);
  void request(const BlobRequest& request);
  enum class Sent { Yes, Later, Failed };
  // Returns Later if the network or the receiver is not ready for it.
  Sent send(std::uint64_t requester, const BlobChunk& chunk);
  void forget(std::uint64_t requester);  // the requester needs no more for now

  // News since the last call. `gone`: the board or deployer has left, or has timed out; only its name and
  // number are set.
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
  // Returns how many bytes of files may be on their way to this process, so that a burst finds room and is not lost.
  [[nodiscard]] std::uint64_t room() const noexcept { return room_; }

  // Returns how much longer discovery takes than on an open network: participants authenticate each other first.
  [[nodiscard]] std::int64_t letting_in_ns() const noexcept { return letting_in_ns_; }

  // Returns the agents in the network with another protocol, as far as they are known by now; a link in the participant
  // of another one knows none.
  std::vector<deploy::OtherAgent> other_agents();

  // In a plant with keys: participants that report under another name, as far as they were received.
  [[nodiscard]] std::vector<deploy::Impostor> impostors() const;

  // For other topics on this link (deploy/link/command_link.h): the participant in which they are created, and the word
  // that their readers signal.
  [[nodiscard]] int participant() const noexcept;
  [[nodiscard]] rt::SignalWord& wake_word() noexcept;
  // Returns whether the sample that `reader` received from this publication is from that board. Always true in an open
  // plant.
  [[nodiscard]] bool speaks_for(int reader, std::uint64_t publication, const std::string& board);

  // Waits until something has arrived or until `deadline` (CLOCK_MONOTONIC).
  void wait(rt::MonoTime deadline);

 private:
  struct Impl;
  DeployLink(std::unique_ptr<Impl> impl, bool secured);
  std::unique_ptr<Impl> impl_;
  std::int64_t letting_in_ns_;
  std::uint64_t room_;
};

}  // namespace indurop::deploy
