// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel {
class Communicator;
}

namespace hogel::work {

class ResultLog;

/// Ranks that execute a job: one rank, or all ranks of the communicator together.
enum class DoneBy { one_rank, all_ranks };

/// Scope of one job. Hides the communicator unless all ranks execute the job; disables checkpointing inside the job.
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
