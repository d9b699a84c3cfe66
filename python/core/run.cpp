// SPDX-License-Identifier: Apache-2.0
// Runs long work on a thread without the GIL.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core.h"

namespace hogel::python {
namespace {

constexpr std::chrono::milliseconds poll_interval{50};

// Thread that runs the work of run(). It is reused between calls, because the library caches memory per thread: a new
// thread would cost 0.2 to 2 ms per call.
class Worker {
  public:
    Worker() {
        std::thread([this] { work(); }).detach();
    }
    void begin(std::function<void()> job) {
        const std::lock_guard lock(mutex_);
        job_ = std::move(job);
        failure_ = nullptr;
        changed_.notify_all();
    }
    // Waits for up to poll_interval. Returns whether the job has ended.
    bool wait() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, poll_interval, [this] { return !job_; });
    }
    // Returns the exception of the job that ended, or null.
    std::exception_ptr failure() { return std::exchange(failure_, nullptr); }

  private:
    [[noreturn]] void work() {
        std::unique_lock lock(mutex_);
        while (true) {
            changed_.wait(lock, [this] { return static_cast<bool>(job_); });
            lock.unlock();
            std::exception_ptr failure;
            try {
                job_();
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            failure_ = std::move(failure);
            job_ = nullptr;
            changed_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> job_;  // until it has ended
    std::exception_ptr failure_;
};

// Pool of idle workers, as many as there were concurrent calls. They end with the process. A forked process has none of
// its parent's threads and creates its own.
class Workers {
  public:
    Worker* take() {
        const std::lock_guard lock(mutex_);
        if (process_ != getpid()) idle_.clear();
        process_ = getpid();
        if (idle_.empty()) return new Worker;
        Worker* const worker = idle_.back();
        idle_.pop_back();
        return worker;
    }
    void give_back(Worker* worker) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(worker);
    }

  private:
    std::mutex mutex_;
    std::vector<Worker*> idle_;
    pid_t process_ = 0;
};

Workers& workers() {
    static auto& all = *new Workers;  // never destroyed: threads may still run at exit
    return all;
}

// Throws the exception raised by a signal handler: KeyboardInterrupt after Ctrl-C.
void check_signals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Returns whether to continue.
bool report_progress(const py::object& report, double fraction) {
    if (report.is_none()) return true;
    const py::object answer = report(fraction);
    return answer.is_none() || answer.cast<bool>();
}

}  // namespace

void run(const py::object& report, const std::function<void(const Progress&)>& work) {
    std::stop_source stop;
    std::atomic<double> completed = 0;
    const Progress progress(stop.get_token(), [&](double fraction) {
        completed = fraction;
        return true;
    });
    Worker* const worker = workers().take();
    worker->begin([&] { work(progress); });
    const auto ended = [worker] {
        const py::gil_scoped_release release;
        return worker->wait();
    };
    std::exception_ptr raised;
    while (!ended()) {
        if (raised) continue;
        try {
            check_signals();
            if (!report_progress(report, completed)) stop.request_stop();
        } catch (...) {
            raised = std::current_exception();
            stop.request_stop();
        }
    }
    const std::exception_ptr failure = worker->failure();
    workers().give_back(worker);
    if (raised) std::rethrow_exception(raised);
    if (failure) std::rethrow_exception(failure);
    if (!report_progress(report, 1)) throw Error(ErrorCode::cancelled, "stopped on request");
}

std::shared_ptr<const py::object> share(py::object object) {
    return {new py::object(std::move(object)), [](const py::object* shared) {
                if (Py_IsInitialized() == 0) return;  // the interpreter has been finalised
                const py::gil_scoped_acquire acquire;
                delete shared;
            }};
}

Metadata metadata_of(const py::object& entries) {
    if (entries.is_none()) return {};
    const py::object pairs = py::isinstance<py::dict>(entries) ? entries.attr("items")() : entries;
    Metadata metadata;
    for (const py::handle pair : pairs) {
        const auto entry = py::cast<py::sequence>(pair);
        metadata.emplace_back(py::str(entry[0]), py::str(entry[1]));
    }
    return metadata;
}

}  // namespace hogel::python
