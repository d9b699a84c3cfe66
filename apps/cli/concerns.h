// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string_view>

#include "hogel/error.h"

namespace hogel::cli {

/// A word of the library's messages, which state facts, and the options that set what it speaks of.
struct Concern {
    std::string_view word;
    std::string_view options;  ///< "--eye, --pupil"
};

/// Throws the error again; Error(usage) with the options of the first concern whose word it holds before its message:
/// "--pitch: a pitch of 2 um ...". An empty word is in every message. A message that begins with an option stays.
[[noreturn]] void throw_with_options(const Error& error, std::initializer_list<Concern> concerns);

/// Work of the library on what options say, whose Error(usage) then names them.
template <class Work>
auto with_options(std::initializer_list<Concern> concerns, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw_with_options(error, concerns);
    }
}

}  // namespace hogel::cli
