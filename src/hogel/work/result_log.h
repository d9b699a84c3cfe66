// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/work/checkpoint_file.h"

namespace hogel::work {

/// Checkpoint of the results of ordered_reduce() loops, in the order of their merges. The key of a result consists of
/// the index of its loop, the number of results of the loop, and the index of the result.
class ResultLog {
  public:
    /// An empty path stores nothing; all ranks but the root pass it. Throws as CheckpointFile does.
    ResultLog(const std::filesystem::path& path, const std::vector<std::string>& work) : file_(path, work) {}
    /// Removes the file if it holds no results.
    ~ResultLog();
    ResultLog(const ResultLog&) = delete;
    ResultLog& operator=(const ResultLog&) = delete;

    /// Begins the next loop, of n results, and passes the stored results of this loop to `take`.
    /// @return  number of stored results, which are the first results of the loop
    std::size_t begin(std::size_t n, const std::function<void(std::size_t i, std::string_view bytes)>& take);
    /// Stores the next result of the current loop.
    void keep(std::string_view bytes);
    /// Removes the file.
    void remove() { file_.remove(); }

  private:
    CheckpointFile file_;
    std::uint64_t loops_ = 0;
    std::uint64_t results_ = 0;        // number of results in the file
    std::vector<std::uint64_t> next_;  // key of the next result to store
};

/// Returns the log of the active ResumeScope, or null.
ResultLog* result_log();
void set_result_log(ResultLog* log);

/// Runs work that writes its own files. Skips it if an earlier run with the active ResumeScope's checkpoint has
/// finished it. All ranks call it.
void once(const std::function<void()>& work);

}  // namespace hogel::work
