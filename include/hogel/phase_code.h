// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/table.h"

namespace hogel {

/// The mapping between whole numbers of a picture and phases. The number v of 0 to V (255 for 8 bits) has the phase
/// offset + range·u, with u = v/(V + 1), or u = v/V if the code is closed. An inverted code has V − v in place of v. In
/// pictures of floating-point numbers from 0 to 1 the number itself is u, or 1 − u if inverted.
struct PhaseCode {
    double range = 2 * std::numbers::pi;  ///< radians
    double offset = 0;                    ///< radians
    bool inverted = false;                ///< whether larger numbers mean smaller phases
    bool closed = false;                  ///< whether V stands for the full range; otherwise V + 1 does

    /// Returns the phase of a number, radians.
    /// @param largest  V; 0 for floating-point numbers
    HOGEL_API double phase(double number, double largest) const;
    /// Returns the number from 0 to `largest` with the phase nearest to `phase` (radians), modulo 2π. If the range is
    /// less than 2π, phases outside it get the nearer end of the range. If it is more, the smallest suitable number is
    /// returned.
    HOGEL_API unsigned level(double phase, unsigned largest) const;

    friend bool operator==(const PhaseCode&, const PhaseCode&) = default;
};

/// How the levels of a pattern are sent to a panel. The pattern's file states it, so that readers undo tables and
/// flips.
struct PanelLevels {
    std::vector<std::uint16_t> table = {};      ///< number that is sent for each level; empty: the level itself
    bool flipped_x = false, flipped_y = false;  ///< whether columns or rows are sent in reverse order
    std::string correction = {};                ///< file of a wavefront correction that the levels contain; empty: none

    friend bool operator==(const PanelLevels&, const PanelLevels&) = default;
};

/// A row of phase_codes().
struct PhaseCodeInfo {
    std::string name;  ///< "slmsuite"
    std::string text;  ///< one line
    PhaseCode code;
};

/// Returns the phase codes of programs, by name: hogel, neural-holography, slmsuite, odak, tensorholo.
HOGEL_API Table<PhaseCodeInfo>& phase_codes();

/// Parses the name of a phase code, or a description such as "range=2.2pi,offset=-90deg,invert". Angles are multiples
/// of pi, or have the unit deg or rad. Described codes are closed. Throws Error(usage).
HOGEL_API PhaseCode parse_phase_code(const std::string& text);

/// Returns the text of a code for parse_phase_code(): its name, or a description. The description of an open code is
/// for 8-bit numbers, with 255/256 of the range for the largest number.
HOGEL_API std::string phase_code_text(const PhaseCode& code);

}  // namespace hogel
