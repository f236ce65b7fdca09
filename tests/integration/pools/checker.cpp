// SPDX-License-Identifier: Apache-2.0
// Compares each byte of each chunk. A wrong one is kept in a file, which no restart of the node removes.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "content.h"

using namespace pooltest::Flow;

namespace {

void keep_wrong(const char* pool, std::uint64_t index) {
  const char* const folder = std::getenv("POOLS_TEST_FOLDER");
  const std::string path = std::string(folder == nullptr ? "/tmp" : folder) + "/wrong-" + std::to_string(index);
  if (std::FILE* const file = std::fopen(path.c_str(), "w"); file != nullptr) {
    (void)std::fprintf(file, "%s\n", pool);
    (void)std::fclose(file);
  }
}

template <class Pool, class Count>
void check_all(const Pool& pool, const char* name, Count& count) {
  while (const auto chunk = pool.next()) {
    const std::int64_t age = chunk.age().count();
    const std::int64_t since = irp::now_ns() - static_cast<std::int64_t>(chunk->index);
    if (!pool_content::is_whole(*chunk)) {
      keep_wrong(name, chunk->index);
    }
    const std::int64_t error = std::abs(since - age);
    if (error > age_error_ns) {
      age_error_ns = error;
    }
    newest = chunk->index;
    count += 1;
  }
}

}  // namespace

int main() {
  irp::initPeriodExe();
  while (irp::waitPeriod()) {
    check_all(large, "large", large_seen);
    check_all(small, "small", small_seen);
  }
}
