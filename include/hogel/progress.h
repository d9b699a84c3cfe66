#pragma once

#include <functional>

#include "hogel/error.h"

namespace hogel {

/// Told the fraction done, 0..1, now and then, on one thread at a time; returns false to stop the work.
using Progress = std::function<bool(double fraction)>;

/// Reports to a callback that may be empty. Throws Error(cancelled) when the callback asks to stop.
inline void report(const Progress& progress, double fraction) {
    if (progress && !progress(fraction)) throw Error(ErrorCode::cancelled, "stopped on request");
}

}  // namespace hogel
