// SPDX-License-Identifier: Apache-2.0
#include "hogel/team.h"

#include <atomic>

#include "hogel/error.h"
#include "hogel/work/job_scope.h"
#include "hogel/work/result_log.h"

namespace hogel {
namespace {

std::atomic<Team*> current_team = nullptr;

}  // namespace

std::string Team::share(const std::string& of_first) {
    meet();
    if (!is_first()) return receive_from(0);
    for (std::size_t process = 1; process < size(); ++process) send_to(process, of_first);
    return of_first;
}

TeamScope::TeamScope(Team& team) {
    Team* none = nullptr;
    if (!current_team.compare_exchange_strong(none, &team))
        throw Error(ErrorCode::usage, "this process is one of a team already");
}

TeamScope::~TeamScope() { current_team = nullptr; }

work::JobScope::JobScope(DoneBy by) : team_(current_team), log_(result_log()) {
    if (by == DoneBy::one_process) current_team = nullptr;
    set_result_log(nullptr);
}

work::JobScope::~JobScope() {
    current_team = team_;
    set_result_log(log_);
}

Team* team() { return current_team; }

bool is_first_process() { return team() == nullptr || team()->is_first(); }

}  // namespace hogel
