// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "hogel/exchange.h"

namespace hogel {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Device templates of the maker's software.
constexpr const char* toolkit =
    "https://github.com/Looking-Glass/LKG-Toolkit/blob/0b6209bfa83c8eda5dd862666d4af83bd9e1ec67/Toolkit-API/"
    "Implementations/Core/HardCodedLKGDeviceTemplates.cs";
// What the display itself reports; the toolkit has 5999x5999 pixels of 7x7 tiles.
constexpr const char* reported = "https://github.com/regcs/AliceLG/pull/147";

}  // namespace

Table<QuiltDisplay>& quilt_displays() {
    static Table<QuiltDisplay> table("display for quilts",
                                     {{"lkg-portrait", 8, 6, 3360, 3360, 0.75, 40 * degree, toolkit},
                                      {"lkg-go", 11, 6, 4092, 4092, 0.5625, 54 * degree, toolkit},
                                      {"lkg-16-portrait", 11, 6, 5995, 6000, 0.5625, 50 * degree, toolkit},
                                      {"lkg-16-landscape", 8, 6, 7680, 4320, 1.77778, 50 * degree, reported},
                                      {"lkg-32-portrait", 11, 6, 8184, 8184, 0.5625, 54 * degree, toolkit},
                                      {"lkg-32-landscape", 7, 7, 8190, 8190, 1.77778, 50 * degree, toolkit},
                                      {"lkg-65", 8, 9, 8192, 8192, 1.77778, 40 * degree, toolkit},
                                      {"lkg-8.9", 5, 9, 4096, 4096, 1.6, 40 * degree, toolkit},
                                      {"lkg-15.6", 5, 9, 4096, 4096, 1.77778, 40 * degree, toolkit},
                                      {"lkg-8k", 5, 9, 8192, 8192, 1.77778, 40 * degree, toolkit}},
                                     "device");
    return table;
}

}  // namespace hogel
