// SPDX-License-Identifier: Apache-2.0
// Whose deployments a board takes: with the public key of a plant among its keys only those that are signed with it.

#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace indurop::deploy {

// By whose keys a board is known to the others.
struct OwnKeys {
  std::string plant;
  std::filesystem::path folder;  // empty: it has none
  std::string state;             // other than before: the files have changed
  std::string problem;           // why that cannot be said; empty: it can
  bool operator==(const OwnKeys&) const = default;
};

class DeployKeys {
 public:
  // Looks in $INDUROP_KEYS_DIR, normally /etc/indurop/keys, for PLANT/BOARD/deploy.pub.
  explicit DeployKeys(const std::string& board);

  // Why what was said for this plant does not count; empty: it does. A board without any key takes everything, one
  // whose keys cannot be read nothing. Reads the keys each time: they may be brought while the agent runs.
  [[nodiscard]] std::string refusal(const std::string& plant, const std::string& text,
                                    const std::string& signature) const;

  // The keys of this board in `plant`, what it runs, else in the only plant it has keys of.
  [[nodiscard]] OwnKeys own(const std::string& plant) const;

 private:
  // With an error it is not known.
  bool any(std::error_code& error) const;
  std::filesystem::path folder_;
  std::string board_;
};

}  // namespace indurop::deploy
