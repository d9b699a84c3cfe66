// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/stop_scope.h"

#include <utility>

#include "hogel/error.h"
#include "hogel/progress.h"

namespace hogel::core {
namespace {

thread_local const StopScope* innermost = nullptr;

}  // namespace

StopScope::StopScope(const Progress& progress) : stop_(progress.stop()), outer_(innermost) {
    if (stop_.stop_possible() && !(outer_ && outer_->stop_ == stop_)) innermost = this;
}

StopScope::~StopScope() { innermost = outer_; }

bool StopScope::requested() const { return stop_.stop_requested() || (outer_ && outer_->requested()); }

const StopScope* stop_scope() { return innermost; }

InheritedStopScope::InheritedStopScope(const StopScope* scope) : before_(std::exchange(innermost, scope)) {}

InheritedStopScope::~InheritedStopScope() { innermost = before_; }

void throw_if_stopped() {
    if (innermost && innermost->requested()) throw Error(ErrorCode::cancelled, "stopped on request");
}

}  // namespace hogel::core

namespace hogel {

struct Stoppable::Scope {
    explicit Scope(const Progress& progress) : scope(progress) {}
    core::StopScope scope;
};

Stoppable::Stoppable(const Progress& progress) : scope_(std::make_unique<Scope>(progress)) {}

Stoppable::~Stoppable() = default;

}  // namespace hogel
