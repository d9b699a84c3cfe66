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

// How long messages may take to leave at the end.
constexpr std::chrono::seconds link_patience{5};
// How long messages on their way are waited for.
constexpr int tries_without_pause = 1000;
constexpr std::chrono::microseconds between_tries{50};
// Memory of messages that have left is kept for those that arrive, because that of a new string is cleared: that of so
// many, of these sizes.
constexpr std::size_t max_spare = 8, min_spare_bytes = std::size_t{1} << 16, max_spare_bytes = std::size_t{1} << 21;

// What every process of this machine says of itself, in the order of their ranks.
template <class Value>
std::vector<Value> values_of_machine(const Value& own) {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int size = 1;
    MPI_Comm_size(machine, &size);
    std::vector<Value> values(static_cast<std::size_t>(size));
    MPI_Allgather(&own, sizeof own, MPI_BYTE, values.data(), sizeof own, MPI_BYTE, machine);
    MPI_Comm_free(&machine);
    return values;
}

// The processors that this process may run on, divided by the number of processes on this machine that may run on
// exactly those: all of them, or those that mpirun bound each process to.
std::size_t fair_threads() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    if (sched_getaffinity(0, sizeof mine, &mine) != 0) CPU_SET(0, &mine);
    const std::vector<cpu_set_t> sets = values_of_machine(mine);
    const auto same = std::ranges::count_if(sets, [&](const cpu_set_t& set) { return CPU_EQUAL(&set, &mine) != 0; });
    return static_cast<std::size_t>(std::max<long>(1, CPU_COUNT(&mine) / std::max<long>(1, same)));
}

}  // namespace

MpiLink::MpiLink(int& argc, char**& argv) {
    int provided = MPI_THREAD_SINGLE, rank = 0, size = 1;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_dup(MPI_COMM_WORLD, &all_);
    // What goes to a rank that is lost is lost; its job ends by a stop, in good order.
    MPI_Comm_set_errhandler(all_, MPI_ERRORS_RETURN);
    MPI_Comm_rank(all_, &rank);
    MPI_Comm_size(all_, &size);
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
            forget_what_has_left();
            if (sent_.empty() || std::chrono::steady_clock::now() > end) break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    MPI_Comm_free(&all_);
    MPI_Finalize();
}

void MpiLink::abort(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
}

void MpiLink::forget_what_has_left() {
    for (auto each = sent_.begin(); each != sent_.end();) {
        int left = 0;
        MPI_Test(&each->request, &left, MPI_STATUS_IGNORE);
        if (left != 0) keep_memory(std::move(each->bytes));
        each = left != 0 ? sent_.erase(each) : std::next(each);
    }
}

void MpiLink::keep_memory(std::string bytes) {
    if (spare_.size() < max_spare && bytes.size() >= min_spare_bytes && bytes.size() <= max_spare_bytes)
        spare_.push_back(std::move(bytes));
}

std::string MpiLink::room_for(std::size_t bytes) {
    const auto spare = std::ranges::find_if(spare_, [&](const std::string& each) { return each.size() >= bytes; });
    if (bytes < min_spare_bytes || spare == spare_.end()) return std::string(bytes, '\0');
    std::string room = std::move(*spare);
    spare_.erase(spare);
    room.resize(bytes);
    return room;
}

void MpiLink::send(std::size_t to, Kind kind, std::string bytes) {
    if (bytes.size() > std::numeric_limits<int>::max())
        throw Error(ErrorCode::internal,
                    fmt::format("a message of {} bytes between ranks is longer than MPI sends at once", bytes.size()));
    const std::lock_guard lock(mutex_);
    forget_what_has_left();
    Sent& sent = sent_.emplace_back();
    sent.bytes = std::move(bytes);
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, static_cast<int>(to),
              static_cast<int>(kind), all_, &sent.request);
}

std::optional<Message> MpiLink::receive(Kind kind) {
    std::unique_lock lock(mutex_);
    forget_what_has_left();
    int there = 0, bytes = 0;
    MPI_Status status;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Improbe(MPI_ANY_SOURCE, static_cast<int>(kind), all_, &there, &message, &status);
    if (there == 0) return std::nullopt;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    Message received{static_cast<std::size_t>(status.MPI_SOURCE), room_for(static_cast<std::size_t>(bytes))};
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Imrecv(received.bytes.data(), bytes, MPI_BYTE, &message, &request);
    // The rest of a long message never comes from a machine that is lost: other threads go on.
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
