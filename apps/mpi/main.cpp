// SPDX-License-Identifier: Apache-2.0
// hogel-mpi: commands of hogel with their work distributed over the ranks of an MPI program.
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

// Time that a failed rank waits for the others, which end within a second of a stop.
constexpr std::chrono::seconds patience{15};
// Time for the other ranks to write their checkpoints after a rank was lost, before mpirun ends them.
constexpr std::chrono::milliseconds grace{900};
// Within this time after a stop the end of another rank still counts as the cause of the stop.
constexpr std::chrono::milliseconds consequences{100};
// Exit status of a killed process.
constexpr int status_of_loss = 128 + SIGKILL;

// Commands with work that the library distributes over ranks.
constexpr std::array<std::string_view, 8> shared_commands{"render", "compress", "decompress", "hologram",
                                                          "slm",    "photo",    "propagate",  "make"};

// Blocks signals in threads started by MPI: cli::Interrupts waits for them.
void block_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

// Only the root prints.
void silence_output() {
    const int null_device = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null_device < 0) return;
    dup2(null_device, STDOUT_FILENO);
    close(null_device);
}

class Ranks final : public cli::Processes {
  public:
    explicit Ranks(MpiLink& link)
        : link_(link),
          communicator_(link),
          scope_(communicator_),
          watch_(local_others(), [this](const RankProcess& rank) { end_after_loss(rank); }) {
        if (!communicator_.is_root()) silence_output();
    }

    void begin(cli::Session& session) override {
        communicator_.stop_with(session.stop);
        {
            const std::lock_guard lock(mutex_);
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

    cli::Outcome end(const cli::Outcome& local) override {
        Report report;
        report.failed = local.status != 0;
        report.status = local.status;
        report.code = local.code;
        report.text = local.message;
        while (lost_) std::this_thread::sleep_for(grace);  // until end_without() ends the process
        // A batch system or mpirun stops the remaining ranks after the loss of a machine.
        bool reported = false;
        const auto report_silent = [&](const std::vector<std::size_t>& silent) {
            if (local.status <= 128 || link_.on_this_machine().front().rank != link_.rank()) return;
            cli::print_failure(fmt::format("{}; no answer from rank{} {} of {}, which may be lost; {}", local.message,
                                           silent.size() == 1 ? "" : "s", fmt::join(silent, ", "), link_.size(),
                                           advice()));
            reported = true;
        };
        const std::optional<Report> combined = communicator_.settle(report, patience, report_silent);
        if (!combined) {
            if (!reported) cli::print_failure(local.message);
            link_.abort(local.status);
        }
        return {combined->failed ? combined->status : 0, combined->code,
                communicator_.is_root() && !reported ? combined->text : ""};
    }

  private:
    std::vector<RankProcess> local_others() const {
        std::vector<RankProcess> others = link_.on_this_machine();
        std::erase_if(others, [&](const RankProcess& each) { return each.rank == link_.rank(); });
        return others;
    }

    const char* advice() const {
        return resumes_ ? "completed work is saved: run the same command to continue, with any number of ranks"
                        : "run the command again";
    }

    struct StopTime {
        Ranks& ranks;
        void operator()() const { ranks.stopped_ = Clock::now().time_since_epoch().count(); }
    };

    // A rank that ends some time after a stop is not lost: it was stopped too, or MPI ended it.
    bool was_stopped_before() const {
        const Clock::duration since(stopped_.load());
        return since.count() != 0 && Clock::now().time_since_epoch() - since > consequences;
    }

    // Handles the loss of a rank on this machine: the lowest remaining rank reports it, all write their checkpoints,
    // and the job ends.
    void end_after_loss(const RankProcess& lost) {
        if (was_stopped_before()) return;
        lost_ = true;
        const auto survivor = std::ranges::find_if(link_.on_this_machine(),
                                                   [&](const RankProcess& each) { return each.rank != lost.rank; });
        if (survivor->rank == link_.rank())
            cli::print_failure(fmt::format("rank {} of {} (process {}) was lost; {}", lost.rank, link_.size(),
                                           lost.process, advice()));
        {
            const std::lock_guard lock(mutex_);
            stop_.request_stop();
        }
        std::this_thread::sleep_for(grace);
        std::_Exit(status_of_loss);  // MPI_Abort() would print more lines
    }

    MpiLink& link_;
    RankCommunicator communicator_;
    CommunicatorScope scope_;
    std::mutex mutex_;
    std::stop_source stop_;  // copy of Session::stop
    std::atomic<bool> resumes_ = false, lost_ = false;
    std::atomic<Clock::rep> stopped_ = 0;  // time of the stop; 0: none
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
