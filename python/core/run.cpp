// SPDX-License-Identifier: Apache-2.0
// Long work beside the interpreter.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "core.h"

namespace hogel::python {
namespace {

constexpr std::chrono::milliseconds between_looks{50};

// What the thread that works and the one that waits know of each other.
struct Shared {
    std::mutex mutex;
    std::condition_variable ended;
    bool done = false;
    std::exception_ptr failure;
    std::atomic<double> fraction = 0;

    void finish(std::exception_ptr with) {
        const std::lock_guard lock(mutex);
        failure = std::move(with);
        done = true;
        ended.notify_all();
    }
    bool wait() {
        const py::gil_scoped_release release;
        std::unique_lock lock(mutex);
        return ended.wait_for(lock, between_looks, [this] { return done; });
    }
};

// Throws what a signal's handler raised, KeyboardInterrupt after Ctrl-C.
void look_for_signals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Whether to go on.
bool tell(const py::object& report, double fraction) {
    if (report.is_none()) return true;
    const py::object answer = report(fraction);
    return answer.is_none() || answer.cast<bool>();
}

}  // namespace

void run(const py::object& report, const std::function<void(const Progress&)>& work) {
    std::stop_source stop;
    Shared shared;
    const Progress progress(stop.get_token(), [&](double fraction) {
        shared.fraction = fraction;
        return true;
    });
    std::thread worker([&] {
        try {
            work(progress);
            shared.finish(nullptr);
        } catch (...) {
            shared.finish(std::current_exception());
        }
    });
    std::exception_ptr raised;
    while (!shared.wait()) {
        if (raised) continue;
        try {
            look_for_signals();
            if (!tell(report, shared.fraction)) stop.request_stop();
        } catch (...) {
            raised = std::current_exception();
            stop.request_stop();
        }
    }
    {
        const py::gil_scoped_release release;
        worker.join();
    }
    if (raised) std::rethrow_exception(raised);
    if (shared.failure) std::rethrow_exception(shared.failure);
    if (!tell(report, 1)) throw Error(ErrorCode::cancelled, "stopped on request");
}

std::shared_ptr<const py::object> share(py::object object) {
    return {new py::object(std::move(object)), [](const py::object* shared) {
                if (Py_IsInitialized() == 0) return;  // nothing is left to release it
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
