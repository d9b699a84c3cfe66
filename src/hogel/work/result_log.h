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

/// The results of loops that merge in order (ordered_reduce()), in the order in which they were merged, in a file. The
/// key of a result is the number of its loop, the loop's number of results, and its own number.
class ResultLog {
  public:
    /// Without a path it keeps nothing: of a process that is not the first of a team. Throws as CheckpointFile does.
    ResultLog(const std::filesystem::path& path, const std::vector<std::string>& work) : file_(path, work) {}
    /// The file stays if it holds results.
    ~ResultLog();
    ResultLog(const ResultLog&) = delete;
    ResultLog& operator=(const ResultLog&) = delete;

    /// Begins the next loop, of n results, and gives what is kept of it.
    /// @return how many results there were, the first ones of the loop
    std::size_t begin(std::size_t n, const std::function<void(std::size_t i, std::string_view bytes)>& take);
    /// Keeps the next result of the loop that was begun.
    void keep(std::string_view bytes);
    /// Removes the file.
    void remove() { file_.remove(); }

  private:
    CheckpointFile file_;
    std::uint64_t loops_ = 0;
    std::uint64_t results_ = 0;        // in the file
    std::vector<std::uint64_t> next_;  // key of the result that is kept next
};

/// That of the ResumeScope which exists, or null.
ResultLog* result_log();
void set_result_log(ResultLog* log);

/// Does a piece of work whose results are in files of their own, unless the ResumeScope that exists says that it was
/// done the last time. All processes of a team call it.
void once(const std::function<void()>& work);

}  // namespace hogel::work
