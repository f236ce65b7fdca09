// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS as the mirror needs it: configuration made from the settings, never the user's.

#pragma once

#include <string>

#include "mirror/endpoint.h"
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

std::string frames_topic(const std::string& plant, const std::string& board, Stream stream);
std::string catalogue_topic(const std::string& plant);
std::string beacon_topic(const std::string& plant);

// Reliable or not, last value kept for late joiners, liveliness with the plant's lease.
Qos plane_qos(const Settings& settings, Stream stream);

}  // namespace indurop::mirror
