// SPDX-License-Identifier: Apache-2.0
#include "concerns.h"

#include <fmt/format.h>

namespace hogel::cli {

void throw_with_options(const Error& error, std::initializer_list<Concern> concerns) {
    const std::string_view message = error.what();
    if (error.code() == ErrorCode::usage && !message.starts_with("--"))
        for (const Concern& concern : concerns)
            if (message.find(concern.word) != std::string_view::npos)
                throw Error(ErrorCode::usage, fmt::format("{}: {}", concern.options, message));
    throw error;
}

}  // namespace hogel::cli
