// SPDX-License-Identifier: Apache-2.0
// Messages between boards and deployers, as plain data: boards report their state, a deployer sends its order. Both are
// repeated, so nothing depends on a single message. No network, no files.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::deploy {

// A board's phase in a deployment.
enum class Phase : std::uint8_t {
  Steady,    // in no deployment: runs what is committed
  Fetching,  // fetches missing files
  Checking,  // checks the plant on its own copy
  Prepared,  // ready to switch
  Trial,     // runs the new deployment, its health is not known yet
  Healthy,   // runs the new deployment, which is healthy
  Failed,    // failed: runs what is committed, see `message`
};
const char* to_text(Phase phase) noexcept;

// The step that the deployer requests.
enum class Step : std::uint8_t { Prepare, Switch, Commit, Abort };

// How boards change to a deployment.
enum class Way : std::uint8_t {
  Restart,   // their nodes end and start again
  Exchange,  // the modules that differ are exchanged at one tick; the nodes go on
  Compare,   // nothing changes; boards report what they would exchange
};

// The condition of a board's node, as reported by its agent.
enum class NodeCondition : std::uint8_t {
  None,  // nothing is deployed
  Starting,
  Running,
  Stopping,
  Restarting,  // died, will be restarted soon
  Failed,      // died too often, or its configuration is refused: stays down
  Stopped,     // by command: stays down until it is started or deployed again
};
const char* to_text(NodeCondition condition) noexcept;

// A board's committed deployment. `generation` counts deployments of the plant and is the same on all its boards.
struct CommittedDeployment {
  std::uint64_t generation = 0;
  std::string plant;
  std::string current;             // id, empty: nothing
  std::uint64_t current_size = 0;  // of its package's text
  std::string comment;             // comment of the user who deployed `current`
  std::string previous;            // id of the deployment before it, empty: none
  std::vector<std::string> members;
  std::string grant;  // the deployer's signature of grant_text() of this; empty: unsigned
};

// A board's progress in fetching the missing files.
struct FetchProgress {
  std::uint32_t files = 0;
  std::uint32_t files_done = 0;
  std::uint64_t bytes = 0;
  std::uint64_t bytes_done = 0;
};

// Counters of a board's node.
struct NodeFigures {
  std::uint64_t tick = 0;
  std::uint64_t lost_ticks = 0;
  std::uint64_t overruns = 0;
  std::uint64_t faults = 0;
};

// A new field is added to this struct, to the IDL and to the list in deploy/link/wire_words.h; the compiler compares
// them.
struct BoardReport : CommittedDeployment, FetchProgress, NodeFigures {
  std::string board;
  std::uint64_t agent = 0;  // this run of the agent
  std::string host;
  std::string release;  // of the platform
  // The deployment that the board is in, or was in last.
  std::uint64_t deployer = 0;
  std::string deployer_host;
  std::string proposed;  // id
  Phase phase = Phase::Steady;
  Phase stage = Phase::Steady;  // phase in which it failed
  std::uint64_t refused = 0;    // deployer whose orders this board rejects
  std::string refusal;          // why they are rejected
  std::string message;          // why it failed or rolled back; else a note for people
  NodeCondition node = NodeCondition::None;
  std::int64_t clock_offset_ns = 0;  // the board's CLOCK_REALTIME minus the deployer's, transport included
  Way way = Way::Restart;            // how it can change to the deployment, once it is prepared
  std::int64_t grid_ns = 0;          // its ticks that may be exchanged at are multiples of this; 0: no node runs
  std::string plan;                  // text of a BoardPlan, while it is in a deployment; empty: there is none
};

// An agent of another release with another protocol: it is present, but its messages cannot be read.
struct OtherAgent {
  unsigned protocol = 0;
  std::string board;  // empty: not announced; so is host
  std::string host;
};
// Returns "the agent of board b on HOST speaks protocol 1 ...", and what to do.
std::string describe(const OtherAgent& agent, unsigned own_protocol);

// A participant with keys of the plant that reports in the name of a board that is not in its certificate. Its reports
// are rejected.
struct Impostor {
  std::string claimed;
  std::string board;  // board that owns these keys; empty: not known
  std::uint64_t reports = 0;
};
// Returns "board b reports in the name of board a ...", and what to do.
std::string describe(const Impostor& impostor);

struct Order {
  std::uint64_t deployer = 0;  // this run of the deployer
  std::string host;
  std::string plant;
  std::string deployment;  // id: digest of the package's text
  std::uint64_t size = 0;  // of the package's text
  std::uint64_t generation = 0;
  std::vector<std::string> boards;  // the addressed boards
  Step step = Step::Prepare;
  std::int64_t said_at_ns = 0;    // CLOCK_REALTIME of the deployer when it was sent
  std::int64_t switch_at_ns = 0;  // the same clock; with Step::Switch
  std::int64_t health_ns = 0;     // how long the new deployment is monitored before it counts as healthy
  // Prepare: what is wanted; Switch: what is done, Exchange only if all boards can.
  Way way = Way::Restart;
  std::string grant;      // signature of grant_text(); empty: unsigned
  std::string signature;  // of order_text()
};

// The signed texts: that a deployment belongs to the plant, permanently, and the deployer's current order.
std::string grant_text(const std::string& plant, const std::string& deployment, std::uint64_t generation);
std::string order_text(const Order& order);

// A piece of a file. Files are named by their digest.
struct BlobRequest {
  std::uint64_t requester = 0;  // agent or deployer
  std::uint64_t source = 0;     // agent or deployer
  std::string blob;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  bool restart = false;  // discard this requester's earlier requests
};
struct BlobChunk {
  std::uint64_t source = 0;
  std::string blob;
  std::uint64_t offset = 0;
  bool missing = false;  // the source does not have it
  std::vector<std::uint8_t> data;
};

// The number of digits of an id that are shown to people.
inline constexpr std::size_t kShownDigits = 12;
inline std::string shown_id(const std::string& id) {
  return id.substr(0, kShownDigits);
}
// Id of the release of the platform that is installed on a board, in place of that of one that was deployed to it.
inline constexpr const char* kInstalledRelease = "installed";
// In the message of a board that runs another release than its committed one.
inline constexpr const char* kCannotBeRun = "cannot be run, see the log of the agent";
// Blob name in place of a digest: the list of a board's earlier deployments, as JSON.
inline constexpr const char* kHistoryBlob = "history";
// Blob name: the list of users of the plant (transaction/user_list.h), if the board has a newer one than that of the id
// after this prefix; without an id the one it has.
inline constexpr std::string_view kUsersBlob = "users/";
// Blob name: the list of valid keys (core/keys/trust_list.h), if the board has a later one than that of the serial
// after this prefix; without a serial the one it has.
inline constexpr std::string_view kTrustBlob = "trust/";
// Blob name: the variables that the board's node currently reads from other boards, and their age.
inline constexpr const char* kMirrorBlob = "mirror";
// Blob name: the current run block of the board's node (node_texts.h), for remote tools.
inline constexpr const char* kRunBlob = "run";
// Blob names: the variables of the board's node, their values, and what was printed (node_texts.h).
inline constexpr const char* kVariablesBlob = "variables";
inline constexpr const char* kValuesBlob = "values";
inline constexpr const char* kMessagesBlob = "messages";
// Blob name: the state of its indurop-pools (node_texts.h).
inline constexpr const char* kPoolsBlob = "pools";
// Blob name: its alarms (deploy/agent/board_alarms.h).
inline constexpr const char* kAlarmsBlob = "alarms";
// Blob name: its files compared with their digests (deploy/agent/board_verify.h): this prefix and a name of the
// request.
inline constexpr std::string_view kVerifyBlob = "verify/";
// Blob names: the list of its black boxes (deploy/agent/boxes_text.h), and one of them: this prefix and its name.
inline constexpr const char* kBoxesBlob = "boxes";
inline constexpr std::string_view kBoxBlob = "box/";
// Blob names: the list of its recordings (deploy/agent/board_recorder.h), and one of them: this prefix and its name.
inline constexpr const char* kRecordingsBlob = "recordings";
inline constexpr std::string_view kRecordingBlob = "recording/";

}  // namespace indurop::deploy
