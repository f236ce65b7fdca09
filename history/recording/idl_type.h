// SPDX-License-Identifier: Apache-2.0
// The type of a channel's messages as a type of the schema, from its OMG IDL: the inverse of omg_idl(). The fields of a
// struct are where C++ has them.

#pragma once

#include <indurop/result.h>

#include <string_view>

#include "core/base/problem.h"
#include "core/schema/schema.h"

namespace indurop::recording {

// Returns the type that `name`, a struct of this text, stands for; from_cdr() reads its messages. A text of one byte
// comes back with two. Errors: unsupported IDL, strings without a bound; a value of more than kMaxMessageBytes.
Result<schema::Type, base::Problem> idl_type(std::string_view text, std::string_view name);

}  // namespace indurop::recording
