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

/// The team of this process, or null if no other process is in it, so that there is nobody to share work with.
inline Communicator* communicator_of_several() {
    Communicator* const all = communicator();
    return all != nullptr && all->size() > 1 ? all : nullptr;
}

/// Whether loops send their results to other processes, or keep them in a file.
inline bool is_shared_or_kept(DoneBy by = DoneBy::one_rank) {
    return (by == DoneBy::one_rank && communicator_of_several() != nullptr) || result_log() != nullptr;
}

/// How results travel between the processes of a team.
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

/// ordered_reduce() in a team, for results as bytes.
/// @param in_flight  as of local_ordered_reduce(); in a team tiles_in_flight() of each process, on the average, are
/// alive,
///                   results in the first one. 1: each process computes one result at a time, on the calling thread
/// @param max_message  bytes; longer results are sent in parts
void ordered_reduce_in_ranks(Communicator& communicator, std::size_t n, std::size_t in_flight,
                             const std::function<std::string(std::size_t)>& body,
                             const std::function<void(std::size_t, std::string_view)>& merge,
                             std::size_t max_message = std::size_t{1} << 30);

/// ordered_reduce() for results as bytes, alone or in a team: those that are kept in a file are taken from it.
void ordered_reduce_bytes(std::size_t n, std::size_t in_flight, const std::function<std::string(std::size_t)>& body,
                          const std::function<void(std::size_t, std::string_view)>& merge, DoneBy by);

/// How many tiles of each process of a team are alive on the average.
/// @param in_flight  as of local_ordered_reduce()
std::size_t tiles_in_flight(std::size_t in_flight);

/// As local_ordered_reduce(), but where this process is one of a team, each computes the results that are handed to it,
/// and the first merges all of them, on a thread of its own while it computes others. So a sum over tiles is the same
/// for any number of processes. All call it in the same order, never from bodies of loops; those that are not the first
/// return without having merged anything, and may be ahead of it. Within a ResumeScope what is merged is kept in a
/// file, and not computed again the next time.
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

/// As ordered_reduce(), for jobs that use all threads of a process, which works on one job at a time, within a
/// JobScope. Within a ResumeScope jobs are kept as a whole.
/// @param by  one_rank: jobs are handed to processes, and the first one takes all results. all_ranks: all processes
///            make each job together and take its result; results that were kept are taken by the first one alone
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

/// Gives all processes of a team what the first one has.
template <class Result>
void share_result(Result& result, const Sent<Result>& sent) {
    Communicator* const all = communicator_of_several();
    if (all == nullptr) return;
    MessageWriter message;
    if (all->is_root()) sent.write(message, result);
    const std::string bytes = all->share(message.take());
    MessageReader reader(bytes);
    if (!all->is_root()) result = sent.read(reader);
}

}  // namespace hogel::work
