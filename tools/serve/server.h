// SPDX-License-Identifier: Apache-2.0
// indurop-serve as a whole: gate, door, answers, page.

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/client/board/plant_watch.h"
#include "tools/client/plc/plc_pictures.h"
#include "tools/console/serve_options.h"
#include "tools/serve/admission.h"
#include "tools/serve/alarms/alarm_desk.h"
#include "tools/serve/api/api.h"
#include "tools/serve/api/router.h"
#include "tools/serve/audit.h"
#include "tools/serve/boards/boards.h"
#include "tools/serve/door/door.h"
#include "tools/serve/jog/jog_desk.h"
#include "tools/serve/leases/lease_desk.h"
#include "tools/serve/page.h"
#include "tools/serve/stream/hub.h"
#include "tools/serve/users/sign_in_limit.h"
#include "tools/serve/users/user_book.h"
#include "tools/serve/worker.h"

namespace indurop::serve {

class Server final : public House {
 public:
  Server(tools::ServeOptions options, Admission admission, const std::string& version);

  // Serves until a signal ends it. Returns the exit code.
  int run();

  std::string choose_subprotocol(const Request& request) override;
  Client identify(const std::string& certificate) override;
  std::optional<Reply> refuse(Request& request) override;
  void note_refused(const Request& request, const std::string& why, std::uint64_t count) override;
  std::optional<Reply> answer(const Request& request, Ticket ticket) override;
  std::unique_ptr<Visitor> receive(const Request& request, Line& line) override;

 private:
  // The same for a request that has waited; may be called by any thread.
  std::optional<Reply> refuse_now(Request& request);
  // Readers of boards of other hosts; the door's thread is 0.
  static constexpr std::size_t kPlantReader = 1;
  static constexpr std::size_t kFilesReader = 2;
  // One more thread with its own boards and jobs. The worker ends first.
  struct Helper {
    explicit Helper(const std::string& node, const RemotePoller* remote = nullptr, std::size_t reader = 0)
        : boards(node, remote, reader) {}
    Boards boards;
    Worker worker;
  };
  struct SignIn {
    SignInLimit limit;
    Worker worker;  // verifies passwords
  };
  // Answers on another thread; empty: by route and call.
  using Answer = std::function<Reply(const Match& match)>;
  std::optional<Reply> hand_over(Worker& worker, Match match, Ticket ticket, Answer answer = {});
  std::optional<Reply> hand_over(Helper& helper, Match match, Ticket ticket);
  std::optional<Reply> let_wait(const Match& match, Ticket ticket);
  std::optional<Reply> ask_plant(Match match, Ticket ticket);
  std::optional<Reply> order_plant(Match match, Ticket ticket);
  std::optional<Reply> ask_plc(Match match, Ticket ticket);
  std::optional<Reply> try_to_sign_in(Match match, Ticket ticket);
  // Returns true if the request is about a board of another host.
  [[nodiscard]] bool is_remote(const Match& match) const;
  std::optional<Reply> ask_remote(Match match, Ticket ticket);
  // Returns the job that answers, with a copy of the request.
  std::function<void()> job_of(Match match, Ticket ticket, Answer answer = {});
  Reply answered(const Match& match);
  void announce() const;

  tools::ServeOptions options_;
  UserBook users_;
  AccessGate gate_;
  ClientCertificates authority_;
  Audit audit_;
  AlarmDesk alarms_;
  LeaseDesk leases_;
  JogDesk jogs_;
  Api api_;
  Page page_;
  RemotePoller remote_boards_;
  Boards boards_;
  Hub hub_;
  std::unique_ptr<Door> door_;  // declared after everything its connections use
  std::unique_ptr<Door::Alarm> sampling_;
  Helper files_;
  SignIn sign_in_;
  Helper orders_;
  Helper holds_;
  Helper history_;
  Helper calls_;
  Helper replays_;
  struct Plant {
    Plant(const deploy::LinkSettings& settings, const std::string& node, const RemotePoller& boards_of_it)
        : watch(settings), boards(node, &boards_of_it, kPlantReader, &watch) {}
    tools::PlantWatch watch;  // used by the worker's thread
    Boards boards;            // used by the worker's thread
    Worker worker;
    Worker orders;  // one at a time
  };
  struct Plc {
    Plc(const std::vector<tools::PlcFiles>& programs, const std::string& node) : pictures(programs), boards(node) {}
    tools::PlcPictures pictures;  // used by the worker's thread
    Boards boards;
    Worker worker;
  };
  std::unique_ptr<Plc> plc_;                      // null: no program is shown
  std::unique_ptr<Plant> plant_;                  // null: no plant is served
  std::vector<std::unique_ptr<Helper>> waiting_;  // one for each request that waits; created when needed
};

}  // namespace indurop::serve
