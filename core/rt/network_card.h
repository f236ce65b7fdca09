// SPDX-License-Identifier: Apache-2.0
// How the driver of a network card treats frames. Not real-time safe.

#pragma once

#include <optional>
#include <string>

namespace indurop::rt {

struct CardSettings {
  // How long the card holds back an interrupt, us; nothing: the driver does not say.
  std::optional<unsigned> receive_wait_us;
  std::optional<unsigned> send_wait_us;
  bool gathers_frames = false;  // the kernel waits for more frames (GRO, LRO)
};
// Of a network interface by its name. What the system does not say is left out.
CardSettings card_settings(const std::string& interface);

}  // namespace indurop::rt
