// SPDX-License-Identifier: Apache-2.0
// Decides which deployments a board accepts: if it has the public key of a plant, only those signed with that key.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

#include "core/base/problem.h"
#include "core/keys/trust_list.h"

namespace indurop::deploy {

// The keys by which other boards know this board.
struct OwnKeys {
  std::string plant;
  std::filesystem::path folder;  // empty: it has none
  std::string state;             // differs from the earlier value when the files have changed
  std::string problem;           // why the keys cannot be determined; empty: they can
  bool operator==(const OwnKeys&) const = default;
};

class DeployKeys {
 public:
  // Searches $INDUROP_KEYS_DIR, by default /etc/indurop/keys, for PLANT/BOARD/deploy.pub.
  explicit DeployKeys(const std::string& board);

  // Returns why a message for this plant is rejected; empty: it is accepted. A board without any key accepts
  // everything, one whose keys cannot be read nothing. Reads the keys each time: they may be installed while the agent
  // runs.
  [[nodiscard]] std::string refusal(const std::string& plant, const std::string& text,
                                    const std::string& signature) const;

  // Returns which keys of the plant are valid for this board: the list that it has received, if it is later than the
  // one that was copied to it with its keys.
  [[nodiscard]] keys::ReceivedTrust trust(const std::string& plant) const;

  // Returns the board's keys in `plant`, which it runs, else in the only plant of which it has keys.
  [[nodiscard]] OwnKeys own(const std::string& plant) const;

 private:
  // With an error it is not known whether the board has any keys.
  bool any(std::error_code& error) const;
  std::filesystem::path folder_;
  std::string board_;
};

}  // namespace indurop::deploy
