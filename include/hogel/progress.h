// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <functional>
#include <stop_token>
#include <utility>

#include "hogel/error.h"

namespace hogel {

/// How a caller follows and stops long work: the last argument of every verb. Work asks often, inside its parallel
/// loops too, whether it is to stop, and then throws Error(cancelled) within a second.
class Progress {
  public:
    /// Receives the fraction done, 0..1, now and then, on one thread at a time. Returns false to stop the work.
    using Callback = std::function<bool(double fraction)>;

    /// Nobody follows.
    Progress() = default;
    /// Stops when the token is asked to; any thread may ask at any time.
    explicit Progress(std::stop_token stop, Callback callback = {})
        : stop_(std::move(stop)), callback_(std::move(callback)) {}
    /// From a callback alone, which may return nothing or whether to go on.
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

    /// Whether anybody follows.
    explicit operator bool() const { return stop_.stop_possible() || callback_; }
    const std::stop_token& stop() const { return stop_; }

    /// Tells the callback, and returns whether to go on.
    bool operator()(double fraction) const { return !stop_.stop_requested() && (!callback_ || callback_(fraction)); }
    /// The same, but throws Error(cancelled) where the work is to stop.
    void report(double fraction) const {
        if (!(*this)(fraction)) throw Error(ErrorCode::cancelled, "stopped on request");
    }
    /// For a part of the work, whose fractions 0..1 are those from `begin` to `end` of the whole.
    Progress part(double begin, double end) const {
        if (!callback_) return Progress(stop_);
        return Progress(stop_, [callback = callback_, begin, end](double fraction) {
            return callback(begin + (end - begin) * fraction);
        });
    }
    /// For part i of n equal ones.
    Progress part(std::size_t i, std::size_t n) const {
        return part(static_cast<double>(i) / static_cast<double>(n),
                    static_cast<double>(i + 1) / static_cast<double>(n));
    }

  private:
    std::stop_token stop_;
    Callback callback_;
};

}  // namespace hogel
