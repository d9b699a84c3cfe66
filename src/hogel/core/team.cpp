// SPDX-License-Identifier: Apache-2.0
#include "hogel/team.h"

#include <atomic>

#include "hogel/core/alone.h"
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

core::AloneScope::AloneScope() : team_(current.exchange(nullptr)) {}

core::AloneScope::~AloneScope() { current = team_; }

Team* team() { return current; }

bool is_first_process() { return team() == nullptr || team()->is_first(); }

}  // namespace hogel
