// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel {
class Communicator;
}

namespace hogel::work {

class ResultLog;

/// Who does a job: one process of a team, or all of them together.
enum class DoneBy { one_rank, all_ranks };

/// While this object exists, a job is done: it sees no team, unless the whole team does it, and keeps nothing itself.
class JobScope {
  public:
    explicit JobScope(DoneBy by = DoneBy::one_rank);
    ~JobScope();
    JobScope(const JobScope&) = delete;
    JobScope& operator=(const JobScope&) = delete;

  private:
    Communicator* communicator_;
    ResultLog* log_;
};

}  // namespace hogel::work
