// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/core/alone.h"
#include "hogel/core/message.h"
#include "hogel/core/parallel.h"
#include "hogel/core/result_log.h"
#include "hogel/team.h"

namespace hogel::core {

/// The team of this process, or null if no other process is in it, so that there is nobody to share work with.
inline Team* team_of_several() {
    Team* const all = team();
    return all != nullptr && all->size() > 1 ? all : nullptr;
}

/// Whether loops send their results to other processes, or keep them in a file.
inline bool is_shared_or_kept() { return team_of_several() != nullptr || result_log() != nullptr; }

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

template <class Value, std::size_t axes>
Sent<Array<Value, axes>> sent_array() {
    return {[](MessageWriter& to, const Array<Value, axes>& array) { to.put(array); },
            [](MessageReader& from) { return from.get_array<Value, axes>(); }};
}

/// shared_ordered() in a team, for results as bytes.
/// @param in_flight  as of parallel_ordered(); in a team tiles_in_flight() of each process, on the average, are alive,
///                   results in the first one. 1: each process computes one result at a time, on the calling thread
/// @param max_message  bytes; longer results are sent in parts
void ordered_in_team(Team& team, std::size_t n, std::size_t in_flight,
                     const std::function<std::string(std::size_t)>& body,
                     const std::function<void(std::size_t, std::string_view)>& merge,
                     std::size_t max_message = std::size_t{1} << 30);

/// shared_ordered() for results as bytes, alone or in a team: those that are kept in a file are taken from it.
void ordered_by_bytes(std::size_t n, std::size_t in_flight, const std::function<std::string(std::size_t)>& body,
                      const std::function<void(std::size_t, std::string_view)>& merge);

/// How many tiles of each process of a team are alive on the average.
/// @param in_flight  as of parallel_ordered()
std::size_t tiles_in_flight(std::size_t in_flight);

/// As parallel_ordered(), but where this process is one of a team, each computes the results that are handed to it, and
/// the first merges all of them, on a thread of its own while it computes others. So a sum over tiles is the same for
/// any number of processes. All call it in the same order, never from bodies of loops; those that are not the first
/// return without having merged anything, and may be ahead of it. Within a ResumeScope what is merged is kept in a
/// file, and not computed again the next time.
template <class Result>
void shared_ordered(std::size_t n, std::size_t in_flight, const Sent<Result>& sent,
                    const std::function<Result(std::size_t)>& body,
                    const std::function<void(std::size_t, Result&)>& merge) {
    if (!is_shared_or_kept()) return parallel_ordered<Result>(n, in_flight, body, merge);
    ordered_by_bytes(
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
        });
}

/// While this object exists, loops keep nothing, although there is a ResumeScope: those inside of what is kept whole.
class NothingKept {
  public:
    NothingKept() : log_(result_log()) { set_result_log(nullptr); }
    ~NothingKept() { set_result_log(log_); }
    NothingKept(const NothingKept&) = delete;
    NothingKept& operator=(const NothingKept&) = delete;

  private:
    ResultLog* log_;
};

/// While this object exists, this process works without its team and keeps nothing.
class JobScope {
    AloneScope alone_;
    NothingKept nothing_;
};

/// As shared_ordered(), for jobs that use all threads of a process: a process works on one job at a time, within a
/// JobScope. Within a ResumeScope jobs are kept as a whole.
template <class Result>
void shared_jobs(std::size_t n, const Sent<Result>& sent, const std::function<Result(std::size_t)>& job,
                 const std::function<void(std::size_t, Result&)>& take) {
    const std::function<Result(std::size_t)> body = [&](std::size_t i) {
        const JobScope scope;
        return job(i);
    };
    if (is_shared_or_kept()) return shared_ordered<Result>(n, 1, sent, body, take);
    for (std::size_t i = 0; i < n; ++i) {
        Result result = job(i);
        take(i, result);
    }
}

/// For large results that all processes of a team make together, one after the other: calls make(i) for every i in
/// [0, n) and take(i, result) after each. Within a ResumeScope the results of the first process are kept in a file, and
/// not made again the next time; that process alone then takes them from there.
template <class Result>
void kept_one_by_one(std::size_t n, const Sent<Result>& sent, const std::function<Result(std::size_t)>& make,
                     const std::function<void(std::size_t, Result&)>& take) {
    ResultLog* const log = result_log();
    std::size_t kept = 0;
    if (log != nullptr) {
        kept = log->begin(n, [&](std::size_t i, std::string_view bytes) {
            MessageReader message(bytes);
            Result result = sent.read(message);
            take(i, result);
        });
        if (Team* const all = team_of_several()) kept = all->sum(kept);  // which only the first one knows
    }
    for (std::size_t i = kept; i < n; ++i) {
        std::optional<Result> result;
        {
            const NothingKept nothing;
            result = make(i);
        }
        if (log != nullptr) {
            MessageWriter message;
            sent.write(message, *result);
            log->keep(message.take());
        }
        take(i, *result);
    }
}

/// Gives all processes of a team what the first one has.
template <class Result>
void share_result(Result& result, const Sent<Result>& sent) {
    Team* const all = team_of_several();
    if (all == nullptr) return;
    MessageWriter message;
    if (all->is_first()) sent.write(message, result);
    const std::string bytes = all->share(message.take());
    MessageReader reader(bytes);
    if (!all->is_first()) result = sent.read(reader);
}

}  // namespace hogel::core
