// SPDX-License-Identifier: Apache-2.0
#include "mpi/rank_communicator.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "mpi/hand_out.h"

namespace hogel::mpi {
namespace {

using Clock = std::chrono::steady_clock;

// How often messages are looked for: by the first process, for which others wait, less often while there are none; by
// those that wait for an answer; and by those that wait for a stop.
constexpr std::chrono::microseconds between_requests{200}, between_rare_requests{1600}, between_stops{5000},
    between_answers{100};
// How often those that wait for all look whether to stop.
constexpr std::chrono::milliseconds between_answers_of_all{50};
// Within this time after a failure all processes have usually stopped.
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

// The failure that all report: one that is no consequence of a stop, otherwise that of a signal, otherwise any.
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
            const bool any = serve();
            pause = link_.rank() != 0 ? between_stops
                    : any             ? between_requests
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

// Returns whether there was anything to do for others.
bool RankCommunicator::serve() {
    bool any = false;
    if (link_.rank() == 0) {
        while (serve_first()) any = true;
    } else if (link_.receive(Kind::stop)) {
        stop_here();
    }
    const std::lock_guard lock(mutex_);
    if (!stop_.stop_requested() || std::exchange(stop_sent_, true)) return any;
    if (link_.rank() == 0)
        stop_all();
    else
        link_.send(0, Kind::please_stop, "");
    return any;
}

// Called with the lock.
void RankCommunicator::stop_all() {
    stop_sent_ = true;
    if (stopping_.exchange(true)) return;
    for (std::size_t other = 1; other < link_.size(); ++other) link_.send(other, Kind::stop, "");
    answer_requests();
    passed_.notify_all();
    stop_.request_stop();
}

void RankCommunicator::stop_here() {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    stop_sent_ = true;
    stop_.request_stop();
}

// Handles one message of each kind. Returns whether there was any.
bool RankCommunicator::serve_first() {
    bool any = false;
    if (const auto message = link_.receive(Kind::ask)) {
        any = true;
        const std::lock_guard lock(mutex_);
        requests_.push_back(
            {message->from, number_at(message->bytes, 0), number_at(message->bytes, 1), number_at(message->bytes, 2)});
        answer_requests();
    }
    if (auto message = link_.receive(Kind::post)) {
        any = true;
        const std::lock_guard lock(listening_);
        const std::uint64_t channel = take_last_number(message->bytes);
        const auto listener = listeners_.find(channel);
        if (listener == listeners_.end())
            early_[channel].push_back(std::move(message->bytes));
        else if (listener->second)
            listener->second(std::move(message->bytes));
    }
    if (const auto message = link_.receive(Kind::report)) {
        any = true;
        const std::lock_guard lock(mutex_);
        take_report(message->from, from_bytes(message->bytes));
    }
    if (link_.receive(Kind::please_stop)) {
        any = true;
        const std::lock_guard lock(mutex_);
        stop_all();
    }
    return any;
}

// Called with the lock.
void RankCommunicator::take_report(std::size_t from, Report report) {
    if (report.failed) stop_all();
    reports_[from] = std::move(report);
    if (!std::ranges::all_of(reports_, [](const auto& each) { return each.has_value(); })) return;
    Report verdict;
    if (const Report* failure = failure_among(reports_)) {
        verdict = *failure;
    } else {
        verdict.text = reports_.front()->text;
        for (const std::optional<Report>& each : reports_) verdict.number += each->number;
    }
    for (std::size_t other = 1; other < link_.size(); ++other) link_.send(other, Kind::verdict, to_bytes(verdict));
    for (std::optional<Report>& each : reports_) each.reset();
    verdict_ = std::move(verdict);
    concluded_.notify_all();
}

void RankCommunicator::report(Report own) {
    if (link_.rank() != 0) return link_.send(0, Kind::report, to_bytes(own));
    const std::lock_guard lock(mutex_);
    take_report(0, std::move(own));
}

// What all reports come to; nothing if they do not come in time.
std::optional<Report> RankCommunicator::verdict(std::optional<std::chrono::milliseconds> patience) {
    const auto end = Clock::now() + patience.value_or(std::chrono::milliseconds(0));
    if (link_.rank() == 0) {
        std::unique_lock lock(mutex_);
        const auto concluded = [&] { return verdict_.has_value(); };
        if (!patience)
            concluded_.wait(lock, concluded);
        else if (!concluded_.wait_until(lock, end, concluded))
            return std::nullopt;
        return std::exchange(verdict_, std::nullopt);
    }
    for (auto pause = between_answers;; pause = std::min<std::chrono::microseconds>(2 * pause, between_stops)) {
        if (const auto message = link_.receive(Kind::verdict)) return from_bytes(message->bytes);
        if (patience && Clock::now() > end) return std::nullopt;
        std::this_thread::sleep_for(pause);
    }
}

// After this process has failed. The first one tells all others to stop as soon as it hears of any failure.
std::vector<std::size_t> RankCommunicator::silent_ones() {
    if (link_.rank() != 0) return stopping_ ? std::vector<std::size_t>{} : std::vector<std::size_t>{0};
    const std::lock_guard lock(mutex_);
    std::vector<std::size_t> silent;
    for (std::size_t rank = 0; rank < reports_.size(); ++rank)
        if (!reports_[rank]) silent.push_back(rank);
    return silent;
}

bool RankCommunicator::is_to_stop() {
    const std::lock_guard lock(mutex_);
    return stop_.stop_requested();
}

Report RankCommunicator::agree(Report own) {
    report(std::move(own));
    std::optional<Report> of_all;
    // Those that are lost never answer: once this process is to stop, it does not wait for them.
    for (auto last = Clock::time_point::max(); !(of_all = verdict(between_answers_of_all));) {
        if (!is_to_stop()) continue;
        last = std::min(last, Clock::now() + usual_answer);
        if (Clock::now() < last) continue;
        has_reported_ = true;
        throw Error(ErrorCode::cancelled, "stopped on request");
    }
    if (!of_all->failed) return *of_all;
    failure_ = of_all;
    throw Error(of_all->code, of_all->text);
}

std::optional<Report> RankCommunicator::settle(Report own, std::chrono::seconds patience,
                                               const std::function<void(const std::vector<std::size_t>&)>& silent) {
    if (failure_) return failure_;
    if (!own.failed) {
        report(std::move(own));
        return verdict(std::nullopt);
    }
    if (!has_reported_) report(own);
    // The answer to what this one did not wait for may still come, and be good: then the failure is still to be told.
    const auto answer = [&](std::chrono::milliseconds time) {
        std::optional<Report> of_all = verdict(time);
        if (!of_all || of_all->failed || !std::exchange(has_reported_, false)) return of_all;
        report(own);
        return verdict(time);
    };
    if (const std::optional<Report> soon = answer(usual_answer)) return soon;
    const std::vector<std::size_t> ranks = silent_ones();
    if (silent && !ranks.empty()) silent(ranks);
    return answer(patience);
}

std::uint64_t RankCommunicator::sum(std::uint64_t number) {
    Report own;
    own.number = number;
    return agree(std::move(own)).number;
}

// Called with the lock. No tiles are handed out any more when work is to stop; nothing is returned where none may be
// handed out yet.
std::optional<RankCommunicator::Tiles> RankCommunicator::take_tiles(const Request& request) {
    Queue& of = queues_.try_emplace(request.queue, Queue{0, request.tiles}).first->second;
    if (stopping_ || of.tiles != request.tiles || of.next == of.tiles) return Tiles{of.tiles, 0};
    const std::uint64_t left = of.tiles - of.next;
    const std::uint64_t begun = of.next - std::min(of.next, of.done);
    if (begun >= request.ahead) return std::nullopt;
    const Tiles given{
        of.next, std::min({left, request.ahead - begun, tiles_at_once(std::min(left, request.ahead), link_.size())})};
    of.next += given.count;
    return given;
}

// Called with the lock.
void RankCommunicator::answer_requests() {
    for (auto each = requests_.begin(); each != requests_.end();) {
        const std::optional<Tiles> tiles = take_tiles(*each);
        if (tiles) link_.send(each->from, Kind::answer, pack(each->queue, tiles->first, tiles->count));
        each = tiles ? requests_.erase(each) : std::next(each);
    }
}

void RankCommunicator::pass(std::uint64_t queue, std::uint64_t done) {
    const std::lock_guard lock(mutex_);
    Queue& of = queues_[queue];
    of.done = std::max(of.done, done);
    answer_requests();
    passed_.notify_all();
}

// Called with the lock of what was asked.
void RankCommunicator::ask(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead) {
    if (asked_.insert(queue).second) link_.send(0, Kind::ask, pack(queue, tiles, ahead));
}

// Called with the same lock.
RankCommunicator::Tiles RankCommunicator::next_tiles(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead) {
    if (link_.rank() == 0) {
        std::unique_lock lock(mutex_);
        std::optional<Tiles> some;
        passed_.wait(lock, [&] { return (some = take_tiles({0, queue, tiles, ahead})).has_value(); });
        return *some;
    }
    ask(queue, tiles, ahead);
    while (!answers_.contains(queue)) {
        if (const auto message = link_.receive(Kind::answer))
            answers_[number_at(message->bytes, 0)] = {number_at(message->bytes, 1), number_at(message->bytes, 2)};
        else
            std::this_thread::sleep_for(between_answers);
    }
    asked_.erase(queue);
    return answers_.extract(queue).mapped();
}

std::optional<std::uint64_t> RankCommunicator::next_tile(std::uint64_t queue, std::uint64_t tiles,
                                                         std::uint64_t ahead) {
    const std::lock_guard asking(asking_);
    OwnTiles& own = own_[queue];
    if (own.here.count == 0 && !own.over) {
        own.here = next_tiles(queue, tiles, ahead);
        if (stopping_) throw Error(ErrorCode::cancelled, "stopped on request");
        own.over = own.here.count == 0;
    }
    if (own.over) return std::nullopt;
    const std::uint64_t tile = own.here.first++;
    if (--own.here.count == 0 && link_.rank() != 0 && asks_ahead(tiles - own.here.first, link_.size()))
        ask(queue, tiles, ahead);
    return tile;
}

// The channel is at the end, because messages may be large, and have room there.
void RankCommunicator::send(std::uint64_t channel, std::string bytes) {
    bytes += pack(channel);
    link_.send(0, Kind::post, std::move(bytes));
}

void RankCommunicator::listen(std::uint64_t channel, std::function<void(std::string bytes)> take) {
    const std::lock_guard lock(listening_);
    auto early = early_.extract(channel);
    if (take && !early.empty())
        for (std::string& bytes : early.mapped()) take(std::move(bytes));
    listeners_[channel] = std::move(take);
}

void RankCommunicator::send_to(std::size_t process, std::string bytes) {
    link_.send(process, Kind::direct, std::move(bytes));
}

std::string RankCommunicator::receive_from(std::size_t process) {
    for (;;) {
        std::list<std::string>& of_it = direct_[process];
        if (!of_it.empty()) {
            std::string first = std::move(of_it.front());
            of_it.pop_front();
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
