// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/pool_program.h"

#include <fmt/format.h>

#include "core/base/read_file.h"
#include "deploy/words/node_texts.h"
#include "store/vars/process.h"
#include "store/vars/retain.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

std::optional<PoolProgram> read_pool_program(std::string_view text) {
  const JsonValue whole = JsonValue::parse(text).value_or(JsonValue());
  PoolProgram program;
  if (!read(whole, "state", program.state) || !read(whole, "pid", program.pid) ||
      !read(whole, "start_time", program.start_time) || !read(whole, "problem", program.problem)) {
    return std::nullopt;
  }
  for (const JsonValue& one : whole["pools"].values()) {
    PoolProgram::Pool& pool = program.pools.emplace_back();
    if (!read(one, "pool", pool.name) || !read(one, "text", pool.text)) {
      return std::nullopt;
    }
  }
  return program;
}

std::optional<PoolProgram> view_pool_program(const std::string& node) {
  const auto text = base::read_file(deploy::pools_file(vars::state_directory(node)));
  auto program = text ? read_pool_program(*text) : std::nullopt;
  if (program && program->pid > 0 && !vars::process_alive(static_cast<pid_t>(program->pid), program->start_time)) {
    program->state = "restarting";
    program->problem = "indurop-pools has ended with the agent of this board; the next agent starts it";
    program->pid = 0;
  }
  return program;
}

std::string line_of(const PoolProgram& program) {
  std::string line = "indurop-pools is " + printable(program.state);
  if (program.pid > 0) {
    line += fmt::format(" (pid {})", program.pid);
  }
  const char* separator = ": ";
  for (const PoolProgram::Pool& pool : program.pools) {
    line += separator + printable(pool.name) + " " + printable(pool.text);
    separator = "; ";
  }
  return line;
}

JsonValue json_of(const std::optional<PoolProgram>& program) {
  if (!program) {
    return {};
  }
  JsonValue pools = JsonValue::array();
  for (const PoolProgram::Pool& pool : program->pools) {
    pools.push_back({{"pool", pool.name}, {"text", pool.text}});
  }
  return {{"state", program->state}, {"pid", program->pid}, {"problem", program->problem}, {"pools", pools}};
}

}  // namespace indurop::tools
