// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "core.h"
#include "hogel/parameters.h"
#include "hogel/requests.h"

namespace hogel::python {

/// Sets the parameters that keywords name. None stands for the default. Throws Error(usage), which
/// names the parameter.
void read_keywords(Parameters& parameters, const py::dict& keywords);

/// Name, default as text and help of each wanted parameter.
py::list described(
    const Parameters& parameters,
    const std::function<bool(const Parameter&)>& is_wanted = [](const Parameter&) { return true; });

/// The parameters of hogel/requests.h with the values of keywords. Keywords of other parameters are ignored.
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
