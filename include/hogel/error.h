// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "hogel/export.h"

namespace hogel {

/// Kinds of errors, for programs to act on. The value is also the exit status of the command-line program.
enum class ErrorCode {
    usage = 2,         ///< the request is invalid: wrong unit, contradictory or impossible options
    bad_input = 3,     ///< a file or scene is missing, damaged or of another kind
    cannot_write = 4,  ///< an output cannot be created, or the disk is full
    not_built_in = 5,  ///< this build lacks the feature
    cancelled = 6,     ///< the caller stopped the work through its Progress
    internal = 70,     ///< a bug: a condition that the library should have ensured
};

/// The exception type of the library. `what()` is one line: what is wrong, where, and what was expected.
class HOGEL_API Error : public std::runtime_error {
  public:
    Error(ErrorCode code, const std::string& message) : Error(code, "", message) {}
    /// Constructs an error about a parameter of the request. Only ErrorCode::usage keeps the parameter.
    /// @param parameter  name on the command line with '_' for '-', such as "focal_plane"; several: "eye, pitch"
    Error(ErrorCode code, std::string parameter, const std::string& message)
        : std::runtime_error(message),
          code_(code),
          parameter_(code == ErrorCode::usage ? std::move(parameter) : std::string()) {}
    ErrorCode code() const noexcept { return code_; }
    /// Returns the parameters that the error is about, separated by ", "; empty if unknown.
    const std::string& parameter() const noexcept { return parameter_; }

  private:
    ErrorCode code_;
    std::string parameter_;
};

}  // namespace hogel
