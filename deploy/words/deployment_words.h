// SPDX-License-Identifier: Apache-2.0
// What boards and deployers say to each other, as plain data: boards tell their state, a deployer what it wants. Both
// are told again and again, so nothing depends on a single message. No network and no files here.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::deploy {

// Where a board is in a deployment.
enum class Phase : std::uint8_t {
  Steady,    // in none: runs what is committed
  Fetching,  // gets the files it lacks
  Checking,  // of the plant, on its own copy
  Prepared,  // could switch
  Trial,     // runs the new deployment, for how well is not known yet
  Healthy,   // and it does well
  Failed,    // could not: runs what is committed, see `message`
};
const char* to_text(Phase phase) noexcept;

// What the deployer wants.
enum class Step : std::uint8_t { Prepare, Switch, Commit, Abort };

// The node of a board, as its agent sees it.
enum class NodeCondition : std::uint8_t {
  None,  // nothing is deployed
  Starting,
  Running,
  Stopping,
  Restarting,  // died, comes back soon
  Failed,      // died too often, or its configuration is refused: stays down
  Stopped,     // by command: stays down until it is told to start, or deployed anew
};
const char* to_text(NodeCondition condition) noexcept;

// What a board has committed. `generation` counts deployments of the plant and is the same on all its boards.
struct CommittedDeployment {
  std::uint64_t generation = 0;
  std::string plant;
  std::string current;             // id, empty: nothing
  std::uint64_t current_size = 0;  // of its package's text
  std::string comment;             // of whoever deployed it
  std::string previous;            // likewise
  std::vector<std::string> members;
  std::string grant;  // the deployer's signature of grant_text() of this; empty: unsigned
};

// How far a board is with the files it lacks.
struct FetchProgress {
  std::uint32_t files = 0;
  std::uint32_t files_done = 0;
  std::uint64_t bytes = 0;
  std::uint64_t bytes_done = 0;
};

// What the node of a board counts.
struct NodeFigures {
  std::uint64_t tick = 0;
  std::uint64_t lost_ticks = 0;
  std::uint64_t overruns = 0;
  std::uint64_t faults = 0;
};

// A new field is added here, in the IDL and in the list of deploy/link/wire_words.h; the compiler compares them.
struct BoardReport : CommittedDeployment, FetchProgress, NodeFigures {
  std::string board;
  std::uint64_t agent = 0;  // this run of the agent
  std::string host;
  std::string release;  // of the platform
  // The deployment it is in, or was in last.
  std::uint64_t deployer = 0;
  std::string deployer_host;
  std::string proposed;  // id
  Phase phase = Phase::Steady;
  Phase stage = Phase::Steady;  // where it failed
  std::uint64_t refused = 0;    // deployer that this board does not take orders of
  std::string refusal;          // and why
  std::string message;          // why it failed or went back; else what people should know
  NodeCondition node = NodeCondition::None;
  std::int64_t clock_offset_ns = 0;  // CLOCK_REALTIME here minus the deployer's, transport included
};

// An agent of another release whose protocol is not this one's: it is there, and nothing it says can be heard.
struct OtherAgent {
  unsigned protocol = 0;
  std::string board;  // empty: it does not tell; likewise
  std::string host;
};
// "the agent of board b on HOST speaks protocol 1 ...", and what to do.
std::string describe(const OtherAgent& agent, unsigned own_protocol);

// Somebody with keys of the plant who reports in the name of a board that its certificate does not have. Nothing of it
// is believed.
struct Impostor {
  std::string claimed;
  std::string board;  // that has these keys; empty: it is not known
  std::uint64_t reports = 0;
};
// "board b reports in the name of board a ...", and what to do.
std::string describe(const Impostor& impostor);

struct Order {
  std::uint64_t deployer = 0;  // this run of the deployer
  std::string host;
  std::string plant;
  std::string deployment;  // id: digest of the package's text
  std::uint64_t size = 0;  // of the package's text
  std::uint64_t generation = 0;
  std::vector<std::string> boards;  // those that are meant
  Step step = Step::Prepare;
  std::int64_t said_at_ns = 0;    // CLOCK_REALTIME of the deployer
  std::int64_t switch_at_ns = 0;  // likewise; with Step::Switch
  std::int64_t health_ns = 0;     // how long the new deployment is watched before it counts as good
  std::string grant;              // signature of grant_text(); empty: unsigned
  std::string signature;          // of order_text()
};

// What is signed: that a deployment is one of the plant's, for good, and what a deployer says just now.
std::string grant_text(const std::string& plant, const std::string& deployment, std::uint64_t generation);
std::string order_text(const Order& order);

// A piece of a file. Files are named by their digest.
struct BlobRequest {
  std::uint64_t requester = 0;  // agent or deployer
  std::uint64_t source = 0;     // likewise
  std::string blob;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  bool restart = false;  // forget what this requester asked before
};
struct BlobChunk {
  std::uint64_t source = 0;
  std::string blob;
  std::uint64_t offset = 0;
  bool missing = false;  // the source does not have it
  std::vector<std::uint8_t> data;
};

// How people see an id.
inline constexpr std::size_t kShownDigits = 12;
inline std::string shown_id(const std::string& id) {
  return id.substr(0, kShownDigits);
}
// In place of a digest: the list of a board's earlier deployments, as JSON.
inline constexpr const char* kHistoryBlob = "history";
// Likewise: what the board's node reads from other boards at this moment, and how old it is.
inline constexpr const char* kMirrorBlob = "mirror";
// Likewise: the run block of the board's node as it is at this moment (deploy/agent/run_image.h), for tools elsewhere.
inline constexpr const char* kRunBlob = "run";
// Likewise: the variables of the board's node, their values, and what was printed (deploy/agent/board_values.h).
inline constexpr const char* kVariablesBlob = "variables";
inline constexpr const char* kValuesBlob = "values";
inline constexpr const char* kMessagesBlob = "messages";
// Likewise: its alarms (deploy/agent/board_alarms.h).
inline constexpr const char* kAlarmsBlob = "alarms";
// Likewise: its files compared with their digests (deploy/agent/board_verify.h): this and a name of the question.
inline constexpr std::string_view kVerifyBlob = "verify/";
// Likewise: the list of its black boxes (deploy/agent/boxes_text.h), and one of them: this and its name.
inline constexpr const char* kBoxesBlob = "boxes";
inline constexpr std::string_view kBoxBlob = "box/";
// Likewise: the list of its recordings (deploy/agent/board_recorder.h), and one of them.
inline constexpr const char* kRecordingsBlob = "recordings";
inline constexpr std::string_view kRecordingBlob = "recording/";

}  // namespace indurop::deploy
