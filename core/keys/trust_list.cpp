// SPDX-License-Identifier: Apache-2.0
#include "core/keys/trust_list.h"

#include <fmt/format.h>

#include <cerrno>
#include <string_view>
#include <utility>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "core/keys/plant_parts.h"
#include "core/keys/revocation.h"

namespace indurop::keys {

namespace fs = std::filesystem;
using base::Problem;

namespace {

constexpr std::string_view kMark = "indurop trust list\n";
constexpr std::size_t kLargest = 1U << 20U;  // bytes: some thousand revoked certificates

}  // namespace

std::string signed_trust_list(const TrustList& list, const Authority& authority) {
  return sign_document(authority, fmt::format("{}{}\n{}\n{}\n{}{}", kMark, list.plant, list.serial, list.revoked.size(),
                                              list.revoked, list.deploy_keys));
}

std::optional<TrustList> read_trust_list(const std::string& document, const std::string& authority) {
  std::string text = signed_text(document, authority);
  std::erase(text, '\r');  // S/MIME ends lines with CRLF
  std::string_view rest = text;
  if (!rest.starts_with(kMark)) {
    return std::nullopt;
  }
  rest.remove_prefix(kMark.size());
  TrustList list;
  list.plant = base::take_line(rest);
  const auto serial = base::whole_number(base::take_line(rest));
  const auto size = base::whole_number(base::take_line(rest));
  if (!serial || !size || *size > rest.size()) {
    return std::nullopt;
  }
  list.serial = *serial;
  list.revoked = rest.substr(0, *size);
  list.deploy_keys = rest.substr(*size);
  return list;
}

fs::path received_trust(const fs::path& state, const std::string& plant) {
  return state / "keys" / plant;
}

ReceivedTrust::ReceivedTrust(ParticipantKeys own, fs::path folder) : own_(std::move(own)), folder_(std::move(folder)) {}

fs::path ReceivedTrust::file() const {
  return folder_ / kTrust;
}

fs::path ReceivedTrust::revoked() const {
  return folder_ / kRevoked;
}

BoardTrust ReceivedTrust::current() const {
  const std::string authority = read_text(own_.authority);
  std::string brought = read_text(own_.folder / kTrust);
  auto received = base::read_file(file());
  const auto before = read_trust_list(brought, authority);
  auto later = received ? read_trust_list(*received, authority) : std::nullopt;
  if (later && (!before || before->serial < later->serial)) {
    if (read_text(revoked()) != later->revoked) {
      // Where this fails, DDS Security rejects the file, and the board stays out of the network.
      (void)base::replace_file(revoked(), later->revoked, base::Durable::Yes, kPublic);
    }
    return {later->serial, std::move(*received), revoked(), std::move(later->deploy_keys), {}};
  }
  BoardTrust trust{before ? before->serial : 0,
                   before ? std::move(brought) : std::string(),
                   own_.revoked,
                   read_text(own_.deploy_key),
                   {}};
  if (!later && (received || received.error().sys_errno != ENOENT)) {
    trust.problem = fmt::format(
        "{}: the list of valid keys that this board had received is not valid{}; an earlier one "
        "applies until another board or indurop keys send brings it again",
        file().string(), received ? "" : " (" + received.error().text + ")");
  }
  return trust;
}

Result<TrustList, Problem> ReceivedTrust::later(const std::string& document) const {
  const std::string authority = read_text(own_.authority);
  if (document.size() > kLargest) {
    return Problem{"it is too large for a list of keys"};
  }
  auto list = read_trust_list(document, authority);
  if (!list) {
    return Problem{"it is no list that the authority of this board's keys has signed"};
  }
  if (const auto facts = read_certificate(authority); !facts || facts->organisation != list->plant) {
    return Problem{fmt::format("it is the list of plant {}", list->plant)};
  }
  if (!revocation_list_of(list->revoked, authority)) {
    return Problem{"it has no list of revoked certificates of this authority"};  // nothing could connect with it
  }
  const BoardTrust present = current();
  if (list->serial <= present.serial) {
    return Problem{fmt::format("this board has list {} of the keys, and this one is {}", present.serial, list->serial)};
  }
  if (!revokes_all_of(list->revoked, read_text(present.revoked))) {
    return Problem{"it would make certificates valid again that are revoked"};
  }
  return *std::move(list);
}

Result<std::uint64_t, Problem> ReceivedTrust::judge(const std::string& document) const {
  const auto list = later(document);
  return list ? Result<std::uint64_t, Problem>(list->serial) : list.error();
}

Result<void, Problem> ReceivedTrust::take(const std::string& document) const {
  const auto list = later(document);
  if (!list) {
    return list.error();
  }
  std::error_code error;
  fs::create_directories(folder_, error);
  // The list last: it makes the other file valid, which until then revokes more than the list before at most.
  for (const auto& [path, text] : {std::pair(revoked(), &list->revoked), std::pair(file(), &document)}) {
    if (const auto written = base::replace_file(path, *text, base::Durable::Yes, kPublic); !written) {
      return Problem{base::cannot_write(path, written.error())};
    }
  }
  return {};
}

bool ReceivedTrust::revokes(const std::string& certificate) const {
  return is_revoked(certificate, read_text(own_.revoked)) || is_revoked(certificate, read_text(current().revoked));
}

}  // namespace indurop::keys
