// SPDX-License-Identifier: Apache-2.0
// The table of all paths.
#include <array>

#include "serve/api/answers.h"

namespace indurop::serve {

std::span<const Route> all_routes() {
  static constexpr std::array kRoutes{
      Route{Method::Get, "/api/v1/openapi.json", Pace::Quick, &answers::description},
      Route{Method::Get, "/api/v1/status", Pace::Quick, &answers::server_status},
  };
  return kRoutes;
}

}  // namespace indurop::serve
