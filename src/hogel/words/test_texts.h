// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/parameters.h"

namespace hogel {

// For tests: sets parameters from texts.
template <class Values>
struct FromTexts {
    Values values;
    Parameters table;

    explicit FromTexts(const Metadata& texts) {
        values.declare(table);
        for (const auto& [name, text] : texts) table.look_up(name)->read_value(text, name);
    }
};

}  // namespace hogel
