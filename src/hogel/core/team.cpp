// SPDX-License-Identifier: Apache-2.0
#include "hogel/team.h"

#include <atomic>

#include "hogel/core/job_scope.h"
#include "hogel/core/result_log.h"
#include "hogel/error.h"

namespace hogel {
namespace {

std::atomic<Team*> current = nullptr;

}  // namespace

std::string Team::share(const std::string& of_first) {
    meet();
    if (!is_first()) return receive_from(0);
    for (std::size_t process = 1; process < size(); ++process) send_to(process, of_first);
    return of_first;
}

TeamScope::TeamScope(Team& team) {
    Team* none = nullptr;
    if (!current.compare_exchange_strong(none, &team))
        throw Error(ErrorCode::usage, "this process is one of a team already");
}

TeamScope::~TeamScope() { current = nullptr; }

core::JobScope::JobScope(DoneBy by) : team_(current), log_(result_log()) {
    if (by == DoneBy::one_process) current = nullptr;
    set_result_log(nullptr);
}

core::JobScope::~JobScope() {
    current = team_;
    set_result_log(log_);
}

Team* team() { return current; }

bool is_first_process() { return team() == nullptr || team()->is_first(); }

}  // namespace hogel
