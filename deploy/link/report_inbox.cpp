// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/report_inbox.h"

#include <utility>

#include "deploy/link/wire_words.h"
#include "network/dds/entity.h"

namespace indurop::deploy {

dds::Listener ReportInbox::listener() {
  return dds::data_listener([](dds::Handle reader, void* of) { static_cast<ReportInbox*>(of)->receive(reader); }, this);
}

void ReportInbox::receive(dds::Handle reader) {
  {
    const std::lock_guard lock(mutex_);
    dds::take_all<indurop_deploy_BoardReport>(reader, [&](const auto& sample, const dds::SampleInfo& info) {
      Received& to = place(info.publication, sample.board, sample.agent);
      if (info.valid) {
        to.report = wire::word_of<BoardReport>(sample);
        ++to.reports;
      }
      to.gone = !info.alive;
    });
  }
  wake_.wake();
}

ReportInbox::Received& ReportInbox::place(dds::InstanceHandle publication, const std::string& board,
                                          std::uint64_t agent) {
  const auto [found, is_new] = places_.try_emplace({publication, board, agent}, received_.size());
  if (is_new) {
    Received& made = received_.emplace_back();
    made.publication = publication;
    made.board = board;
    made.agent = agent;
  }
  return received_[found->second];
}

std::vector<ReportInbox::Received> ReportInbox::take() {
  const std::lock_guard lock(mutex_);
  places_.clear();
  return std::exchange(received_, {});
}

}  // namespace indurop::deploy
