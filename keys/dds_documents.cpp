// SPDX-License-Identifier: Apache-2.0
#include "keys/dds_documents.h"

#include <fmt/format.h>

#include <vector>

#include "schema/topic_name.h"

namespace indurop::keys {
namespace {

// Any domain: the manifest says which, and may change it without new keys.
constexpr const char* kDomains = "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

struct Topics {
  std::vector<std::string> publish;
  std::vector<std::string> subscribe;
};

Topics topics_of(Role role, const std::string& plant, const std::string& name) {
  const std::string own = schema::plant_topics(plant);
  const std::string deploy = schema::deploy_topics();
  switch (role) {
    case Role::Board:
      // A board that was taken over can lie about its own variables, not about those of others.
      return {{schema::board_topics(plant, name) + "*", own + "catalogue", own + "beacon", deploy + "board",
               deploy + "request", deploy + "blob/*"},
              {own + "*", deploy + "*"}};
    case Role::Viewer:
      return {{}, {own + "*", deploy + "board"}};
    case Role::Deployer:
      return {{deploy + "*"}, {own + "*", deploy + "*"}};
  }
  return {};
}

std::string section(const char* element, const std::vector<std::string>& topics) {
  if (topics.empty()) {
    return {};
  }
  std::string text;
  for (const std::string& topic : topics) {
    text += fmt::format("          <topic>{}</topic>\n", topic);
  }
  return fmt::format("        <{0}><topics>\n{1}        </topics></{0}>\n", element, text);
}

}  // namespace

std::string governance_document() {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      {}
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)",
                     kDomains);
}

std::string permissions_document(Role role, const std::string& plant, const std::string& name,
                                 const std::string& subject, const Validity& validity) {
  const Topics topics = topics_of(role, plant, name);
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name="{0}">
      <subject_name>{0}</subject_name>
      <validity>
        <not_before>{1}</not_before>
        <not_after>{2}</not_after>
      </validity>
      <allow_rule>
        {3}
{4}{5}      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)",
                     subject, utc_text(validity.from), utc_text(validity.until), kDomains,
                     section("publish", topics.publish), section("subscribe", topics.subscribe));
}

}  // namespace indurop::keys
