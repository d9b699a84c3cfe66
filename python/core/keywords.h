// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "core.h"
#include "hogel/parameters.h"
#include "hogel/requests.h"

namespace hogel::python {

/// Sets parameters from keywords of the same names. None stands for the default. Throws Error(usage) with the name of
/// the parameter.
void read_keywords(Parameters& parameters, const py::dict& keywords);

/// Returns name, default as text, and help of each selected parameter.
py::list described(
    const Parameters& parameters,
    const std::function<bool(const Parameter&)>& is_wanted = [](const Parameter&) { return true; });

/// A parameter struct of hogel/requests.h with values from keywords. Other keywords are ignored.
template <class Values>
struct Keywords {
    Values values;
    Parameters table;

    explicit Keywords(const py::dict& keywords = {}) {
        values.declare(table);
        read_keywords(table, keywords);
    }
};

}  // namespace hogel::python
