// SPDX-License-Identifier: Apache-2.0
#include "mpi/rank_communicator.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "mpi/hand_out.h"

namespace hogel::mpi {
namespace {

using Clock = std::chrono::steady_clock;

// Polling intervals: of the root, growing while there are no messages; of ranks that wait for an answer; and of ranks
// that listen for a stop.
constexpr std::chrono::microseconds between_requests{200}, between_rare_requests{1600}, between_stops{5000},
    between_answers{100};
// Interval at which a rank that waits for all others checks for a stop.
constexpr std::chrono::milliseconds between_answers_of_all{50};
// Time within which all ranks usually stop after a failure.
constexpr std::chrono::milliseconds usual_answer{333};

template <class... Numbers>
std::string pack(Numbers... numbers) {
    std::string bytes;
    const auto add = [&](std::uint64_t number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
    (add(static_cast<std::uint64_t>(numbers)), ...);
    return bytes;
}

std::uint64_t number_at(const std::string& bytes, std::size_t index) {
    std::uint64_t number = 0;
    if (bytes.size() >= (index + 1) * sizeof number)
        std::memcpy(&number, bytes.data() + index * sizeof number, sizeof number);
    return number;
}

std::string tail_of(const std::string& bytes, std::size_t numbers) {
    return bytes.substr(std::min(bytes.size(), numbers * sizeof(std::uint64_t)));
}

std::uint64_t take_last_number(std::string& bytes) {
    const std::size_t rest = bytes.size() - std::min(bytes.size(), sizeof(std::uint64_t));
    const std::uint64_t number = number_at(bytes.substr(rest), 0);
    bytes.resize(rest);
    return number;
}

std::string to_bytes(const Report& report) {
    return pack(report.failed ? 1 : 0, report.status, static_cast<int>(report.code), report.number) + report.text;
}

Report from_bytes(const std::string& bytes) {
    return {number_at(bytes, 0) != 0, static_cast<int>(number_at(bytes, 1)),
            static_cast<ErrorCode>(static_cast<int>(number_at(bytes, 2))), number_at(bytes, 3), tail_of(bytes, 4)};
}

// Selects the failure that all ranks report: preferably one that is not a cancellation, then one by a signal, then any.
const Report* failure_among(const std::vector<std::optional<Report>>& reports) {
    const auto find = [&](const auto& is) -> const Report* {
        for (const std::optional<Report>& report : reports)
            if (report->failed && is(*report)) return &*report;
        return nullptr;
    };
    if (const Report* error = find([](const Report& r) { return r.code != ErrorCode::cancelled; })) return error;
    if (const Report* signal = find([](const Report& r) { return r.status > 128; })) return signal;
    return find([](const Report&) { return true; });
}

}  // namespace

RankCommunicator::RankCommunicator(Link& link) : link_(link), reports_(link.size()) {
    server_ = std::jthread([this](const std::stop_token& ended) {
        for (auto pause = between_requests; !ended.stop_requested(); std::this_thread::sleep_for(pause)) {
            const bool handled = serve();
            pause = link_.rank() != 0 ? between_stops
                    : handled         ? between_requests
                                      : std::min<std::chrono::microseconds>(2 * pause, between_rare_requests);
        }
    });
}

RankCommunicator::~RankCommunicator() {
    server_.request_stop();
    server_.join();
}

void RankCommunicator::stop_with(std::stop_source stop) {
    const std::lock_guard lock(mutex_);
    stop_ = std::move(stop);
    if (stopping_) stop_.request_stop();
}

// Handles pending messages. Returns whether there were any.
bool RankCommunicator::serve() {
    bool handled = false;
    if (link_.rank() == 0) {
        while (serve_root()) handled = true;
    } else if (link_.receive(Kind::stop)) {
        stop_local();
    }
    const std::lock_guard lock(mutex_);
    if (!stop_.stop_requested() || std::exchange(stop_sent_, true)) return handled;
    if (link_.rank() == 0)
        stop_all();
    else
        link_.send(0, Kind::stop_request, "");
    return handled;
}

// Called with the lock.
void RankCommunicator::stop_all() {
    stop_sent_ = true;
    if (stopping_.exchange(true)) return;
    for (std::size_t destination = 1; destination < link_.size(); ++destination)
        link_.send(destination, Kind::stop, "");
    answer_requests();
    passed_.notify_all();
    stop_.request_stop();
}

void RankCommunicator::stop_local() {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    stop_sent_ = true;
    stop_.request_stop();
}

// Handles one message of each kind. Returns whether there was any.
bool RankCommunicator::serve_root() {
    bool handled = false;
    if (const auto message = link_.receive(Kind::tile_request)) {
        handled = true;
        const std::lock_guard lock(mutex_);
        requests_.push_back(
            {message->from, number_at(message->bytes, 0), number_at(message->bytes, 1), number_at(message->bytes, 2)});
        answer_requests();
    }
    if (auto message = link_.receive(Kind::message)) {
        handled = true;
        const std::lock_guard lock(listeners_mutex_);
        const std::uint64_t channel = take_last_number(message->bytes);
        const auto listener = listeners_.find(channel);
        if (listener == listeners_.end())
            unclaimed_[channel].push_back(std::move(message->bytes));
        else if (listener->second)
            listener->second(std::move(message->bytes));
    }
    if (const auto message = link_.receive(Kind::report)) {
        handled = true;
        const std::lock_guard lock(mutex_);
        take_report(message->from, from_bytes(message->bytes));
    }
    if (link_.receive(Kind::stop_request)) {
        handled = true;
        const std::lock_guard lock(mutex_);
        stop_all();
    }
    return handled;
}

// Called with the lock.
void RankCommunicator::take_report(std::size_t from, Report report) {
    if (report.failed) stop_all();
    reports_[from] = std::move(report);
    if (!std::ranges::all_of(reports_, [](const auto& each) { return each.has_value(); })) return;
    Report combined;
    if (const Report* failure = failure_among(reports_)) {
        combined = *failure;
    } else {
        combined.text = reports_.front()->text;
        for (const std::optional<Report>& each : reports_) combined.number += each->number;
    }
    for (std::size_t destination = 1; destination < link_.size(); ++destination)
        link_.send(destination, Kind::combined_report, to_bytes(combined));
    for (std::optional<Report>& each : reports_) each.reset();
    combined_ = std::move(combined);
    concluded_.notify_all();
}

void RankCommunicator::report(Report local) {
    if (link_.rank() != 0) return link_.send(0, Kind::report, to_bytes(local));
    const std::lock_guard lock(mutex_);
    take_report(0, std::move(local));
}

// Waits for the combined report. Returns nothing after `patience`; without `patience` waits without limit.
std::optional<Report> RankCommunicator::wait_for_combined(std::optional<std::chrono::milliseconds> patience) {
    const auto end = Clock::now() + patience.value_or(std::chrono::milliseconds(0));
    if (link_.rank() == 0) {
        std::unique_lock lock(mutex_);
        const auto concluded = [&] { return combined_.has_value(); };
        if (!patience)
            concluded_.wait(lock, concluded);
        else if (!concluded_.wait_until(lock, end, concluded))
            return std::nullopt;
        return std::exchange(combined_, std::nullopt);
    }
    for (auto pause = between_answers;; pause = std::min<std::chrono::microseconds>(2 * pause, between_stops)) {
        if (const auto message = link_.receive(Kind::combined_report)) return from_bytes(message->bytes);
        if (patience && Clock::now() > end) return std::nullopt;
        std::this_thread::sleep_for(pause);
    }
}

// Returns the ranks that have not answered after a failure of this one. The root stops all ranks on the first failure,
// so a rank that was not stopped has not heard from the root.
std::vector<std::size_t> RankCommunicator::silent_ranks() {
    if (link_.rank() != 0) return stopping_ ? std::vector<std::size_t>{} : std::vector<std::size_t>{0};
    const std::lock_guard lock(mutex_);
    std::vector<std::size_t> silent;
    for (std::size_t rank = 0; rank < reports_.size(); ++rank)
        if (!reports_[rank]) silent.push_back(rank);
    return silent;
}

bool RankCommunicator::is_stop_requested() {
    const std::lock_guard lock(mutex_);
    return stop_.stop_requested();
}

Report RankCommunicator::agree(Report local) {
    report(std::move(local));
    std::optional<Report> combined_report;
    // Lost ranks never answer: after a stop request the wait is limited.
    for (auto deadline = Clock::time_point::max(); !(combined_report = wait_for_combined(between_answers_of_all));) {
        if (!is_stop_requested()) continue;
        deadline = std::min(deadline, Clock::now() + usual_answer);
        if (Clock::now() < deadline) continue;
        has_reported_ = true;
        throw Error(ErrorCode::cancelled, "stopped on request");
    }
    if (!combined_report->failed) return *combined_report;
    failure_ = combined_report;
    throw Error(combined_report->code, combined_report->text);
}

std::optional<Report> RankCommunicator::settle(Report local, std::chrono::seconds patience,
                                               const std::function<void(const std::vector<std::size_t>&)>& silent) {
    if (failure_) return failure_;
    if (!local.failed) {
        report(std::move(local));
        return wait_for_combined(std::nullopt);
    }
    if (!has_reported_) report(local);
    // The pending answer to an earlier report may still arrive and be a success: then reports the failure.
    const auto answer = [&](std::chrono::milliseconds time) {
        std::optional<Report> combined_report = wait_for_combined(time);
        if (!combined_report || combined_report->failed || !std::exchange(has_reported_, false)) return combined_report;
        report(local);
        return wait_for_combined(time);
    };
    if (const std::optional<Report> early_answer = answer(usual_answer)) return early_answer;
    const std::vector<std::size_t> ranks = silent_ranks();
    if (silent && !ranks.empty()) silent(ranks);
    return answer(patience);
}

std::uint64_t RankCommunicator::sum(std::uint64_t number) {
    Report local;
    local.number = number;
    return agree(std::move(local)).number;
}

// Called with the lock. Returns an empty range at the end of the queue and after a stop, and nothing if the request
// must wait.
std::optional<RankCommunicator::Tiles> RankCommunicator::take_tiles(const Request& request) {
    Queue& state = queues_.try_emplace(request.queue, Queue{0, request.tiles}).first->second;
    if (stopping_ || state.tiles != request.tiles || state.next == state.tiles) return Tiles{state.tiles, 0};
    const std::uint64_t left = state.tiles - state.next;
    const std::uint64_t begun = state.next - std::min(state.next, state.done);
    if (begun >= request.ahead) return std::nullopt;
    const Tiles range{state.next, std::min({left, request.ahead - begun,
                                            tiles_at_once(std::min(left, request.ahead), link_.size())})};
    state.next += range.count;
    return range;
}

// Called with the lock.
void RankCommunicator::answer_requests() {
    for (auto each = requests_.begin(); each != requests_.end();) {
        const std::optional<Tiles> tiles = take_tiles(*each);
        if (tiles) link_.send(each->from, Kind::tile_answer, pack(each->queue, tiles->first, tiles->count));
        each = tiles ? requests_.erase(each) : std::next(each);
    }
}

void RankCommunicator::pass(std::uint64_t queue, std::uint64_t done) {
    const std::lock_guard lock(mutex_);
    Queue& state = queues_[queue];
    state.done = std::max(state.done, done);
    answer_requests();
    passed_.notify_all();
}

// Called with tiles_mutex_ locked.
void RankCommunicator::request_tiles(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead) {
    if (requested_.insert(queue).second) link_.send(0, Kind::tile_request, pack(queue, tiles, ahead));
}

// Called with tiles_mutex_ locked.
RankCommunicator::Tiles RankCommunicator::next_tiles(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead) {
    if (link_.rank() == 0) {
        std::unique_lock lock(mutex_);
        std::optional<Tiles> range;
        passed_.wait(lock, [&] { return (range = take_tiles({0, queue, tiles, ahead})).has_value(); });
        return *range;
    }
    request_tiles(queue, tiles, ahead);
    while (!answers_.contains(queue)) {
        if (const auto message = link_.receive(Kind::tile_answer))
            answers_[number_at(message->bytes, 0)] = {number_at(message->bytes, 1), number_at(message->bytes, 2)};
        else
            std::this_thread::sleep_for(between_answers);
    }
    requested_.erase(queue);
    return answers_.extract(queue).mapped();
}

std::optional<std::uint64_t> RankCommunicator::next_tile(std::uint64_t queue, std::uint64_t tiles,
                                                         std::uint64_t ahead) {
    const std::lock_guard lock(tiles_mutex_);
    LocalTiles& local = local_tiles_[queue];
    if (local.range.count == 0 && !local.finished) {
        local.range = next_tiles(queue, tiles, ahead);
        if (stopping_) throw Error(ErrorCode::cancelled, "stopped on request");
        local.finished = local.range.count == 0;
    }
    if (local.finished) return std::nullopt;
    const std::uint64_t tile = local.range.first++;
    if (--local.range.count == 0 && link_.rank() != 0 && asks_ahead(tiles - local.range.first, link_.size()))
        request_tiles(queue, tiles, ahead);
    return tile;
}

// Appends the channel at the end, because prepending would move the bytes of large messages.
void RankCommunicator::send(std::uint64_t channel, std::string bytes) {
    bytes += pack(channel);
    link_.send(0, Kind::message, std::move(bytes));
}

void RankCommunicator::listen(std::uint64_t channel, std::function<void(std::string bytes)> take) {
    const std::lock_guard lock(listeners_mutex_);
    auto unclaimed = unclaimed_.extract(channel);
    if (take && !unclaimed.empty())
        for (std::string& bytes : unclaimed.mapped()) take(std::move(bytes));
    listeners_[channel] = std::move(take);
}

void RankCommunicator::send_to(std::size_t destination, std::string bytes) {
    link_.send(destination, Kind::direct, std::move(bytes));
}

std::string RankCommunicator::receive_from(std::size_t source) {
    for (;;) {
        std::list<std::string>& messages = direct_[source];
        if (!messages.empty()) {
            std::string first = std::move(messages.front());
            messages.pop_front();
            return first;
        }
        if (auto message = link_.receive(Kind::direct))
            direct_[message->from].push_back(std::move(message->bytes));
        else
            std::this_thread::sleep_for(between_answers);
        if (stopping_) throw Error(ErrorCode::cancelled, "stopped on request");
    }
}

}  // namespace hogel::mpi
