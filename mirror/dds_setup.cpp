// SPDX-License-Identifier: Apache-2.0
#include "mirror/dds_setup.h"

#include <fmt/format.h>

#include <array>

#include "mirror/dds_log.h"
#include "mirror/interface.h"
#include "mirror/security.h"
#include "schema/topic_name.h"

namespace indurop::mirror {
namespace {

constexpr int kParticipantsPerHost = 64;  // boards and tools of one host, when ports are tried one by one
constexpr std::array<const char*, kStreams> kStreamNames = {"prompt", "loose", "bulk"};

std::string network(const Settings& settings, const std::string& interface_name) {
  const bool multicast = settings.multicast && !settings.one_host;
  // Loopback can do it, but does not say so.
  std::string text = fmt::format("<Interfaces><NetworkInterface name=\"{}\"{}/></Interfaces>", xml_text(interface_name),
                                 multicast && interface_name == "lo" ? " multicast=\"true\"" : "");
  // Multicast finds the other boards; data goes to those that read it.
  text += fmt::format("<AllowMulticast>{}</AllowMulticast>", multicast ? "spdp" : "false");
  return "<General>" + text + "</General>";
}

std::string discovery(const Settings& settings) {
  std::string text = fmt::format("<LeaseDuration>{} ns</LeaseDuration>", settings.lease_ns);
  std::string peers;
  if (settings.one_host) {
    peers = "<Peer address=\"127.0.0.1\"/>";
  } else if (!settings.multicast || settings.known_ports) {
    for (const std::string& peer : settings.peers) {
      peers += fmt::format("<Peer address=\"{}\"/>", xml_text(peer));
    }
  }
  if (!peers.empty() || settings.known_ports) {
    text +=
        fmt::format("<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>",
                    kParticipantsPerHost);
  }
  if (!peers.empty()) {
    text += fmt::format("<Peers>{}</Peers>", peers);
  }
  return "<Discovery>" + text + "</Discovery>";
}

std::string threads(const Settings& settings) {
  std::string text;
  // Where the process may use it only: else Cyclone ends the whole process.
  const std::string realtime =
      settings.fifo_priority > 0
          ? fmt::format("<Scheduling><Class>realtime</Class><Priority>{}</Priority></Scheduling>",
                        settings.fifo_priority)
          : "";
  for (const char* name : {"recv", "tev", "gc", "dq.builtins", "dq.user"}) {
    text += fmt::format("<Thread Name=\"{}\">{}<StackSize>256 kB</StackSize></Thread>", name,
                        name == std::string_view("gc") ? "" : realtime);
  }
  return "<Threads>" + text + "</Threads>";
}

// Frames are small and their receiver is quick: a quarter of the usual buffer, in pieces that hold any datagram.
std::string sizes(const Settings& settings) {
  return settings.known_ports ? ""
                              : "<Sizing><ReceiveBufferSize>256 kB</ReceiveBufferSize>"
                                "<ReceiveBufferChunkSize>72 kB</ReceiveBufferChunkSize></Sizing>";
}

}  // namespace

std::string domain_configuration(const Settings& settings, const std::string& interface_name) {
  return network(settings, interface_name) + discovery(settings) + threads(settings) + sizes(settings) +
         // One receive thread: with more, ending can hang, and none could get a priority.
         "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads>"
         // A lost last value is repaired within milliseconds, not 100.
         "<HeartbeatInterval min=\"2 ms\" minsched=\"5 ms\" max=\"100 ms\">10 ms</HeartbeatInterval>"
         "<NackDelay>1 ms</NackDelay><PreEmptiveAckDelay>1 ms</PreEmptiveAckDelay>" +
         // Files: sockets that hold what a receiver has asked for (deploy_link.h), and no limit for senders below that.
         (settings.known_ports
              ? "<SocketReceiveBufferSize max=\"4 MB\"/>"
                "<Watermarks><WhcHigh>16 MB</WhcHigh><WhcLow>8 MB</WhcLow><WhcHighInit>16 MB</WhcHighInit></Watermarks>"
              : "") +
         "</Internal>" + (settings.security.on() ? security_configuration(settings.security, security_plugins()) : "");
}

Participant join_plant(const Settings& settings, std::string& problem) {
  catch_dds_log();
  Participant joined;
  std::string note;
  const std::string interface_name = choose_interface(settings, problem, note);
  if (interface_name.empty() ||
      (settings.security.on() && !security_usable(settings.security, security_plugins(), problem))) {
    return joined;
  }
  const auto id = static_cast<dds_domainid_t>(settings.domain);
  joined.domain = Entity(dds_create_domain(id, domain_configuration(settings, interface_name).c_str()));
  if (!joined.domain.ok()) {
    problem = fmt::format("DDS domain {}: {}", settings.domain, joined.domain.why());
    return joined;
  }
  const Qos qos(dds_create_qos());
  if (!settings.board.empty()) {
    dds_qset_entity_name(qos.get(), settings.board.c_str());  // for tools of DDS, and for other releases
  }
  joined.participant = Entity(dds_create_participant(id, qos.get(), nullptr));
  if (!joined.participant.ok()) {
    const std::string said = last_dds_message();
    problem = said.empty() ? joined.participant.why() : said;
    if (settings.security.on()) {
      problem = fmt::format("keys refused (indurop keys list tells more): {}", problem);
    }
    joined.domain.reset();
    return joined;
  }
  problem = note;
  return joined;
}

std::string frames_topic(const std::string& plant, const std::string& board, Stream stream) {
  return schema::board_topics(plant, board) + kStreamNames[static_cast<std::size_t>(stream)];
}

std::string catalogue_topic(const std::string& plant) {
  return schema::plant_topics(plant) + "catalogue";
}

std::string beacon_topic(const std::string& plant) {
  return schema::plant_topics(plant) + "beacon";
}

Qos plane_qos(const Settings& settings, Stream stream) {
  return make_qos({.reliable = stream != Stream::BestEffort, .lease_ns = settings.lease_ns});
}

}  // namespace indurop::mirror
