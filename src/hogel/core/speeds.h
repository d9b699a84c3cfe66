// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/core/shared_plane.h"
#include "hogel/team.h"

namespace hogel::core {

/// How fast the processes of a team are just now, as parts of their sum, measured in some milliseconds on the threads
/// of each: nodes differ, and so do the processors of a machine that others use. For work that cannot be handed out
/// while it goes on. All processes call it together, and get the same.
std::vector<double> speeds_of_processes(Team& team);

/// The lines of a process: as many as its part, all in order.
/// @param parts  of each process; their sum is 1
LineRange lines_in_parts(const std::vector<double>& parts, std::size_t process, std::size_t lines);

/// The parts of a piece of work with which all processes end together, as far as that is possible.
/// @param speeds  of the processes; their sum is 1
/// @param before  the work that each process does before, in the same unit as `work`
std::vector<double> parts_after(const std::vector<double>& speeds, const std::vector<double>& before, double work);

}  // namespace hogel::core
