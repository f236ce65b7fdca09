// SPDX-License-Identifier: Apache-2.0
// Lists of revoked certificates (RFC 5280, 5) as PEM. Accesses no files.

#pragma once

#include <string>
#include <vector>

#include "core/keys/credentials.h"

namespace indurop::keys {

// Makes a list that revokes certificates with these serial numbers, in addition to those of `before`, which may be
// empty.
std::string make_revocation_list(const Authority& authority, const std::string& before,
                                 const std::vector<std::string>& serials, const Validity& validity);
bool is_revoked(const std::string& certificate, const std::string& revocation_list);
// Returns true if the list revokes all that the list `before` revokes, which may be no list.
bool revokes_all_of(const std::string& revocation_list, const std::string& before);
// Returns true if it is a revocation list that this authority signed.
bool revocation_list_of(const std::string& revocation_list, const std::string& authority);

}  // namespace indurop::keys
