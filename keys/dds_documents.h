// SPDX-License-Identifier: Apache-2.0
// The two documents of DDS Security: what a plant's domains demand, and what one participant may do in them. Text only;
// sign_document() makes them valid.

#pragma once

#include <string>

#include "keys/credentials.h"

namespace indurop::keys {

// What somebody who has a certificate of the plant may do.
enum class Role {
  Board,     // publishes its own variables, reads all, reports to the deployer
  Viewer,    // reads all, publishes nothing
  Deployer,  // commands agents of boards
};

// Nobody without a certificate; everything said is encrypted or at least signed, discovery included.
std::string governance_document();
// `subject` as in CertificateFacts. `name` is the board's, for Role::Board.
std::string permissions_document(Role role, const std::string& plant, const std::string& name,
                                 const std::string& subject, const Validity& validity);

}  // namespace indurop::keys
