// SPDX-License-Identifier: Apache-2.0
// The answers, one function per path and method of serve/openapi.json. Those of one subject are in one file.

#pragma once

#include "serve/api/api.h"
#include "serve/api/router.h"

namespace indurop::serve::answers {

Reply description(Api& api, const Call& call);
Reply server_status(Api& api, const Call& call);

}  // namespace indurop::serve::answers
