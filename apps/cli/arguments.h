// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::cli {

/// Columns and rows: "256x256", or "256" for a square.
struct Counts {
    std::size_t columns = 0, rows = 0;
};

/// Options whose values have units. All throw Error(usage) naming the option where a value makes no sense; the present
/// value is shown in the help as the default.
CLI::Option* add_length(CLI::App* command, const std::string& name, double& metres, const std::string& help);
/// "40deg" for both across and down, or "40,30deg".
struct Angles {
    double across = 0, down = 0;
};
CLI::Option* add_angle(CLI::App* command, const std::string& name, double& radians, const std::string& help);
CLI::Option* add_angles(CLI::App* command, const std::string& name, Angles& angles, const std::string& help);
CLI::Option* add_counts(CLI::App* command, const std::string& name, Counts& counts, const std::string& help);
/// "400" for so many across and as many down as it takes (rows 0), or "640x480".
CLI::Option* add_resolution(CLI::App* command, const std::string& name, Counts& counts, const std::string& help);
/// "0,0,300mm": a component without a unit takes the one of the last.
CLI::Option* add_point(CLI::App* command, const std::string& name, Vec3& point, const std::string& help);
/// A positive whole number.
CLI::Option* add_count(CLI::App* command, const std::string& name, std::size_t& count, const std::string& help);

/// The colours that a hologram is made for, as wavelengths: "633nm", or "rgb" for the three of Defaults.
CLI::Option* add_wavelengths(CLI::App* command, std::vector<double>& wavelengths);

/// Where light of a wavelength belongs in a picture: 0 red, 1 green, 2 blue.
std::size_t colour_of(double wavelength);

}  // namespace hogel::cli
