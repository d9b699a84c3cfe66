// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/result_log.h"

#include <atomic>

#include "hogel/communicator.h"
#include "hogel/error.h"
#include "hogel/resume.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::work {
namespace {

std::atomic<ResultLog*> current_log = nullptr;

}  // namespace

ResultLog* result_log() { return current_log; }

void set_result_log(ResultLog* log) { current_log = log; }

ResultLog::~ResultLog() {
    if (results_ == 0) file_.remove();
}

std::size_t ResultLog::begin(std::size_t n, const std::function<void(std::size_t i, std::string_view bytes)>& take) {
    next_ = {loops_++, n, 0};
    std::uint64_t& result = next_.back();
    while (result < n) {
        const std::optional<CheckpointRecord> record = file_.read(&next_);
        if (!record) break;
        take(result++, record->bytes);
        ++results_;
    }
    return result;
}

void ResultLog::keep(std::string_view bytes) {
    if (!file_.is_open()) return;
    file_.append(checkpoint_record_head(next_, bytes));
    file_.append(bytes);
    ++next_.back();
    ++results_;
}

void once(const std::function<void()>& work) {
    if (result_log() == nullptr) return work();
    shared_jobs<std::uint8_t>(
        1, {},
        [&](std::size_t) {
            work();
            return std::uint8_t{1};
        },
        [](std::size_t, std::uint8_t&) {}, DoneBy::all_ranks);
}

}  // namespace hogel::work

namespace hogel {

ResumeScope::ResumeScope(const std::filesystem::path& file, const std::vector<std::string>& work)
    : log_(std::make_unique<work::ResultLog>(is_root_rank() ? file : std::filesystem::path(), work)) {
    if (work::result_log() != nullptr)
        throw Error(ErrorCode::usage, "a ResumeScope exists already; only one can be active at a time");
    work::set_result_log(log_.get());
}

ResumeScope::~ResumeScope() { work::set_result_log(nullptr); }

void ResumeScope::once(const std::function<void()>& work) { work::once(work); }

void ResumeScope::complete() { log_->remove(); }

}  // namespace hogel
