// SPDX-License-Identifier: Apache-2.0
#include "mpi/mpi_link.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "hogel/error.h"

namespace hogel::mpi {
namespace {

// Time for messages to leave at the end.
constexpr std::chrono::seconds link_patience{5};
// Polling of messages that are arriving.
constexpr int tries_without_pause = 1000;
constexpr std::chrono::microseconds between_tries{50};
// Number and sizes of buffers of sent messages that are reused for received ones. A new string would be cleared first.
constexpr std::size_t max_spare = 8, min_spare_bytes = std::size_t{1} << 16, max_spare_bytes = std::size_t{1} << 21;

// Gathers a value of every rank on this machine, in the order of ranks.
template <class Value>
std::vector<Value> values_of_machine(const Value& local) {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int size = 1;
    MPI_Comm_size(machine, &size);
    std::vector<Value> values(static_cast<std::size_t>(size));
    MPI_Allgather(&local, sizeof local, MPI_BYTE, values.data(), sizeof local, MPI_BYTE, machine);
    MPI_Comm_free(&machine);
    return values;
}

// Returns the number of processors in this process's affinity mask, divided by the number of ranks on this machine with
// the same mask.
std::size_t fair_threads() {
    cpu_set_t affinity;
    CPU_ZERO(&affinity);
    if (sched_getaffinity(0, sizeof affinity, &affinity) != 0) CPU_SET(0, &affinity);
    const std::vector<cpu_set_t> sets = values_of_machine(affinity);
    const auto same =
        std::ranges::count_if(sets, [&](const cpu_set_t& set) { return CPU_EQUAL(&set, &affinity) != 0; });
    return static_cast<std::size_t>(std::max<long>(1, CPU_COUNT(&affinity) / std::max<long>(1, same)));
}

}  // namespace

MpiLink::MpiLink(int& argc, char**& argv) {
    int provided = MPI_THREAD_SINGLE, rank = 0, size = 1;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator_);
    // Messages to a lost rank are dropped: the job then ends by a stop instead of an MPI error.
    MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN);
    MPI_Comm_rank(communicator_, &rank);
    MPI_Comm_size(communicator_, &size);
    rank_ = static_cast<std::size_t>(rank);
    size_ = static_cast<std::size_t>(size);
    threads_ = fair_threads();
    on_this_machine_ = values_of_machine(RankProcess{rank_, getpid()});
    if (provided < MPI_THREAD_SERIALIZED)
        throw Error(ErrorCode::not_built_in, "this MPI cannot be called by several threads (MPI_THREAD_SERIALIZED)");
}

MpiLink::~MpiLink() {
    const auto end = std::chrono::steady_clock::now() + link_patience;
    for (;;) {
        {
            const std::lock_guard lock(mutex_);
            release_sent();
            if (sent_.empty() || std::chrono::steady_clock::now() > end) break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    MPI_Comm_free(&communicator_);
    MPI_Finalize();
}

void MpiLink::abort(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
}

void MpiLink::release_sent() {
    for (auto each = sent_.begin(); each != sent_.end();) {
        int complete = 0;
        MPI_Test(&each->request, &complete, MPI_STATUS_IGNORE);
        if (complete != 0) recycle(std::move(each->bytes));
        each = complete != 0 ? sent_.erase(each) : std::next(each);
    }
}

void MpiLink::recycle(std::string bytes) {
    if (spare_.size() < max_spare && bytes.size() >= min_spare_bytes && bytes.size() <= max_spare_bytes)
        spare_.push_back(std::move(bytes));
}

std::string MpiLink::buffer_of(std::size_t bytes) {
    const auto spare = std::ranges::find_if(spare_, [&](const std::string& each) { return each.size() >= bytes; });
    if (bytes < min_spare_bytes || spare == spare_.end()) return std::string(bytes, '\0');
    std::string buffer = std::move(*spare);
    spare_.erase(spare);
    buffer.resize(bytes);
    return buffer;
}

void MpiLink::send(std::size_t to, Kind kind, std::string bytes) {
    if (bytes.size() > std::numeric_limits<int>::max())
        throw Error(ErrorCode::internal,
                    fmt::format("a message of {} bytes between ranks exceeds the limit of MPI, 2 GiB", bytes.size()));
    const std::lock_guard lock(mutex_);
    release_sent();
    Sent& sent = sent_.emplace_back();
    sent.bytes = std::move(bytes);
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, static_cast<int>(to),
              static_cast<int>(kind), communicator_, &sent.request);
}

std::optional<Message> MpiLink::receive(Kind kind) {
    std::unique_lock lock(mutex_);
    release_sent();
    int available = 0, bytes = 0;
    MPI_Status status;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Improbe(MPI_ANY_SOURCE, static_cast<int>(kind), communicator_, &available, &message, &status);
    if (available == 0) return std::nullopt;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    Message received{static_cast<std::size_t>(status.MPI_SOURCE), buffer_of(static_cast<std::size_t>(bytes))};
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Imrecv(received.bytes.data(), bytes, MPI_BYTE, &message, &request);
    // The rest of a long message never arrives from a lost machine: releases the lock for other threads.
    for (int arrived = 0, tries = 0; MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), arrived == 0; ++tries) {
        lock.unlock();
        if (tries < tries_without_pause)
            std::this_thread::yield();
        else
            std::this_thread::sleep_for(between_tries);
        lock.lock();
    }
    return received;
}

}  // namespace hogel::mpi
