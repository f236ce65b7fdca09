// SPDX-License-Identifier: Apache-2.0
// What the Fast DDS programs have in common: a participant that Cyclone DDS understands, whatever the version.
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <cstdint>

#if __has_include("stationPubSubTypes.hpp")  // of fastddsgen 4, for Fast DDS 3
#include "stationPubSubTypes.hpp"
constexpr auto kOk = eprosima::fastdds::dds::RETCODE_OK;
#else
#include "stationPubSubTypes.h"
constexpr auto kOk = ReturnCode_t::RETCODE_OK;
#endif

// With the profile that the environment names. Null: the domain cannot be joined.
inline eprosima::fastdds::dds::DomainParticipant* join(std::uint32_t domain) {
  auto* const factory = eprosima::fastdds::dds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  eprosima::fastdds::dds::DomainParticipantQos qos = factory->get_default_participant_qos();
  // Fast DDS 3 announces descriptions of its types, of which Cyclone DDS 0.10 requests the minimal one. Fast DDS
  // answers with the complete one, and Cyclone DDS never matches the two. Without descriptions, names of types are
  // compared.
  qos.properties().properties().emplace_back("fastdds.type_propagation", "disabled");
  return factory->create_participant(domain, qos);
}
