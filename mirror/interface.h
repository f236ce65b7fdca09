// SPDX-License-Identifier: Apache-2.0
// Which network interface a board speaks through. DDS's own choice is not used: it takes loopback while the network is
// down and stays there, and of several cards it takes one silently.

#pragma once

#include <string>

#include "mirror/settings.h"

namespace indurop::mirror {

// Name of the interface; empty, and `problem` says why and what to do, if there is none to use now. `note` is set if
// the choice was not clear.
std::string choose_interface(const Settings& settings, std::string& problem, std::string& note);

}  // namespace indurop::mirror
