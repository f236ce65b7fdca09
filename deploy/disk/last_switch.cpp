// SPDX-License-Identifier: Apache-2.0
#include "deploy/disk/last_switch.h"

#include <sys/types.h>

#include "core/base/file_problem.h"
#include "core/base/json.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

using base::Json;

constexpr std::uint64_t kSwitchFormat = 1;
constexpr mode_t kSwitchMode = 0640;

Json json_of(const LastSwitch& last) {
  const Order& order = last.order;
  Json out{{"indurop_switch", kSwitchFormat},
           {"release", order.deployment},
           {"size", order.size},
           {"generation", order.generation},
           {"plant", order.plant},
           {"boards", order.boards},
           {"grant", order.grant},
           {"deployer", order.deployer},
           {"host", order.host},
           {"health_ns", order.health_ns},
           {"joining", last.joining},
           {"session", last.session},
           {"begun_ns", last.begun_ns},
           {"starts", last.starts},
           {"ended", last.ended},
           {"installed", last.installed}};
  if (last.expired) {  // else left out: releases before 0.2 do not know it, and the digest counts all fields
    out["expired"] = true;
  }
  return out;
}

}  // namespace

std::string switch_text(const LastSwitch& last) {
  Json whole = json_of(last);
  whole["sha256"] = keys::digest_of(whole.dump());
  return whole.dump(2) + "\n";
}

std::optional<LastSwitch> read_switch(std::string_view text) {
  const Json whole = Json::parse(text).value_or(Json());
  LastSwitch out;
  Order& order = out.order;
  std::uint64_t format = 0;
  std::string digest;
  out.expired = whole.find("expired") != nullptr;
  if (!read(whole, "indurop_switch", format) || format != kSwitchFormat || !read(whole, "release", order.deployment) ||
      !read(whole, "size", order.size) || !read(whole, "generation", order.generation) ||
      !read(whole, "plant", order.plant) || !read(whole, "boards", order.boards) ||
      !read(whole, "grant", order.grant) || !read(whole, "deployer", order.deployer) ||
      !read(whole, "host", order.host) || !read(whole, "health_ns", order.health_ns) ||
      !read(whole, "joining", out.joining) || !read(whole, "session", out.session) ||
      !read(whole, "begun_ns", out.begun_ns) || !read(whole, "starts", out.starts) ||
      !read(whole, "ended", out.ended) || !read(whole, "installed", out.installed) || !read(whole, "sha256", digest) ||
      digest != keys::digest_of(json_of(out).dump())) {
    return std::nullopt;
  }
  return out;
}

std::optional<LastSwitch> load_switch(const std::filesystem::path& platform) {
  const auto text = base::read_file(platform / kSwitchFile);
  return text ? read_switch(*text) : std::nullopt;
}

Result<void, base::Problem> save_switch(const std::filesystem::path& platform, const LastSwitch& last) {
  const std::filesystem::path file = platform / kSwitchFile;
  const auto written = base::replace_file(file, switch_text(last), base::Durable::Yes, kSwitchMode);
  return written ? Result<void, base::Problem>() : base::Problem{base::cannot_write(file, written.error())};
}

}  // namespace indurop::deploy
