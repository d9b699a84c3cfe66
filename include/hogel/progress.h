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

/// Reports the progress of long work and lets the caller stop it. It is the last argument of every function that can
/// take long. A stop request through the token takes effect within a second, because every parallel loop checks the
/// token. A callback can stop the work by returning false, but only when it is called. Both cause Error(cancelled).
class Progress {
  public:
    /// Receives the completed fraction, 0 to 1, on one thread at a time. Returns false to stop the work.
    using Callback = std::function<bool(double fraction)>;

    /// No callback, and no way to stop.
    Progress() = default;
    /// Stops when the token's source requests a stop, from any thread; calls the callback if there is one.
    explicit Progress(std::stop_token stop, Callback callback = {})
        : stop_(std::move(stop)), callback_(std::move(callback)) {}
    /// Takes a callback that returns nothing, or whether to continue.
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

    /// Returns whether there is a callback, or a token that can request a stop.
    explicit operator bool() const { return stop_.stop_possible() || callback_; }
    const std::stop_token& stop() const { return stop_; }

    /// Calls the callback and returns whether to continue.
    bool operator()(double fraction) const { return !stop_.stop_requested() && (!callback_ || callback_(fraction)); }
    /// Calls the callback, and throws Error(cancelled) if the work must stop.
    void report(double fraction) const {
        if (!(*this)(fraction)) throw Error(ErrorCode::cancelled, "stopped on request");
    }
    /// Returns the progress of a part of the work: its fractions 0 to 1 become `begin` to `end`.
    Progress part(double begin, double end) const {
        if (!callback_) return Progress(stop_);
        return Progress(stop_, [callback = callback_, begin, end](double fraction) {
            return callback(begin + (end - begin) * fraction);
        });
    }
    /// Returns the progress of part i (from 0) of n equal parts.
    Progress part(std::size_t i, std::size_t n) const {
        return part(static_cast<double>(i) / static_cast<double>(n),
                    static_cast<double>(i + 1) / static_cast<double>(n));
    }

  private:
    std::stop_token stop_;
    Callback callback_;
};

/// Makes functions without a Progress argument, such as write_image(), stoppable on this thread while the object
/// exists. They throw Error(cancelled) after a stop request through the token of `progress`. Destroy it on the same
/// thread.
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
