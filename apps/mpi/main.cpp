// SPDX-License-Identifier: Apache-2.0
// hogel-mpi: commands of hogel whose work the ranks of an MPI program share.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/commands.h"
#include "cli/program.h"
#include "hogel/error.h"
#include "hogel/resources.h"
#include "mpi/loss_watch.h"
#include "mpi/mpi_link.h"
#include "mpi/rank_communicator.h"

namespace hogel::mpi {
namespace {

using Clock = std::chrono::steady_clock;

// A rank that has failed waits so long for the others, which end within a second of a stop.
constexpr std::chrono::seconds patience{15};
// After a rank was lost the others have so long to keep what is done, before mpirun ends them.
constexpr std::chrono::milliseconds grace{900};
// A rank that is lost is noticed within this time after mpirun has stopped others because of it.
constexpr std::chrono::milliseconds consequences{100};
// As of a process that was killed.
constexpr int status_of_loss = 128 + SIGKILL;

// Those whose long work the library shares among the processes of a team.
constexpr std::array<std::string_view, 8> shared_commands{"render", "compress", "decompress", "hologram",
                                                          "slm",    "photo",    "propagate",  "make"};

// Signals are for the thread that waits for them, not for those that MPI starts.
void block_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

// Only the first rank prints.
void silence_output() {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
}

class Ranks final : public cli::Processes {
  public:
    explicit Ranks(MpiLink& link)
        : link_(link),
          communicator_(link),
          scope_(communicator_),
          watch_(others_here(), [this](const RankProcess& rank) { end_without(rank); }) {
        if (!communicator_.is_root()) silence_output();
    }

    void begin(cli::Session& session) override {
        communicator_.stop_with(session.stop);
        {
            const std::lock_guard lock(stopping_);
            stop_ = session.stop;
        }
        on_stop_.emplace(session.stop.get_token(), StopTime{*this});
        for (char* const* word = session.arguments; word != nullptr && *word != nullptr; ++word)
            if (std::string_view(*word) == "--resume") resumes_ = true;
        if (session.threads == 0) session.threads = link_.threads();
        if (!communicator_.is_root()) session.quiet = true;
        const std::string command = session.command->name();
        if (std::ranges::find(shared_commands, command) == shared_commands.end())
            throw Error(ErrorCode::not_built_in,
                        fmt::format("{}: the ranks of hogel-mpi cannot share its work yet; expected {}, or the program "
                                    "hogel",
                                    command, fmt::join(shared_commands, ", ")));
    }

    cli::Outcome end(const cli::Outcome& own) override {
        Report report;
        report.failed = own.status != 0;
        report.status = own.status;
        report.code = own.code;
        report.text = own.message;
        while (lost_) std::this_thread::sleep_for(grace);  // until end_without() ends the process
        // A batch system or mpirun also stops what is left after a machine was lost.
        bool said = false;
        const auto say = [&](const std::vector<std::size_t>& silent) {
            if (own.status <= 128 || link_.on_this_machine().front().rank != link_.rank()) return;
            cli::print_failure(fmt::format("{}; no word of rank{} {} of {}, which may be lost; {}", own.message,
                                           silent.size() == 1 ? "" : "s", fmt::join(silent, ", "), link_.size(),
                                           what_then()));
            said = true;
        };
        const std::optional<Report> verdict = communicator_.settle(report, patience, say);
        if (!verdict) {
            if (!said) cli::print_failure(own.message);
            link_.abort(own.status);
        }
        return {verdict->failed ? verdict->status : 0, verdict->code,
                communicator_.is_root() && !said ? verdict->text : ""};
    }

  private:
    std::vector<RankProcess> others_here() const {
        std::vector<RankProcess> others = link_.on_this_machine();
        std::erase_if(others, [&](const RankProcess& each) { return each.rank == link_.rank(); });
        return others;
    }

    const char* what_then() const {
        return resumes_ ? "what is done is kept: the same command goes on from there, with any number of ranks"
                        : "run the command again";
    }

    struct StopTime {
        Ranks& ranks;
        void operator()() const { ranks.stopped_ = Clock::now().time_since_epoch().count(); }
    };

    // Ranks that end some time after a stop are not lost: they were stopped, too, or MPI ended them.
    bool was_stopped_before() const {
        const Clock::duration since(stopped_.load());
        return since.count() != 0 && Clock::now().time_since_epoch() - since > consequences;
    }

    // After a rank of this machine was lost: the first of those that are left says so, all keep what they have done,
    // and the job ends.
    void end_without(const RankProcess& lost) {
        if (was_stopped_before()) return;
        lost_ = true;
        const auto left = std::ranges::find_if(link_.on_this_machine(),
                                               [&](const RankProcess& each) { return each.rank != lost.rank; });
        if (left->rank == link_.rank())
            cli::print_failure(fmt::format("rank {} of {} (process {}) was lost; {}", lost.rank, link_.size(),
                                           lost.process, what_then()));
        {
            const std::lock_guard lock(stopping_);
            stop_.request_stop();
        }
        std::this_thread::sleep_for(grace);
        std::_Exit(status_of_loss);  // MPI_Abort() would say more than the line above
    }

    MpiLink& link_;
    RankCommunicator communicator_;
    CommunicatorScope scope_;
    std::mutex stopping_;
    std::stop_source stop_;  // of the session
    std::atomic<bool> resumes_ = false, lost_ = false;
    std::atomic<Clock::rep> stopped_ = 0;  // when
    std::optional<std::stop_callback<StopTime>> on_stop_;
    LossWatch watch_;
};

int run(int argc, char** argv) {
    set_max_kept_memory(SIZE_MAX);  // the program ends with its command
    block_signals();
    MpiLink link(argc, argv);
    Ranks ranks(link);
    return cli::run_program(cli::commands(), argc, argv, &ranks);
}

}  // namespace
}  // namespace hogel::mpi

int main(int argc, char** argv) { return hogel::mpi::run(argc, argv); }
