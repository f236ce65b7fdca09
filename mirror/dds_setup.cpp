// SPDX-License-Identifier: Apache-2.0
#include "mirror/dds_setup.h"

#include <fmt/format.h>

#include <array>
#include <mutex>

#include "mirror/dds_log.h"
#include "mirror/interface.h"
#include "mirror/security.h"
#include "schema/topic_name.h"

namespace indurop::mirror {
namespace {

constexpr int kProtocol = 1;
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

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

Qos make_qos(const Settings& settings, Stream stream) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), stream == Stream::BestEffort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, settings.lease_ns);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

}  // namespace

std::string domain_configuration(const Settings& settings, const std::string& interface_name) {
  return network(settings, interface_name) + discovery(settings) + threads(settings) +
         // One receive thread: with more, ending can hang, and none could get a priority.
         "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads>"
         // A lost last value is repaired within milliseconds, not 100.
         "<HeartbeatInterval min=\"2 ms\" minsched=\"5 ms\" max=\"100 ms\">10 ms</HeartbeatInterval>"
         "<NackDelay>1 ms</NackDelay><PreEmptiveAckDelay>1 ms</PreEmptiveAckDelay>" +
         // Files: keep sending while the first pieces are being acknowledged.
         (settings.known_ports
              ? "<Watermarks><WhcHigh>4 MB</WhcHigh><WhcLow>1 MB</WhcLow><WhcHighInit>2 MB</WhcHighInit></Watermarks>"
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
  joined.participant = Entity(dds_create_participant(id, nullptr, nullptr));
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
  return fmt::format("indurop/{}/{}/{}/{}", kProtocol, schema::topic_part(plant), schema::topic_part(board),
                     kStreamNames[static_cast<std::size_t>(stream)]);
}

std::string catalogue_topic(const std::string& plant) {
  return fmt::format("indurop/{}/{}/catalogue", kProtocol, schema::topic_part(plant));
}

std::string beacon_topic(const std::string& plant) {
  return fmt::format("indurop/{}/{}/beacon", kProtocol, schema::topic_part(plant));
}

Entity make_writer(dds_entity_t participant, const dds_topic_descriptor_t& type, const std::string& topic,
                   const Settings& settings, Stream stream) {
  const Qos qos = make_qos(settings, stream);
  const dds_entity_t made = dds_create_topic(participant, &type, topic.c_str(), nullptr, nullptr);
  return made < 0 ? Entity(made) : Entity(dds_create_writer(participant, made, qos.get(), nullptr));
}

Entity make_reader(dds_entity_t participant, const dds_topic_descriptor_t& type, const std::string& topic,
                   const Settings& settings, Stream stream, const dds_listener_t* listener) {
  const Qos qos = make_qos(settings, stream);
  const dds_entity_t made = dds_create_topic(participant, &type, topic.c_str(), nullptr, nullptr);
  return made < 0 ? Entity(made) : Entity(dds_create_reader(participant, made, qos.get(), listener));
}

}  // namespace indurop::mirror
