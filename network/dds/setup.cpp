// SPDX-License-Identifier: Apache-2.0
#include "network/dds/setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "core/base/xml_text.h"
#include "core/rt/open_files.h"
#include "network/dds/endpoint.h"
#include "network/dds/handshakes.h"
#include "network/dds/interface.h"
#include "network/dds/log.h"
#include "network/dds/security.h"
#include "network/dds/steady_waits.h"

namespace indurop::dds {
namespace {

constexpr int kParticipantsPerHost = 64;  // boards and tools on one host, if ports are tried one after another
constexpr int kPortsPerDomain = 119;      // participants of a domain on one host that can have ports of their own
constexpr std::size_t kRoomForTools = 19;

// Multicast discovery is also used on one host: one message reaches all participants, instead of one for each possible
// port. But a third-party program that names a peer there cannot use multicast on loopback.
bool found_by_multicast(const NetworkSettings& settings) {
  return settings.multicast && !(settings.one_host && settings.known_ports);
}

// On one host, what all participants read is sent once for all. Without multicast on every topic, a participant also
// sends each announcement to all it knows, one by one. Topics that few read are excepted (partitioning()), for which a
// participant needs a port of the domain: in larger plants all is sent one by one.
bool sent_to_all(const NetworkSettings& settings) {
  return settings.one_host && found_by_multicast(settings) && !settings.unicast_topics.empty() &&
         settings.others + kRoomForTools < kPortsPerDomain;
}

std::string network(const NetworkSettings& settings, const std::string& interface_name) {
  const bool multicast = found_by_multicast(settings);
  // Loopback supports multicast, but does not report it.
  std::string text =
      fmt::format("<Interfaces><NetworkInterface name=\"{}\"{}/></Interfaces>", base::xml_text(interface_name),
                  multicast && interface_name == "lo" ? " multicast=\"true\"" : "");
  // Multicast finds the other boards; data is sent only to boards that read it.
  text += fmt::format("<AllowMulticast>{}</AllowMulticast>", !multicast              ? "false"
                                                             : sent_to_all(settings) ? "spdp,asm"
                                                                                     : "spdp");
  return "<General>" + text + "</General>";
}

// A participant that was forgotten is discovered again after this time. None hears more than 32 of these in a second.
std::chrono::milliseconds announced_every(std::size_t others) {
  constexpr std::chrono::milliseconds kEvery{500};
  constexpr std::size_t kPerSecond = 32;
  return std::max(kEvery, std::chrono::milliseconds{1000 * others / kPerSecond});
}

std::string discovery(const NetworkSettings& settings) {
  std::string text =
      fmt::format("<LeaseDuration>{} ns</LeaseDuration>", std::max(settings.lease_ns, settings.forget_ns));
  if (settings.forget_ns > settings.lease_ns) {
    text += fmt::format("<SPDPInterval>{} ms</SPDPInterval>", announced_every(settings.others).count());
  }
  std::string peers;
  if (settings.one_host) {
    peers = found_by_multicast(settings) ? "" : "<Peer address=\"127.0.0.1\"/>";
  } else if (!settings.multicast || settings.known_ports) {
    for (const std::string& peer : settings.peers) {
      peers += fmt::format("<Peer address=\"{}\"/>", base::xml_text(peer));
    }
  }
  if (!peers.empty() || settings.known_ports || sent_to_all(settings)) {
    text +=
        fmt::format("<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>",
                    sent_to_all(settings) ? kPortsPerDomain - 1 : kParticipantsPerHost);
  }
  if (!peers.empty()) {
    text += fmt::format("<Peers>{}</Peers>", peers);
  }
  return "<Discovery>" + text + "</Discovery>";
}

// Readers of these topics announce their own address only.
std::string partitioning(const NetworkSettings& settings) {
  if (!sent_to_all(settings)) {
    return "";
  }
  return fmt::format(
      "<Partitioning><NetworkPartitions><NetworkPartition Name=\"own\" Address=\"127.0.0.1\"/></NetworkPartitions>"
      "<PartitionMappings><PartitionMapping NetworkPartition=\"own\" DCPSPartitionTopic=\"*.{}\"/></PartitionMappings>"
      "</Partitioning>",
      base::xml_text(settings.unicast_topics));
}

std::string threads(const NetworkSettings& settings) {
  std::string text;
  // Only if the process has the permission: otherwise Cyclone ends the whole process.
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

// Receivers are quick: a quarter of the usual buffer, in pieces that hold any datagram. Memory grows until messages
// have gone through all of it, which takes those of an agent that rests two minutes.
std::string sizes(const NetworkSettings& settings) {
  return fmt::format(
      "<Sizing><ReceiveBufferSize>{} kB</ReceiveBufferSize>"
      "<ReceiveBufferChunkSize>72 kB</ReceiveBufferChunkSize></Sizing>",
      settings.in_flight > 0 ? 1024 : 256);
}

// Files: sockets that hold what a receiver has asked for (deploy_link.h), and no limit for senders below that. Images:
// as much as the system permits, and a limit, so that a slow receiver is noticed instead of being sent more.
std::string buffers(const NetworkSettings& settings) {
  if (settings.in_flight > 0) {
    return fmt::format(
        "<SocketReceiveBufferSize max=\"8 MB\"/>"
        "<Watermarks><WhcHigh>{0} B</WhcHigh><WhcLow>{1} B</WhcLow><WhcHighInit>{0} B</WhcHighInit></Watermarks>",
        settings.in_flight, settings.in_flight / 2);
  }
  return settings.known_ports
             ? "<SocketReceiveBufferSize max=\"4 MB\"/>"
               "<Watermarks><WhcHigh>16 MB</WhcHigh><WhcLow>8 MB</WhcLow><WhcHighInit>16 MB</WhcHighInit></Watermarks>"
             : "";
}

// A lost last value is repaired within milliseconds, not 100. Not where programs of others take part by keys: with
// these, Fast DDS is let in less often (docs/adr/0016).
//
// Until the last one has answered, a writer asks all of its readers again in this interval, and each answers: with many
// of them that costs the time in which the last one would. So each is asked as often as if there were eight, and on one
// host all boards together ask as often as those of eight would. Parts are sent again anyway (kKeepAliveNs in
// frame_layout.h).
std::string quick_repair(const NetworkSettings& settings) {
  constexpr std::chrono::milliseconds kQuick{10};
  constexpr std::chrono::milliseconds kUsual{100};
  constexpr std::chrono::milliseconds kLongest{1000};
  constexpr std::size_t kFew = 8;
  const auto others = static_cast<std::int64_t>(std::max(settings.others, kFew));
  const auto few = static_cast<std::int64_t>(kFew);
  const auto every = settings.one_host ? std::min(kLongest, kQuick * others * others / (few * few))
                                       : std::min(kUsual, kQuick * others / few);
  return fmt::format(
      "<HeartbeatInterval min=\"2 ms\" minsched=\"5 ms\" max=\"{} ms\">{} ms</HeartbeatInterval>"
      "<NackDelay>1 ms</NackDelay><PreEmptiveAckDelay>1 ms</PreEmptiveAckDelay>",
      std::max(kUsual, every).count(), every.count());
}

}  // namespace

std::string domain_configuration(const NetworkSettings& settings, const std::string& interface_name) {
  return network(settings, interface_name) + discovery(settings) + partitioning(settings) + threads(settings) +
         sizes(settings) +
         // One receive thread: with more, shutdown can hang, and none could get a priority.
         "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads>" +
         (settings.known_ports && settings.security.on() ? "" : quick_repair(settings)) + buffers(settings) +
         "</Internal>" + (settings.security.on() ? security_configuration(settings.security, security_plugins()) : "");
}

Result<Joined, base::Problem> join_network(const NetworkSettings& settings) {
  catch_dds_log();
  auto interface = choose_interface(settings);
  if (!interface) {
    return std::move(interface).error();
  }
  if (settings.security.on()) {
    if (auto usable = security_usable(settings.security, security_plugins()); !usable) {
      return std::move(usable).error();
    }
  }
  const auto id = static_cast<dds_domainid_t>(settings.domain);
  Entity domain(dds_create_domain(id, domain_configuration(settings, interface->name).c_str()));
  if (!domain.ok() && domain.get() != DDS_RETCODE_PRECONDITION_NOT_MET) {
    return base::Problem{fmt::format("DDS domain {}: {}", settings.domain, domain.why())};
  }
  const Qos qos(dds_create_qos());
  if (!settings.board.empty()) {
    dds_qset_entity_name(qos.get(), settings.board.c_str());  // for DDS tools and other releases
  }
  if (!settings.user_data.empty()) {
    dds_qset_userdata(qos.get(), settings.user_data.data(), settings.user_data.size());
  }
  Entity participant(dds_create_participant(id, qos.get(), nullptr));
  if (!participant.ok()) {
    const std::string reason = last_dds_message();
    const std::string why = reason.empty() ? participant.why() : reason;
    return base::Problem{settings.security.on() ? fmt::format("keys refused (see indurop keys list): {}", why) : why};
  }
  // Cyclone's sockets have no O_CLOEXEC. A node that outlives its agent would keep the agent's ports.
  rt::close_open_files_on_exec();
  if (interface->note.empty() && !waits_are_steady()) {
    interface->note =
        "other programs receive nothing from this one for as long as its clock was set back, because DDS uses that "
        "clock";
  }
  if (interface->note.empty() && settings.security.on() && !handshakes_are_unlimited()) {
    interface->note = "a program that does not answer a handshake for 100 s can end this one (Cyclone DDS 0.10.2)";
  }
  return Joined{{std::move(domain), std::move(participant)}, std::move(interface->note)};
}

}  // namespace indurop::dds
