// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hogel::core {

/// The results of loops that merge in order (shared_ordered()), in the order in which they were merged, in a file. Each
/// record has a checksum; one that is damaged or incomplete ends the file, whose results from there on are computed
/// again.
///
/// The file: a line `hogel results 1`, the lines of the work, each after `work `, a line `results`, and for each result
/// the checksum of what follows, the number of the loop, its number of results, the number of the result and of its
/// bytes (8 bytes each, of this machine), and the bytes.
class ResultLog {
  public:
    /// Opens or creates the file. Without a path it keeps nothing: of a process that is not the first of a team.
    ResultLog(const std::filesystem::path& path, const std::vector<std::string>& work);
    ~ResultLog();
    ResultLog(const ResultLog&) = delete;
    ResultLog& operator=(const ResultLog&) = delete;

    /// Begins the next loop, of n results, and gives what is kept of it.
    /// @return how many results there were, the first ones of the loop
    std::size_t begin(std::size_t n, const std::function<void(std::size_t i, std::string_view bytes)>& take);
    /// Keeps the next result of the loop that was begun.
    void keep(std::string_view bytes);
    /// Removes the file.
    void remove();

  private:
    struct Head {
        std::uint64_t loop = 0, results = 0, result = 0, bytes = 0;
    };
    [[noreturn]] void fail(int error) const;
    void read_work(const std::vector<std::string>& work);
    bool read(void* to, std::size_t bytes);
    bool read_record(Head& head, std::string& bytes);
    void write(std::string_view bytes);
    void forget_the_rest();

    std::filesystem::path path_;
    int file_ = -1;
    std::uint64_t place_ = 0;  // of the next record
    bool at_end_ = false;      // nothing kept is left to be taken
    Head next_;                // of the result that is kept next
    std::uint64_t loops_ = 0;
    std::uint64_t results_ = 0;  // in the file
};

/// That of the ResumeScope which exists, or null.
ResultLog* result_log();
void set_result_log(ResultLog* log);

}  // namespace hogel::core
