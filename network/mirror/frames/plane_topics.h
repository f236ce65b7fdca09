// SPDX-License-Identifier: Apache-2.0
// Names and QoS of the topics by which boards of one plant exchange values.

#pragma once

#include <string>

#include "network/dds/endpoint.h"
#include "network/mirror/frames/packing.h"
#include "network/mirror/frames/settings.h"

namespace indurop::mirror {

std::string frames_topic(const std::string& plant, const std::string& board, Stream stream);
std::string catalogue_topic(const std::string& plant);
std::string beacon_topic(const std::string& plant);

// Reliable or best effort, last value kept for late joiners, liveliness with the plant's lease.
dds::Qos plane_qos(const Settings& settings, Stream stream);

}  // namespace indurop::mirror
