// SPDX-License-Identifier: Apache-2.0
// The two documents of DDS Security: what a plant's domains require, and what one participant may do in them. Text
// only; sign_document() makes them valid.

#pragma once

#include <string>

#include "core/keys/credentials.h"
#include "core/keys/variable_rights.h"

namespace indurop::keys {

// The rights of a participant that has a certificate of the plant.
enum class Role {
  Board,     // publishes its own variables, reads all, reports to the deployer
  Viewer,    // reads all, publishes no value
  Deployer,  // commands agents of boards
  Tool,      // reads and sets the variables of its lists on the external plane, nothing else
  User,      // reads all, and commands agents as far as the plant's list of users lets it
};

struct Holder {
  Role role = Role::Board;
  std::string plant;
  std::string name;
  VariableRights variables = {};  // for Role::Tool
};

// Admits only participants with a certificate; all traffic is encrypted or at least signed, including discovery.
std::string governance_document();
// `subject` as in CertificateFacts.
std::string permissions_document(const Holder& holder, const std::string& subject, const Validity& validity);

}  // namespace indurop::keys
