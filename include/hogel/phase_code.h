// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>

#include "hogel/export.h"
#include "hogel/table.h"

namespace hogel {

/// How the whole numbers of a picture stand for phases. The phase of the number v of 0 to V (255 for 8 bits) is
/// offset + range·u, where u = v/(V + 1), or v/V where the code is closed; an inverted code counts from V down. Numbers
/// that are not whole, from 0 to 1, are u themselves, or 1 − u.
struct PhaseCode {
    double range = 2 * std::numbers::pi;  ///< radians
    double offset = 0;                    ///< radians
    bool inverted = false;                ///< whether larger numbers are smaller phases
    bool closed = false;                  ///< whether V stands for the whole range; otherwise V + 1 would

    /// The phase of a number, in radians. @param largest  V; 0 for numbers that are not whole
    HOGEL_API double phase(double number, double largest) const;
    /// The number from 0 to `largest` whose phase is nearest to one in radians, in whole turns. Where the range is less
    /// than a turn, phases beyond it get the nearer end; where it is more, the smallest numbers that will do.
    HOGEL_API unsigned level(double phase, unsigned largest) const;

    friend bool operator==(const PhaseCode&, const PhaseCode&) = default;
};

/// A row of phase_codes().
struct PhaseCodeInfo {
    std::string name;  ///< "slmsuite"
    std::string text;  ///< one line
    PhaseCode code;
};

/// The codes of phase pictures by the programs that make them: hogel, neural-holography, slmsuite, odak, tensorholo.
HOGEL_API Table<PhaseCodeInfo>& phase_codes();

/// The code of a name, or of a description such as "range=2.2pi,offset=-90deg,invert": angles as multiples of pi, or
/// with the units deg or rad; the largest number stands for the whole range. Throws Error(usage).
HOGEL_API PhaseCode parse_phase_code(const std::string& text);

/// The text by which parse_phase_code() knows a code: its name, or a description. That of an open code is for numbers
/// of 8 bits, of which the largest then stands for 255/256 of the range.
HOGEL_API std::string phase_code_text(const PhaseCode& code);

}  // namespace hogel
