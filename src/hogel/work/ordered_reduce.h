// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/communicator.h"
#include "hogel/work/job_scope.h"
#include "hogel/work/message.h"
#include "hogel/work/parallel.h"
#include "hogel/work/result_log.h"

namespace hogel::work {

/// Returns the communicator of this process, or null if it has only one rank.
inline Communicator* communicator_of_several() {
    Communicator* const current = communicator();
    return current != nullptr && current->size() > 1 ? current : nullptr;
}

/// Returns whether loops send their results to other ranks or store them in a checkpoint file.
inline bool is_shared_or_kept(DoneBy by = DoneBy::one_rank) {
    return (by == DoneBy::one_rank && communicator_of_several() != nullptr) || result_log() != nullptr;
}

/// Serialisation of results between ranks.
template <class Result>
struct Sent {
    std::function<void(MessageWriter& message, const Result& result)> write =
        [](MessageWriter& message, const Result& result) { message.put(result); };
    std::function<Result(MessageReader& message)> read = [](MessageReader& message) { return message.get<Result>(); };
};

template <class Value>
Sent<std::vector<Value>> sent_vector() {
    return {[](MessageWriter& to, const std::vector<Value>& values) { to.put(values); },
            [](MessageReader& from) { return from.get_vector<Value>(); }};
}

/// Does the work of ordered_reduce() over the ranks of a communicator, for results that are serialised to bytes.
/// @param in_flight    as for local_ordered_reduce(). The root holds at most tiles_in_flight() results times the number
///                     of ranks. 1: each rank computes one result at a time, on the calling thread
/// @param max_message  bytes; longer results are sent in several messages
void ordered_reduce_in_ranks(Communicator& communicator, std::size_t n, std::size_t in_flight,
                             const std::function<std::string(std::size_t)>& body,
                             const std::function<void(std::size_t, std::string_view)>& merge,
                             std::size_t max_message = std::size_t{1} << 30);

/// Does the work of ordered_reduce() for results that are serialised to bytes. Uses the ranks of the communicator, if
/// there is one. Within a ResumeScope, first merges the results that an earlier run left in the checkpoint.
void ordered_reduce_bytes(std::size_t n, std::size_t in_flight, const std::function<std::string(std::size_t)>& body,
                          const std::function<void(std::size_t, std::string_view)>& merge, DoneBy by);

/// Returns the maximum number of computed but unmerged results in ordered_reduce(), divided by the number of ranks: 4 ·
/// in_flight. All of them may wait on the root. For estimates of memory.
/// @param in_flight  as for local_ordered_reduce()
std::size_t tiles_in_flight(std::size_t in_flight);

/// As local_ordered_reduce(), over all ranks. The root merges all results in order, on a separate thread while it
/// computes further results: a sum over tiles is the same for any number of ranks. All ranks must call it in the same
/// order, never from loop bodies. Other ranks merge nothing and may return before the root. Within a ResumeScope merged
/// results are kept in a file and not computed again in the next run.
/// @param by  as for shared_jobs()
template <class Result>
void ordered_reduce(std::size_t n, std::size_t in_flight, const Sent<Result>& sent,
                    const std::function<Result(std::size_t)>& body,
                    const std::function<void(std::size_t, Result&)>& merge, DoneBy by = DoneBy::one_rank) {
    if (!is_shared_or_kept(by)) return local_ordered_reduce<Result>(n, in_flight, body, merge);
    ordered_reduce_bytes(
        n, in_flight,
        [&](std::size_t i) {
            MessageWriter message;
            sent.write(message, body(i));
            return message.take();
        },
        [&](std::size_t i, std::string_view bytes) {
            MessageReader message(bytes);
            Result result = sent.read(message);
            merge(i, result);
        },
        by);
}

/// As ordered_reduce(), for jobs that use all threads of a process. A process executes one job at a time, within a
/// JobScope. Within a ResumeScope each job is checkpointed as a whole.
/// @param by  one_rank: each job runs on one rank, and the root takes all results. all_ranks: all ranks execute each
///            job together and take its result; only the root takes the results of earlier runs
template <class Result>
void shared_jobs(std::size_t n, const Sent<Result>& sent, const std::function<Result(std::size_t)>& job,
                 const std::function<void(std::size_t, Result&)>& take, DoneBy by = DoneBy::one_rank) {
    const std::function<Result(std::size_t)> body = [&](std::size_t i) {
        const JobScope scope(by);
        return job(i);
    };
    if (is_shared_or_kept(by)) return ordered_reduce<Result>(n, 1, sent, body, take, by);
    for (std::size_t i = 0; i < n; ++i) {
        Result result = job(i);
        take(i, result);
    }
}

/// Copies a result of the root to all ranks.
template <class Result>
void broadcast_result(Result& result, const Sent<Result>& sent) {
    Communicator* const current = communicator_of_several();
    if (current == nullptr) return;
    MessageWriter message;
    if (current->is_root()) sent.write(message, result);
    const std::string bytes = current->broadcast(message.take());
    MessageReader reader(bytes);
    if (!current->is_root()) result = sent.read(reader);
}

}  // namespace hogel::work
