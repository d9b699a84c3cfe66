// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "hogel/export.h"

namespace hogel {

/// The kind of a failure, on which programs can act. The value is also the exit status of the command-line program.
enum class ErrorCode {
    usage = 2,         ///< the request makes no sense: wrong unit, contradicting or impossible options
    bad_input = 3,     ///< a file or a scene is missing, damaged, or not what it claims to be
    cannot_write = 4,  ///< an output cannot be created, or the disk is full
    not_built_in = 5,  ///< this build lacks the feature
    cancelled = 6,     ///< the caller stopped the work through its Progress
    internal = 70,     ///< a condition that the library itself should have ensured: a bug
};

/// The one exception type of the library. `what()` is a single line that says what is wrong, where, and what was
/// expected.
class HOGEL_API Error : public std::runtime_error {
  public:
    Error(ErrorCode code, const std::string& message) : Error(code, "", message) {}
    /// An error about a parameter of the request, which is kept for ErrorCode::usage alone: files have no parameters.
    /// @param parameter  its name on the command line with '_' for '-', "focal_plane"; several are "eye, pitch"
    Error(ErrorCode code, std::string parameter, const std::string& message)
        : std::runtime_error(message),
          code_(code),
          parameter_(code == ErrorCode::usage ? std::move(parameter) : std::string()) {}
    ErrorCode code() const noexcept { return code_; }
    /// The parameter that the error is about, or several, or an empty text.
    const std::string& parameter() const noexcept { return parameter_; }

  private:
    ErrorCode code_;
    std::string parameter_;
};

}  // namespace hogel
