// SPDX-License-Identifier: Apache-2.0
// Which files of keys a node uses.

#include "node/parts/plant_part.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "config/xml/plant_reader.h"
#include "core/keys/plant_keys.h"
#include "core/keys/trust_list.h"
#include "store/vars/retain.h"
#include "tests/unit/config/module_file.h"

namespace indurop::node {
namespace {

namespace fs = std::filesystem;

class NodeKeys : public testing::Test {
 protected:
  NodeKeys() {
    ::setenv("INDUROP_STATE_DIR", (folder_ / "state").c_str(), 1);
    const keys::Instant until = keys::instant_now() + std::chrono::days(10);
    EXPECT_TRUE(keys_.make("cell", {"a", "b"}, until));
    EXPECT_TRUE(keys_.add_viewer("eve", until));
  }
  ~NodeKeys() override { ::unsetenv("INDUROP_STATE_DIR"); }
  std::string revoked(const std::string& board) const {
    const config::ReadPlant read = config::read_plant_text(
        "<plant name=\"cell\"><security>keys</security><board name=\"a\"/><board name=\"b\"/></plant>",
        folder_ / "plant.xml");
    return board_security(read.plant, board).revoked;
  }

  config::ModuleFolder folder_;
  keys::PlantKeys keys_{folder_ / "keys"};
};

TEST_F(NodeKeys, Has_the_revoked_certificates_of_the_latest_list) {
  EXPECT_EQ(revoked("a"), keys_.board("a") / "revoked.pem");
  // Its agent receives a list after the folder of keys was copied to it.
  fs::copy(keys_.board("a"), folder_ / "copied");
  for (const keys::KeyListing& each : keys_.list(keys::instant_now())) {
    if (each.name == "eve") {
      ASSERT_TRUE(keys_.revoke(each));
    }
  }
  const std::string list = *keys_.trust_list();
  fs::remove_all(keys_.board("a"));
  fs::copy(folder_ / "copied", keys_.board("a"));
  const fs::path received = keys::received_trust(vars::state_directory("a"), "cell");
  ASSERT_TRUE(keys::ReceivedTrust(keys::ParticipantKeys(keys_.board("a")), received).take(list));
  EXPECT_EQ(revoked("a"), received / "revoked.pem");
  EXPECT_TRUE(fs::exists(received / "revoked.pem"));
  EXPECT_EQ(revoked("b"), keys_.board("b") / "revoked.pem");
}

}  // namespace
}  // namespace indurop::node
