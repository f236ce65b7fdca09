// SPDX-License-Identifier: Apache-2.0
#include "core/keys/dds_documents.h"

#include <fmt/format.h>

#include <vector>

#include "core/schema/topic_name.h"

namespace indurop::keys {
namespace {

// Any domain: the manifest defines it, and may change it without new keys.
constexpr const char* kDomains = "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

struct Topics {
  std::vector<std::string> publish;
  std::vector<std::string> subscribe;
};

// The rights of a participant in two steps: the platform's own topics, and of all other topics those of variables.
struct Rights {
  Topics own;
  Topics variables;
};

Rights rights_of(const Holder& holder) {
  const std::string plant = schema::plant_topics(holder.plant);
  const std::string deploy = schema::deploy_topics();
  const std::string directory = schema::directory_topic();
  const std::string request_name = schema::request_topic();
  switch (holder.role) {
    case Role::Board:
      // A compromised board can send wrong values of its own variables, but not of other boards': frames between boards
      // carry its name. Which variables it shows to tools is defined by the manifest, not by its keys.
      return {{{schema::board_topics(holder.plant, holder.name) + "*", plant + "catalogue", plant + "beacon",
                deploy + "board", deploy + "request", deploy + "blob/*", deploy + "reply", directory},
               {plant + "*", deploy + "*", request_name}},
              {{"*"}, {"*"}}};
    case Role::Viewer:
      return {{{deploy + "request", request_name}, {plant + "*", deploy + "board", deploy + "blob/*", directory}},
              {{}, {"*"}}};
    case Role::Deployer:
      return {{{deploy + "*"}, {plant + "*", deploy + "*"}}, {}};
    case Role::User:
      return {{{deploy + "command", deploy + "request", request_name},
               {plant + "*", deploy + "board", deploy + "reply", deploy + "blob/*", directory}},
              {{}, {"*"}}};
    case Role::Tool: {
      Topics variables{variable_topics(holder.variables.write), variable_topics(holder.variables.read)};
      variables.subscribe.insert(variables.subscribe.end(), variables.publish.begin(), variables.publish.end());
      return {{{request_name}, {directory}}, std::move(variables)};
    }
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

std::string rule(const char* kind, const Topics& topics) {
  const std::string sections = section("publish", topics.publish) + section("subscribe", topics.subscribe);
  return sections.empty() ? std::string{}
                          : fmt::format("      <{0}>\n        {1}\n{2}      </{0}>\n", kind, kDomains, sections);
}

// The first rule that matches a topic applies: patterns of variables never match topics of the platform.
std::string rules_of(const Holder& holder) {
  const Rights rights = rights_of(holder);
  const std::string variables = rule("allow_rule", rights.variables);
  const std::string platform = "indurop/[0-9]*";
  return rule("allow_rule", rights.own) +
         (variables.empty() ? variables : rule("deny_rule", {{platform}, {platform}}) + variables);
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

std::string permissions_document(const Holder& holder, const std::string& subject, const Validity& validity) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name="{0}">
      <subject_name>{0}</subject_name>
      <validity>
        <not_before>{1}</not_before>
        <not_after>{2}</not_after>
      </validity>
{3}      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)",
                     subject, utc_text(validity.from), utc_text(validity.until), rules_of(holder));
}

}  // namespace indurop::keys
