// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <functional>
#include <stop_token>
#include <utility>

#include "hogel/error.h"

namespace hogel {

/// How a caller follows and stops long work: the last argument of every function that may take long. A stop asked of
/// the token ends the work with Error(cancelled) within a second: every parallel loop looks at it. A callback that
/// returns false ends it at once, but is called only now and then.
class Progress {
  public:
    /// Receives the fraction done, 0 to 1, on one thread at a time. Returns false to stop the work.
    using Callback = std::function<bool(double fraction)>;

    /// Work that is neither followed nor stopped.
    Progress() = default;
    /// Stops when the token's source is asked to, by any thread at any time; calls the callback if there is one.
    explicit Progress(std::stop_token stop, Callback callback = {})
        : stop_(std::move(stop)), callback_(std::move(callback)) {}
    /// From a callback alone, which returns whether to go on, or nothing.
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

    /// Whether there is a callback, or a token that can be asked to stop.
    explicit operator bool() const { return stop_.stop_possible() || callback_; }
    const std::stop_token& stop() const { return stop_; }

    /// Calls the callback, and returns whether to go on.
    bool operator()(double fraction) const { return !stop_.stop_requested() && (!callback_ || callback_(fraction)); }
    /// Calls the callback, and throws Error(cancelled) where the work is to stop.
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

}  // namespace hogel
