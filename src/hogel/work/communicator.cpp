// SPDX-License-Identifier: Apache-2.0
#include "hogel/communicator.h"

#include <atomic>

#include "hogel/error.h"
#include "hogel/work/job_scope.h"
#include "hogel/work/result_log.h"

namespace hogel {
namespace {

std::atomic<Communicator*> current_communicator = nullptr;

}  // namespace

std::string Communicator::broadcast(const std::string& root_value) {
    barrier();
    if (!is_root()) return receive_from(0);
    for (std::size_t rank = 1; rank < size(); ++rank) send_to(rank, root_value);
    return root_value;
}

CommunicatorScope::CommunicatorScope(Communicator& communicator) {
    Communicator* expected = nullptr;
    if (!current_communicator.compare_exchange_strong(expected, &communicator))
        throw Error(ErrorCode::usage, "this process already has a communicator; only one can be active");
}

CommunicatorScope::~CommunicatorScope() { current_communicator = nullptr; }

work::JobScope::JobScope(DoneBy by) : communicator_(current_communicator), log_(result_log()) {
    if (by == DoneBy::one_rank) current_communicator = nullptr;
    set_result_log(nullptr);
}

work::JobScope::~JobScope() {
    current_communicator = communicator_;
    set_result_log(log_);
}

Communicator* communicator() { return current_communicator; }

bool is_root_rank() { return communicator() == nullptr || communicator()->is_root(); }

}  // namespace hogel
