// SPDX-License-Identifier: Apache-2.0
// Names and QoS of the topics by which boards of one plant exchange values.

#pragma once

#include <string>

#include "network/dds/endpoint.h"
#include "network/mirror/frames/frame_layout.h"
#include "network/mirror/frames/settings.h"

namespace indurop::mirror {

std::string frames_topic(const std::string& plant, const std::string& board, Stream stream);
std::string catalogue_topic(const std::string& plant);
std::string beacon_topic(const std::string& plant);

// Matches the topics of frames of all boards: no others of the plane have as many parts.
inline constexpr const char* kFramesTopics = "indurop/*/*/*/*";

// Reliable or best effort, last value kept for late joiners.
dds::Qos plane_qos(Stream stream);
// Beacons: best effort, and their board is silent when none came for the plant's lease.
dds::Qos beacon_qos(const Settings& settings);

}  // namespace indurop::mirror
