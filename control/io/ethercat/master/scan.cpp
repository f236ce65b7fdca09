// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "control/io/ethercat/master/master.h"

namespace indurop::io::ethercat {

namespace {

using std::chrono::milliseconds;

constexpr Clock kEepromPatience = milliseconds(200);
constexpr std::size_t kMaxImage = 64 * std::size_t{1024};

// Where the image ends as far as it was read: after the category that says so. Nothing: more has to be read first.
std::optional<std::size_t> end_of(Bytes image) {
  std::size_t at = std::size_t{2} * kSiiCategories;
  while (at + 4 <= image.size()) {
    if (load<std::uint16_t>(image, at) == kSiiEnd) {
      return at + 2;
    }
    at += 4 + std::size_t{2} * load<std::uint16_t>(image, at + 2);
  }
  return std::nullopt;
}

}  // namespace

bool Scan::read_eeprom(std::size_t place, std::size_t word, std::vector<std::uint8_t>& into) {
  std::array<std::uint8_t, 6> command{};
  store<std::uint16_t>(command, 0, kEepromRead);
  store<std::uint32_t>(command, 2, static_cast<std::uint32_t>(word));
  if (!requester_.write(place, reg::kEepromControl, command)) {
    return false;
  }
  const Clock deadline = requester_.wait() + kEepromPatience;
  for (Clock now{0}; now < deadline; now = requester_.wait()) {
    const auto status = requester_.read(place, reg::kEepromControl, 2);
    if (!status) {
      return false;
    }
    const auto bits = load<std::uint16_t>(*status, 0);
    if ((bits & kEepromBusy) != 0) {
      continue;
    }
    const auto found = requester_.read(place, reg::kEepromData, (bits & kEepromEightBytes) != 0 ? 8 : 4);
    if ((bits & kEepromErrors) != 0 || !found) {
      return false;
    }
    into.insert(into.end(), found->begin(), found->end());
    return true;
  }
  return false;
}

std::optional<std::vector<std::uint8_t>> Scan::read_image(std::size_t place) {
  const std::array<std::uint8_t, 1> force = {kEepromForce};
  const std::array<std::uint8_t, 1> own = {kEepromOfMaster};
  std::vector<std::uint8_t> image;
  if (!requester_.write(place, reg::kEepromConfig, force) || !requester_.write(place, reg::kEepromConfig, own)) {
    return std::nullopt;
  }
  while (!end_of(image) && image.size() < kMaxImage) {
    if (!read_eeprom(place, image.size() / 2, image)) {
      return std::nullopt;
    }
  }
  return image;
}

FoundSlave Scan::identify(std::size_t place) {
  FoundSlave found;
  const auto alias = requester_.read(place, reg::kAlias, 2);
  const auto state = requester_.read(place, reg::kAlStatus, 2);
  const auto features = requester_.read(place, reg::kFeatures, 2);
  if (!alias || !state || !features) {
    found.problem = "it does not answer any more";
    return found;
  }
  found.alias = load<std::uint16_t>(*alias, 0);
  found.features = load<std::uint16_t>(*features, 0);
  found.state = static_cast<AlState>((*state)[0] & kAlStateMask);
  const auto image = read_image(place);
  if (!image) {
    found.problem = "its EEPROM does not answer";
    return found;
  }
  auto sii = read_sii(*image);
  if (!sii) {
    found.problem = fmt::format("its EEPROM is not readable: {}", sii.error());
    return found;
  }
  found.sii = std::move(*sii);
  return found;
}

Result<std::vector<FoundSlave>, std::string> Scan::run() {
  const std::array<std::uint8_t, 1> nothing{};
  const auto count = requester_.request(Command::Brd, address_of(0, reg::kType), nothing);
  if (!count || count->wkc == 0) {
    return std::string("no slave answers; check the cable, and the power of the first slave");
  }
  std::vector<FoundSlave> slaves;
  for (std::size_t place = 0; place < count->wkc; ++place) {
    slaves.push_back(identify(place));
  }
  return slaves;
}

}  // namespace indurop::io::ethercat
