// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/foe_client.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr Clock kFoePatience = std::chrono::seconds(20);  // a slave may erase its memory first

std::string text_of(Bytes bytes) {
  return {bytes.begin(), std::find(bytes.begin(), bytes.end(), std::uint8_t{0})};
}

std::string refusal_of(const Foe& error) {
  const std::string text = text_of(error.data);
  return fmt::format("it refuses: {} ({:04x}h){}{}", foe_error_text(error.number), error.number,
                     text.empty() ? "" : ": ", text);
}

std::string unexpected(const Foe& foe) {
  return fmt::format("it answers with something else (operation {}, number {})", static_cast<unsigned>(foe.code),
                     foe.number);
}

}  // namespace

void FoeClient::report(std::size_t bytes) const {
  if (progress_) {
    progress_(bytes);
  }
}

// Sends a message and returns the answer. A slave that is busy is asked again with the same message.
Result<std::vector<std::uint8_t>, std::string> FoeClient::ask(Bytes message) {
  for (;;) {
    if (std::string wrong = session_.send(MailboxType::Foe, message); !wrong.empty()) {
      return wrong;
    }
    auto answer = session_.receive(
        [](const Mailbox& mailbox) { return mailbox.type == MailboxType::Foe && read_foe(mailbox.data); },
        kFoePatience);
    if (!answer) {
      return answer.error();
    }
    const Foe foe = *read_foe(*answer);
    if (foe.code == FoeCode::Error) {
      return refusal_of(foe);
    }
    if (foe.code != FoeCode::Busy) {
      return answer;
    }
  }
}

Result<std::vector<std::uint8_t>, std::string> FoeClient::read(const std::string& name) {
  const std::size_t most = session_.answer_room() - kFoeHeader;
  std::vector<std::uint8_t> content;
  std::vector<std::uint8_t> message = write_foe(FoeCode::Read, password_, name);
  for (std::uint32_t packet = 1;; ++packet) {
    const auto answer = ask(message);
    if (!answer) {
      return answer.error();
    }
    const Foe foe = *read_foe(*answer);
    if (foe.code != FoeCode::Data || foe.number != packet) {
      return unexpected(foe);
    }
    content.insert(content.end(), foe.data.begin(), foe.data.end());
    report(content.size());
    message = write_foe(FoeCode::Acknowledge, packet);
    if (foe.data.size() < most) {
      std::string wrong = session_.send(MailboxType::Foe, message);
      return wrong.empty() ? Result<std::vector<std::uint8_t>, std::string>(std::move(content)) : std::move(wrong);
    }
  }
}

std::string FoeClient::write(const std::string& name, Bytes content) {
  const std::size_t most = session_.room() - kFoeHeader;
  std::vector<std::uint8_t> message = write_foe(FoeCode::Write, password_, name);
  std::size_t done = 0;
  // A packet that is not full is the last one, so a file of full packets ends with an empty one.
  bool is_last = false;
  for (std::uint32_t packet = 0;; ++packet) {
    const auto answer = ask(message);
    if (!answer) {
      return answer.error();
    }
    if (const Foe foe = *read_foe(*answer); foe.code != FoeCode::Acknowledge || foe.number != packet) {
      return unexpected(foe);
    }
    report(done);
    if (is_last) {
      return {};
    }
    const Bytes part = content.subspan(done, std::min(most, content.size() - done));
    message = write_foe(FoeCode::Data, packet + 1, part);
    done += part.size();
    is_last = part.size() < most;
  }
}

}  // namespace indurop::io::ethercat
