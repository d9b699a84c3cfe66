// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/work_before.h"

#include <algorithm>
#include <string>
#include <utility>

#include "hogel/core/message.h"

namespace hogel::core {
namespace {

// Between reports to the first process.
constexpr std::chrono::milliseconds between_reports{20};

// From less than this fraction of its work nobody knows how long a process takes for it; and one that says that it has
// done all has something left until it has finished.
constexpr double enough = 0.05, nearly = 0.99;

}  // namespace

WorkBefore::WorkBefore(Team& team, std::vector<double> work, std::vector<double> speeds,
                       std::function<Clock::time_point()> now)
    : team_(team),
      work_(std::move(work)),
      speeds_(std::move(speeds)),
      channel_(team.next_number()),
      now_(std::move(now)),
      reports_(team.size()) {
    if (!team_.is_first()) return;
    team_.listen(channel_, [this](const std::string& bytes) {
        MessageReader message(bytes);
        const auto process = message.get<std::size_t>();
        take(process, message.get<double>());
    });
}

WorkBefore::~WorkBefore() {
    if (team_.is_first()) team_.listen(channel_, {});
}

void WorkBefore::report(double fraction) {
    const Clock::time_point now = now_();
    if (now - said_ < between_reports) return;
    said_ = now;
    say(std::min(fraction, nearly));
}

void WorkBefore::say(double fraction) {
    if (team_.is_first()) return take(0, fraction);
    MessageWriter message;
    message.put(team_.rank());
    message.put(fraction);
    team_.send(channel_, message.take());
}

// In the first process.
void WorkBefore::take(std::size_t process, double fraction) {
    const std::lock_guard lock(mutex_);
    if (left_) return;
    const double now = std::chrono::duration<double>(now_() - began_).count();
    reports_[process] = {fraction, now};
    if (fraction < 1) return;
    left_ = left(now);
    for (std::size_t other = 1; other < team_.size(); ++other) {
        MessageWriter message;
        message.put(*left_);
        team_.send_to(other, message.take());
    }
}

// With the lock, when one has done its work.
std::vector<double> WorkBefore::left(double now) const {
    // What processes of all speeds together do in a second, from what is done so far.
    double done = 0, speed = 0;
    for (std::size_t process = 0; process < reports_.size(); ++process)
        if (reports_[process].fraction > 0) {
            done += work_[process] * reports_[process].fraction / reports_[process].seconds;
            speed += speeds_[process];
        }
    std::vector<double> left(work_.size());
    for (std::size_t process = 0; process < reports_.size(); ++process) {
        const Report& last = reports_[process];
        const double whole =
            last.fraction > enough ? last.seconds / last.fraction : work_[process] * speed / (speeds_[process] * done);
        left[process] = std::max(0.0, whole - now) * speeds_[process] * done / speed;
    }
    return left;
}

std::vector<double> WorkBefore::finish() {
    say(1);
    if (!team_.is_first()) {
        const std::string bytes = team_.receive_from(0);
        return MessageReader(bytes).get_vector<double>();
    }
    const std::lock_guard lock(mutex_);
    return *left_;
}

}  // namespace hogel::core
