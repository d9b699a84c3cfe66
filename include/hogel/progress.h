// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <stop_token>
#include <utility>

#include "hogel/error.h"
#include "hogel/export.h"

namespace hogel {

/// Reports the progress of long work to a caller and lets the caller stop it: the last argument of every function that
/// may take long. Both ways to stop end the work with Error(cancelled). A stop request to the token takes effect within
/// a second, because every parallel loop checks the token; a callback can stop the work by returning false, but only
/// when it is called.
class Progress {
  public:
    /// Receives the fraction done, 0 to 1, on one thread at a time. Returns false to stop the work.
    using Callback = std::function<bool(double fraction)>;

    /// No callback and no way to stop.
    Progress() = default;
    /// Stops when a stop is requested from the token's source, on any thread; calls the callback if there is one.
    explicit Progress(std::stop_token stop, Callback callback = {})
        : stop_(std::move(stop)), callback_(std::move(callback)) {}
    /// From a callback alone, which returns either nothing or whether to continue.
    template <std::invocable<double> F>
    requires(!std::same_as<std::remove_cvref_t<F>, Progress>) Progress(F callback)
        : callback_([f = std::move(callback)](double fraction) {
              if constexpr (std::same_as<std::invoke_result_t<F, double>, void>) {
                  f(fraction);
                  return true;
              } else {
                  return static_cast<bool>(f(fraction));
              }
          }) {}

    /// Whether there is a callback or a token through which a stop can be requested.
    explicit operator bool() const { return stop_.stop_possible() || callback_; }
    const std::stop_token& stop() const { return stop_; }

    /// Calls the callback and returns whether to continue.
    bool operator()(double fraction) const { return !stop_.stop_requested() && (!callback_ || callback_(fraction)); }
    /// Calls the callback and throws Error(cancelled) if the work is to stop.
    void report(double fraction) const {
        if (!(*this)(fraction)) throw Error(ErrorCode::cancelled, "stopped on request");
    }
    /// The progress of a part of the work: its fractions 0 to 1 are fractions `begin` to `end` of the whole.
    Progress part(double begin, double end) const {
        if (!callback_) return Progress(stop_);
        return Progress(stop_, [callback = callback_, begin, end](double fraction) {
            return callback(begin + (end - begin) * fraction);
        });
    }
    /// The progress of part number i (from 0) of n equal parts.
    Progress part(std::size_t i, std::size_t n) const {
        return part(static_cast<double>(i) / static_cast<double>(n),
                    static_cast<double>(i + 1) / static_cast<double>(n));
    }

  private:
    std::stop_token stop_;
    Callback callback_;
};

/// While this object exists, functions without a Progress that this thread calls, such as write_image(), end with
/// Error(cancelled) when a stop is requested from the progress's token. It must be destroyed by the same thread.
class HOGEL_API Stoppable {
  public:
    explicit Stoppable(const Progress& progress);
    ~Stoppable();
    Stoppable(const Stoppable&) = delete;
    Stoppable& operator=(const Stoppable&) = delete;

  private:
    struct Scope;
    std::unique_ptr<Scope> scope_;
};

}  // namespace hogel
