// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS as the mirror needs it: configuration made from the settings, never the user's; one place for QoS.

#pragma once

#include <string>

#include "mirror/entity.h"
#include "mirror/packing.h"
#include "mirror/settings.h"

namespace indurop::mirror {

// The domain's configuration for a network interface. Why each line: docs/design/mirror.md.
std::string domain_configuration(const Settings& settings, const std::string& interface_name);

// Domain and participant. Not ok() if the network cannot be had now: `problem` says why, and the caller tries again. If
// ok(), `problem` may still hold something the user should know. Messages of DDS go to the log sink.
struct Participant {
  Entity domain;
  Entity participant;  // deleted first
};
Participant join_plant(const Settings& settings, std::string& problem);

// Topic names are the protocol: boards of another protocol do not see each other at all.
std::string frames_topic(const std::string& plant, const std::string& board, Stream stream);
std::string catalogue_topic(const std::string& plant);
std::string beacon_topic(const std::string& plant);

// Reliable or not, last value kept for late joiners, liveliness with the plant's lease.
Entity make_writer(dds_entity_t participant, const dds_topic_descriptor_t& type, const std::string& topic,
                   const Settings& settings, Stream stream);
Entity make_reader(dds_entity_t participant, const dds_topic_descriptor_t& type, const std::string& topic,
                   const Settings& settings, Stream stream, const dds_listener_t* listener);

}  // namespace indurop::mirror
