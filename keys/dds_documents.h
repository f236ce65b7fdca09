// SPDX-License-Identifier: Apache-2.0
// The two documents of DDS Security: what a plant's domains demand, and what one participant may do in them. Text only;
// sign_document() makes them valid.

#pragma once

#include <string>

#include "keys/credentials.h"
#include "keys/variable_rights.h"

namespace indurop::keys {

// What somebody who has a certificate of the plant may do.
enum class Role {
  Board,     // publishes its own variables, reads all, reports to the deployer
  Viewer,    // reads all, publishes no value
  Deployer,  // commands agents of boards
  Tool,      // reads and sets the variables of its lists on the external plane, nothing else
};

struct Holder {
  Role role = Role::Board;
  std::string plant;
  std::string name;
  VariableRights variables = {};  // of a tool
};

// Nobody without a certificate; everything said is encrypted or at least signed, discovery included.
std::string governance_document();
// `subject` as in CertificateFacts.
std::string permissions_document(const Holder& holder, const std::string& subject, const Validity& validity);

}  // namespace indurop::keys
