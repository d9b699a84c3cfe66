// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/journal.h"

#include <utility>

#include "hogel/error.h"

namespace hogel::work {
namespace {

// Time between writes: at most this much work is lost if the machine stops.
constexpr std::chrono::seconds between_writes{20};

}  // namespace

// The first record, with an empty key, means that the file of samples has been created.
Journal::Journal(const std::filesystem::path& path, const std::vector<std::string>& work, std::function<void()> flush)
    : file_(std::in_place, path, work), flush_(std::move(flush)) {
    std::optional<CheckpointRecord> record = file_->read();
    begun_ = record && record->key.empty();
    if (!begun_) return;
    while ((record = file_->read())) before_.insert(std::move(record->key));
}

Journal::Journal(std::set<Part> before, std::function<void()> flush, std::function<void(const std::string&)> send)
    : flush_(std::move(flush)), send_(std::move(send)), begun_(true), before_(std::move(before)) {}

Journal::~Journal() {
    try {
        write();
    } catch (const Error&) {
        // Ignored: a run that resumes computes unrecorded parts again.
    }
}

void Journal::begin() {
    file_->clear();
    file_->append(CheckpointRecord().encoded());
    before_.clear();
    written_ = std::chrono::steady_clock::now();
    begun_ = true;
}

void Journal::write_pending() {
    if (pending_.empty()) return;
    flush_();
    const std::string records = std::exchange(pending_, {});
    if (send_)
        send_(records);
    else if (file_)
        file_->append(records);
    written_ = std::chrono::steady_clock::now();
}

void Journal::note(const Part& part) {
    const std::lock_guard lock(mutex_);
    pending_ += CheckpointRecord{part, {}}.encoded();
    if (std::chrono::steady_clock::now() - written_ >= between_writes) write_pending();
}

void Journal::write() {
    const std::lock_guard lock(mutex_);
    if (file_ || send_) write_pending();
}

void Journal::take(const std::string& records) {
    const std::lock_guard lock(mutex_);
    if (file_) file_->append(records);
}

void Journal::remove() {
    const std::lock_guard lock(mutex_);
    send_ = nullptr;
    pending_.clear();
    if (file_) file_->remove();
    file_.reset();
}

}  // namespace hogel::work
