// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "hogel/error.h"
#include "hogel/units.h"

using namespace hogel;

int main() {
    if (parse_length("16mm", "--size") != 16e-3) return 1;
    try {
        parse_length("16", "--size");
    } catch (const Error& error) {  // the library's exceptions cross its border as themselves
        std::puts(format_length(633e-9).c_str());
        return error.code() == ErrorCode::usage ? 0 : 2;
    }
    return 3;
}
